//! Compares formulas and claims of the paper "Modeling the unfair toss of an unbiased coin" with the exact motion,
//! where its text loses a quadrant or leaves something open. docs/paper-audit.md cites these tests.

use blackbox::toss;
use dynamics::body_rate::body_precession_rate;
use toss::{Coin, ExactMotion};

/// The paper's (2)-(4): ωx = Ω sin(q t + δ) and ωy = -Ω cos(q t + δ), with tan δ = -ωx/ωy at launch. An arctangent of
/// this ratio finds δ or δ + π; atan2 finds δ.
#[test]
fn tan_delta_loses_its_quadrant() {
    for (k, [x, y, z]) in
        [(0.5, [1.0, 1.0, 2.5]), (0.5, [1.0, -2.0, 2.5]), (2.0, [-3.0, 1.0, -0.7]), (2.0, [-2.0, -1.0, 4.0])]
    {
        let motion = ExactMotion::new(&toss(k, [x, y, z], 0.0, 1.0));
        let transverse = x.hypot(y);
        for step in 0..20 {
            let time = 0.1 * f64::from(step);
            let rate = motion.state(time).unwrap().rate;
            let deviation = |delta: f64| {
                let (sin, cos) = (body_precession_rate(k, z) * time + delta).sin_cos();
                (rate.x - transverse * sin).hypot(rate.y + transverse * cos)
            };
            assert!(deviation(x.atan2(-y)) < 1e-14 * transverse, "by atan2");
            let printed = deviation((-x / y).atan());
            let expected = if y < 0.0 { 0.0 } else { 2.0 * transverse };
            assert!((printed - expected).abs() < 1e-14 * transverse, "ωy = {y}: off by {printed}");
        }
    }
}

#[test]
fn the_cheated_toss_is_within_45_degrees_as_a_disc_alone() {
    for (coin, degrees) in [(Coin::PAPER, 48.527), (Coin::DISC, 15.793)] {
        let cheated = toss(coin.inertia_ratio(), [1.0, 1.0, 2.5], 0.0, 1.0);
        let cone = ExactMotion::new(&cheated).cone_angle().to_degrees();
        assert!((cone - degrees).abs() < 5e-4, "{cone}");
    }
}
