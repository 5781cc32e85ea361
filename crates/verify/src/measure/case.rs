//! The text of a toss, such as `i1=5e-7 i3=2.5e-7 rate=1.0,1.0,2.5 tilt=0.0 time=0.5`. The report writes down every worst
//! case in this form, and the option `--replay` reads it back to the same toss: the shortest decimals of an f64 that read
//! back are exact, and a number that was given in another unit stays in that unit. It is written behind the number, as a
//! ratio to the SI unit or as a part of a turn: `radius=24.26@1/1000` are millimetres, and `tilt=15.0@1/360turn` degrees.

use std::collections::BTreeMap;

use anyhow::{Context, anyhow, ensure};
use dynamics::{Body, Toss};
use toss::quantity::{Angle, AngleUnit, Quantity, Unit};
use toss::{Attitude, Coin, Launch, StepControl, TimeOfFlight};

use crate::measure::subject::Subject;

/// All that the toss was given by, as `NAME=VALUE` fields.
pub(crate) fn text(toss: &Toss) -> String {
    let body = match (toss.body.coin().map(|coin| (coin, coin.cylinder())), toss.body.moments()) {
        (Some((_, Some(cylinder))), _) => {
            let [mass, radius, thickness] = cylinder.map(|given| in_unit(given, AngleUnit::Radians(given.unit())));
            format!("mass={mass} radius={radius} thickness={thickness}")
        }
        (Some((coin, None)), _) => format!("i1={:?} i3={:?}", coin.i1(), coin.i3()),
        (None, Some(moments)) => format!("moments={}", list(&moments)),
        (None, None) => format!("inertia={}", list(&toss.body.inertia())),
    };
    let (rate, unit) = toss.launch.given_rate();
    let rate = list(&<[f64; 3]>::from(rate)) + &unit_text(unit);
    let attitude = match toss.launch.attitude().tilt() {
        Some(Angle::Radians(given)) => format!("tilt={}", in_unit(given, AngleUnit::Radians(given.unit()))),
        Some(Angle::Turns(given)) => format!("tilt={}", in_unit(given, AngleUnit::Turns(given.unit()))),
        None if is_horizontal(&toss.launch) => "tilt=0.0".to_owned(),
        None => format!("attitude={}", list(&toss.launch.attitude().given_components())),
    };
    let flight = flight(&toss.launch).map(|(name, value)| format!(" {name}={value:?}"));
    format!("{body} rate={rate} {attitude}{}", flight.collect::<String>())
}

/// A number with its unit.
fn in_unit(given: Quantity, unit: AngleUnit) -> String {
    format!("{:?}{}", given.value(), unit_text(unit))
}

/// The unit behind a number; nothing for the SI unit.
fn unit_text(unit: AngleUnit) -> String {
    match unit {
        AngleUnit::RADIAN => String::new(),
        AngleUnit::Radians(unit) => format!("@{}/{}", unit.numerator(), unit.denominator()),
        AngleUnit::Turns(unit) => format!("@{}/{}turn", unit.numerator(), unit.denominator()),
    }
}

/// The unit that [`unit_text`] writes, without the `@`.
fn read_unit(text: &str) -> Option<AngleUnit> {
    let (ratio, is_of_turns) = text.strip_suffix("turn").map_or((text, false), |ratio| (ratio, true));
    let (numerator, denominator) = ratio.split_once('/')?;
    let unit = Unit::ratio(numerator.parse().ok()?, denominator.parse().ok()?)?;
    Some(if is_of_turns { AngleUnit::Turns(unit) } else { AngleUnit::Radians(unit) })
}

/// The numbers that the time of flight was given by.
fn flight(launch: &Launch) -> impl Iterator<Item = (&'static str, f64)> {
    let [time, speed, gravity, drop] = match launch.time_of_flight() {
        TimeOfFlight::Given(time) => [Some(time), None, None, None],
        TimeOfFlight::Ballistic { speed, gravity } => [None, Some(speed), Some(gravity), None],
        TimeOfFlight::BallisticTo { speed, gravity, drop } => [None, Some(speed), Some(gravity), Some(drop)],
    };
    let all = [("time", time), ("speed", speed), ("gravity", gravity), ("drop", drop)];
    all.into_iter().filter_map(|(name, value)| Some((name, value?)))
}

