//! The end of an integrated flight.

use dynamics::{Flight, Vector3, Work};

/// The end state of an integrated flight, and what a bound of its error has to know of its steps, if it has one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Landed<B = ()> {
    pub(crate) flight: Flight,
    /// P (BF), before it is normalised.
    pub(crate) turn: [f64; 4],
    /// ω (BF, rad/s).
    pub(crate) rate: Vector3<f64>,
    pub(crate) work: Work,
    pub(crate) bound: B,
}

impl<B> Landed<B> {
    /// The end of `flight` with this turn and these rates, along the axes and in the unit of the flight.
    pub(crate) fn new(flight: &Flight, (turn, rate): ([f64; 4], [f64; 3]), work: Work, bound: B) -> Self {
        Self { flight: *flight, turn: flight.turn_in_body(turn), rate: flight.rate_at(rate), work, bound }
    }
}
