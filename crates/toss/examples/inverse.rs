//! How must a coin be launched to land heads in 95 % of the tosses?
//!
//! A US quarter is thrown from horizontal at any speed from 3 to 5 m/s. It tumbles at the rate Ω (the body rate about a
//! diameter). Which spin ωz (the body rate about its normal) does it need? For long flights the answer is a formula:
//! cot²ψ = sin(π (p - ½)) and ωz = Ω/(k tan ψ), where p is the wanted probability, ψ the angle between the normal and
//! the angular momentum, and k = I3/I1. For speeds from 3 to 5 m/s the share of heads has a closed form, and the
//! example finds the spin from it by bisection. Independent random launches then confirm the result.
//!
//! ```text
//! Ω/(rad/s)  ωz in long flights  ωz from 3 to 5 m/s  heads of 1000000 launches (95 %)
//! 10         5.0036              5.0086              0.9500 (0.9496 to 0.9504)
//! 50         25.0180             24.9705             0.9498 (0.9494 to 0.9503)
//! 250        125.0900            125.0985            0.9502 (0.9497 to 0.9506)
//! ```
//!
//! `cargo run --release -p toss --example inverse`

use toss::catalogue::named_coin;
use toss::sampling::{Estimate, Found, Interval, Plan, Rest, Sampler, Space, clopper_pearson, rate_ratio};
use toss::{Coin, Error};

const WANTED: f64 = 0.95;
const LAUNCHES: u64 = 1_000_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let quarter = named_coin("us-quarter")?;
    println!("Ω/(rad/s)  ωz in long flights  ωz from 3 to 5 m/s  heads of {LAUNCHES} launches (95 %)");
    for rate in [10.0, 50.0, 250.0] {
        let long = rate / rate_ratio(WANTED, quarter.inertia_ratio())?;
        let spin = spin(quarter, rate)?;
        let sample = heads(quarter, rate, spin, Plan::Random { points: LAUNCHES, seed: 1 })?;
        let Interval { lo, hi } = sample.interval.ok_or("a sample has an interval")?;
        println!("{rate:<9}  {long:<18.4}  {spin:<18.4}  {:.4} ({lo:.4} to {hi:.4})", sample.probability);

        // This interval is wider than the one that is printed: by chance alone, one seed in 10 000 fails.
        let Found::Counts(counts) = sample.found else { return Err("a sample has counts".into()) };
        assert!(clopper_pearson(counts.heads(), LAUNCHES, 0.9999).contains(WANTED));
    }
    Ok(())
}

/// The spin ωz (rad/s) that gives the wanted share of heads at the tumbling rate `rate` (rad/s). The share is smaller
/// without spin, and it is 1 at ψ = 45°, where Ω = k ωz.
fn spin(coin: Coin, rate: f64) -> Result<f64, Error> {
    let (mut less, mut more) = (0.0, rate / coin.inertia_ratio());
    for _ in 0..60 {
        let middle = 0.5 * (less + more);
        let share = heads(coin, rate, middle, Plan::ExactSpeed(Rest::Grid))?.probability;
        if share < WANTED { less = middle } else { more = middle }
    }
    Ok(more)
}

/// The probability of heads at speeds from 3 to 5 m/s, for the rates (rad/s) of tumbling and of spin.
fn heads(coin: Coin, rate: f64, spin: f64, plan: Plan) -> Result<Estimate, Error> {
    let space = Space::builder(coin).rate_x(rate).rate_y(0.0).rate_z(spin).speed(3.0..=5.0).build()?;
    Sampler::exact().estimate(&space, plan)
}