/// The tolerance or the step of `subject`, as a field behind the text of a toss; empty for a closed form.
pub(crate) fn settings(subject: &Subject) -> String {
    match subject.stepping.map(|stepping| stepping.control()) {
        Some(StepControl::Tolerance(tolerance)) => format!(" tolerance={tolerance:?}"),
        Some(StepControl::Step(step)) => format!(" step={step:?}"),
        None => String::new(),
    }
}

/// Reads a toss from fields as a row prints them. What follows a `#` is a comment; a launch without a tilt is horizontal.
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
    let mut fields = Fields::of(text.split_once('#').map_or(text, |(fields, _)| fields))?;
    let control = match (fields.take("tolerance")?, fields.take("step")?) {
        (Some([tolerance]), None) => Some(StepControl::Tolerance(tolerance)),
        (None, Some([step])) => Some(StepControl::Step(step)),
        (None, None) => None,
        (Some(_), Some(_)) => return Err(anyhow!("either a tolerance or a step is needed")),
    };
    let body = if let Some(moments) = fields.take("moments")? {
        Body::from_moments(moments)?
    } else if let Some(elements) = fields.take("inertia")? {
        Body::from_inertia(elements)?
    } else if let Some(mass) = fields.quantity("mass")? {
        let mut length = |name| fields.quantity(name)?.with_context(|| format!("{name} is missing"));
        Coin::from_cylinder(mass, length("radius")?, length("thickness")?)?.into()
    } else {
        Coin::from_moments(fields.one("i1")?, fields.one("i3")?)?.into()
    };
    let (rate, unit): ([f64; 3], AngleUnit) = fields.take_in_unit("rate")?.context("rate is missing")?;
    let attitude = match (fields.take("attitude")?, fields.take_in_unit("tilt")?) {
        (Some(components), None) => Attitude::from_components(components)?,
        (None, tilt) => {
            let tilt = tilt.map_or(0.0.into(), |([tilt], unit): ([f64; 1], AngleUnit)| unit.times(tilt));
            Launch::new(rate, TimeOfFlight::Given(0.0))?.with_tilt(tilt)?.attitude()
        }
        (Some(_), Some(_)) => return Err(anyhow!("either an attitude or a tilt is needed")),
    };
    let flight = match fields.take("time")? {
        Some([time]) => TimeOfFlight::Given(time),
        None => {
            let (speed, gravity) = (fields.one("speed")?, fields.one("gravity")?);
            TimeOfFlight::thrown(speed, gravity, fields.take("drop")?.map(|[drop]| drop))
        }
    };
    ensure!(fields.0.is_empty(), "unknown fields: {}", fields.0.into_keys().collect::<Vec<_>>().join(", "));
    Ok((Toss { body, launch: Launch::in_unit(rate, unit, flight)?.with_attitude(attitude) }, control))
}

/// Whether the launch is horizontal, with heads up.
pub(crate) fn is_horizontal(launch: &Launch) -> bool {
    let attitude = launch.attitude();
    attitude.tilt().map_or(attitude == Attitude::IDENTITY, |tilt| tilt.radians() == 0.0)
}

fn list(numbers: &[f64]) -> String {
    numbers.iter().map(|number| format!("{number:?}")).collect::<Vec<_>>().join(",")
}

/// Numbers and their unit by the name of their field.
struct Fields<'a>(BTreeMap<&'a str, (Vec<f64>, AngleUnit)>);

impl<'a> Fields<'a> {
    fn of(text: &'a str) -> anyhow::Result<Self> {
        let mut fields = BTreeMap::new();
        for field in text.split_whitespace() {
            let (name, values) = field.split_once('=').with_context(|| format!("'{field}' is no NAME=VALUE"))?;
            let number = |text: &str| text.parse().map_err(|_| anyhow!("{name}: '{text}' is no number"));
            let (values, unit) = match values.split_once('@') {
                Some((values, unit)) => {
                    (values, read_unit(unit).with_context(|| format!("{name}: '@{unit}' is no unit"))?)
                }
                None => (values, AngleUnit::RADIAN),
            };
            let numbers = values.split(',').map(number).collect::<anyhow::Result<_>>()?;
            ensure!(fields.insert(name, (numbers, unit)).is_none(), "{name} is given twice");
        }
        Ok(Self(fields))
    }

