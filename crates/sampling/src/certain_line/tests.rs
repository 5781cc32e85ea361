//! Tests of the line: it lies where the exact motion has its edge, whatever the grid of the map.

use Coordinate::{Psi, RateX, RateY, RateZ, Speed, Tilt, Turn};
use dynamics::precession::rate_of_precession;
use dynamics::{Coin, CoinToss, Launch, TimeOfFlight, Vector3};
use exact::CoinMotion;

use super::*;
use crate::plan::{Plan, Rest, Scrambled};
use crate::sampler::Sampler;

/// The line over two coordinates of a space.
fn drawn(coin: Coin, texts: &[(Coordinate, &str)], axes: [Coordinate; 2]) -> Result<CertainLine, &'static str> {
    let space = Space::parse(coin, texts).unwrap();
    let plan = Plan::ExactSpeed(if space.free().count() > 3 { sobol() } else { Rest::Grid });
    certain_line(&Sampler::exact().map(&space, axes, plan).unwrap(), &space)
}

/// Its pieces.
fn line(coin: Coin, texts: &[(Coordinate, &str)], axes: [Coordinate; 2]) -> Result<Vec<Piece>, &'static str> {
    drawn(coin, texts, axes).map(|line| line.pieces)
}

fn sobol() -> Rest {
    Rest::Sobol(Scrambled::new(8, 1))
}

/// The least cos θ of the motion from a launch: 0 on the edge.
fn least_cos_tilt(coin: Coin, rate: Vector3<f64>, tilt: f64) -> f64 {
    let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap().with_tilt(tilt).unwrap();
    let motion = CoinMotion::new(&CoinToss { coin, launch });
    (motion.momentum_tilt() + motion.cone_angle()).cos()
}

#[test]
fn on_a_coarse_grid_the_line_is_straight_and_leaves_from_the_origin() {
    for points in ["2", "3", "7", "61"] {
        let (x, z) = (format!("0:30:{points}"), format!("0:60:{points}"));
        let texts = [(RateX, x.as_str()), (RateY, "0"), (RateZ, z.as_str()), (Speed, "3:5")];
        let pieces = line(Coin::PAPER, &texts, [RateX, RateZ]).unwrap();
        let [piece] = pieces.as_slice() else { panic!("{points} points: {} pieces", pieces.len()) };
        assert_eq!((piece[0], piece[piece.len() - 1]), ((0.0, 0.0), (30.0, 60.0)), "{points} points");
        assert_eq!(piece.len(), 2, "it is straight");
        assert_eq!(drawn(Coin::PAPER, &texts, [RateX, RateZ]).unwrap().angles, "ψ = 45°");
    }
}

#[test]
fn away_from_the_origin_the_line_is_straight_and_with_the_other_spin_its_angle_is_135_degrees() {
    let texts = [(RateX, "10:30:4"), (RateY, "0"), (RateZ, "-60:-1:5"), (Speed, "3:5")];
    let CertainLine { pieces, angles } = drawn(Coin::PAPER, &texts, [RateX, RateZ]).unwrap();
    assert_eq!((pieces, angles), (vec![vec![(10.0, -20.0), (30.0, -60.0)]], "ψ = 135°"));
}

#[test]
fn both_lines_are_drawn_where_the_spin_has_both_senses() {
    let texts = [(RateX, "-30:30:4"), (RateY, "5"), (RateZ, "-60:60:4"), (Speed, "4")];
    let pieces = line(Coin::PAPER, &texts, [RateX, RateZ]).unwrap();
    let ends: Vec<[(f64, f64); 2]> = pieces.iter().map(|piece| [piece[0], piece[piece.len() - 1]]).collect();
    // 0.5 |ωz| = hypot(ωx, 5) is 30 rad/s at ωx = 29.58 rad/s.
    let corner = 875.0_f64.sqrt();
    for (end, expected) in
        ends.concat().iter().zip([(-corner, -60.0), (corner, -60.0), (-corner, 60.0), (corner, 60.0)])
    {
        assert!((end.0 - expected.0).hypot(end.1 - expected.1) < 1e-9, "{ends:?}");
    }
    assert_eq!(pieces.len(), 2);
    assert_eq!(drawn(Coin::PAPER, &texts, [RateX, RateZ]).unwrap().angles, "ψ = 45° and 135°");
}

#[test]
fn over_psi_the_line_is_straight_and_on_the_edge_of_the_exact_motion() {
    for (tilt, psi, axes, number, expected) in [
        (0.0, "0:90deg:4", [Turn, Psi], 1, "ψ = 45°"),
        (0.0, "10deg:170deg:4", [Psi, Turn], 2, "ψ = 45° and 135°"),
        (0.6, "10deg:170deg:4", [Psi, Turn], 2, ""),
    ] {
        let text = tilt.to_string();
        let texts = [(Turn, "30:60:3"), (Psi, psi), (Tilt, text.as_str()), (Speed, "3:5")];
        let CertainLine { pieces, angles } = drawn(Coin::PAPER, &texts, axes).unwrap();
        assert_eq!((pieces.len(), angles), (number, expected));
        for (across, up) in pieces.into_iter().flatten() {
            let [turn, psi] = if axes[0] == Psi { [up, across] } else { [across, up] };
            let rate = rate_of_precession(&Coin::PAPER, turn, psi).unwrap();
            assert!(least_cos_tilt(Coin::PAPER, rate, tilt).abs() < 1e-12, "{turn}, {psi}, {tilt}");
        }
    }
    let texts = [(Turn, "30:60:3"), (Psi, "60deg"), (Speed, "3:5:3")];
    assert_eq!(line(Coin::PAPER, &texts, [Turn, Speed]).unwrap_err(), "no line: neither axis is ψ");
    let texts = [(Turn, "30:60:3"), (Psi, "60deg:90deg:3"), (Speed, "3:5:3")];
    assert_eq!(line(Coin::PAPER, &texts, [Turn, Psi]).unwrap_err(), "no line: it does not pass through this map");
}

