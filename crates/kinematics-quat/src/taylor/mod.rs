//! Flights by Taylor series: the steps of a [`coin`] and of any [`rigid`] body, the [`plan`] of their lengths, the
//! [`product`] of turns, and many flights in [`lockstep`].

pub(crate) mod coin;
pub(crate) mod lockstep;
pub(crate) mod plan;
pub(crate) mod product;
pub(crate) mod rigid;
