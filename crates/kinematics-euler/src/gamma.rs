//! [`GammaSolver`], which integrates the γ-ODE (10), the paper's own equation: one equation of second order for the
//! spin angle γ. It is here to test the paper's equation, with guards at the points where that equation is singular.
//!
//! ```text
//! γ'' + A γ' + B γ'² + C = 0                                                                            (10)
//! A = (3 ωz - q) β'/D,   B = -2 β'/D,   C = -(ωz (ωz - q) + D²) β'/D                                    (11)
//! D = ωx sin γ + ωy cos γ = α' sin β,   u = ωz - γ' = α' cos β                                         by (5)
//! β' = ωx cos γ - ωy sin γ                                                                              (8)
//! ```
//!
//! Here ω = (ωx, ωy, ωz) is the body rate, α the precession, β the nutation, k = I3/I1 and q = (k - 1) ωz. In (11),
//! ωx' = -q ωy and ωy' = q ωx are inserted already.
//!
//! The other two angles follow without a division by cos β, which may be 0: β = atan2(s D, s u) from (9), and
//! α' = s √(D² + u²), where s is the sign of α'. The sign is constant, because α' could only change it by vanishing. At
//! that point D and u are 0 and (10) reads 0/0, which is a typed error.

use dynamics::body_rate::{body_precession_rate, transverse_acceleration};
use dynamics::integrate::OdeSystem;
use dynamics::{
    CoinToss, EulerAngles, Flight, Formulation, Landing, Scheme, Settings, Singularity, SolveError, Solver,
    SolverEntry, Stepping, Toss,
};
use nalgebra::SVector;

use crate::initial::InitialConditions;
use crate::passes::Passes;
use crate::raw::RawGamma;

/// Why the γ-ODE solves coins alone.
const FOR_COINS: &str = "its equation supposes I1 = I2 and a constant ωz";

/// If |D| is below this fraction of |β'|, about √ε, rounding errors leave no correct digit of (10).
const CANCELLATION_THRESHOLD: f64 = 1.5e-8;

/// A flight is refused if |α'| falls below this fraction of the rates. D and u, from which β is recovered, are then
/// small differences of the rates and have lost two digits.
const SMALLEST_PRECESSION: f64 = 1e-2;

/// The solver that integrates the γ-ODE.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GammaSolver {
    stepping: Stepping,
    formulation: Formulation,
}

impl GammaSolver {
    /// The solver's name in the registry.
    pub const NAME: &'static str = "gamma";

    /// The solver's entry for the registry.
    pub fn entry() -> SolverEntry {
        let build =
            |settings: &Settings| -> Box<dyn Solver> { Box::new(Self::new(settings.stepping, settings.formulation)) };
        SolverEntry::new(Self::NAME, "the γ-ODE (10), the paper's equation for the spin angle", build)
            .with_schemes(&Scheme::RUNGE_KUTTA)
            .with_formulations(&Formulation::ALL)
            .with_color([213, 94, 0])
    }

    /// A solver that integrates the equations of `formulation` with `stepping`.
    pub fn new(stepping: Stepping, formulation: Formulation) -> Self {
        Self { stepping, formulation }
    }
}

impl Solver for GammaSolver {
    fn name(&self) -> &str {
        Self::NAME
    }

    fn stepping(&self) -> Option<Stepping> {
        Some(self.stepping)
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let (landing, passes) = self.land_coin(&toss.of_coin(Self::NAME, FOR_COINS)?)?;
        let growth = passes.growth(self.formulation);
        Ok(landing.with_error(self.stepping.error_estimate(toss)?.map(|estimate| growth * estimate)))
    }
}

impl GammaSolver {
    fn land_coin(&self, toss: &CoinToss) -> Result<(Landing, Passes), SolveError> {
        let flight = Flight::new(&Toss::from(*toss))?;
        let rate = flight.rate;
        let start = InitialConditions::new(toss, &rate, self.formulation);
        let k = toss.coin.inertia_ratio();
        let first = SVector::from([start.angles.gamma, rate.z - start.u, start.angles.alpha, rate.x, rate.y]);
        if !self.formulation.is_guarded() {
            let system = RawGamma::new(k, rate.z);
            let (end, work) = flight.integrate(&system, first, &self.stepping)?;
            return Ok((start.landing(&flight, &system.angles(&end), [end[3], end[4]], work)?, Passes::none()));
        }
        let system = GammaSystem { launched: start.angles.beta, ..GammaSystem::new(k, rate.z, start.precession) };
        if system.precession_too_slow(&first) && !start.rests_at_the_pole(&rate) {
            return Err(SolveError::Singular { point: Singularity::PrecessionTooSlow, time: 0.0 });
        }
        let (end, work) = flight.integrate(&system, first, &self.stepping)?;
        let landing = start.landing(&flight, &system.angles(&end), [end[3], end[4]], work)?;
        Ok((landing, system.passes))
    }
}

/// The guarded system over the state (γ, γ', α, ωx, ωy).
struct GammaSystem {
    /// ωz.
    rate_z: f64,
    /// q = (k - 1) ωz, the rate at which (ωx, ωy) turns in the body frame.
    q: f64,
    /// s, the sign of α'.
    sense: f64,
    /// β at launch.
    launched: f64,
    passes: Passes,
}

