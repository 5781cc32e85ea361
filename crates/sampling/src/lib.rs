//! From launches to probabilities.
//!
//! A [`Space`] says which launches are meant; method A lays a grid over it, method B draws from it at random
//! ([`estimate()`]). Counts are integers and do not depend on the number of threads. This is the only crate that knows a
//! random number generator.

pub mod axis;
pub mod estimate;
pub mod interval;
pub mod long_flight;
pub mod space;

pub use axis::Axis;
pub use estimate::{Counts, Plan, SampleError, estimate, random_tosses};
pub use interval::{Interval, clopper_pearson, wilson};
pub use long_flight::long_flight_probability;
pub use space::{NAMED_SPACES, NamedSpace, Space, YAxis, named_space};
