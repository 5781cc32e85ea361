//! How does this toss land, and how close was it to the other side?
//!
//! A US quarter tumbles at 38 turns a second and spins about its normal at 50 rad/s. It is thrown at 2.4 m/s and caught
//! at the height at which it left the hand. The margin is the smallest change of the speed v0 that flips the outcome; ψ
//! is the angle between the normal and the angular momentum.
//!
//! ```text
//! outcome   heads, proven
//! cos θ     0.700987799768
//! attitude  w +0.718362807  x +0.338857683  y -0.186229887  z +0.578315465
//! margin    +16.7013 mm/s in v0, +0.3090 turns/s in ωx
//! ψ         67.4155°, heads for ever below 45°
//! ```
//!
//! `cargo run --release -p toss --example toss`

use std::f64::consts::TAU;

use toss::catalogue::named_coin;
use toss::{CoinMotion, ExactSolver, InputError, Launch, Solver, TimeOfFlight, Toss, Vector3, certify, margin};

const SPEED: f64 = 2.4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let toss = thrown(SPEED)?;
    let proven = certify(&toss)?;
    let landing = ExactSolver.land(&toss)?;
    let [w, x, y, z] = landing.state.attitude.components();
    let nearest = margin(&toss)?;
    let change = nearest.speed.ok_or("no speed changes the outcome")?;
    let change_of_rate = nearest.rate[0].ok_or("no rate about x changes the outcome")?;
    println!("outcome   {}, proven", proven.outcome().name());
    println!("cos θ     {:.12}", landing.cos_tilt);
    println!("attitude  w {w:+.9}  x {x:+.9}  y {y:+.9}  z {z:+.9}");
    println!("margin    {:+.4} mm/s in v0, {:+.4} turns/s in ωx", 1e3 * change, change_of_rate / TAU);
    let motion = CoinMotion::new(&toss.coin().ok_or("a quarter is a coin")?);
    println!("ψ         {:.4}°, heads for ever below 45°", motion.cone_angle().to_degrees());

    // A change slightly below the margin keeps the outcome, and one slightly above flips it.
    assert_eq!(certify(&thrown(SPEED + change * (1.0 - 1e-9))?)?.outcome(), proven.outcome());
    assert_ne!(certify(&thrown(SPEED + change * (1.0 + 1e-9))?)?.outcome(), proven.outcome());
    Ok(())
}

/// The toss of the quarter at `speed` (m/s).
fn thrown(speed: f64) -> Result<Toss, InputError> {
    let up = TimeOfFlight::Ballistic { speed, gravity: 9.81 };
    let launch = Launch::new(Vector3::new(38.0 * TAU, 0.0, 50.0), up)?;
    Ok(Toss::new(named_coin("us-quarter")?, launch))
}
