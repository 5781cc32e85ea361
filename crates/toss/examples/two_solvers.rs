//! Solves a toss in closed form and by an integrator. README.md shows this program.
//!
//! ```text
//! heads: 0.66566129, integrated 0.66566129
//! ```

use toss::{Coin, ExactSolver, Launch, Registry, Settings, Solver, TimeOfFlight, Toss};

fn main() -> Result<(), toss::Error> {
    let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
    let toss = Toss::new(Coin::PAPER, Launch::new([1.0, 1.0, 2.5], thrown)?);
    let integrator = Registry::standard().named("quaternion")?.solver(&Settings::default())?;
    let (exact, integrated) = (ExactSolver.tilt(&toss)?, integrator.tilt(&toss)?);
    println!("{}: {:.8}, integrated {:.8}", exact.outcome().name(), exact.cos_tilt, integrated.cos_tilt);
    Ok(()) // heads: 0.66566129, integrated 0.66566129
}
