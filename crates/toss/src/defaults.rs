//! What is taken where nothing is given. The command line and the Python package read it here, so that the same question has the
//! same answer in both.
//!
//! Defaults of one toss stand with their types: [`DEFAULT_GRAVITY`](dynamics::time_of_flight::DEFAULT_GRAVITY),
//! [`Coin::PAPER`](dynamics::Coin::PAPER), [`Stepping::DEFAULT`](dynamics::Stepping::DEFAULT). Work is done by one thread per core;
//! where workers share the parts of an estimate, each of them has one.

use sampling::enclosure::usual_accuracy;
pub use sampling::plan::{SCRAMBLES, SEED};
use sampling::{Coordinate, Method, Plan, Rest, Scrambled, Space};

/// The number of times of a trace.
pub const TRACE_POINTS: usize = 101;

/// The number of times of a trace that is planned.
pub const PLANNED_POINTS: usize = 100;

/// The largest error of P(heads) over a space of coins.
pub const ACCURACY: f64 = 1e-4;

/// The same for bodies with I1 ≠ I2, which have no closed form of the share over all speeds.
pub const ACCURACY_OF_BODIES: f64 = 1e-3;

/// The most launches of bodies with I1 ≠ I2, which are proven one by one.
pub const MOST_OF_BODIES: u64 = 1 << 16;

/// Numbers of launches of a coin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Launches {
    /// Independent ones.
    pub random: u64,
    /// Points of all scrambles together.
    pub sobol: u64,
}

/// The launches of an estimate.
pub const LAUNCHES: Launches = Launches { random: 250_000, sobol: 1 << 18 };

/// The launches of each node of a map.
pub const LAUNCHES_OF_A_NODE: Launches = Launches { random: 1024, sobol: 1024 };

/// The number of flights at each angle ψ, whose share is compared with the limit of long flights.
pub const LONG_FLIGHTS: u64 = 1000;

/// The number of seeds over which the errors of methods are measured, and the power of 2 that is the largest number of launches.
pub const REPLICATES: u64 = 16;

/// See [`REPLICATES`].
pub const UP_TO: u32 = 18;

/// The number of steps in which the convergence of `points` launches is shown.
pub fn steps(points: u64) -> u64 {
    points.min(500)
}

/// The largest error of P(heads) over `space`.
pub fn accuracy(space: &Space) -> f64 {
    if space.coin().is_some() { ACCURACY } else { ACCURACY_OF_BODIES }
}

/// A method of choosing launches, with the numbers that somebody gives for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// The method.
    pub method: Method,
    /// The number of launches.
    pub points: Option<u64>,
    /// The number of scrambles.
    pub scrambles: u64,
    /// The seed of random launches or of scrambles.
    pub seed: u64,
    /// The largest error of an enclosure.
    pub accuracy: Option<f64>,
}

impl Wanted {
    /// The method without numbers.
    pub fn new(method: Method) -> Self {
        Self { method, points: None, scrambles: SCRAMBLES, seed: SEED, accuracy: None }
    }

    /// The plan for `space`, of `usual` launches or fewer if no number is given. Of exact-speed it is a grid if that needs no
    /// number, because all other axes have their points.
    pub fn plan(&self, space: &Space, usual: Launches) -> Plan {
        let Self { scrambles, seed, .. } = *self;
        let most = if space.coin().is_some() { u64::MAX } else { MOST_OF_BODIES };
        let points = |usual: u64| self.points.unwrap_or(usual.min(most));
        let scrambled = || {
            // Each scramble has as many points as the others.
            let usual = usual.sobol.min(most).div_ceil(scrambles.max(1)).saturating_mul(scrambles);
            Scrambled { points: self.points.unwrap_or(usual), scrambles, seed }
        };
        match self.method {
            Method::Grid => Plan::Grid,
            Method::Random => Plan::Random { points: points(usual.random), seed },
            Method::Sobol => Plan::Sobol(scrambled()),
            Method::Enclosure => Plan::Enclosure { accuracy: self.accuracy.unwrap_or_else(|| usual_accuracy(space)) },
            Method::ExactSpeed => {
                let grid = Plan::ExactSpeed(Rest::Grid);
                let only_the_speed_is_free = space.free().all(|of| of == Coordinate::Speed);
                let has_grid = self.points.is_none() && grid.points(space).is_ok();
                if only_the_speed_is_free || has_grid { grid } else { Plan::ExactSpeed(Rest::Sobol(scrambled())) }
            }
        }
    }
}

