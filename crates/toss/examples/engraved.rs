//! What does the relief of a coin change?
//!
//! A US quarter with a model of its relief (`us-quarter-engraved` in the catalogue) is thrown beside the same quarter as
//! a cylinder, with the same launches: a hand that turns it at 207 rad/s about x and 60 rad/s about n, at 2.45 m/s, and
//! varies each of these by some percent. The outcomes of both are proven, launch by launch:
//!
//! ```text
//! hand varies by  heads as a cylinder  heads with its relief  land differently
//! 0.1  %          1.0000               1.0000                 0.0000
//! 0.5  %          0.9890               0.9885                 0.0010
//! 1    %          0.8027               0.8025                 0.0027
//! 2    %          0.6255               0.6265                 0.0063
//! 5    %          0.6089               0.6086                 0.0042
//! ```
//!
//! The relief moves n at landing by a degree or so. A toss that lands on edge within that angle lands on the other side,
//! and the share of heads of a hand that varies hardly changes.
//!
//! `cargo run --release -p toss --example engraved`

use toss::catalogue::named_body;
use toss::sampling::{HAND, Plan, Space};
use toss::{Outcome, Toss, certify};

/// Number of launches for each spread.
const LAUNCHES: u64 = 4096;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (cylinder, engraved) = (named_body("us-quarter")?, named_body("us-quarter-engraved")?);
    let toss = Space::builder(cylinder).rate_x(207.0).rate_y(0.0).rate_z(60.0).speed(2.45).build()?;
    println!("hand varies by  heads as a cylinder  heads with its relief  land differently");
    let mut different = Vec::new();
    for percent in [0.1, 0.5, 1.0, 2.0, 5.0] {
        let space = toss.with_spread(percent / 100.0, &HAND)?;
        let (mut heads, mut differ) = ([0_u32; 2], 0_u32);
        for drawn in space.drawn(Plan::Random { points: LAUNCHES, seed: 1 })?.flatten() {
            let launch = drawn.toss.launch;
            let lands = |body| certify(&Toss { body, launch }).map(toss::Certificate::outcome);
            let outcomes = [lands(cylinder)?, lands(engraved)?];
            for (heads, outcome) in heads.iter_mut().zip(outcomes) {
                *heads += u32::from(outcome == Outcome::Heads);
            }
            differ += u32::from(outcomes[0] != outcomes[1]);
        }
        let share = |count: u32| f64::from(count) / LAUNCHES as f64;
        let [plain, relief] = heads.map(share);
        println!("{percent:<4} %          {plain:.4}               {relief:.4}                 {:.4}", share(differ));
        different.push(share(differ));
    }
    assert!(different.iter().all(|share| *share < 0.01), "{different:?}");
    Ok(())
}
