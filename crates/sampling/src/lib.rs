//! This crate computes the probability of heads for launches that vary. One toss is determined by mechanics; chance
//! enters only through the distribution of launches, which this crate describes, samples and sums up.
//!
//! ```text
//! axes → space → launches (grid, random, Sobol) in columns
//!      → outcomes or shares → counts or means → estimate with its interval
//! ```
//!
//! A [`Space`] is the distribution of the launches, and a [`Plan`] selects the launches that are tried. A [`Sampler`]
//! solves these and returns an [`Estimate`]. Sums are integers, so that no result depends on the number of threads.
//! This is the only crate with a random number generator.
//!
//! # Features
//! Both are on by default. `rayon` solves launches on all threads of rayon's current pool; without it they are solved on one,
//! with the same result. `serde` reads and writes plans, spaces and tallies as plain data, and has the spaces that come by name or
//! from a TOML file.

pub mod axis;
mod block;
mod certain_line;
pub mod coordinate;
pub mod counted;
pub mod counts;
#[cfg(feature = "serde")]
mod data;
pub mod drawn;
pub mod enclosure;
pub mod estimate;
pub mod exact_speed;
mod fold;
mod grid;
pub mod interval;
mod launches;
pub mod long_flight;
pub mod long_flight_share;
pub mod map;
pub mod people;
pub mod people_file;
pub mod plan;
pub mod power;
pub mod practice;
pub mod random;
pub mod same_side;
pub mod sampler;
pub mod sequence;
mod sequences;
pub mod series;
mod shares;
pub mod sobol;
pub mod space;
pub mod space_builder;
#[cfg(feature = "serde")]
mod space_data;
#[cfg(feature = "serde")]
pub mod space_file;
pub mod spread;
pub mod tally;
#[cfg(feature = "serde")]
mod tally_data;
pub mod unresolved;

pub use axis::{Axis, Distribution};
pub use certain_line::{CertainLine, Piece, certain_line};
pub use coordinate::Coordinate;
pub use counted::{Counted, Person};
pub use counts::Counts;
pub use drawn::Drawn;
pub use estimate::{Estimate, Found, IntervalKind};
pub use fold::{Narrowed, Progress, Stop};
pub use interval::{Interval, clopper_pearson};
pub use long_flight::{long_flight_cone, long_flight_probability, rate_ratio};
pub use long_flight_share::{LONG_FLIGHT_TURNS, LongFlightLine, LongFlightShare, listed_cone_angles};
pub use map::{Map, Node, first_node, map_nodes};
pub use people::Spread;
pub use people_file::{CountsError, Named, people};
pub use plan::{Method, Plan, Rest, Scrambled};
pub use power::Power;
pub use practice::Practice;
pub use random::random_tosses;
pub use same_side::{Cone, FEW_PEOPLE, SameSide, SameSideBias};
pub use sampler::Sampler;
pub use sequence::NextStart;
pub use series::{ESTIMATORS, ErrorLine, Errors, Estimator, MethodErrors, RunningStep, rms_error};
pub use space::{AxisOrTie, Space};
pub use space_builder::SpaceBuilder;
#[cfg(feature = "serde")]
pub use space_file::{DescribedSpace, named_space, named_spaces};
pub use spread::{
    Alone, HAND, LARGEST_SPREAD, LargestSpread, MOST_LOOKS, RESOLUTION, SMALLEST_SPREAD, Spreads, SufficientSpread,
};
pub use tally::Tally;
