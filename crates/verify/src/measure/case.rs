//! A case is a toss that the report can write down in full and the command line can repeat. Hex floats hold every bit
//! of the inputs, so a failure can be reproduced exactly.

use std::collections::BTreeMap;

use anyhow::{Context, ensure};
use toss::quantity::Quantity;
use toss::{Coin, CoinToss, Launch, TimeOfFlight, Vector3};

use crate::measure::subject::Subject;

/// A toss whose attitude at launch is a turn about the laboratory's x axis, as the command line can repeat it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// The toss.
    pub toss: CoinToss,
    /// The tilt at launch (rad): the angle of that turn.
    pub tilt: f64,
}

impl Case {
    /// All inputs as `NAME=HEX` fields, separated by spaces.
    pub fn hex(&self) -> String {
        let CoinToss { coin, launch } = self.toss;
        let rate = launch.rate();
        let mut fields = match coin.cylinder().map(|given| given.map(Quantity::to_f64)) {
            None => vec![("i1", coin.i1()), ("i3", coin.i3())],
            Some([mass, radius, thickness]) => vec![("mass", mass), ("radius", radius), ("thickness", thickness)],
        };
        fields.extend([("rate_x", rate.x), ("rate_y", rate.y), ("rate_z", rate.z), ("tilt", self.tilt)]);
        match launch.time_of_flight() {
            TimeOfFlight::Given(time) => fields.push(("time", time)),
            TimeOfFlight::Ballistic { speed, gravity } => {
                fields.extend([("speed", speed), ("gravity", gravity)]);
            }
            TimeOfFlight::BallisticTo { speed, gravity, drop } => {
                fields.extend([("speed", speed), ("gravity", gravity), ("drop", drop)]);
            }
        }
        fields.iter().map(|(name, value)| format!("{name}={}", hex_float(*value))).collect::<Vec<_>>().join(" ")
    }

    /// Reads a case from a line that [`Case::hex`] wrote.
    ///
    /// # Errors
    /// If a field is missing, unknown or can't be read, or the toss is invalid.
    pub fn from_hex(line: &str) -> anyhow::Result<Self> {
        let mut fields = fields(line)?;
        let mut take = |name: &str| fields.remove(name).with_context(|| format!("{name} is missing"));
        let coin = match take("mass") {
            Ok(mass) => Coin::from_cylinder(mass, take("radius")?, take("thickness")?)?,
            Err(_) => Coin::from_moments(take("i1")?, take("i3")?)?,
        };
        let rate = Vector3::new(take("rate_x")?, take("rate_y")?, take("rate_z")?);
        let tilt = take("tilt")?;
        let time_of_flight = match take("time") {
            Ok(time) => TimeOfFlight::Given(time),
            Err(_) => {
                let (speed, gravity) = (take("speed")?, take("gravity")?);
                match take("drop") {
                    Ok(drop) => TimeOfFlight::BallisticTo { speed, gravity, drop },
                    Err(_) => TimeOfFlight::Ballistic { speed, gravity },
                }
            }
        };
        ensure!(fields.is_empty(), "unknown fields: {}", fields.into_keys().collect::<Vec<_>>().join(", "));
        let launch = Launch::new(rate, time_of_flight)?.with_tilt(tilt)?;
        Ok(Self { toss: CoinToss { coin, launch }, tilt })
    }

    /// The command of `unfair-toss` that solves this toss with the solver and settings of `subject`.
    pub fn command(&self, subject: &Subject) -> String {
        let CoinToss { coin, launch } = self.toss;
        let rate = launch.rate();
        let flight = match launch.time_of_flight() {
            TimeOfFlight::Given(time) => format!("--time {time:?}"),
            TimeOfFlight::Ballistic { speed, gravity } => format!("--speed {speed:?} --gravity {gravity:?}"),
            TimeOfFlight::BallisticTo { speed, gravity, drop } => {
                format!("--speed {speed:?} --gravity {gravity:?} --drop {drop:?}")
            }
        };
        let body = match coin.cylinder().map(|given| given.map(Quantity::to_f64)) {
            None => format!("--moments {:?},{:?}", coin.i1(), coin.i3()),
            Some([mass, radius, thickness]) => format!("--cylinder {mass:?},{radius:?},{thickness:?}"),
        };
        format!(
            "cargo run -q --release --bin unfair-toss -- toss {body} --rate {:?},{:?},{:?} {flight} --tilt {:?} {}",
            rate.x,
            rate.y,
            rate.z,
            self.tilt,
            subject.options()
        )
    }
}

