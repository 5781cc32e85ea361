//! Verdicts, traces, choices of the planner and its answers as plain data. What may hold a proof is written and not read,
//! because a file proves nothing.

mod choice;

use dynamics::State;
use dynamics::error::require;
use dynamics::{Attitude, EulerAngles, Outcome};
use exact::Stage;
use kinematics_quat::IntegratedCertificate;
use serde::de::{Error, IgnoredAny};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::answer::Verdict;
use crate::trace::TracePoint;

/// `{ outcome, proven }`, and the `stage` of a proof.
impl Serialize for Verdict {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data {
            outcome: Outcome,
            proven: bool,
            #[serde(skip_serializing_if = "Option::is_none")]
            stage: Option<Stage>,
        }
        Data { outcome: self.outcome(), proven: self.is_proven(), stage: self.stage() }.serialize(to)
    }
}

/// `{ cos_tilt, error_bound, attitude, attitude_error_bound, rate }`, the rate in rad/s about the body's axes.
pub(crate) fn enclosed<S: Serializer>(found: &IntegratedCertificate, to: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Data {
        cos_tilt: f64,
        error_bound: f64,
        attitude: Attitude,
        attitude_error_bound: f64,
        rate: [f64; 3],
    }
    let State { attitude, rate } = found.landing().state;
    let (error_bound, attitude_error_bound) = (found.error_bound(), found.attitude_error_bound());
    Data { cos_tilt: found.cos_tilt(), error_bound, attitude, attitude_error_bound, rate: rate.into() }.serialize(to)
}

/// `{ time, cos_tilt, normal, face, attitude, angles }` in s and rad.
impl Serialize for TracePoint {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data {
            time: f64,
            cos_tilt: f64,
            normal: [f64; 3],
            face: [f64; 3],
            attitude: Attitude,
            angles: EulerAngles,
        }
        let &Self { time, attitude, angles, normal, face, cos_tilt } = self;
        Data { time, cos_tilt, normal: normal.into(), face: face.into(), attitude, angles }.serialize(to)
    }
}

/// Reads the time, the attitude and the angles. The rest follows from the attitude, and is not believed.
impl<'de> Deserialize<'de> for TracePoint {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Data {
            time: f64,
            attitude: Attitude,
            angles: EulerAngles,
            #[serde(rename = "cos_tilt")]
            _cos_tilt: Option<IgnoredAny>,
            #[serde(rename = "normal")]
            _normal: Option<IgnoredAny>,
            #[serde(rename = "face")]
            _face: Option<IgnoredAny>,
        }
        let Data { time, attitude, angles, .. } = Data::deserialize(from)?;
        require("time [s]", time, "finite and >= 0", time >= 0.0).map_err(D::Error::custom)?;
        let point = Self::new(time, attitude, &angles);
        let turn = angles.attitude().angle_to(&attitude);
        require("angles", turn, "those of the attitude, to 1e-9 rad", turn <= 1e-9).map_err(D::Error::custom)?;
        Ok(Self { angles, ..point })
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight, Toss};
    use exact::{ExactSolver, certify};
    use serde_json::{from_value, json, to_value};

    use super::*;
    use crate::trace::trace;

    fn toss() -> Toss {
        Toss::new(Coin::PAPER, Launch::new([9.0, 4.0, 3.0], TimeOfFlight::Given(1.5)).unwrap())
    }

    #[test]
    fn traces_are_read_back_to_the_bit_and_what_contradicts_the_attitude_is_refused() {
        let points = trace(&ExactSolver, &toss(), 50).unwrap();
        let written = to_value(&points).unwrap();
        assert_eq!(from_value::<Vec<TracePoint>>(written.clone()).unwrap(), points);
        for (field, value, message) in [
            ("time", json!(-1.0), "time [s] = -1.0 is outside"),
            ("angles", json!({ "alpha": 0.0, "beta": 0.1, "gamma": 0.0 }), "angles = "),
            ("attitude", json!([0, 0, 0, 0]), "attitude (largest component) = 0.0"),
            ("speed", json!(1), "unknown field `speed`"),
        ] {
            let mut point = written[7].clone();
            point[field] = value;
            let error = from_value::<TracePoint>(point).unwrap_err().to_string();
            assert!(error.starts_with(message), "{error}");
        }
    }

    #[test]
    fn a_verdict_says_whether_it_is_proven() {
        let proven = to_value(Verdict::Proven(certify(&toss()).unwrap())).unwrap();
        assert_eq!(
            (&proven["outcome"], &proven["proven"], &proven["stage"]),
            (&json!("tails"), &json!(true), &json!("f64"))
        );
        let estimated = to_value(Verdict::Estimated(Outcome::Tails)).unwrap();
        assert_eq!(estimated, json!({ "outcome": "tails", "proven": false }));
    }
}
