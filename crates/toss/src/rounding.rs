//! Numbers that people type with units are rounded when they are converted to SI units, and an outcome is proven for the
//! numbers after that. [`Rounding`] judges whether it is also the outcome of the numbers as they were typed.

use dynamics::quantity::{Given, common_unit};
use dynamics::{Body, InputError, Outcome, SolveError, Thrown, TimeOfFlight, Toss};
use exact::certified::holds_within;
use exact::{CoinMotion, certify};

/// What was rounded when the numbers of a toss were converted to SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounding {
    /// Whether the speed, the time of flight, gravity or the drop was rounded.
    pub flight: bool,
    /// Whether the body rate was rounded.
    pub rate: bool,
    /// How the body was rounded.
    pub body: BodyRounding,
}

/// How the moments of a body, or the elements of its inertia tensor, were rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one a toss, and a `Body` is `Copy`")]
pub enum BodyRounding {
    /// None of them was rounded.
    Exact,
    /// Some were. They were given in one unit, in which they make this body. It moves as the given one does, because
    /// ratios of moments decide the motion.
    InOneUnit(Body),
    /// Some were, and no unit makes a body of the numbers as they were given.
    Rounded,
}

impl BodyRounding {
    /// The rounding of the `elements` of which `body` makes a body, in any unit.
    pub fn of(elements: &[Given], body: impl Fn(Vec<f64>) -> Result<Body, InputError>) -> Self {
        if elements.iter().all(|given| given.is_exact_in_si()) {
            return Self::Exact;
        }
        let in_unit =
            common_unit(elements).and_then(|_| body(elements.iter().map(|given| given.value()).collect()).ok());
        in_unit.map_or(Self::Rounded, Self::InOneUnit)
    }
}

/// Relative error of a number after a conversion. With u = 2^-53, conversions change the rates by up to 8 u of themselves,
/// k by 3 u and T by 4 u.
const RELATIVE: f64 = 4.0 * f64::EPSILON;

impl Rounding {
    /// What the conversion of `thrown` to a toss rounds.
    pub fn of(thrown: &Thrown) -> Self {
        let body = BodyRounding::of(thrown.elements(), |elements| thrown.body_of(&elements));
        Self { flight: thrown.rounds_flight(), rate: thrown.rounds_rate(), body }
    }

    /// Whether nothing was rounded.
    pub fn is_none(&self) -> bool {
        !self.flight && !self.rate && self.body == BodyRounding::Exact
    }

    /// A bound of the relative errors of the rates, of k and of the time of flight T of `toss`; `None` for a landing above the
    /// launch that ends the flight next to its top, where T depends on the speed without a bound.
    ///
    /// T = (v0 + v1)/g, with v1 = √(v0² + 2 g drop) the speed at landing. If v0, g and drop < 0 are each off by 2 u of themselves,
    /// with 2 g |drop| < v0², then v1 is off by at most 4 u v0²/v1, and T by (4 + 4 v0/v1) u of itself, at most 4 ε v0/v1.
    fn relative_error(&self, toss: &Toss) -> Option<f64> {
        let TimeOfFlight::BallisticTo { speed, gravity, drop } = toss.launch.time_of_flight() else {
            return Some(RELATIVE);
        };
        if !self.flight || drop >= 0.0 {
            return Some(RELATIVE);
        }
        let slowed = (1.0 + 2.0 * (gravity / speed) * (drop / speed)).sqrt();
        // Above this, squares of the errors and the roundings of the line before make no difference.
        (slowed > 1e-6).then(|| RELATIVE / slowed)
    }

