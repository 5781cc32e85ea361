//! Proofs by integration, by the theorem of `docs/proofs/enclosure.md`: bounds of one step ([`coin_step`], [`rigid_step`]),
//! of the rates of a body ([`polhode`], in registers [`rigid_lanes`]) and of a whole [`flight`]; flights in more
//! [`digits`]; the [`driver`], which tries them in turn, its [`certificate`], and [`counts`].

pub(crate) mod certificate;
pub(crate) mod coin_step;
pub(crate) mod counts;
pub(crate) mod digits;
pub(crate) mod driver;
pub(crate) mod flight;
pub(crate) mod polhode;
pub(crate) mod rigid_lanes;
pub(crate) mod rigid_step;
