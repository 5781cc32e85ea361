//! The entries of the catalogue, and those with three different moments of inertia. The latter show what a coin
//! cannot do: a racket that turns over on its own, and a coin whose relief makes it wobble unevenly.
//!
//! Where nobody has published the moments, the entry is a stated model, and its numbers stand here.

use std::str::FromStr;

use crate::body::Body;
use crate::catalogue::CATALOGUE;
use crate::coin::{Coin, NO_COIN};
use crate::error::{InputError, find_named};

const RACKET: &str = "M. S. Ashbaugh, C. C. Chicone and R. H. Cushman, J. Dynam. Differ. Equ. 3 (1991), 67, footnote 4, \
                      as measured by H. Brody, Phys. Teach. 23 (1985), 213";
const NESC: &str = "NASA/TM-2015-218675 vol. II, check case 2, in slug ft² (1 slug ft² = 1.3558179483314004 kg m²)";
const BOOK: &str = "our model: a homogeneous cuboid of format A5";
const RELIEF: &str = "our model: the cylinder of us-quarter, of which 0.13 g is a homogeneous elliptic slab on the heads \
                      side, with half-axes of 6 mm (x) and 8 mm (y), 0.1 mm high, with its centre at x = 2 mm, y = 1 mm";

/// What the moments of a body follow from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// The moments I1, I2, I3 about x, y and z = n (kg m²).
    Moments([f64; 3]),
    /// A real coin, taken as a homogeneous cylinder, in the units in which mints publish it.
    Cylinder {
        /// Mass (g).
        mass_g: f64,
        /// Diameter (mm).
        diameter_mm: f64,
        /// Thickness (mm).
        thickness_mm: f64,
    },
    /// A homogeneous cuboid.
    Cuboid {
        /// Mass (g).
        mass_g: f64,
        /// Lengths of its edges along x, y and z = n (mm).
        edges_mm: [f64; 3],
    },
    /// A coin with a relief on its heads side.
    Engraved {
        /// Mass, that of the relief included (g).
        mass_g: f64,
        /// Diameter of the cylinder (mm).
        diameter_mm: f64,
        /// Thickness of the cylinder (mm).
        thickness_mm: f64,
        /// The relief.
        relief: Relief,
    },
}

/// A homogeneous slab with an elliptic outline that lies on the heads side of a coin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relief {
    /// Mass (g).
    pub mass_g: f64,
    /// Half-axes along x and y (mm).
    pub half_axes_mm: [f64; 2],
    /// Height above the face (mm).
    pub height_mm: f64,
    /// Where its centre is, from that of the face along x and y (mm).
    pub centre_mm: [f64; 2],
}

/// A coin or another body with a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Its name, as `us-quarter`.
    pub name: &'static str,
    /// A short description; of a body that is no coin, with the directions of x, y and z.
    pub description: &'static str,
    /// What its moments follow from.
    pub shape: Shape,
    /// Where its figures are from.
    pub source: &'static str,
}

impl Entry {
    /// The body of this entry.
    pub fn body(&self) -> Result<Body, InputError> {
        match self.shape {
            Shape::Moments(moments) => Body::from_moments(moments),
            Shape::Cylinder { mass_g, diameter_mm, thickness_mm } => {
                Coin::from_cylinder(mass_g / 1e3, diameter_mm / 2e3, thickness_mm / 1e3).map(Body::from)
            }
            Shape::Cuboid { mass_g, edges_mm } => {
                let [x, y, z] = edges_mm.map(|edge| edge / 1e3 * (edge / 1e3));
                let twelfth = mass_g / 1e3 / 12.0;
                Body::from_moments([twelfth * (y + z), twelfth * (x + z), twelfth * (x + y)])
            }
            Shape::Engraved { mass_g, diameter_mm, thickness_mm, relief } => {
                let [mass, radius, thickness] = [mass_g / 1e3, diameter_mm / 2e3, thickness_mm / 1e3];
                Body::from_tensor(engraved(mass, radius, thickness, &relief))
            }
        }
    }

    /// The coin of this entry.
    pub fn coin(&self) -> Result<Coin, InputError> {
        self.body()?.coin().ok_or(NO_COIN)
    }
}

/// The inertia tensor (kg m²) of a cylinder with a relief, of `mass` (kg) in all, about the centre of mass of both, by
/// the theorem of parallel axes. `radius` and `thickness` of the cylinder are in m.
fn engraved(mass: f64, radius: f64, thickness: f64, relief: &Relief) -> [[f64; 3]; 3] {
    let slab = relief.mass_g / 1e3;
    let disc = mass - slab;
    let [a, b] = relief.half_axes_mm.map(|half| half / 1e3 * (half / 1e3));
    let height = relief.height_mm / 1e3;
    let across = disc * (radius * radius / 4.0 + thickness * thickness / 12.0);
    let flat = height * height / 12.0;
    let own = [
        across + slab * (b / 4.0 + flat),
        across + slab * (a / 4.0 + flat),
        disc * (radius * radius) / 2.0 + slab * (a + b) / 4.0,
    ];
    // From the centre of the cylinder to that of the slab.
    let [x, y] = relief.centre_mm.map(|part| part / 1e3);
    let apart = [x, y, (thickness + height) / 2.0];
    let square: f64 = apart.iter().map(|part| part * part).sum();
    let reduced = disc * slab / mass;
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let diagonal = if row == column { own[row] + reduced * square } else { 0.0 };
            diagonal - reduced * (apart[row] * apart[column])
        })
    })
}

