//! A case: a toss that a row can name in full and the command line can repeat.

use toss::{TimeOfFlight, Toss};

use crate::subject::Subject;

/// A toss from a coin turned about the lab's x axis, as the command line can repeat it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// The toss.
    pub toss: Toss,
    /// The turn at launch (rad).
    pub tilt: f64,
}

impl Case {
    /// All inputs as hex floats.
    pub fn hex(&self) -> String {
        let Toss { coin, launch } = self.toss;
        let rate = launch.rate();
        let mut fields = vec![
            ("i1", coin.i1()),
            ("i3", coin.i3()),
            ("rate_x", rate.x),
            ("rate_y", rate.y),
            ("rate_z", rate.z),
            ("tilt", self.tilt),
        ];
        match launch.time_of_flight() {
            TimeOfFlight::Given(time) => fields.push(("time", time)),
            TimeOfFlight::Ballistic { speed, gravity } => {
                fields.extend([("speed", speed), ("gravity", gravity)]);
            }
        }
        fields.iter().map(|(name, value)| format!("{name}={}", hex_float(*value))).collect::<Vec<_>>().join(" ")
    }

    /// The command that repeats this toss by `subject`.
    pub fn replay(&self, subject: &Subject) -> String {
        let Toss { coin, launch } = self.toss;
        let rate = launch.rate();
        let flight = match launch.time_of_flight() {
            TimeOfFlight::Given(time) => format!("--time {time:?}"),
            TimeOfFlight::Ballistic { speed, gravity } => format!("--speed {speed:?} --gravity {gravity:?}"),
        };
        format!(
            "cargo run -q --release --bin unfair-toss -- toss --moments {:?},{:?} --rate {:?},{:?},{:?} {flight} \
             --tilt {:?} {}",
            coin.i1(),
            coin.i3(),
            rate.x,
            rate.y,
            rate.z,
            self.tilt,
            subject.options()
        )
    }
}

/// `value` as a hexadecimal floating-point literal of C99, which holds every bit.
fn hex_float(value: f64) -> String {
    let bits = value.to_bits();
    let (fraction, exponent) = (bits & 0x000f_ffff_ffff_ffff, (bits >> 52) & 0x7ff);
    let sign = if value.is_sign_negative() { "-" } else { "" };
    match (exponent, fraction) {
        (0, 0) => format!("{sign}0x0p+0"),
        (0, _) => format!("{sign}0x0.{fraction:013x}p-1022"),
        _ => format!("{sign}0x1.{fraction:013x}p{:+}", exponent.cast_signed() - 1023),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_floats_hold_every_bit() {
        assert_eq!(hex_float(1.0), "0x1.0000000000000p+0");
        assert_eq!(hex_float(-0.1), "-0x1.999999999999ap-4");
        assert_eq!(hex_float(5e-324), "0x0.0000000000001p-1022");
        assert_eq!(hex_float(-0.0), "-0x0p+0");
        assert_eq!(hex_float(f64::MAX), "0x1.fffffffffffffp+1023");
    }
}
