//! The curve of the ideal rates of a body's flight, the polhode, on which A = ω1² + κ1 ω2² and B = ω3² + κ3 ω2² do not
//! change, with bounds of what follows from how far computed rates are from it. The theorem and its proof are in
//! `docs/proofs/enclosure.md`, section 7, whose symbols and numbers of formulas stand here. `errors.rs` adds up the steps.

mod errors;

use dynamics::body::PrincipalAxes;
use dynamics::{Flight, ModelBody, Toss, Unit};
use numerics::{Ball, DoubleDouble, Elementary, UNIT_ROUNDOFF};

pub(super) use self::errors::{Errors, Step};

/// The ideal flight of a body, in the unit of its flight, about its principal axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Polhode {
    /// κ1 and κ3.
    kappas: [Ball<DoubleDouble>; 2],
    /// κ̄, which none of κ1, κ3 and 1 exceeds. It is above 1 for a plate whose moments, as rounded, break the inequality of
    /// bodies.
    widest: f64,
    /// A and B.
    invariants: [Ball<DoubleDouble>; 2],
    /// b, the largest coupling of Euler's equations.
    coupling: f64,
    /// W, which no ideal rate exceeds.
    fastest: f64,
    /// The largest rate at which the body turns across its momentum.
    across: f64,
    /// μ, at which a disturbance of the rates grows at most.
    growth: f64,
    /// The distance of the computed rates at launch from the ideal ones.
    launched: f64,
    /// The error of the turn at landing because the axes are rounded, and because the body is not quite its model.
    axes: f64,
    /// Whether the body turns about a principal axis, as a sphere always does.
    about_axis: bool,
    /// Whether two moments are equal.
    is_symmetric: bool,
}

/// More than underflow can change in a rate.
const TINY: f64 = 1e-150;

/// A speed of the polhode, in units of b, below which TINY matters.
const SLOWEST: f64 = 1e-120;

/// The smallest of all moments but 0 relative to the largest, and the slowest rate (rad/s) in another unit than rad/s, for
/// which nothing underflows.
const SMALLEST: f64 = 1e-200;

/// More than √2.
const ROOT_2: f64 = 1.4143;

/// More than 1/√3.
const INVERSE_ROOT_3: f64 = 0.5774;

impl Polhode {
    /// That of the `model` of a toss with this `flight`. `None` if the numbers of the toss do not tell it: if they are too
    /// far from those of the flight, or underflow.
    pub(super) fn new(toss: &Toss, model: &ModelBody, flight: &Flight) -> Option<Self> {
        let PrincipalAxes { moments, axes } = model.principal;
        let [a, b, c] = model.couplings;
        if !are_told(model, toss.body.rigid().couplings()) {
            return None;
        }
        let rates = ideal_rates(toss, &axes, flight)?;
        let [x, y, z] = rates.map(|rate| rate * rate);
        let vanishes = |coupling: &Ball<DoubleDouble>| coupling.to_f64() == 0.0 && coupling.radius() == 0.0;
        let is_sphere = vanishes(&b);
        let kappas = if is_sphere { [b.like(1.0); 2] } else { [a / b, c / b] };
        let invariants = [x + kappas[0] * y, z + kappas[1] * y];
        let widest = kappas.iter().map(above).fold(1.0, f64::max);
        let fastest = above(&(x + y + z + a * c * y).sqrt());
        let about_axis =
            is_sphere || rates.iter().filter(|rate| rate.to_f64() == 0.0 && rate.radius() == 0.0).count() > 1;
        // Turns about a principal axis stay as they are.
        let still = if about_axis { 0.0 } else { 1.0 };
        let found = Self {
            kappas,
            widest,
            invariants,
            coupling: still * above(&b),
            fastest,
            across: across(&moments, &rates, widest * above(&(b * (invariants[0] * invariants[1]).sqrt())))
                .min(fastest),
            growth: still * above(&(a + c)) * fastest * INVERSE_ROOT_3,
            launched: distance(&rates, flight.rate.into()),
            axes: axes_error(&axes) + off_model(model, fastest * flight.span()),
            about_axis,
            is_symmetric: vanishes(&a) || vanishes(&c),
        };
        let radii = [kappas[0], kappas[1], invariants[0], invariants[1]].map(|ball| ball.radius());
        let told = radii.into_iter().all(|radius| radius < 1e-6) && found.axes < 1e-6 && found.launched < 1e-6;
        (told && fastest.is_finite()).then_some(found)
    }

