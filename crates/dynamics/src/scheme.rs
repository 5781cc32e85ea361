//! [`Scheme`], a scheme of integration: its name, its order, and how its steps can be controlled. A scheme is a value
//! and not an enum, so that an integrator from elsewhere can bring its own.

use std::fmt;
use std::str::FromStr;

use crate::error::{InputError, find_named};

/// A scheme by which an integrator steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scheme {
    name: &'static str,
    order: Option<u32>,
    adaptive: bool,
    takes_steps: bool,
}

impl Scheme {
    /// Dormand and Prince's method of order 8(5,3)
    /// (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I).
    pub const DOP853: Self = Self::new("dop853", Some(8)).adaptive().with_fixed_steps();
    /// Dormand and Prince's method of order 5(4) (J. Comput. Appl. Math. 6, 1980).
    pub const DOPRI5: Self = Self::new("dopri5", Some(5)).adaptive().with_fixed_steps();
    /// The classical method of order 4, without an error estimate.
    pub const RK4: Self = Self::new("rk4", Some(4)).with_fixed_steps();

    /// Taylor series of an order that follows from the tolerance (Jorba & Zou, Exp. Math. 14 (2005), 99).
    pub const TAYLOR: Self = Self::new("taylor", None).adaptive();

    /// The schemes that [`integrate`](crate::integrate::integrate()) can run for any system, since they need nothing
    /// but its right-hand side.
    pub const RUNGE_KUTTA: [Self; 3] = [Self::DOP853, Self::DOPRI5, Self::RK4];

    /// All schemes of this workspace. An integrator from elsewhere may have others, which
    /// [`SolverEntry::scheme`](crate::SolverEntry::scheme) finds.
    pub const ALL: [Self; 4] = [Self::DOP853, Self::DOPRI5, Self::RK4, Self::TAYLOR];

    /// A scheme called `name` whose global error has this `order`, or `None` if the order depends on the tolerance. How
    /// its steps can be controlled is added by [`adaptive`](Self::adaptive) and
    /// [`with_fixed_steps`](Self::with_fixed_steps).
    pub const fn new(name: &'static str, order: Option<u32>) -> Self {
        Self { name, order, adaptive: false, takes_steps: false }
    }

    /// The same scheme, with an estimate of its local error, so that a tolerance can control its steps.
    #[must_use]
    pub const fn adaptive(self) -> Self {
        Self { adaptive: true, ..self }
    }

    /// The same scheme, which can take equal steps of a given length.
    #[must_use]
    pub const fn with_fixed_steps(self) -> Self {
        Self { takes_steps: true, ..self }
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// Order of the global error; `None` if it depends on the tolerance.
    pub const fn order(self) -> Option<u32> {
        self.order
    }

    /// Whether it estimates its local error, so that a tolerance can control its steps.
    pub const fn is_adaptive(self) -> bool {
        self.adaptive
    }

    /// Whether it can take equal steps of a given length.
    pub const fn takes_steps(self) -> bool {
        self.takes_steps
    }
}

/// Writes the name.
impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name)
    }
}

/// Finds one of [`Scheme::ALL`] by its name.
impl FromStr for Scheme {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        find_named("scheme", name, &Self::ALL, |scheme| scheme.name).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schemes_state_their_name_order_and_step_control() {
        let table = [("dop853", Some(8), true, true), ("dopri5", Some(5), true, true), ("rk4", Some(4), false, true)];
        for (scheme, expected) in Scheme::RUNGE_KUTTA.into_iter().zip(table) {
            assert_eq!((scheme.name(), scheme.order(), scheme.is_adaptive(), scheme.takes_steps()), expected);
        }
        let own = Scheme::new("own", None).adaptive();
        assert_eq!((own.name(), own.order(), own.is_adaptive(), own.takes_steps()), ("own", None, true, false));
    }

    #[test]
    fn a_scheme_is_written_by_its_name_and_read_by_it() {
        for scheme in Scheme::ALL {
            assert_eq!(scheme.to_string().parse(), Ok(scheme));
        }
        let error = "heun".parse::<Scheme>().unwrap_err().to_string();
        assert_eq!(error, "scheme = 'heun' is unknown; known: dop853, dopri5, rk4, taylor");
    }
}