/// The fields of a line of hex floats by their names.
///
/// # Errors
/// If a field can't be read, or is given twice.
pub(super) fn fields(line: &str) -> anyhow::Result<BTreeMap<&str, f64>> {
    let mut fields = BTreeMap::new();
    for field in line.split_whitespace() {
        let (name, text) = field.split_once('=').with_context(|| format!("'{field}' is no NAME=VALUE"))?;
        let value = from_hex_float(text).with_context(|| format!("{name}: '{text}' is no hex float"))?;
        ensure!(fields.insert(name, value).is_none(), "{name} is given twice");
    }
    Ok(fields)
}

/// `value` as a hexadecimal floating-point literal of C99, which keeps every bit.
pub(super) fn hex_float(value: f64) -> String {
    let bits = value.to_bits();
    let (fraction, exponent) = (bits & 0x000f_ffff_ffff_ffff, (bits >> 52) & 0x7ff);
    let sign = if value.is_sign_negative() { "-" } else { "" };
    match (exponent, fraction) {
        (0, 0) => format!("{sign}0x0p+0"),
        (0, _) => format!("{sign}0x0.{fraction:013x}p-1022"),
        _ => format!("{sign}0x1.{fraction:013x}p{:+}", exponent.cast_signed() - 1023),
    }
}

/// Reads a literal that [`hex_float`] wrote; `None` for anything else.
fn from_hex_float(text: &str) -> Option<f64> {
    let (sign, rest) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let (digits, exponent) = rest.strip_prefix("0x")?.split_once('p')?;
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, "0000000000000"));
    let (whole, exponent) = (whole.parse::<u64>().ok()?, exponent.parse::<i32>().ok()?);
    if fraction.len() != 13 || whole > 1 || !(-1022..=1023).contains(&exponent) {
        return None;
    }
    let fraction = u64::from_str_radix(fraction, 16).ok()?;
    let biased = if whole == 0 { 0 } else { u64::try_from(exponent + 1023).ok()? };
    Some(sign * f64::from_bits(biased << 52 | fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_survives_a_round_trip_through_its_hex_line() {
        for index in 0..500 {
            let case = crate::measure::adversary::launch(3, index).unwrap();
            assert_eq!(Case::from_hex(&case.hex()).unwrap(), case);
        }
        let thrown = [
            TimeOfFlight::Ballistic { speed: 0.1, gravity: 9.81 },
            TimeOfFlight::BallisticTo { speed: 0.1, gravity: 9.81, drop: 1.3 },
        ];
        for thrown in thrown {
            let launch = Launch::new(Vector3::new(-0.0, 5e-324, f64::MAX), thrown).unwrap();
            for coin in [Coin::DISC, Coin::from_cylinder(0.003, 0.01874, 0.00114).unwrap()] {
                let case = Case { toss: CoinToss { coin, launch }, tilt: 0.0 };
                assert_eq!(Case::from_hex(&case.hex()).unwrap(), case);
            }
        }
        assert_eq!(from_hex_float(&hex_float(-0.0)).unwrap().to_bits(), (-0.0_f64).to_bits());
    }

    #[test]
    fn reading_a_broken_hex_line_names_the_broken_field() {
        let line = crate::measure::adversary::launch(3, 0).unwrap().hex();
        let first = line.split_once(' ').unwrap().0;
        for (broken, message) in [
            (line.replace("tilt", "tlit"), "tilt is missing"),
            (line.replace("i1=0x1", "i1=0x3"), "i1: '0x3"),
            (format!("{line} {first}"), "i1 is given twice"),
            (format!("{line} spin=0x0p+0"), "unknown fields: spin"),
            (format!("{line} spin"), "'spin' is no NAME=VALUE"),
            (line.replace("i1=0x1", "i1=-0x1"), "I1"),
        ] {
            let error = Case::from_hex(&broken).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }

    #[test]
    fn hex_floats_keep_every_bit() {
        assert_eq!(hex_float(1.0), "0x1.0000000000000p+0");
        assert_eq!(hex_float(-0.1), "-0x1.999999999999ap-4");
        assert_eq!(hex_float(5e-324), "0x0.0000000000001p-1022");
        assert_eq!(hex_float(-0.0), "-0x0p+0");
        assert_eq!(hex_float(f64::MAX), "0x1.fffffffffffffp+1023");
    }
}
