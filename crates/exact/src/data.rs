//! Certificates, margins and sensitivities as plain data for records. They are written and never read: a file proves
//! nothing, and only the code of this crate makes a certificate.

use dynamics::Outcome;
use serde::{Serialize, Serializer};

use crate::certificate::{Certificate, ProvenCounts, Stage};
use crate::margin::Margin;
use crate::sensitivity::Sensitivity;

/// The [name](Stage::name).
impl Serialize for Stage {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.name())
    }
}

/// `{ outcome, stage }`.
impl Serialize for Certificate {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data {
            outcome: Outcome,
            stage: Stage,
        }
        Data { outcome: self.outcome(), stage: self.stage() }.serialize(to)
    }
}

/// `{ heads, tails, ties }`, and `by`: a list of each stage with the number of outcomes that it decided.
impl Serialize for ProvenCounts {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data {
            heads: u64,
            tails: u64,
            ties: u64,
            by: [(Stage, u64); Stage::ALL.len()],
        }
        let by = Stage::ALL.map(|stage| (stage, self.by(stage)));
        Data { heads: self.heads(), tails: self.tails(), ties: self.ties(), by }.serialize(to)
    }
}

/// `{ time, speed, gravity, tilt, rate, rate_range, time_range }` in s, m/s, m/s², rad and rad/s. What no change flips is
/// null, and so is a range that is infinite.
impl Serialize for Margin {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data {
            time: Option<f64>,
            speed: Option<f64>,
            gravity: Option<f64>,
            tilt: Option<f64>,
            rate: [Option<f64>; 3],
            rate_range: [f64; 3],
            time_range: [Option<f64>; 2],
        }
        let &Self { time, speed, gravity, tilt, rate, rate_range, time_range } = self;
        let time_range = time_range.map(|range| Some(range).filter(|range| range.is_finite()));
        Data { time, speed, gravity, tilt, rate, rate_range, time_range }.serialize(to)
    }
}

/// `{ attitude, cos_tilt }`: derivatives with respect to ωx, ωy, ωz and T, of the attitude a list of three for each input.
impl Serialize for Sensitivity {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data {
            attitude: [[f64; 3]; 4],
            cos_tilt: [f64; 4],
        }
        Data { attitude: self.attitude.into(), cos_tilt: self.cos_tilt.into() }.serialize(to)
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, CoinToss, Launch, TimeOfFlight, Tosses};
    use serde_json::{json, to_value};

    use super::*;
    use crate::batch::Batch;
    use crate::certified::certify_coin;
    use crate::margin::margin_coin;

    /// The paper's cheated toss, with the margins of `docs/paper-audit.md`.
    #[test]
    fn proofs_margins_and_sensitivities_are_written_with_the_names_of_their_fields() {
        let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
        let toss = CoinToss { coin: Coin::PAPER, launch: Launch::new([1.0, 1.0, 2.5], thrown).unwrap() };
        let certificate = to_value(certify_coin(&toss).unwrap()).unwrap();
        assert_eq!(certificate, json!({ "outcome": "heads", "stage": "f64" }));
        let margin = to_value(margin_coin(&toss).unwrap()).unwrap();
        assert!((margin["speed"].as_f64().unwrap() - 3.4123).abs() < 1e-4, "{margin}");
        assert_eq!((&margin["rate"][2], &margin["rate_range"][2]), (&json!(null), &json!(1000.0)));
        let sensitivity = Sensitivity::new(&toss.into()).unwrap();
        let written = to_value(sensitivity).unwrap();
        assert_eq!(written["attitude"][3][0].as_f64(), Some(sensitivity.attitude[(0, 3)]));
        assert_eq!(written["cos_tilt"][2].as_f64(), Some(sensitivity.cos_tilt[2]));
        let columns = [&[1.0, 9.0][..], &[1.0, 9.0], &[2.5, 0.0]];
        let attitude = toss.launch.attitude();
        let tosses = Tosses::new(toss.coin, attitude, 9.81, columns, &[3.0, 3.0]).unwrap();
        let counts = to_value(Batch::new(tosses).count().unwrap()).unwrap();
        assert_eq!((&counts["ties"], &counts["by"][0]), (&json!(0), &json!(["f64", 2])));
        assert_eq!(counts["heads"].as_u64().unwrap() + counts["tails"].as_u64().unwrap(), 2);
    }

    #[test]
    fn stages_are_found_by_their_names() {
        for stage in Stage::ALL {
            assert_eq!(stage.to_string().parse(), Ok(stage));
        }
        assert_eq!("guess".parse::<Stage>().unwrap_err().field(), "stage");
    }
}
