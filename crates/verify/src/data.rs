//! The data that the suite judges with, inside the crate, so that the suite works wherever it is built: the numbers from
//! outside, the problems, the limits of this workspace's own solvers, and what these solvers are known to do where
//! methods fail.

/// Motions that were computed outside this workspace.
pub(crate) const MOTIONS: &str = include_str!("../data/motion.toml");

/// Probabilities that were computed outside this workspace.
pub(crate) const PROBABILITIES: &str = include_str!("../data/probability.toml");

/// Moments of inertia of the catalogue's coins, from what mints publish.
pub(crate) const COINS: &str = include_str!("../data/coins.toml");

/// The problems on which speed is compared with accuracy.
pub(crate) const PROBLEMS: &str = include_str!("../data/problems.toml");

/// What the solvers of this workspace are known to do at every hazard.
pub(crate) const ATLAS: &str = include_str!("../data/atlas.toml");

/// The allowed deviations of the solvers of this workspace and of its libraries.
pub(crate) const LIMITS: &str = include_str!("../data/limits.toml");