    fn take_in_unit<const N: usize>(&mut self, name: &str) -> anyhow::Result<Option<([f64; N], AngleUnit)>> {
        let Some((numbers, unit)) = self.0.remove(name) else { return Ok(None) };
        let found = numbers.len();
        let numbers = numbers.try_into().map_err(|_| anyhow!("{name}: {N} numbers are needed, not {found}"))?;
        Ok(Some((numbers, unit)))
    }

    /// Numbers in the SI unit.
    fn take<const N: usize>(&mut self, name: &str) -> anyhow::Result<Option<[f64; N]>> {
        let Some((numbers, unit)) = self.take_in_unit(name)? else { return Ok(None) };
        ensure!(unit == AngleUnit::RADIAN, "{name}: it has no unit but that of the SI");
        Ok(Some(numbers))
    }

    /// A length or a mass.
    fn quantity(&mut self, name: &str) -> anyhow::Result<Option<Quantity>> {
        match self.take_in_unit(name)? {
            Some(([value], AngleUnit::Radians(unit))) => Ok(Some(Quantity::new(value, unit))),
            Some(_) => Err(anyhow!("{name}: it is not counted in turns")),
            None => Ok(None),
        }
    }

    fn one(&mut self, name: &str) -> anyhow::Result<f64> {
        self.take(name)?.map(|[number]: [f64; 1]| number).with_context(|| format!("{name} is missing"))
    }
}

#[cfg(test)]
mod tests {
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
            assert_eq!(text(&read(&format!("{} # a remark", text(&toss))).unwrap()), text(&toss));
        }
    }

    #[test]
    fn a_toss_reads_back_in_the_units_that_it_was_given_in() {
        let [thousandth, degree, inch] = [(1, 1000), (1, 360), (127, 5000)].map(|(n, d)| Unit::ratio(n, d).unwrap());
        let coin = Coin::from_cylinder(
            Quantity::new(5.67, thousandth),
            Quantity::new(24.26, thousandth),
            Quantity::new(0.1, inch),
        );
        let launch = Launch::in_unit([2280.0, 0.1, -7.3], AngleUnit::Turns(degree), TimeOfFlight::Given(0.5)).unwrap();
        let tilts = [AngleUnit::Turns(degree).times(15.0), AngleUnit::Radians(thousandth).times(0.1)];
        for launch in tilts.map(|tilt| launch.with_tilt(tilt).unwrap()) {
            let toss = Toss { body: coin.clone().unwrap().into(), launch };
            assert_eq!(read(&text(&toss)).unwrap(), toss, "{}", text(&toss));
        }
        let text = text(&Toss { body: coin.unwrap().into(), launch: launch.with_tilt(tilts[0]).unwrap() });
        assert!(text.contains("radius=24.26@1/1000") && text.contains("tilt=15.0@1/360turn"), "{text}");
    }

    #[test]
    fn reading_a_broken_text_names_the_broken_field() {
        let line = "i1=1.0 i3=0.5 rate=1.0,1.0,2.5 tilt=0.1 time=0.5";
        for (broken, message) in [
            (line.replace("i3", "i2"), "i3 is missing"),
            (line.replace("i1=1.0", "i1=0x3"), "i1: '0x3' is no number"),
            (line.replace("1.0,1.0", "1.0"), "rate: 3 numbers are needed, not 2"),
            (line.replace("time", "speed"), "gravity is missing"),
            (format!("{line} i1=1.0"), "i1 is given twice"),
            (format!("{line} spin=0.0"), "unknown fields: spin"),
            (format!("{line} spin"), "'spin' is no NAME=VALUE"),
            (line.replace("tilt=0.1", "tilt=0.1@1/0"), "tilt: '@1/0' is no unit"),
            (line.replace("time=0.5", "time=0.5@1/1000"), "time: it has no unit but that of the SI"),
            (line.replace("i1=", "i1=-"), "I1"),
            (line.replace("i1=1.0 i3=0.5", "moments=1.0,2.0,9.0"), "I3"),
        ] {
            let error = read(&broken).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
