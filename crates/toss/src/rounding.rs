//! Numbers that people type with units are rounded when they are converted to SI units, and an outcome is proven for the
//! numbers after that. [`Rounding`] judges whether it is also the outcome of the numbers as they were typed.

use dynamics::quantity::{Given, common_unit};
use dynamics::{Body, InputError, Outcome, SolveError, TimeOfFlight, Toss};
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
    /// Whether nothing was rounded.
    pub fn is_none(&self) -> bool {
        !self.flight && !self.rate && self.body == BodyRounding::Exact
    }

    /// Whether the time of flight was rounded so that its error has no bound: a landing above the launch may end the flight
    /// near its top, where the time depends on the speed without a bound.
    fn time_is_unbounded(&self, toss: &Toss) -> bool {
        self.flight && matches!(toss.launch.time_of_flight(), TimeOfFlight::BallisticTo { drop, .. } if drop < 0.0)
    }

    /// A bound of the angle (rad) between the landing of `toss` and that of the numbers as they were typed: 0 if none was
    /// rounded, `None` where no bound is known, as for a body with I1 ≠ I2 next to whose separatrix a rounding may change
    /// all.
    ///
    /// The landed coin is the launched one, turned by Φ = (ωx, ωy, k ωz) T and then by -q T with q = (k - 1) ωz about n. Three
    /// factors, each with a relative error of 4 ε, change Φ by up to 3.1 of it and q T by as much of q T and of
    /// k ωz T, which |Φ| bounds.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn error_bound(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
        if self.is_none() {
            return Ok(Some(0.0));
        }
        let Some(coin_toss) = toss.coin().filter(|_| !self.time_is_unbounded(toss)) else { return Ok(None) };
        let (turn, spin) = CoinMotion::new(&coin_toss).phases(toss.launch.time_of_flight())?;
        Ok(Some(RELATIVE * (6.3 * turn.hi() + 3.1 * spin.hi().abs())))
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
        if self.time_is_unbounded(toss) {
            return Ok(false);
        }
        holds_within(&coin_toss, RELATIVE)
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
            let (unit, time) = (degrees.angle_unit(), TimeOfFlight::Given(1e5));
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
        let caught = toss(Coin::DISC, 1.0, TimeOfFlight::BallisticTo { speed: 3.0, gravity: 9.81, drop: -0.1 });
        let flight = Rounding { flight: true, ..NONE };
        assert_eq!([flight.error_bound(&body), flight.error_bound(&caught)], [Ok(None), Ok(None)]);
    }

    #[test]
    fn a_catch_above_the_launch_is_kept_only_if_its_time_was_not_rounded() {
        for (drop, expected) in [(-0.1, false), (0.1, true)] {
            let caught = toss(Coin::PAPER, 1.0, TimeOfFlight::BallisticTo { speed: 3.0, gravity: 9.81, drop });
            let certificate = certify(&caught).unwrap();
            let keeps = |rounded: Rounding| rounded.keeps(&caught, certificate.outcome());
            assert_eq!(keeps(Rounding { flight: true, ..NONE }), Ok(expected));
            assert_eq!(keeps(Rounding { rate: true, ..NONE }), Ok(true));
        }
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