    /// A bound of the angle (rad) between the landing of `toss` and that of the numbers as they were typed: 0 if none was
    /// rounded, `None` where no bound is known, as for a body with I1 ≠ I2 next to whose separatrix a rounding may change
    /// all.
    ///
    /// The landed coin is the launched one, turned by Φ = (ωx, ωy, k ωz) T and then by -q T with q = (k - 1) ωz about n. Three
    /// factors, each with the same relative error, change Φ by up to 3.1 of it and q T by as much of q T and
    /// of k ωz T, which |Φ| bounds.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn error_bound(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
        if self.is_none() {
            return Ok(Some(0.0));
        }
        let (Some(coin_toss), Some(relative)) = (toss.coin(), self.relative_error(toss)) else { return Ok(None) };
        let (turn, spin) = CoinMotion::new(&coin_toss).phases(toss.launch.time_of_flight())?;
        Ok(Some(relative * (6.3 * turn.hi() + 3.1 * spin.hi().abs())))
    }

    /// Whether `outcome`, which is proven for `toss`, is proven for the numbers as they were typed. It is not if a number
    /// was rounded and cos θ is so near to 0 that this could have changed it.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn keeps(&self, toss: &Toss, outcome: Outcome) -> Result<bool, SolveError> {
        if self.is_none() {
            return Ok(true);
        }
        let Some(coin_toss) = toss.coin() else { return self.keeps_rigid(toss, outcome) };
        match self.relative_error(toss) {
            Some(relative) => holds_within(&coin_toss, relative),
            None => Ok(false),
        }
    }

    /// As [`Rounding::keeps`], for a body with I1 ≠ I2.
    fn keeps_rigid(&self, toss: &Toss, outcome: Outcome) -> Result<bool, SolveError> {
        match self.body {
            // How much a rounding of the launch changes has no simple bound next to the separatrix.
            _ if self.flight || self.rate => Ok(false),
            BodyRounding::Exact => Ok(true),
            BodyRounding::InOneUnit(body) => Ok(certify(&Toss { body, ..*toss })?.outcome() == outcome),
            BodyRounding::Rounded => Ok(false),
        }
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Dimension, Launch};
    use exact::ExactMotion;

    use super::*;

    const NONE: Rounding = Rounding { flight: false, rate: false, body: BodyRounding::Exact };

    fn toss(body: impl Into<Body>, x: f64, time_of_flight: TimeOfFlight) -> Toss {
        Toss { body: body.into(), launch: Launch::new([x, 0.0, 0.0], time_of_flight).unwrap() }
    }

    fn moments(texts: [&str; 3]) -> Vec<Given> {
        texts.map(|text| Dimension::Inertia.given("", text).unwrap()).into()
    }

    #[test]
    fn an_outcome_next_to_the_edge_is_kept_only_if_nothing_was_rounded() {
        // cos θ = cos(ωx T), with ωx T next to π/2.
        let edge = toss(Coin::PAPER, std::f64::consts::FRAC_PI_2, TimeOfFlight::Given(1.0));
        let far = toss(Coin::PAPER, 1.0, TimeOfFlight::Given(1.0));
        assert_eq!(NONE.keeps(&edge, Outcome::Heads), Ok(true));
        for rounded in [
            Rounding { flight: true, ..NONE },
            Rounding { rate: true, ..NONE },
            Rounding { body: BodyRounding::Rounded, ..NONE },
        ] {
            assert_eq!(rounded.keeps(&edge, Outcome::Heads), Ok(false), "{rounded:?}");
            assert_eq!(rounded.keeps(&far, Outcome::Heads), Ok(true), "{rounded:?}");
        }
    }

    /// Rates in one unit are carried as they are. In two units they are rounded, which the bound has to contain.
    #[test]
    fn a_landing_is_off_by_no_more_than_the_bound_of_its_rounding() {
        let mut largest = 0.0_f64;
        for index in 1..200 {
            let part = |square: f64| 2e4 * (f64::from(index) * square.sqrt()).fract() - 1e4;
            let rate = [2.0, 3.0, 5.0].map(part);
            let degrees = Dimension::TurnRate.given("", "1deg/s").unwrap().unit();
            let (unit, time) = (degrees.size(), TimeOfFlight::Given(1e5));
            let toss = |launch: Launch| Toss { body: Coin::DISC.into(), launch };
            let typed = toss(Launch::in_unit(rate, unit, time).unwrap());
            let rounded = toss(Launch::new(rate.map(|part| degrees.to_si(part)), time).unwrap());
            let landed = |toss: &Toss| ExactMotion::new(toss).state(time).unwrap().attitude;
            let off = landed(&typed).angle_to(&landed(&rounded));
            let bound = Rounding { rate: true, ..NONE }.error_bound(&rounded).unwrap().unwrap();
            assert!(off <= bound, "{rate:?}: {off:e}, not {bound:e}");
            largest = largest.max(off / bound);
            assert_eq!(NONE.error_bound(&rounded), Ok(Some(0.0)));
        }
        // A rounding is at most an eighth of what the bound allows of each factor.
        assert!(largest > 0.01, "{largest}");
        let body = toss(Body::from_moments([1.0, 2.0, 2.5]).unwrap(), 1.0, TimeOfFlight::Given(1.0));
        let top = 9.0 / 19.62_f64;
        let caught =
            toss(Coin::DISC, 1.0, TimeOfFlight::BallisticTo { speed: 3.0, gravity: 9.81, drop: -top.next_down() });
        let flight = Rounding { flight: true, ..NONE };
        assert_eq!([flight.error_bound(&body), flight.error_bound(&caught)], [Ok(None), Ok(None)]);
    }

    fn caught(drop: f64) -> TimeOfFlight {
        TimeOfFlight::BallisticTo { speed: 3.0, gravity: 9.81, drop }
    }

    #[test]
    fn a_catch_above_the_launch_is_kept_where_its_time_of_flight_is_known() {
        let top = 9.0 / 19.62_f64;
        for (drop, expected) in [(0.1, true), (-0.1, true), (-top * (1.0 - 1e-11), true), (-top * (1.0 - 1e-13), false)]
        {
            let caught = toss(Coin::PAPER, 1.0, caught(drop));
            let certificate = certify(&caught).unwrap();
            let keeps = |rounded: Rounding| rounded.keeps(&caught, certificate.outcome());
            assert_eq!(keeps(Rounding { flight: true, ..NONE }), Ok(expected), "{drop}");
            assert_eq!(keeps(Rounding { rate: true, ..NONE }), Ok(true));
        }
        // Next to a quarter of a turn an error of the time of flight decides: the higher the catch, the larger it may be.
        let near = |drop: f64, off: f64| {
            let time = caught(drop);
            let near = toss(Coin::PAPER, (std::f64::consts::FRAC_PI_2 - off) / time.seconds(), time);
            Rounding { flight: true, ..NONE }.keeps(&near, Outcome::Heads).unwrap()
        };
        assert!(near(-0.1, 1e-13) && near(-top * (1.0 - 1e-9), 1e-9));
        assert!(!near(-0.1, 1e-15) && !near(-top * (1.0 - 1e-9), 1e-13));
    }

    /// Errors far larger than those of conversions show by how much they change the time of flight.
    #[test]
    fn a_time_of_flight_is_off_by_no_more_than_the_bound() {
        const OFF: f64 = 1e-7;
        let mut largest = 0.0_f64;
        for part in [0.01, 0.3, 0.9, 0.99, 0.999] {
            let drop = -part * 9.0 / 19.62;
            let toss = toss(Coin::PAPER, 1.0, caught(drop));
            let bound = Rounding { flight: true, ..NONE }.relative_error(&toss).unwrap() * OFF / f64::EPSILON;
            let time = caught(drop).seconds();
            for signs in 0..8_u8 {
                let off = |bit: u8| 1.0 + if signs & bit == 0 { OFF } else { -OFF };
                let changed =
                    TimeOfFlight::BallisticTo { speed: 3.0 * off(1), gravity: 9.81 * off(2), drop: drop * off(4) };
                let change = (changed.seconds() / time - 1.0).abs();
                assert!(change <= bound, "{part} {signs}: {change:e}, not {bound:e}");
                largest = largest.max(change / bound);
            }
        }
        assert!(largest > 0.45, "{largest}");
    }

    #[test]
    fn a_body_in_one_unit_is_proven_in_it_and_no_other_rounding_is_bounded() {
        let of = |texts| BodyRounding::of(&moments(texts), |elements| Body::from_listed_moments(&elements));
        assert_eq!(of(["1", "2", "2.5"]), BodyRounding::Exact);
        assert_eq!(of(["1.1g·cm²", "2.3g·mm²", "1.2g·cm²"]), BodyRounding::Rounded);
        let own = of(["1.1g·cm²", "2.3g·cm²", "2.9g·cm²"]);
        assert_eq!(own, BodyRounding::InOneUnit(Body::from_moments([1.1, 2.3, 2.9]).unwrap()));

        let flight = toss(Body::from_moments([1.1e-7, 2.3e-7, 2.9e-7]).unwrap(), 1.0, TimeOfFlight::Given(1.0));
        let keeps = |rounded: Rounding, outcome| rounded.keeps(&flight, outcome).unwrap();
        assert!(keeps(Rounding { body: own, ..NONE }, Outcome::Heads));
        assert!(!keeps(Rounding { body: own, ..NONE }, Outcome::Tails));
        assert!(!keeps(Rounding { body: BodyRounding::Rounded, ..NONE }, Outcome::Heads));
        assert!(!keeps(Rounding { body: own, rate: true, ..NONE }, Outcome::Heads));
        assert!(!keeps(Rounding { flight: true, ..NONE }, Outcome::Heads));
    }
}
