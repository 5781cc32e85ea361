//! The ladder of models: from what needs no motion to what integrates it.

use serde::{Deserialize, Serialize};

/// A rung of the ladder, from the cheapest on, within a toss and within a space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Heads or tails by the cosine of Keller's coin. It stands before `certain`, though that costs less where it
    /// serves, because a toss is known to be Keller's or not at once.
    Keller,
    /// The face that no motion can change.
    Certain,
    /// Heads or tails by the phases that show heads, in f64.
    Heads,
    /// The cosine of Keller's coin with a compensated phase.
    KellerTilt,
    /// cos θ in f64 with a compensated phase.
    Tilt,
    /// Attitude in f64 with compensated phases.
    Attitude,
    /// cos θ to the last bit.
    TiltExact,
    /// Heads or tails in as many digits as it takes.
    HeadsExact,
    /// The flight, point by point to the last bits.
    Trace,
    /// The equations of motion, step by step.
    Integrator,
    /// The share of heads over a range of speeds, in closed form.
    Share,
    /// Such shares, averaged over Sobol points.
    ShareSobol,
    /// Outcomes of Sobol points.
    Sobol,
    /// Outcomes on a grid.
    Grid,
    /// Outcomes of random launches.
    Random,
}

/// What there is to know of a rung before it is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rung {
    /// The model.
    pub model: Model,
    /// Its name.
    pub name: &'static str,
    /// What it assumes.
    pub assumes: &'static str,
    /// What it gives.
    pub gives: &'static str,
}

const fn rung(model: Model, name: &'static str, assumes: &'static str, gives: &'static str) -> Rung {
    Rung { model, name, assumes, gives }
}

/// All rungs, in the order of [`Model`].
pub const LADDER: [Rung; 15] = [
    rung(Model::Keller, "keller", "ωz = 0, launched flat", "outcome, proven"),
    rung(
        Model::Certain,
        "certain",
        "a cone that never shows the other face, or a flight too short to",
        "outcome, proven",
    ),
    rung(Model::Heads, "heads", "cos θ further from 0 than f64 may be off", "outcome, proven"),
    rung(Model::KellerTilt, "keller-tilt", "ωz = 0, launched flat", "cos θ to the last bits"),
    rung(Model::Tilt, "tilt", "nothing", "cos θ to the last bits"),
    rung(Model::Attitude, "attitude", "nothing", "attitude and body rate to the last bits"),
    rung(Model::TiltExact, "tilt-exact", "nothing", "cos θ to the last bit"),
    rung(Model::HeadsExact, "heads-exact", "nothing", "outcome, proven"),
    rung(Model::Trace, "trace", "nothing", "the flight at equal steps of time"),
    rung(Model::Integrator, "integrator", "a tolerance", "all of these, as a cross-check"),
    rung(Model::Share, "share", "that at most the speed is free", "probability, to rounding"),
    rung(Model::ShareSobol, "share-sobol", "that the speed is free", "probability, with an interval"),
    rung(Model::Sobol, "sobol", "nothing", "probability, with an interval"),
    rung(Model::Grid, "grid", "points on every free axis", "probability, without an error"),
    rung(Model::Random, "random", "nothing", "probability, with an interval"),
];

impl Model {
    /// What there is to know of it.
    pub fn rung(self) -> &'static Rung {
        &LADDER[self as usize]
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        self.rung().name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_has_its_rung_and_is_called_the_same_in_data() {
        for (index, rung) in LADDER.iter().enumerate() {
            assert_eq!((rung.model as usize, rung.model.name()), (index, rung.name));
            assert_eq!(serde_json::to_string(&rung.model).unwrap(), format!("\"{}\"", rung.name));
        }
    }
}