/// The axes of a space, the two that are mapped, and the tilt.
type Case = ([(Coordinate, &'static str); 4], [Coordinate; 2], f64);

#[test]
fn every_point_is_on_the_edge_of_the_exact_motion() {
    let cases: [Case; 6] = [
        ([(RateX, "-30:30:3"), (RateY, "x"), (RateZ, "-60:60:3"), (Tilt, "0")], [RateX, RateZ], 0.0),
        ([(RateX, "-30:30:3"), (RateY, "-40:40:3"), (RateZ, "20"), (Tilt, "0")], [RateX, RateY], 0.0),
        ([(RateX, "-30:30:3"), (RateY, "7"), (RateZ, "-60:60:3"), (Tilt, "0.6")], [RateX, RateZ], 0.6),
        ([(RateX, "-30:30:3"), (RateY, "-40:40:3"), (RateZ, "20"), (Tilt, "0.6")], [RateY, RateX], 0.6),
        ([(RateX, "5"), (RateY, "-40:40:3"), (RateZ, "-60:60:3"), (Tilt, "-1.1")], [RateY, RateZ], -1.1),
        ([(RateX, "z"), (RateY, "-40:40:3"), (RateZ, "-60:60:3"), (Tilt, "0.3")], [RateZ, RateY], 0.3),
    ];
    let mut with_line = 0;
    for coin in [Coin::PAPER, Coin::DISC] {
        for (texts, axes, tilt) in cases {
            let space = Space::parse(coin, &[texts.as_slice(), &[(Speed, "4")]].concat()).unwrap();
            let points = line(coin, &[texts.as_slice(), &[(Speed, "4")]].concat(), axes).unwrap_or_default().concat();
            with_line += i32::from(!points.is_empty());
            for at in points {
                let value = |of: Coordinate| match space.axis_or_tie(of) {
                    _ if of == axes[0] => at.0,
                    _ if of == axes[1] => at.1,
                    Some(AxisOrTie::SameAs(partner)) => {
                        if partner == axes[0] {
                            at.0
                        } else {
                            at.1
                        }
                    }
                    _ => space.axis(of).bounds()[0],
                };
                let rate = Vector3::new(value(RateX), value(RateY), value(RateZ));
                let least = if rate.norm() < 1e-9 { 0.0 } else { least_cos_tilt(coin, rate, tilt) };
                assert!(least.abs() < 1e-6, "{texts:?} at {at:?}: {least}");
            }
        }
    }
    // With ωx = ωz the paper's coin is never certain to land heads.
    assert_eq!(with_line, 11);
}

#[test]
fn over_a_rate_and_the_speed_the_line_is_upright_or_level() {
    let texts = [(RateX, "0:30:3"), (RateY, "0"), (RateZ, "40"), (Speed, "3:5:3")];
    assert_eq!(line(Coin::PAPER, &texts, [RateX, Speed]).unwrap(), [vec![(20.0, 3.0), (20.0, 5.0)]]);
    let level = line(Coin::PAPER, &texts, [Speed, RateX]).unwrap();
    assert!(level.concat().iter().all(|at| at.1 == 20.0) && level.len() == 1, "{level:?}");
}

#[test]
fn where_there_is_no_line_the_reason_is_given() {
    let fixed = [(RateX, "0:30:3"), (RateY, "0:30:3"), (RateZ, "40"), (Speed, "3:5:3"), (Tilt, "0:1:3")];
    let with =
        |of: Coordinate, text: &'static str| fixed.map(|(given, old)| (given, if given == of { text } else { old }));
    for (texts, axes, reason) in [
        (fixed, [RateX, RateY], "varies"),
        (with(RateY, "0"), [RateX, Tilt], "tilt"),
        (
            [(RateX, "1"), (RateY, "1"), (RateZ, "1"), (Speed, "3:5:3"), (Coordinate::Gravity, "9:10:2")],
            [Speed, Coordinate::Gravity],
            "neither axis",
        ),
        (
            [(RateX, "1:2:2"), (RateY, "1:2:2"), (RateZ, "40"), (Speed, "4"), (Tilt, "0")],
            [RateX, RateY],
            "does not pass",
        ),
    ] {
        let found = line(Coin::PAPER, &texts, axes).unwrap_err();
        assert!(found.starts_with("no line") && found.contains(reason), "{found}");
    }
}