impl From<Plan> for Wanted {
    fn from(plan: Plan) -> Self {
        let wanted = Self::new(plan.method());
        match plan {
            Plan::Grid | Plan::ExactSpeed(Rest::Grid) => wanted,
            Plan::Enclosure { accuracy } => Self { accuracy: Some(accuracy), ..wanted },
            Plan::Random { points, seed } => Self { points: Some(points), seed, ..wanted },
            Plan::Sobol(Scrambled { points, scrambles, seed })
            | Plan::ExactSpeed(Rest::Sobol(Scrambled { points, scrambles, seed })) => {
                Self { points: Some(points), scrambles, seed, ..wanted }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sampling::named_space;

    /// The plan of a method without numbers.
    fn usual(method: Method, space: &Space) -> Plan {
        Wanted::new(method).plan(space, LAUNCHES)
    }

    #[test]
    fn what_is_not_given_follows_from_the_space() {
        let axes = |rate_x| {
            let texts = ["rate_x", "rate_y", "rate_z", "speed"].map(|name| Coordinate::named_in("axis", name).unwrap());
            texts.into_iter().zip([rate_x, "5", "1", "3:5"]).collect::<Vec<_>>()
        };
        let coin = Space::parse(dynamics::Coin::PAPER, &axes("0:9")).unwrap();
        let book = dynamics::Body::from_listed_moments(&[1.0, 2.0, 2.5]).unwrap();
        let book = Space::parse(book, &axes("0:9")).unwrap();
        let fixed = Space::parse(dynamics::Coin::PAPER, &axes("7")).unwrap();
        let gridded = named_space("paper-fig4").unwrap();
        assert_eq!(usual(Method::Random, &coin), Plan::Random { points: 250_000, seed: 1 });
        assert_eq!(usual(Method::Random, &book), Plan::Random { points: 1 << 16, seed: 1 });
        let sobol = |points| Scrambled { points, scrambles: 8, seed: 1 };
        assert_eq!(usual(Method::Sobol, &book), Plan::Sobol(sobol(1 << 16)));
        assert_eq!(usual(Method::ExactSpeed, &coin), Plan::ExactSpeed(Rest::Sobol(sobol(1 << 18))));
        for space in [fixed, gridded] {
            assert_eq!(usual(Method::ExactSpeed, &space), Plan::ExactSpeed(Rest::Grid));
        }
        let three = Wanted { scrambles: 3, ..Wanted::new(Method::Sobol) }.plan(&coin, LAUNCHES);
        assert!(three.points(&coin).is_ok(), "{three:?}: each scramble has as many points");
        assert_eq!((accuracy(&coin), accuracy(&book)), (1e-4, 1e-3));
    }

    #[test]
    fn a_plan_keeps_its_numbers() {
        let space = named_space("paper-fig4").unwrap();
        let scrambled = Scrambled { points: 12, scrambles: 3, seed: 9 };
        for plan in [
            Plan::Grid,
            Plan::Random { points: 7, seed: 9 },
            Plan::Sobol(scrambled),
            Plan::ExactSpeed(Rest::Sobol(scrambled)),
            Plan::ExactSpeed(Rest::Grid),
            Plan::Enclosure { accuracy: 1e-5 },
        ] {
            assert_eq!(Wanted::from(plan).plan(&space, LAUNCHES), plan);
        }
    }
}
