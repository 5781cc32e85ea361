//! The Runge-Kutta-Munthe-Kaas method of order 4 on unit quaternions, a Lie-group method: it steps in the Lie algebra
//! and returns to the group by the exponential, so that the norm is kept whatever the step is.
//!
//! With P = P0 exp(u/2) the equation P' = ½ P ⊗ (0, ω) becomes u' = ω + ½ u × ω + 1/12 u × (u × ω) - …, of which the
//! terms shown suffice for order 4 (Munthe-Kaas, Appl. Numer. Math. 29 (1999), 115; Hairer, Lubich & Wanner, Geometric
//! Numerical Integration, IV.8).

use toss::{FreeRotation, Scheme, SolverEntry, StepControl, Vector3};

type Quaternion = nalgebra::Quaternion<f64>;

/// The method's entry.
pub fn entry() -> SolverEntry {
    let scheme = Scheme::new("rkmk4", Some(4)).with_fixed_steps();
    SolverEntry::from_stepper("lie-group", "Runge-Kutta-Munthe-Kaas of order 4", &[scheme], |system, by| {
        let StepControl::Step(h) = by.control() else { return Err("it takes steps of a given length".into()) };
        let [w, x, y, z, rate @ ..] = system.start();
        let (mut turn, mut rate) = (Quaternion::new(w, x, y, z), Vector3::from(rate));
        let steps = (system.duration() / h).round();
        for _ in 0..steps as u64 {
            (turn, rate) = step(system, turn, rate, h);
        }
        let end = [turn.w, turn.i, turn.j, turn.k, rate.x, rate.y, rate.z];
        Ok((end, system.work(steps as u64, 0)))
    })
    .with_color([213, 94, 0])
}

/// The state (P, ω) after a step of length `h`.
fn step(system: &FreeRotation, turn: Quaternion, rate: Vector3<f64>, h: f64) -> (Quaternion, Vector3<f64>) {
    let slope = |u: Vector3<f64>, rate: Vector3<f64>| {
        let [.., x, y, z] = system.derivative(&[1.0, 0.0, 0.0, 0.0, rate.x, rate.y, rate.z]);
        let bracket = u.cross(&rate);
        (rate + 0.5 * bracket + u.cross(&bracket) / 12.0, Vector3::new(x, y, z))
    };
    let (u1, a1) = slope(Vector3::zeros(), rate);
    let (u2, a2) = slope(0.5 * h * u1, rate + 0.5 * h * a1);
    let (u3, a3) = slope(0.5 * h * u2, rate + 0.5 * h * a2);
    let (u4, a4) = slope(h * u3, rate + h * a3);
    let u = h / 6.0 * (u1 + 2.0 * (u2 + u3) + u4);
    let half = Quaternion::from_imag(0.5 * u);
    (turn * half.exp(), rate + h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4))
}
