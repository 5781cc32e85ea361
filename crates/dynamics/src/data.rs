//! Reading and writing of coins, bodies, launches and choices of solvers with serde, for configuration files.
//! Input is first read into plain structs and then converted by the constructors of these types, so that a file cannot make
//! an invalid value. What was written is read back as the same value, to the bit.
//!
//! ```toml
//! coin = "us-quarter"              # or { moments = [I1, I3] } or { cylinder = [mass, radius, thickness] };
//!                                  # the paper's coin if not given. Any body, of a Toss or a space, may also be
//!                                  # { moments = [I1, I2, I3] } or { inertia = [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz] }
//! [launch]
//! rate = [1.0, 1.0, 2.5]           # rad/s, BF; or three texts in one unit, "38rev/s"; or turn and psi
//! speed = 3.0                      # m/s; or time = 0.6, s
//! gravity = 9.81                   # m/s²; this and the next two are the defaults
//! drop = 0.0                       # m, how far below its launch the coin lands
//! tilt = 0.0                       # rad; or attitude = [w, x, y, z]
//! ```
//!
//! The names are those of [`thrown`](crate::thrown). A number is in the SI unit, and a text has a unit: `"15deg"`, `"24mm"`.
//! Rates, tilts and cylinders keep their unit, so that proofs start from the numbers as given; other numbers, and `turn` with
//! `psi`, are converted. A launch without its body has no `turn` and `psi`.
//!
//! | type | as plain data |
//! |---|---|
//! | [`SolverConfig`](crate::SolverConfig) | `{ name = "quaternion", scheme = "dop853", tolerance = 1e-9, formulation = "momentum" }`, or `step` (s) |
//! | [`Formulation`](crate::Formulation) | the name; so are outcomes written |
//! | [`Attitude`](crate::Attitude) | `[w, x, y, z]`, `{ tilt = 0.3 }` or `{ unit_quaternion = [w, x, y, z] }` |
//!
//! Drag and bounce are outside the model. They are fields of a launch nevertheless, so that they are refused with the
//! reason instead of as an "unknown field".
//!
//! serde_json reads numbers to the last bit only with its feature `float_roundtrip`.

#[cfg(feature = "serde")]
mod number;
#[cfg(feature = "serde")]
mod parts;
#[cfg(feature = "serde")]
pub(crate) mod settings;
#[cfg(feature = "serde")]
mod words;

#[cfg(feature = "serde")]
pub use words::in_words;

use crate::error::InputError;

/// Why drag is refused.
pub const NO_DRAG: InputError = InputError::OutsideModel {
    field: "drag",
    why: "the flight is free of torque and drag, and does not approximate a flight through air",
};

/// Why bouncing is refused.
pub const NO_BOUNCE: InputError = InputError::OutsideModel {
    field: "bounce",
    why: "the flight ends at the first landing, and what the coin does on the floor is not solved",
};

/// Why `wobble` is refused: in the literature a coin that turns end over end, at ψ = 90°, does not wobble.
pub const NO_WOBBLE: InputError =
    InputError::Missing { field: "psi", expected: "psi (--psi) in place of wobble, for the angle between n and S" };

#[cfg(test)]
#[cfg(feature = "serde")]
mod tests;