    /// A bound (16) of an error of the rates after the time `h` that is at most `start` now.
    fn grown(&self, start: f64, h: f64) -> f64 {
        let first = start * exp_above(self.growth * h);
        let grown = first * exp_above(2.0 * INVERSE_ROOT_3 * self.widest * self.coupling * first * h);
        if grown <= 2.0 * first { grown } else { f64::INFINITY }
    }

    /// κ1 and κ3, rounded.
    fn rounded_kappas(&self) -> [f64; 2] {
        self.kappas.map(|kappa| kappa.to_f64())
    }

    /// |f|/b at these rates.
    fn speed(&self, [x, y, z]: [f64; 3]) -> f64 {
        let [k, l] = self.rounded_kappas();
        let off = self.kappas.iter().map(Ball::radius).sum::<f64>() * self.fastest * self.fastest;
        let [along_x, along_y, along_z] = [k * y * z, x * z, l * x * y];
        (along_x * along_x + along_y * along_y + along_z * along_z).sqrt() - 2.0 * off
    }

    /// A lower bound of the speed at an ideal rate that is at most `error` from these rates.
    fn speed_near(&self, rates: [f64; 3], error: f64) -> f64 {
        self.speed(rates) - error * self.widest * (ROOT_2 * self.fastest + INVERSE_ROOT_3 * error)
    }

    /// Bounds of what A and B are off at these rates.
    fn residuals(&self, [x, y, z]: [f64; 3]) -> [f64; 2] {
        const OF_DOUBLE_DOUBLE: f64 = 20.0 * UNIT_ROUNDOFF * UNIT_ROUNDOFF;
        let middle = DoubleDouble::product(y, y);
        [0, 1].map(|index: usize| {
            let (kappa, invariant) = (self.kappas[index], self.invariants[index]);
            let outer = [x, z][index];
            let sum = DoubleDouble::product(outer, outer) + *kappa.midpoint() * middle;
            let size = sum.hi().abs() + invariant.to_f64().abs();
            let off = kappa.radius() * middle.hi() + invariant.radius() + OF_DOUBLE_DOUBLE * size + TINY * TINY;
            (sum - *invariant.midpoint()).hi().abs() + off
        })
    }

    /// A bound (19) of the error across the curve, from the residuals at the computed `rates`. It is at most `error`, and
    /// the ideal speed is at least `speed`.
    fn across(&self, rates: [f64; 3], error: f64, speed: f64) -> f64 {
        let [x, y, z] = rates;
        let ([k, l], [of_a, of_b]) = (self.rounded_kappas(), self.residuals(rates));
        let off = self.kappas.map(|kappa| kappa.radius() * self.fastest);
        let widened = self.widest * error;
        let gradient_a = (x * x + k * y * k * y).sqrt() + widened + off[0];
        let gradient_b = (z * z + l * y * l * y).sqrt() + widened + off[1];
        let left = speed - 0.5 * widened * (gradient_a + gradient_b);
        if left > 0.0 { (0.5 * (gradient_a * of_b + gradient_b * of_a) / left).min(error) } else { error }
    }
}

/// A number that is at least the size of all numbers in the ball.
fn above(ball: &Ball<DoubleDouble>) -> f64 {
    (ball.to_f64().abs() + ball.radius()) * (1.0 + 1e-15)
}

/// Whether the couplings of the `model` are the `computed` ones but for their rounding, and nothing underflows.
fn are_told(model: &ModelBody, computed: [f64; 3]) -> bool {
    let off = model.couplings.iter().zip(computed).map(|(exact, rounded)| {
        let rounded = Ball::new(DoubleDouble::exactly(rounded.abs()), 0.0);
        above(&(*exact - rounded))
    });
    let told = off.fold(0.0, f64::max) <= 1.01 * UNIT_ROUNDOFF * above(&model.couplings[1]);
    let least = model.principal.moments[0].to_f64();
    told && (least == 0.0 || least >= SMALLEST)
}

