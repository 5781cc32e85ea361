//! The lines that are exchanged with a program: a header, then a question and an answer for each launch. They are plain
//! numbers between commas, which every language reads without a library.
//!
//! An answer repeats the number of its question. Without it, one line too many on standard output would shift all
//! answers that follow, and an answer to another launch would be taken for a wrong one.

use dynamics::Body;
use dynamics::body_rate::rate_by_momentum;
use numerics::DoubleDouble;
use numerics::scale::power_of_two_scale;
use toss::{Attitude, State, Toss, Vector3};

use crate::measure::diagnosis::{Numbers, turned_back};

/// The names of the columns of a question, which are the first line that a program reads: the number of the question;
/// the moments of inertia about z and x; the body rate (BF); the unit quaternion of the attitude at launch (from BF to
/// LF); the time of flight; the tolerance; the moment about y. A program that reads columns by their names may be given
/// more of them.
pub const HEADER: &str = "id,i1,i3,rate_x,rate_y,rate_z,w,x,y,z,time,tolerance,i2";

/// The sizes of the largest component of a rate (rad/s) that are asked for in seconds. At other rates the unit of time is
/// chosen so that it is 1 to 2: a coin that turns by 1e-228 rad/s for 1e228 s has rates far below any absolute tolerance,
/// and an ordinary integrator returns them wrong without an error.
const IN_SECONDS: std::ops::RangeInclusive<f64> = 1e-3..=1e3;

/// The finest tolerance that is asked for in seconds.
const FINEST: f64 = 1e-13;

/// What a program answered: a landing, or that it has none, in its own words.
pub(super) type Reply = Result<Landed, String>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Landed {
    /// (w, x, y, z).
    pub(super) quaternion: [f64; 4],
    pub(super) rate: Option<[f64; 3]>,
    /// The error of cos θ that the program claims.
    pub(super) error: Option<f64>,
    /// Calls of the right-hand side; 0 if the program does not count them.
    pub(super) calls: u64,
    /// Whether the program says that it takes bodies with three moments.
    pub(super) takes_bodies: bool,
}

/// Where a toss lands, in the axes and the units in which a program is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Question {
    /// I1, I2, I3 in a unit that is a power of two (kg m²), so that their ratios keep every digit.
    moments: [f64; 3],
    /// ω in `unit`.
    rate: Vector3<f64>,
    attitude: Attitude,
    /// In 1/`unit`.
    time: f64,
    tolerance: f64,
    /// 1 rad/s, or the power of two at or below the largest component of ω.
    unit: f64,
    /// From the axes of the question to BF, of a body whose principal axes are others than those of BF.
    axes: Option<Attitude>,
}

impl Question {
    /// The question where `toss` lands by steps of this `tolerance`, absolute and relative, at rates of the size of 1.
    pub(crate) fn new(toss: &Toss, tolerance: f64) -> Self {
        let (largest, seconds) = (toss.launch.rate().amax(), toss.launch.flight_time());
        let scale = power_of_two_at_or_below(largest);
        // Rates below 1 are to be as accurate relative to their size.
        let absolute = tolerance * scale.min(1.0);
        let is_in_seconds = IN_SECONDS.contains(&largest) && absolute >= FINEST;
        let (unit, tolerance) = if is_in_seconds { (1.0, absolute) } else { (scale, tolerance) };
        let time = seconds * unit;
        let (moments, axes) = match toss.body {
            Body::Coin(coin) => {
                let unit = power_of_two_scale(coin.i1()).clamp(1e-30, 1e30);
                ([unit, unit, unit * coin.inertia_ratio()], None)
            }
            Body::Rigid(_) => moments_and_axes(&toss.body),
        };
        let rate = toss.launch.rate() / unit;
        let rate = axes.map_or(rate, |axes| axes.lab_to_body(&rate));
        let launched = toss.launch.attitude();
        let attitude = axes.map_or(launched, |axes| launched * axes);
        Self { moments, rate, attitude, time, tolerance, unit, axes }
    }

    /// The columns behind the number of the question.
    pub(super) fn line(&self) -> String {
        let ([i1, i2, i3], [w, x, y, z]) = (self.moments, self.attitude.components());
        let [a, b, c] = <[f64; 3]>::from(self.rate);
        let numbers = [i1, i3, a, b, c, w, x, y, z, self.time, self.tolerance, i2];
        numbers.map(|number| format!("{number:?}")).join(",")
    }

    /// What is asked, for a diagnosis.
    pub(crate) fn numbers(&self) -> Numbers {
        let axes = self.axes.unwrap_or(Attitude::IDENTITY);
        Numbers::new(self.moments, self.rate.into(), self.time, self.attitude.components()).about(axes)
    }

    /// Whether the attitude and the moments are those of the question only to rounding.
    pub(super) fn is_rounded(&self) -> bool {
        self.axes.is_some()
    }

