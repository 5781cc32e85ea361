//! The lines that are exchanged with a program: a header, then a question and an answer for each launch. They are plain
//! numbers between commas, which every language reads without a library.
//!
//! An answer repeats the number of its question. Without it, one line too many on standard output would shift all
//! answers that follow, and an answer to another launch would be taken for a wrong one.

use dynamics::Flight;
use toss::CoinToss;

/// The names of the columns of a question, which are the first line that a program reads: the number of the question;
/// the moments of inertia; the body rate (BF); the unit quaternion of the attitude at launch (from BF to LF); the time of
/// flight; the tolerance.
///
/// The units of mass and time depend on the toss: I1 is 1, and the largest component of the body rate is between 1 and
/// 2. The landing does not depend on them, but the steps of a program do. In SI units a coin that turns by 1e-228 rad/s
/// for 1e228 s has rates far below any absolute tolerance, and an ordinary integrator returns them wrong without an
/// error.
pub const HEADER: &str = "id,i1,i3,rate_x,rate_y,rate_z,w,x,y,z,time,tolerance";

/// What a program answered: a landing, or that it has none, in its own words.
pub(super) type Reply = Result<Landed, String>;

/// An attitude at landing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Landed {
    /// (w, x, y, z), as it was answered.
    pub(super) quaternion: [f64; 4],
    /// The error of cos θ that the program claims.
    pub(super) error: Option<f64>,
    /// Calls of the right-hand side; 0 if the program does not count them.
    pub(super) calls: u64,
}

/// A question without its number: where `toss`, whose dimensionless form is `flight`, lands by steps of this `tolerance`.
pub(super) fn question(toss: &CoinToss, flight: &Flight, tolerance: f64) -> String {
    let [w, x, y, z] = toss.launch.attitude().components();
    let (rate, time) = (flight.rate, flight.span());
    let numbers = [1.0, toss.coin.inertia_ratio(), rate.x, rate.y, rate.z, w, x, y, z, time, tolerance];
    numbers.map(|number| format!("{number:?}")).join(",")
}

/// The answer in `line` to the question number `id`.
pub(super) fn answer(line: &str, id: u64) -> Result<Reply, String> {
    let columns: Vec<&str> = line.trim().split(',').map(str::trim).collect();
    if let [number, "failed", ..] = columns[..] {
        require_id(number, id)?;
        return Ok(Err(columns[2..].join(", ")));
    }
    let [number, w, x, y, z, ref fields @ ..] = columns[..] else {
        return Err(format!("{} columns where {id},w,x,y,z is expected", columns.len()));
    };
    require_id(number, id)?;
    let mut landing = Landed { quaternion: [0.0; 4], error: None, calls: 0 };
    for (part, text) in landing.quaternion.iter_mut().zip([w, x, y, z]) {
        *part = number_in(text)?;
    }
    for field in fields {
        match field.split_once('=') {
            Some(("error", text)) => landing.error = Some(number_in(text)?),
            Some(("calls", text)) => {
                landing.calls = text.parse().map_err(|_| format!("'{text}' is no number of calls"))?;
            }
            _ => return Err(format!("'{field}' where error=NUMBER or calls=NUMBER is expected")),
        }
    }
    Ok(Ok(landing))
}

fn require_id(text: &str, id: u64) -> Result<(), String> {
    if text == id.to_string() { Ok(()) } else { Err(format!("it begins with '{text}', not with the number {id}")) }
}

fn number_in(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("'{text}' is no number"))
}

#[cfg(test)]
mod tests {
    use toss::{Coin, Launch, TimeOfFlight, Vector3};

    use super::*;

    #[test]
    fn a_question_has_the_columns_of_the_header_with_every_bit_of_the_scaled_toss() {
        for [size, unit] in [[1.0, 1.0], [2f64.powi(-757), 2f64.powi(757)]] {
            let rate = Vector3::new(0.1, -2e-30, 1.5) * size;
            let launch = Launch::new(rate, TimeOfFlight::Given(unit / 3.0)).unwrap();
            let toss = CoinToss { coin: Coin::from_moments(5e-7, 2.5e-7).unwrap(), launch };
            let line = question(&toss, &Flight::new(&toss.into()).unwrap(), 1e-9);
            assert_eq!(line, "1.0,0.5,0.1,-2e-30,1.5,1.0,0.0,0.0,0.0,0.3333333333333333,1e-9");
            assert_eq!(line.split(',').count() + 1, HEADER.split(',').count());
        }
    }

    #[test]
    fn an_answer_is_read_with_and_without_its_optional_fields() {
        let landing = |error, calls| Ok(Landed { quaternion: [0.5, -0.5, 5e-1, -5e-1], error, calls });
        assert_eq!(answer("7,0.5,-.5,5e-1,-5E-01\r", 7), Ok(landing(None, 0)));
        assert_eq!(answer("7, 0.5, -0.5, 0.5, -0.5, calls=12, error=1e-9", 7), Ok(landing(Some(1e-9), 12)));
        assert_eq!(answer("7,failed,too fast, sorry", 7), Ok(Err("too fast, sorry".to_owned())));
        // NaN is a number to the protocol; the solver refuses it.
        assert!(matches!(answer("7,nan,0,0,inf", 7), Ok(Ok(_))));
    }

    #[test]
    fn a_line_that_is_no_answer_says_why() {
        for (line, why) in [
            ("", "1 columns where 7,w,x,y,z is expected"),
            ("y", "1 columns"),
            ("0.5,0.5,0.5,0.5", "4 columns"),
            ("6,0.5,0.5,0.5,0.5", "it begins with '6', not with the number 7"),
            ("6,failed,words", "it begins with '6'"),
            ("7,0.5,0.5,0.5,half", "'half' is no number"),
            ("7,0.5,0.5,0.5,0.5,1e-9", "'1e-9' where error=NUMBER"),
            ("7,0.5,0.5,0.5,0.5,calls=-1", "'-1' is no number of calls"),
            (HEADER, "it begins with 'id'"),
        ] {
            let error = answer(line, 7).unwrap_err();
            assert!(error.contains(why), "{line}: {error}");
        }
    }
}