/// D and u by (5), and β' by (8), at one state.
struct Terms {
    d: f64,
    u: f64,
    beta_rate: f64,
}

impl GammaSystem {
    /// The system of a launch at β = 0.
    fn new(inertia_ratio: f64, rate_z: f64, precession: f64) -> Self {
        Self {
            rate_z,
            q: body_precession_rate(inertia_ratio, rate_z),
            sense: if precession < 0.0 { -1.0 } else { 1.0 },
            launched: 0.0,
            passes: Passes::none(),
        }
    }

    fn terms(&self, y: &SVector<f64, 5>) -> Terms {
        let &[gamma, gamma_rate, _, rate_x, rate_y] = &y.data.0[0];
        let (sin, cos) = gamma.sin_cos();
        Terms { d: rate_x * sin + rate_y * cos, u: self.rate_z - gamma_rate, beta_rate: rate_x * cos - rate_y * sin }
    }

    fn angles(&self, y: &SVector<f64, 5>) -> EulerAngles {
        let Terms { d, u, .. } = self.terms(y);
        // D = u = 0 (each +0 or -0) is a coin without precession. Such a flight is accepted only if n rests: that of a coin
        // at rest, or of one that spins at β = 0.
        let beta = if d == 0.0 && u == 0.0 { self.launched } else { (self.sense * d).atan2(self.sense * u) };
        EulerAngles { alpha: y[2], beta, gamma: y[0] }
    }

    /// γ'' by (10) and (11).
    fn gamma_acceleration(&self, terms: &Terms, gamma_rate: f64) -> f64 {
        let &Terms { d, beta_rate, .. } = terms;
        let (rate_z, q) = (self.rate_z, self.q);
        // Each of A, B and C is a factor times β'/D.
        let (a, b, c) = (3.0 * rate_z - q, -2.0, -(rate_z * (rate_z - q) + d * d));
        let sum = a * gamma_rate + b * gamma_rate * gamma_rate + c;
        // On the regular solution through sin β = 0 the sum vanishes like D², so that γ'' is of the order of D. There 0
        // is as accurate as anything that rounding allows to compute. If β' = 0 too, as in pure spin, γ' is constant.
        let regular = sum.abs() <= CANCELLATION_THRESHOLD * (rate_z * rate_z + gamma_rate * gamma_rate);
        if beta_rate == 0.0 || (d.abs() <= CANCELLATION_THRESHOLD * beta_rate.abs() && regular) {
            return 0.0;
        }
        -sum * (beta_rate / d)
    }

    /// |α'|, and the larger one of √(ωx² + ωy²) and |ωz|, in a state with these `terms`.
    fn precession_and_rate(&self, terms: &Terms, y: &SVector<f64, 5>) -> [f64; 2] {
        [terms.d.hypot(terms.u), y[3].hypot(y[4]).max(self.rate_z.abs())]
    }

    /// Whether |α'| is below [`SMALLEST_PRECESSION`] times the rates.
    fn precession_too_slow(&self, y: &SVector<f64, 5>) -> bool {
        is_too_slow(self.precession_and_rate(&self.terms(y), y))
    }
}

/// Whether a precession is below [`SMALLEST_PRECESSION`] times the rates.
fn is_too_slow([precession, rate]: [f64; 2]) -> bool {
    precession < SMALLEST_PRECESSION * rate
}

impl OdeSystem<5> for GammaSystem {
    fn derivative(&self, y: &SVector<f64, 5>) -> SVector<f64, 5> {
        let terms = self.terms(y);
        let (rate_x_dot, rate_y_dot) = transverse_acceleration(self.q, y[3], y[4]);
        SVector::from([
            y[1],
            self.gamma_acceleration(&terms, y[1]),
            self.sense * terms.d.hypot(terms.u),
            rate_x_dot,
            rate_y_dot,
        ])
    }

    fn singularity(&self, before: &SVector<f64, 5>, after: &SVector<f64, 5>) -> Option<Singularity> {
        let (was, is) = (self.terms(before), self.terms(after));
        let [at_first, at_last] = [(&was, before), (&is, after)].map(|(terms, y)| self.precession_and_rate(terms, y));
        self.passes.turned(after[2] - before[2]);
        for [precession, rate] in [at_first, at_last] {
            self.passes.magnified(rate / precession);
        }
        // D = 0 counts as no crossing, because a tiny transverse rate may underflow in the momentum frame.
        let crossed = was.d * is.d < 0.0;
        let stopped = is_too_slow(at_last) && !is_too_slow(at_first);
        let turned_back = crossed && was.u * is.u < 0.0;
        if stopped || turned_back {
            return Some(Singularity::PrecessionTooSlow);
        }
        // At a launch from sin β = 0 rounding decides the sign of D, so that a change of it is not a crossing.
        let started_there = was.d.abs() <= CANCELLATION_THRESHOLD * was.beta_rate.abs();
        (crossed && !started_there).then_some(Singularity::NormalAlongAxis)
    }
}

#[cfg(test)]
mod tests;