    /// The components of an answered quaternion, which leads from BF to LF.
    pub(crate) fn in_body(&self, quaternion: [f64; 4]) -> [f64; 4] {
        self.axes.map_or(quaternion, |axes| turned_back(quaternion, axes))
    }

    /// The state at landing with this `attitude` (from BF to LF) and, if it was answered, this rate in the axes and the
    /// unit of the question. Else the rate is that with which the body has the angular momentum of the launch.
    pub(super) fn state(&self, toss: &Toss, attitude: Attitude, rate: Option<[f64; 3]>) -> State {
        let rate = match (rate, toss.coin()) {
            (None, Some(coin)) => return State { attitude, rate: rate_by_momentum(&coin, &attitude) },
            (None, None) => self.rate_by_momentum(attitude),
            (Some(rate), _) => rate.into(),
        };
        let in_body = self.axes.map_or(rate, |axes| axes.body_to_lab(&rate));
        State { attitude, rate: in_body * self.unit }
    }

    /// The rate at landing along the axes of the question, in its unit.
    fn rate_by_momentum(&self, attitude: Attitude) -> Vector3<f64> {
        let moments = Vector3::from(self.moments);
        let momentum = self.attitude.body_to_lab(&moments.component_mul(&self.rate));
        let landed = self.axes.map_or(attitude, |axes| attitude * axes).lab_to_body(&momentum);
        // No torque acts about the axis of a rod.
        let along = |part: usize| {
            if self.moments[part] > 0.0 { landed[part] / self.moments[part] } else { self.rate[part] }
        };
        Vector3::new(along(0), along(1), along(2))
    }
}

/// The power of two at or below `largest` ≥ 0, which may be subnormal; 1 for 0.
fn power_of_two_at_or_below(largest: f64) -> f64 {
    // The bits of a subnormal number are a multiple of the smallest one.
    if largest.is_subnormal() { f64::from_bits(1 << largest.to_bits().ilog2()) } else { power_of_two_scale(largest) }
}

/// The moments of a body, the largest of the size of 1 to 2, and their axes where they are not those of BF.
fn moments_and_axes(body: &Body) -> ([f64; 3], Option<Attitude>) {
    let scaled = |moments: [f64; 3]| {
        let unit = power_of_two_scale(moments.into_iter().fold(0.0, f64::max));
        moments.map(|moment| moment / unit)
    };
    if let Some(moments) = body.moments() {
        return (scaled(moments), None);
    }
    let axes = body.rigid().principal().axes.map(|axis| Vector3::from(axis.map(DoubleDouble::hi)));
    let turn = nalgebra::Rotation3::from_matrix_unchecked(nalgebra::Matrix3::from_columns(&axes));
    let turn = nalgebra::UnitQuaternion::from_rotation_matrix(&turn);
    let turn = Attitude::from_components([turn.w, turn.i, turn.j, turn.k]).unwrap_or(Attitude::IDENTITY);
    (scaled(body.principal_moments()), Some(turn))
}

pub(super) fn numbered(number: u64, question: &str) -> String {
    format!("{number},{question}")
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
    let mut landing = Landed { quaternion: [0.0; 4], rate: None, error: None, calls: 0, takes_bodies: false };
    for (part, text) in landing.quaternion.iter_mut().zip([w, x, y, z]) {
        *part = number_in(text)?;
    }
    for (index, field) in fields.iter().enumerate() {
        let name = field.split_once('=').map(|(name, _)| name);
        if fields[..index].iter().any(|other| other.split_once('=').map(|(name, _)| name) == name) {
            return Err(format!("a second '{field}'"));
        }
        match field.split_once('=') {
            Some(("error", text)) => landing.error = Some(number_in(text)?),
            Some(("calls", text)) => {
                landing.calls = text.parse().map_err(|_| format!("'{text}' is no number of calls"))?;
            }
            Some(("rate", text)) => landing.rate = Some(rate_in(text)?),
            Some(("bodies", "yes")) => landing.takes_bodies = true,
            _ => {
                return Err(format!(
                    "'{field}' where error=NUMBER, calls=NUMBER, rate=X;Y;Z or bodies=yes is expected"
                ));
            }
        }
    }
    Ok(Ok(landing))
}

fn rate_in(text: &str) -> Result<[f64; 3], String> {
    let parts: Vec<f64> = text.split(';').map(|part| number_in(part.trim())).collect::<Result<_, _>>()?;
    parts.try_into().map_err(|_| format!("rate={text} where rate=X;Y;Z is expected"))
}

fn require_id(text: &str, id: u64) -> Result<(), String> {
    if text == id.to_string() { Ok(()) } else { Err(format!("it begins with '{text}', not with the number {id}")) }
}

fn number_in(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("'{text}' is no number"))
}

#[cfg(test)]
mod tests {
    use toss::{Coin, Launch, TimeOfFlight};

