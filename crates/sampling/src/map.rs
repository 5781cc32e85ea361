//! This file maps the probability of heads over two coordinates of a space: P(heads | x, y) at the nodes (x, y) of a
//! grid.

use dynamics::{Error, InputError};
#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::coordinate::Coordinate;
use crate::plan::Plan;
use crate::sampler::Sampler;
use crate::space::{AxisOrTie, Space};

/// P(heads) at the nodes of a grid over two coordinates, with the other coordinates distributed as in the space.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The coordinate that varies along a row, and its values.
    pub across: (Coordinate, Vec<f64>),
    /// The coordinate that varies from row to row, and its values.
    pub up: (Coordinate, Vec<f64>),
    /// The nodes, row by row.
    pub nodes: Vec<Node>,
}

/// What is known at a node of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// P(heads), from 0 to 1, of the launches that are decided; `None` if none is.
    pub probability: Option<f64>,
    /// Number of launches that are undecided; 0 without a probability if it was time to end before the node.
    pub undecided: u64,
}

impl Sampler<'_> {
    /// Estimates P(heads) of `space` by `plan` at each node of the grid over the coordinates `across` and `up`.
    ///
    /// # Errors
    /// As [`Sampler::estimate`], and an [`InputError`] that names a coordinate of the grid if it is given twice, is
    /// tied, or has no number of points from 2 to 10 000.
    pub fn map(&self, space: &Space, [across, up]: [Coordinate; 2], plan: Plan) -> Result<Map, Error> {
        map_nodes(space, [across, up])?;
        let (columns, rows) = (values(space, across)?, values(space, up)?);
        // A node is computed as a whole, or not at all.
        let sampler = self.silent().until(&|| false);
        let node = |index: usize| {
            let (column, row) = (columns[index % columns.len()], rows[index / columns.len()]);
            if (self.stop)() {
                return Ok(Node { probability: None, undecided: 0 });
            }
            let here = space.with_axis(across, column)?.with_axis(up, row)?;
            let found = sampler.estimate(&here, plan)?;
            (self.progress)(1);
            Ok(Node { probability: found.is_known().then_some(found.probability), undecided: found.undecided() })
        };
        let indices = 0..columns.len() * rows.len();
        #[cfg(feature = "rayon")]
        let indices = indices.into_par_iter();
        let nodes = indices.map(node).collect::<Vec<Result<_, Error>>>();
        // Collected in order, so that of several errors it is always the first that is returned.
        let nodes = nodes.into_iter().collect::<Result<_, _>>()?;
        Ok(Map { across: (across, columns), up: (up, rows), nodes })
    }
}

/// More nodes than this are refused: a map holds some hundred bytes for each, and so does its chart.
const MOST_NODES: u64 = 1_000_000;

/// The number of nodes of a map of `space`.
///
/// # Errors
/// As [`Sampler::map`], before anything is computed.
pub fn map_nodes(space: &Space, [across, up]: [Coordinate; 2]) -> Result<u64, InputError> {
    let refused = |value, expected| InputError::Malformed { field: up.field(), value, expected };
    if across == up {
        return Err(refused(up.name().to_owned(), "two different coordinates"));
    }
    let (columns, rows) = (count(space, across)?, count(space, up)?);
    if columns * rows > MOST_NODES {
        return Err(refused(format!("{columns} × {rows} points"), "a map of at most 1000000 nodes"));
    }
    Ok(columns * rows)
}

/// The space that the first node of a map of `space` has its probability from.
///
/// # Errors
/// As [`Space::with_axis`].
pub fn first_node(space: &Space, axes: [Coordinate; 2]) -> Result<Space, InputError> {
    axes.into_iter().try_fold(*space, |space, of| space.with_axis(of, space.axis(of).bounds()[0]))
}

/// The grid points of a coordinate.
fn values(space: &Space, of: Coordinate) -> Result<Vec<f64>, InputError> {
    let points = count(space, of)?;
    Ok((0..points).map(|index| space.axis(of).grid_point(index, points)).collect())
}