/// A bound (21) of how far the body turns away from its `model` while it turns by `phase`.
fn off_model(model: &ModelBody, phase: f64) -> f64 {
    if model.off == 0.0 {
        return 0.0;
    }
    let (phase, least) = (1.5 * phase, model.principal.moments[0]);
    1.001 * model.off / (least.to_f64() - least.radius()) * phase * phase * (1.0 + 0.2 * phase)
}

/// The largest rate across the momentum, if no |f| exceeds `fastest`.
fn across(moments: &[Ball<DoubleDouble>; 3], rates: &[Ball<DoubleDouble>; 3], fastest: f64) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| moments[axis] * rates[axis]);
    let momentum = (x * x + y * y + z * z).sqrt();
    let least = momentum.to_f64() * (1.0 - 1e-15) - momentum.radius();
    if least > 0.0 { above(&moments[2]) * fastest / least } else { f64::INFINITY }
}

/// A bound of e^x, from 2 artanh y ≥ 2 y; infinite for x ≥ 16.
fn exp_above(x: f64) -> f64 {
    let y = x / 16.0;
    let root = if y < 1.0 { (1.0 + y) / (1.0 - y) } else { f64::INFINITY };
    root.powi(8)
}

/// The ideal rates at launch about the principal axes, in the unit of the flight. `None` if they may have lost digits.
fn ideal_rates(toss: &Toss, axes: &[[Ball<DoubleDouble>; 3]; 3], flight: &Flight) -> Option<[Ball<DoubleDouble>; 3]> {
    let exactly = |value: f64| Ball::new(DoubleDouble::exactly(value), 0.0);
    let largest = toss.launch.rate().amax();
    let scale = numerics::scale::power_of_two_scale(largest);
    let (given, unit) = toss.launch.given_rate();
    let parts = [given.x, given.y, given.z];
    let lost = if parts.iter().any(|part| *part != 0.0 && (part / scale).abs() < TINY) { TINY * TINY } else { 0.0 };
    let in_radians = unit == Unit::ONE;
    if in_radians && are_exact(axes) {
        return Some(<[f64; 3]>::from(flight.rate).map(|rate| exactly(rate).widened(lost)));
    }
    if !in_radians && (largest < SMALLEST || given.amax() > 1.0 / SMALLEST) {
        return None;
    }
    let unit = if in_radians { exactly(1.0) } else { exactly(0.0).like_big(&unit.in_digits(160)) };
    let along = |axis: &[Ball<DoubleDouble>; 3]| {
        let turning = axis.iter().zip(parts).filter(|(direction, part)| direction.to_f64() != 0.0 && *part != 0.0);
        turning.fold(exactly(0.0), |sum, (direction, part)| sum + *direction * exactly(part / scale) * unit)
    };
    // Axes that are not exact have no components that are exactly 0.
    let lost = if are_exact(axes) { lost } else { lost + TINY };
    Some(axes.each_ref().map(|axis| along(axis).widened(lost)))
}

/// Whether these axes are those of the body frame, in any order.
fn are_exact(axes: &[[Ball<DoubleDouble>; 3]; 3]) -> bool {
    axes.iter().flatten().all(|part| part.radius() == 0.0 && [0.0, 1.0].contains(&part.to_f64().abs()))
}

/// A bound of the distance between ideal rates and computed ones.
fn distance(ideal: &[Ball<DoubleDouble>; 3], computed: [f64; 3]) -> f64 {
    let off = |(ideal, computed): (&Ball<DoubleDouble>, f64)| {
        let exact = *ideal.midpoint() - computed.into();
        exact.hi().abs() * (1.0 + 1e-15) + ideal.radius()
    };
    ideal.iter().zip(computed).map(off).sum()
}

/// A bound of the error of a turn that is taken from principal axes to those of the body with rounded axes.
fn axes_error(axes: &[[Ball<DoubleDouble>; 3]; 3]) -> f64 {
    // `f64::max` would pass over a NaN.
    let larger = |most: f64, one: f64| if one > most || one.is_nan() { one } else { most };
    let radius = axes.iter().flatten().map(Ball::radius).fold(0.0, larger);
    if are_exact(axes) { 0.0 } else { 12.0 * UNIT_ROUNDOFF + 6.0 * radius }
}

#[cfg(test)]
mod tests;
