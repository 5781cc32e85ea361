//! Why does a tennis racket turn over?
//!
//! Throw a racket up flat so that it turns end over end, about the axis y in its plane and across its handle, and catch
//! it by the handle after one turn: the other face is up. The turn about y, the axis of the middle moment of inertia, is
//! unstable (M. S. Ashbaugh, C. C. Chicone and R. H. Cushman, J. Dynam. Differ. Equ. 3 (1991), 67). A disturbance grows
//! by the factor exp(2π √((I3 - I2)(I2 - I1)/(I1 I3))) in a turn, which is 265 for this racket, so that a twist of a few
//! percent, which no hand avoids, becomes a half turn about the handle.
//!
//! Thrown at 12 rad/s with a twist about the handle as well, and caught after one turn, the face that was up is:
//!
//! ```text
//! twist / turn  cos θ at the catch
//! 0             +1.0000, heads
//! 0.000000001   +1.0000, heads
//! 0.000001      +1.0000, heads
//! 0.0001        +0.9999, heads
//! 0.001         +0.9905, heads
//! 0.01          +0.3539, heads
//! 0.03          -0.6172, tails
//! 0.1           -0.9532, tails
//! 0.3           -0.9757, tails
//! 1             +0.8503, heads
//! ```
//!
//! Every outcome is proven. At exactly 0 the racket would turn about y for ever, and smaller twists take further turns.
//!
//! `cargo run --release -p toss --example racket`

use std::f64::consts::TAU;

use toss::{Body, ExactSolver, Launch, Outcome, Solver, TimeOfFlight, Toss, certify};

/// ωy (rad/s).
const TURN: f64 = 12.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let body: Body = "racket".parse()?;
    println!("twist / turn  cos θ at the catch");
    let mut outcomes = Vec::new();
    for twist in [0.0, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0] {
        let launch = Launch::new([twist * TURN, TURN, 0.0], TimeOfFlight::Given(TAU / TURN))?;
        let toss = Toss { body, launch };
        let outcome = certify(&toss)?.outcome();
        println!("{twist:<12}  {:+.4}, {outcome}", ExactSolver.tilt(&toss)?.cos_tilt);
        outcomes.push(outcome);
    }
    // Smaller twists need more turns to grow.
    assert!(outcomes[..5].iter().all(|outcome| *outcome == Outcome::Heads));
    assert!(outcomes[6..9].iter().all(|outcome| *outcome == Outcome::Tails));
    Ok(())
}
