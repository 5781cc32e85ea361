//! Which launches are fair, and which are certain?
//!
//! The map shows the probability of heads for a US quarter that is thrown at 3 to 5 m/s: the share of the speeds that
//! land heads, in closed form. The rate of tumbling Ω goes across, 1 rad/s per character; the rate of spin ωz goes up.
//! A digit is the probability in tenths, and `#` means heads at every speed.
//!
//! The line `/` is Ω = k ωz, with k = I3/I1. There the angle ψ between the normal and the angular momentum is 45°. Left
//! of it the coin shows heads at every time. Right of it fast coins become fair, while slow coins make so few turns
//! that the probability depends on where these end.
//!
//! ```text
//!  30 ############################################################/9
//!  28 ########################################################/99888
//!  26 ####################################################/988888777
//!  24 ################################################/9988877777777
//!  22 ############################################/98887777777776666
//!  20 ########################################/998877777776666676666
//!  18 ####################################/9887777777776666666666666
//!  16 ################################/98887777776666666666666655556
//!  14 ############################/988777777666666665555666655555555
//!  12 ########################/9877777776666666656666555555655555555
//!  10 ####################/98777776556666665555555555555545555555555
//!   8 ################/977777766666655555666555555555555554455555555
//!   6 ############/9877776545566655555544556655444555555555444555555
//!   4 ########/97666655666654445665555554445555444455545555444455554
//!   2 ####/#9#975334555455654434555544554444555544445545555444455554
//!   0 #/#40015896423455445565434455544554444555544445544555544455554
//!  ωz over Ω, from 0 to 60 rad/s
//! ```
//!
//! `cargo run --release -p toss --example map`

use toss::catalogue::named_coin;
use toss::sampling::{Axis, Coordinate, Plan, Rest, Sampler, Space};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let quarter = named_coin("us-quarter")?;
    let space = Space::builder(quarter)
        .rate_x(Axis::range(0.0..=60.0).with_points(61))
        .rate_y(0.0)
        .rate_z(Axis::range(0.0..=30.0).with_points(16))
        .speed(3.0..=5.0)
        .build()?;
    let across_and_up = [Coordinate::RateX, Coordinate::RateZ];
    let mapped = Sampler::exact().map(&space, across_and_up, Plan::ExactSpeed(Rest::Grid))?;
    let (rates, spins) = (&mapped.across.1, &mapped.up.1);
    for (spin, row) in spins.iter().zip(mapped.nodes.chunks(rates.len())).rev() {
        let certain = rates.iter().filter(|rate| **rate <= quarter.inertia_ratio() * spin).count();
        let row = row.iter().map(|node| node.probability.ok_or("the exact motion decides all"));
        let row = row.collect::<Result<Vec<f64>, _>>()?;
        let (left, right) = row.split_at(certain);
        println!("{spin:>3} {}/{}", text(left), text(right));
        assert!(left.iter().all(|probability| *probability == 1.0));
    }
    println!(" ωz over Ω, from 0 to 60 rad/s");
    Ok(())
}

fn text(probabilities: &[f64]) -> String {
    let digit = |part: f64| (0..10).rev().find(|tenth| part >= 0.1 * f64::from(*tenth)).unwrap_or(0);
    probabilities.iter().map(|part| if *part == 1.0 { "#".to_owned() } else { digit(*part).to_string() }).collect()
}
