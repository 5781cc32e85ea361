//! The text of a toss, such as `moments=5e-7,2.5e-7 rate=1.0,1.0,2.5 time=0.5 tilt=0.0`. The report writes down every worst
//! case in this form, and the option `--replay` reads it back to the same toss. Its fields are those of
//! [`Thrown`], which keeps each number in the unit that it was given in.

use anyhow::{anyhow, bail, ensure};
use dynamics::thrown::Field;
use dynamics::{Thrown, Toss};
use toss::{Launch, StepControl};

use crate::measure::subject::Subject;

/// All that the toss was given by, as `NAME=VALUE` fields.
pub(crate) fn text(toss: &Toss) -> String {
    Thrown::of(toss).text()
}

/// The tolerance or the step of `subject`, as a field behind the text of a toss; empty for a closed form.
pub(crate) fn settings(subject: &Subject) -> String {
    match subject.stepping.map(|stepping| stepping.control()) {
        Some(StepControl::Tolerance(tolerance)) => format!(" tolerance={tolerance:?}"),
        Some(StepControl::Step(step)) => format!(" step={step:?}"),
        None => String::new(),
    }
}

/// Reads a toss from fields as a row prints them. What follows a `#` is a comment. A launch without a tilt is horizontal,
/// and without a body it is that of the paper's coin.
///
/// # Errors
/// If a field is missing, unknown or can't be read, or the toss is invalid.
pub fn read(text: &str) -> anyhow::Result<Toss> {
    read_with_settings(text).and_then(|(toss, control)| {
        ensure!(control.is_none(), "a toss has no tolerance and no step");
        Ok(toss)
    })
}

/// As [`read`], with the tolerance or the step of the solvers that fly the toss, if one is given.
///
/// # Errors
/// As [`read`], and if both are given. Whether their sizes are valid is for a scheme to say.
pub fn read_with_settings(text: &str) -> anyhow::Result<(Toss, Option<StepControl>)> {
    let (mut thrown, mut control) = (Thrown::default(), None);
    for field in text.split_once('#').map_or(text, |(fields, _)| fields).split_whitespace() {
        let Some((name, value)) = field.split_once('=') else { bail!("'{field}' is no NAME=VALUE") };
        let number = || value.parse().map_err(|_| anyhow!("{name}: '{value}' is no number"));
        let own = match name {
            "tolerance" => StepControl::Tolerance(number()?),
            "step" => StepControl::Step(number()?),
            name => {
                thrown.set(Field::named(name)?, value)?;
                continue;
            }
        };
        ensure!(control.replace(own).is_none(), "either a tolerance or a step is needed");
    }
    Ok((thrown.toss()?, control))
}

/// Whether the launch is horizontal, with heads up.
pub(crate) fn is_horizontal(launch: &Launch) -> bool {
    launch.tilt() == Some(0.0)
}

#[cfg(test)]
mod tests {
    use toss::{Attitude, Body, Coin, TimeOfFlight};

    use super::*;
    use crate::measure::adversary;

    #[test]
    fn a_toss_of_any_body_reads_back_from_its_text() {
        let thrown = [
            TimeOfFlight::Given(3.0),
            TimeOfFlight::Ballistic { speed: 0.1, gravity: 9.81 },
            TimeOfFlight::BallisticTo { speed: 0.1, gravity: 9.81, drop: 1.3 },
        ];
        let bodies = [
            Coin::DISC.into(),
            Coin::from_cylinder(0.003, 0.01874, 0.00114).unwrap().into(),
            Body::from_moments([1.0, 2.0, 2.25]).unwrap(),
            Body::from_inertia([2.0, 3.0, 4.0, 0.1, -0.2, 1e-300]).unwrap(),
        ];
        let launch = |flight| Launch::new([-0.0, 5e-324, f64::MAX], flight).unwrap();
        let launches = thrown.map(launch).into_iter();
        let turned = Attitude::from_components([0.5, -0.25, 1.0 / 3.0, 2.0]).unwrap();
        let launches = launches.flat_map(|level| [level, level.with_tilt(-0.1).unwrap(), level.with_attitude(turned)]);
        let tosses = launches.flat_map(|launch| bodies.map(|body| Toss { body, launch }));
        for toss in tosses.chain((0..500).map(|index| adversary::launch(3, index))) {
            assert_eq!(read(&text(&toss)).unwrap(), toss);
            for (more, control) in
                [(" tolerance=1e-9", StepControl::Tolerance(1e-9)), (" step=0.5", StepControl::Step(0.5))]
            {
                assert_eq!(read_with_settings(&(text(&toss) + more)).unwrap(), (toss, Some(control)));
                assert!(read(&(text(&toss) + more)).is_err());
            }
            assert!(read_with_settings(&(text(&toss) + " step=1 tolerance=1")).is_err());
            assert_eq!(read(&format!("{} # a remark", text(&toss))).unwrap(), toss);
        }
    }

    #[test]
    fn reading_a_broken_text_names_the_broken_field() {
        let line = "moments=1.0,0.5 rate=1.0,1.0,2.5 tilt=0.1 time=0.5";
        for (broken, message) in [
            (line.replace("rate", "rites"), "field = 'rites' is unknown; known: coin"),
            (line.replace("moments=1.0", "moments=0x3"), "moments = '0x3,0.5' can't be used"),
            (line.replace("1.0,1.0", "1.0"), "rate = '1.0,2.5' can't be used: expected WX,WY,WZ"),
            (line.replace("time=0.5", ""), "speed is missing"),
            (format!("{line} time=1.0"), "time = 'given twice'"),
            (format!("{line} spin"), "'spin' is no NAME=VALUE"),
            (line.replace("tilt=0.1", "tilt=0.1@1/0"), "tilt [rad] = '0.1@1/0' can't be used"),
            (line.replace("time=0.5", "time=0.5@1/3turn"), "time [s] = '0.5@1/3turn' can't be used"),
            (line.replace("moments=", "moments=-"), "I1"),
            (line.replace("moments=1.0,0.5", "moments=1.0,2.0,9.0"), "I3"),
            (format!("{line} step=x"), "step: 'x' is no number"),
        ] {
            let error = read(&broken).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