    use super::*;

    fn asked(toss: &Toss, tolerance: f64) -> String {
        Question::new(toss, tolerance).line()
    }

    #[test]
    fn a_question_has_the_columns_of_the_header_with_every_bit_of_the_toss() {
        for (size, unit, moment, expected) in [
            // In seconds, with the moments of the coin to a power of two.
            (1.0, 1.0, 0.75, "0.5,0.25,0.1,-2e-30,1.5,1.0,0.0,0.0,0.0,0.3333333333333333,1e-9,0.5"),
            // A slow coin needs a finer absolute tolerance.
            (
                2f64.powi(-4),
                1.0,
                1.0,
                "1.0,0.5,0.00625,-1.25e-31,0.09375,1.0,0.0,0.0,0.0,0.3333333333333333,6.25e-11,1.0",
            ),
            // Rates of no ordinary size have a unit of their own.
            (
                2f64.powi(-757),
                2f64.powi(757),
                1.0,
                "1.0,0.5,0.1,-2e-30,1.5,1.0,0.0,0.0,0.0,0.3333333333333333,1e-9,1.0",
            ),
            // Subnormal ones, too, which have fewer digits.
            (
                f64::from_bits(1 << 16),
                2f64.powi(1023),
                1.0,
                "1.0,0.5,0.100006103515625,-0.0,1.5,1.0,0.0,0.0,0.0,9.701276818911234e-12,1e-9,1.0",
            ),
        ] {
            let rate = Vector3::new(0.1, -2e-30, 1.5) * size;
            let launch = Launch::new(rate, TimeOfFlight::Given(unit / 3.0)).unwrap();
            let line = asked(&Toss::new(Coin::from_moments(moment, 0.5 * moment).unwrap(), launch), 1e-9);
            assert_eq!(line, expected);
            assert_eq!(line.split(',').count() + 1, HEADER.split(',').count());
        }
    }

    /// A body given by its moments keeps its axes; of a tensor, the program is asked in its principal axes.
    #[test]
    fn the_answer_about_principal_axes_is_that_about_the_axes_of_the_body() {
        let launch = Launch::new([1.5, -0.5, 1.0], TimeOfFlight::Given(0.5)).unwrap();
        let launch = launch.with_attitude(Attitude::from_components([0.5, -0.1, 0.7, 0.4]).unwrap());
        let given = Toss::new(Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch);
        assert!(asked(&given, 1e-9).starts_with("0.5,1.25,1.5,-0.5,1.0,") && asked(&given, 1e-9).ends_with(",1.0"));
        let tensor = Body::from_inertia([2.0, 2.2, 1.4, 0.3, -0.1, 0.25]).unwrap();
        for toss in [given, Toss::new(tensor, launch)] {
            let question = Question::new(&toss, 1e-9);
            let launched = question.in_body(question.attitude.components());
            let attitude = Attitude::from_components(launched).unwrap();
            assert!(attitude.angle_to(&toss.launch.attitude()) < 1e-15);
            for rate in [None, Some(question.rate.into())] {
                let state = question.state(&toss, attitude, rate);
                assert!((state.rate - toss.launch.rate()).norm() < 1e-14, "{state:?}");
            }
        }
    }

    #[test]
    fn an_answer_is_read_with_and_without_its_optional_fields() {
        let landing = |error, calls| {
            Ok(Landed { quaternion: [0.5, -0.5, 5e-1, -5e-1], rate: None, error, calls, takes_bodies: false })
        };
        assert_eq!(answer("7,0.5,-.5,5e-1,-5E-01\r", 7), Ok(landing(None, 0)));
        assert_eq!(answer("7, 0.5, -0.5, 0.5, -0.5, calls=12, error=1e-9", 7), Ok(landing(Some(1e-9), 12)));
        assert_eq!(answer("7,failed,too fast, sorry", 7), Ok(Err("too fast, sorry".to_owned())));
        let Ok(Ok(of_body)) = answer("7,1,0,0,0,rate=1;-2; 3e0,bodies=yes", 7) else { panic!("it is an answer") };
        assert_eq!((of_body.rate, of_body.takes_bodies), (Some([1.0, -2.0, 3.0]), true));
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
            ("7,0.5,0.5,0.5,0.5,rate=1;2", "rate=1;2 where rate=X;Y;Z"),
            ("7,0.5,0.5,0.5,0.5,rate=1;2;c", "'c' is no number"),
            ("7,0.5,0.5,0.5,0.5,calls=-1", "'-1' is no number of calls"),
            ("7,0.5,0.5,0.5,0.5,calls=1,error=1e-9,calls=2", "a second 'calls=2'"),
            (HEADER, "it begins with 'id'"),
        ] {
            let error = answer(line, 7).unwrap_err();
            assert!(error.contains(why), "{line}: {error}");
        }
    }
}
