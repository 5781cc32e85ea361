//! How much do people's coins wobble?
//!
//! 48 people flipped coins 350 757 times, and 178 078 of the coins landed on the side that had been up (data set of F. Bartoš et
//! al., "Fair coins tend to land on the same side they started", arXiv:2310.04153, 2023). The more a coin wobbles, the
//! more often it does so. Let ψ be the angle between the coin's normal and its angular momentum. If every coin left the
//! thumb flat, had the same ψ (or 180° - ψ) and flew for many turns, the share of coins that land on the same side
//! would be p(ψ) = ½ + asin(cot²ψ)/π (P. Diaconis, S. Holmes and R. Montgomery, SIAM Review 49 (2007), 211). This
//! example solves for ψ:
//!
//! ```text
//! same side     0.5077, ψ = 81.2°
//! all alike     0.5060 to 0.5094, ψ = 80.3° to 82.2° (95 %)
//! 48 people     0.5044 to 0.5157, ψ = 77.5° to 83.3° (95 %)
//! the most biased 0.6007, ψ = 60.8°
//! a US quarter  0.5075 ± 0.0005, 4000000 launches with that ψ
//! ```
//!
//! At ψ = 90° a coin is fair. The first interval assumes that all flips are alike; it agrees with the interval in that
//! paper's abstract, which has three digits. But people differ by more than chance. The second interval is that of the mean
//! over people, each counted once: it treats the people as the sample and is more than three times as wide.
//!
//! Three things are not accounted for: ψ may differ from flip to flip, coins need not leave the thumb flat, and flights
//! may be short. So the angle would explain the share, but it need not be the mean of the real angles. The last line is
//! a check: a sample of launches with this ψ has the same share.
//!
//! `cargo run --release -p toss --example human`

use toss::catalogue::named_coin;
use toss::sampling::{Axis, Estimate, Plan, SameSide, SameSideBias, Sampler, Space, rate_ratio};

/// For each person, the number of flips that landed on the side they started from (data set dat.bartos2023 of the R
/// package metadat).
const SAME: [u32; 48] = [
    780, 1126, 2204, 7056, 4957, 1937, 7458, 4971, 5219, 5368, 1801, 3352, 7506, 2761, 2510, 5022, 8649, 353, 2220,
    3261, 10148, 4340, 2475, 2071, 5559, 1769, 7586, 5069, 2510, 2540, 1118, 5080, 1525, 1749, 3815, 3309, 2224, 2020,
    1658, 1426, 4334, 9080, 3705, 7895, 1869, 2055, 956, 1682,
];
/// For each person, the number of all flips.
const FLIPS: [u32; 48] = [
    1600, 2300, 4477, 14324, 10015, 3900, 15012, 10005, 10500, 10757, 3600, 6700, 15000, 5500, 5000, 10000, 17182, 701,
    4400, 6463, 20100, 8596, 4900, 4100, 11000, 3500, 14999, 10004, 4944, 5000, 2200, 9996, 3000, 3400, 7400, 6400,
    4300, 3900, 3200, 2750, 8328, 17434, 7098, 15000, 3481, 3800, 1691, 2800,
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let counts = SAME.iter().zip(FLIPS).map(|(same, flips)| SameSide::new((*same).into(), flips.into()));
    let people = counts.collect::<Result<Vec<SameSide>, _>>()?;
    let apart = SameSideBias::of(&people)?;
    let (share, together) = (apart.share, SameSideBias::of(&[apart.counts])?);
    assert_eq!(apart.counts, SameSide::new(178_078, 350_757)?);
    println!("same side     {share:.4}, ψ = {:.1}°", degrees(together.cone.map(|cone| cone.angle)));
    println!("all alike     {}", text(&together));
    println!("48 people     {}", text(&apart));
    let alone = people.iter().map(|person| SameSideBias::of(&[*person])).collect::<Result<Vec<_>, _>>()?;
    let most = alone.iter().max_by(|one, other| one.share.total_cmp(&other.share)).ok_or("there are people")?;
    println!("the most biased {:.4}, ψ = {:.1}°", most.share, degrees(most.cone.map(|cone| cone.angle)));

    let sample = of_a_quarter(share)?;
    let half_width = sample.half_width().ok_or("a sample has an interval")?;
    println!("a US quarter  {:.4} ± {half_width:.4}, {} launches with that ψ", sample.probability, sample.points);
    // 1e-3 is four standard deviations of the sample, and less than a fifth of the half-width of the people's interval.
    assert!((sample.probability - share).abs() < 1e-3);
    Ok(())
}

/// Estimates the share of launches that land on the same side for a US quarter whose ψ should give `share`. The coin
/// turns 40 times a second, and the speed has a standard deviation of 0.2 m/s. This spreads the phase at landing by
/// 10 rad, which is as good as a long flight.
fn of_a_quarter(share: f64) -> Result<Estimate, toss::Error> {
    const RATE: f64 = 251.0;
    let quarter = named_coin("us-quarter")?;
    let spin = RATE / rate_ratio(share, quarter.inertia_ratio())?;
    let space = Space::builder(quarter).rate_x(RATE).rate_y(0.0).rate_z(spin).speed(Axis::normal(4.0, 0.2)).build()?;
    Sampler::exact().estimate(&space, Plan::Random { points: 4_000_000, seed: 1 })
}

/// The interval of the share with that of the angles. A smaller angle ψ belongs to a larger share.
fn text(found: &SameSideBias) -> String {
    let [least, most] = [0, 1].map(|end| degrees(found.cone.map(|cone| cone.interval[end])));
    format!("{:.4} to {:.4}, ψ = {least:.1}° to {most:.1}° (95 %)", found.interval.lo, found.interval.hi)
}

/// An angle in degrees; not a number where no ψ explains the counts.
fn degrees(angle: Option<f64>) -> f64 {
    angle.map_or(f64::NAN, f64::to_degrees)
}
