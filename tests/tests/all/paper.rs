//! Compares formulas and claims of the paper "Modeling the unfair toss of an unbiased coin" with the exact motion,
//! where its text loses a quadrant or leaves something open. docs/paper-audit.md cites these tests.

use blackbox::toss;
use dynamics::body_rate::body_precession_rate;
use toss::{Coin, CoinMotion, ExactSolver, Formulation, Registry, Settings, Solver, Vector3};

/// The motion of a coin with k = I3/I1 that is launched from horizontal.
fn motion(k: f64, rate: [f64; 3]) -> CoinMotion {
    CoinMotion::new(&toss(k, rate, 0.0, 1.0).coin().expect("a coin"))
}

/// The paper's (2)-(4): ωx = Ω sin(q t + δ) and ωy = -Ω cos(q t + δ), with tan δ = -ωx/ωy at launch. An arctangent of
/// this ratio finds δ or δ + π; atan2 finds δ.
#[test]
fn tan_delta_loses_its_quadrant() {
    for (k, [x, y, z]) in
        [(0.5, [1.0, 1.0, 2.5]), (0.5, [1.0, -2.0, 2.5]), (2.0, [-3.0, 1.0, -0.7]), (2.0, [-2.0, -1.0, 4.0])]
    {
        let motion = motion(k, [x, y, z]);
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
        let cone = motion(coin.inertia_ratio(), [1.0, 1.0, 2.5]).cone_angle().to_degrees();
        assert!((cone - degrees).abs() < 5e-4, "{cone}");
    }
}

/// The paper's checks (a) to (c): |S|, the kinetic energy, and that n·S is the same in both frames. They need the rates
/// alone, or hold for any attitude, so that they pass for a coin that shows the wrong face. S as a vector in TF does not.
#[test]
fn the_papers_checks_pass_where_its_equation_lands_the_wrong_face() {
    let toss = toss(0.5, [2.0, 5.0, 1.0], 2.0, 0.1);
    let raw = Settings { formulation: Formulation::RAW, ..Settings::default() };
    let solver = Registry::standard().named("gamma").unwrap().solver(&raw).unwrap();
    let (found, exact) = (solver.land(&toss).unwrap(), ExactSolver.land(&toss).unwrap());
    assert!(found.cos_tilt > 0.5 && exact.cos_tilt < -0.5);
    let (state, body, rate) = (found.state, toss.body, toss.launch.rate());
    let [momentum, at_launch] = [state.rate, rate].map(|rate| body.angular_momentum(&rate));
    assert!((momentum.norm() / at_launch.norm() - 1.0).abs() < 1e-10, "(a)");
    assert!((body.kinetic_energy(&state.rate) / body.kinetic_energy(&rate) - 1.0).abs() < 1e-10, "(b)");
    let momentum_tf = state.attitude.body_to_lab(&momentum);
    let normal_tf = state.attitude.body_to_lab(&Vector3::z());
    assert!((normal_tf.dot(&momentum_tf) - at_launch.z).abs() < 1e-10 * at_launch.norm(), "(c)");
    let launched = toss.launch.attitude().body_to_lab(&at_launch);
    assert!((momentum_tf - launched).norm() > at_launch.norm(), "S turns in TF");
}

/// From horizontal, the largest angle between n and the vertical is 2ψ, half a precession after the launch.
#[test]
fn the_normal_reaches_twice_the_cone_angle() {
    for (coin, rate, degrees) in [
        (Coin::PAPER, [1.0, 1.0, 2.5], 97.054),
        (Coin::DISC, [1.0, 1.0, 2.5], 31.586),
        (Coin::PAPER, [2.0, 2.0, 0.5], 169.898),
        (Coin::PAPER, [3.0, 0.0, 0.0], 180.0),
    ] {
        let motion = motion(coin.inertia_ratio(), rate);
        let half = std::f64::consts::PI / motion.precession_rate();
        let angle = |time: f64| motion.cos_tilt(time).unwrap().acos().to_degrees();
        assert!((angle(half) - degrees).abs() < 5e-4, "{}", angle(half));
        assert!((0..200).all(|step| angle(0.01 * f64::from(step) * half) <= degrees + 5e-4), "{rate:?}");
    }
}