/// All bodies that are no coins.
pub const BODIES: &[Entry] = &[
    Entry {
        name: "us-quarter-engraved",
        description: "25 US cents with a relief on the heads side",
        shape: Shape::Engraved {
            mass_g: 5.670,
            diameter_mm: 24.26,
            thickness_mm: 1.75,
            relief: Relief { mass_g: 0.13, half_axes_mm: [6.0, 8.0], height_mm: 0.1, centre_mm: [2.0, 1.0] },
        },
        source: RELIEF,
    },
    Entry {
        name: "racket",
        description: "a tennis racket, x along the handle, n out of its face",
        shape: Shape::Moments([0.00121, 0.01638, 0.01748]),
        source: RACKET,
    },
    Entry {
        name: "book",
        description: "a closed book, x along its width, n out of its cover",
        shape: Shape::Cuboid { mass_g: 400.0, edges_mm: [148.0, 210.0, 20.0] },
        source: BOOK,
    },
    Entry {
        name: "nasa-brick",
        description: "a brick, of which several simulators have been compared",
        shape: Shape::Moments([0.002_568_217_474_088_305_3, 0.008_421_011_037_627_346, 0.009_754_655_939_231_735]),
        source: NESC,
    },
];

/// All coins and bodies.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    CATALOGUE.iter().chain(BODIES)
}

/// The body called `name`, of the coins and of [`BODIES`].
pub fn named_body(name: &str) -> Result<Body, InputError> {
    find_named("coin", name, &entries().collect::<Vec<_>>(), |entry| entry.name)?.body()
}

/// Finds a coin or another body of the catalogue by its name.
impl FromStr for Body {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        named_body(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_is_a_body_of_three_moments_and_its_name_is_unique() {
        for (index, entry) in BODIES.iter().enumerate() {
            let body = entry.body().unwrap();
            assert_eq!((body.coin(), Ok(body)), (None, entry.name.parse()), "{}", entry.name);
            let others = BODIES[..index].iter().map(|other| other.name);
            assert!(others.chain(CATALOGUE.iter().map(|coin| coin.name)).all(|other| other != entry.name));
        }
        let quarter: Body = "us-quarter".parse().unwrap();
        assert_eq!(quarter.coin(), "us-quarter".parse().ok());
        let unknown = "groat".parse::<Body>().unwrap_err().to_string();
        assert!(unknown.contains("us-dollar") && unknown.ends_with("us-quarter-engraved, racket, book, nasa-brick"));
    }

    /// A slab of the whole face and a cylinder are a thicker cylinder, and one off the centre is found by adding up
    /// small pieces.
    #[test]
    fn the_tensor_of_an_engraved_coin_is_that_of_its_mass() {
        let whole = Relief { mass_g: 1.0, half_axes_mm: [10.0, 10.0], height_mm: 0.5, centre_mm: [0.0, 0.0] };
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = engraved(0.005, 0.01, 0.002, &whole);
        let thicker = Coin::from_cylinder(0.005, 0.01, 0.0025).unwrap();
        for (found, expected) in [(xx, thicker.i1()), (yy, thicker.i1()), (zz, thicker.i3())] {
            approx::assert_relative_eq!(found, expected, epsilon = 0.0, max_relative = 1e-14);
        }
        assert_eq!([xy, xz, yz], [0.0; 3]);

        let relief = Relief { mass_g: 0.4, half_axes_mm: [3.0, 5.0], height_mm: 0.8, centre_mm: [2.0, -1.0] };
        let found = engraved(0.005, 0.01, 0.002, &relief);
        let mut pieces = pieces(0.0046, [0.01, 0.01], 0.002, [0.0; 3]);
        pieces.extend(self::pieces(0.0004, [0.003, 0.005], 0.0008, [0.002, -0.001, 0.0014]));
        let centre = [0, 1, 2].map(|axis| pieces.iter().map(|(mass, at)| mass * at[axis]).sum::<f64>() / 0.005);
        for (row, column) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)] {
            let expected: f64 = pieces
                .iter()
                .map(|(mass, at)| {
                    let from = [0, 1, 2].map(|axis| at[axis] - centre[axis]);
                    let square: f64 = from.iter().map(|part| part * part).sum();
                    mass * (if row == column { square } else { 0.0 } - from[row] * from[column])
                })
                .sum();
            let found = found[row][column];
            assert!((found - expected).abs() < 1e-3 * found.abs(), "{row} {column}: {found} {expected}");
        }
    }

    /// Small pieces of an elliptic cylinder with the half-axes `half` and the thickness `high` about `centre`.
    fn pieces(mass: f64, half: [f64; 2], high: f64, centre: [f64; 3]) -> Vec<(f64, [f64; 3])> {
        const ACROSS: i32 = 200;
        const UP: i32 = 8;
        let part = |index: i32, number: i32| (f64::from(index) + 0.5) / f64::from(number) - 0.5;
        let places = (0..ACROSS).flat_map(|x| (0..ACROSS).map(move |y| (2.0 * part(x, ACROSS), 2.0 * part(y, ACROSS))));
        let inside: Vec<(f64, f64)> = places.filter(|(x, y)| x * x + y * y <= 1.0).collect();
        let each = mass / (inside.len() as f64 * f64::from(UP));
        let at = |(x, y): (f64, f64), z: i32| {
            [centre[0] + half[0] * x, centre[1] + half[1] * y, centre[2] + high * part(z, UP)]
        };
        inside.into_iter().flat_map(|place| (0..UP).map(move |z| (each, at(place, z)))).collect()
    }
}