/// The number of the grid's values of a coordinate.
fn count(space: &Space, of: Coordinate) -> Result<u64, InputError> {
    const MOST: u64 = 10_000;
    let refused = |value: String| InputError::Malformed {
        field: of.field(),
        value,
        expected: "an axis for a map: LO:HI:POINTS with 2 to 10000 points, and not tied",
    };
    match space.axis_or_tie(of) {
        Some(AxisOrTie::Axis(axis)) => match axis.points() {
            Some(points @ 2..=MOST) => Ok(points),
            _ => Err(refused(axis.to_string())),
        },
        Some(tie @ AxisOrTie::SameAs(_)) => Err(refused(tie.to_string())),
        None => Err(refused("not given".to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;
    use exact::CoinMotion;

    use super::*;
    use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
    use crate::plan::Rest;

    const EXACT: Plan = Plan::ExactSpeed(Rest::Grid);

    fn space(texts: &[(Coordinate, &str)]) -> Space {
        Space::parse(Coin::PAPER, texts).unwrap()
    }

    #[test]
    fn a_map_has_the_probability_of_each_node_and_heads_for_sure_up_to_45_degrees() {
        let space = space(&[(RateX, "0:40:21"), (RateY, "0"), (RateZ, "-10:30:5"), (Speed, "3:5")]);
        let map = Sampler::exact().map(&space, [RateX, RateZ], EXACT).unwrap();
        assert_eq!((map.across.1.len(), map.up.1.len(), map.nodes.len()), (21, 5, 105));
        let shares: Vec<f64> = map.nodes.iter().map(|node| node.probability.unwrap()).collect();
        for (index, probability) in shares.iter().enumerate() {
            let (rate_x, rate_z) = (map.across.1[index % 21], map.up.1[index / 21]);
            let cone = rate_x.atan2(0.5 * rate_z);
            let least_cos_tilt = (2.0 * cone).cos();
            assert!(*probability > 1.0 - 1e-7 || least_cos_tilt < 1e-15, "{rate_x}, {rate_z}: {probability}");
            let speeds = (0..2000).map(|part| 3.0 + (f64::from(part) + 0.5) / 1000.0);
            let heads = speeds.filter(|speed| {
                let toss = space.toss(&[rate_x, 0.0, rate_z, *speed, 9.81, 0.0, 0.0, 0.0, 0.0]).coin().unwrap();
                CoinMotion::new(&toss).cos_tilt(toss.launch.flight_time()).unwrap() > 0.0
            });
            assert!((probability - heads.count() as f64 / 2000.0).abs() < 4e-3, "{rate_x}, {rate_z}: {probability}");
        }
        assert!(shares.iter().any(|probability| *probability < 0.6));
    }

    /// A solver that can't tell any outcome of a launch that turns about x.
    struct Unsure;

    impl dynamics::Solver for Unsure {
        fn name(&self) -> &str {
            "unsure"
        }
        fn land(&self, toss: &dynamics::Toss) -> Result<dynamics::Landing, dynamics::SolveError> {
            let mut landing = exact::ExactSolver.land(toss)?;
            if toss.launch.rate().x > 0.0 {
                landing.error = Some(1.0);
            }
            Ok(landing)
        }
    }

    #[test]
    fn a_node_where_no_launch_is_decided_has_no_probability() {
        let space = space(&[(RateX, "0:40:2"), (RateY, "0"), (RateZ, "10:20:2"), (Speed, "3:5")]);
        let map = Sampler::by(&Unsure).map(&space, [RateX, RateZ], Plan::Random { points: 64, seed: 1 }).unwrap();
        let (spins, unknown) =
            (Node { probability: Some(1.0), undecided: 0 }, Node { probability: None, undecided: 64 });
        assert_eq!(map.nodes, [spins, unknown, spins, unknown]);
        // A quarter of a turn at a single speed is an exact tie.
        let texts = [(RateX, "0:1:2"), (RateY, "0"), (RateZ, "0:1:2"), (Speed, "0"), (Tilt, "90deg")];
        let ties = Space::parse(Coin::PAPER, &texts).unwrap();
        if let Ok(map) = Sampler::exact().map(&ties, [RateX, RateZ], EXACT) {
            assert!(map.nodes.iter().all(|node| node.probability != Some(0.5)), "{map:?}");
        }
    }

    #[test]
    fn a_tied_rate_follows_its_partner() {
        let texts = [(RateX, "0:40:3"), (RateY, "x"), (RateZ, "10:50"), (Speed, "3:5"), (Tilt, "0:1:2")];
        let plan = Plan::ExactSpeed(Rest::Sobol(crate::Scrambled::new(64, 1)));
        let map = Sampler::exact().map(&space(&texts), [RateX, Tilt], plan).unwrap();
        assert_eq!(map.nodes[0], Node { probability: Some(1.0), undecided: 0 }, "no rate but spin");
    }

    #[test]
    fn rejects_coordinates_that_cannot_be_mapped() {
        let space = space(&[(RateX, "0:40:3"), (RateY, "x"), (RateZ, "10:50"), (Speed, "4")]);
        for (axes, field) in [
            ([RateX, RateX], "rate x"),
            ([RateX, RateY], "rate y"),
            ([RateX, RateZ], "rate z"),
            ([Speed, RateX], "speed"),
        ] {
            let error = Sampler::exact().map(&space, axes, EXACT).unwrap_err().to_string();
            assert!(error.starts_with(field), "{error}");
        }
    }
}
