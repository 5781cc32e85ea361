//! The reference of each toss, by the crate [`reference`](mod@::reference), which shares no code with what it judges. A
//! process that tests the checks can make it wrong.

use dynamics::{CoinToss, Launch, Toss};

pub use ::reference::{NoReference, Reference};

/// The landing of a toss of any body.
///
/// # Errors
/// [`NoReference`] where neither a closed form of the reference holds nor its integration.
pub(crate) fn of(toss: &Toss) -> Result<Reference, NoReference> {
    Reference::of(&Toss { launch: judged(toss.launch), ..*toss })
}

/// The landing of a toss of a coin.
pub(crate) fn of_coin(toss: &CoinToss) -> Reference {
    Reference::new(&CoinToss { launch: judged(toss.launch), ..*toss })
}

#[cfg(not(test))]
const fn judged(launch: Launch) -> Launch {
    launch
}

/// The launch, or a longer one in a process that is to judge wrongly.
#[cfg(test)]
fn judged(launch: Launch) -> Launch {
    use std::sync::LazyLock;

    /// What the tests of `judge` set.
    static FACTOR: LazyLock<Option<f64>> =
        LazyLock::new(|| std::env::var("VERIFY_TEST_WRONG_TIME").ok().map(|text| text.parse().expect("a number")));
    let Some(factor) = *FACTOR else { return launch };
    let time = launch.time_of_flight().seconds() * factor;
    launch.with_time_of_flight(dynamics::TimeOfFlight::Given(time)).expect("a time")
}
