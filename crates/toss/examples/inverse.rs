//! How has a coin to be launched to land heads in 95 % of the tosses?
//!
//! A US quarter, from horizontal, at a speed that is anywhere from 3 to 5 m/s: which spin ωz does it need beside the
//! rate Ω at which it tumbles? In long flights cot²ψ = sin(π (p - ½)) and ωz = Ω/(k tan ψ). At these speeds the share
//! of heads is known in closed form, so the spin follows from it by bisection; independent random launches say that it
//! is right.
//!
//! ```text
//! Ω/(rad/s)  ωz in long flights  ωz from 3 to 5 m/s  heads of 1000000 launches (95 %)
//! 10         5.0036              5.0086              0.9500 (0.9496 to 0.9505)
//! 50         25.0180             24.9705             0.9501 (0.9497 to 0.9505)
//! 250        125.0900            125.0985            0.9496 (0.9491 to 0.9500)
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

        // Wider than the interval that is shown, so that chance fails it for one seed in 10 000.
        let Found::Counts(counts) = sample.found else { return Err("a sample has counts".into()) };
        assert!(clopper_pearson(counts.heads(), LAUNCHES, 0.9999).contains(WANTED));
    }
    Ok(())
}

/// The spin ωz (rad/s) at which the tumbling rate `rate` (rad/s) has the wanted share of heads. Without spin it is
/// less; at ψ = 45°, Ω = k ωz, it is 1.
fn spin(coin: Coin, rate: f64) -> Result<f64, Error> {
    let (mut less, mut more) = (0.0, rate / coin.inertia_ratio());
    for _ in 0..60 {
        let middle = 0.5 * (less + more);
        let share = heads(coin, rate, middle, Plan::ExactSpeed(Rest::Grid))?.probability;
        if share < WANTED { less = middle } else { more = middle }
    }
    Ok(more)
}

/// P(heads) at speeds from 3 to 5 m/s.
fn heads(coin: Coin, rate: f64, spin: f64, plan: Plan) -> Result<Estimate, Error> {
    let space = Space::builder(coin).rate_x(rate).rate_y(0.0).rate_z(spin).speed(3.0..=5.0).build()?;
    Sampler::exact().estimate(&space, plan)
}
