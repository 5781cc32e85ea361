//! Do two solvers agree on many tosses?
//!
//! This example chooses the backend when the program is compiled. Its code is generic over [`Solver`], so it needs
//! neither a `Box` nor a look-up by name.
//!
//! ```text
//! heads of 50: 45 by the exact motion, 45 by the quaternion
//! ```
//!
//! `cargo run --release -p toss --example backend_by_type`

use toss::{
    Coin, ExactSolver, Formulation, InputError, Launch, QuaternionSolver, Scheme, SolveError, Solver, Stepping,
    TimeOfFlight, Toss, Vector3,
};

/// The number of tosses that land heads according to `solver`.
fn heads_by<S: Solver>(solver: &S, tosses: &[Toss]) -> Result<usize, SolveError> {
    let mut heads = 0;
    for toss in tosses {
        heads += usize::from(solver.tilt(toss)?.cos_tilt > 0.0);
    }
    Ok(heads)
}

/// 50 tosses of the paper's coin at 4 m/s with the body rates ω = (10, 10, ωz), where ωz is 0, 1, ..., 49 rad/s.
fn tosses() -> Result<Vec<Toss>, InputError> {
    let thrown = TimeOfFlight::thrown(4.0, 9.81, None);
    let toss = |spin: u32| {
        let launch = Launch::new(Vector3::new(10.0, 10.0, f64::from(spin)), thrown)?;
        Ok(Toss::new(Coin::PAPER, launch))
    };
    (0..50).map(toss).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let tosses = tosses()?;
    let quaternion = QuaternionSolver::new(Stepping::adaptive(Scheme::DOP853, 1e-9)?, Formulation::default());
    let (exact, integrated) = (heads_by(&ExactSolver, &tosses)?, heads_by(&quaternion, &tosses)?);
    println!("heads of {}: {exact} by the exact motion, {integrated} by the quaternion", tosses.len());
    assert_eq!(exact, integrated);
    Ok(())
}
