//! Tests of spaces: their coordinates, ties and drops, and what is refused.

use Coordinate::{Drop, Gravity, Psi, RateX, RateY, RateZ, Speed, Tilt, Turn};

use super::*;
use crate::drawn::Drawn;
use crate::plan::{Plan, Rest, Scrambled};
use crate::sampler::Sampler;

fn parse(texts: &[(Coordinate, &str)]) -> Result<Space, InputError> {
    Space::parse(Coin::PAPER, texts)
}

const BOX: [(Coordinate, &str); 4] = [(RateX, "0:50"), (RateY, "x"), (RateZ, "30"), (Speed, "3:5")];

fn with(of: Coordinate, text: &'static str) -> Vec<(Coordinate, &'static str)> {
    BOX.into_iter().filter(|(given, _)| *given != of).chain([(of, text)]).collect()
}

#[test]
fn a_tied_rate_follows_its_partner() {
    let space = parse(&BOX).unwrap();
    let rate = space.toss(&[12.5, 99.0, 30.0, 3.0, 9.81, 0.0, 0.0, 0.0, 0.0]).launch.rate();
    assert_eq!((rate.x, rate.y, rate.z), (12.5, 12.5, 30.0));
    assert_eq!(space.free().collect::<Vec<_>>(), [RateX, Speed]);
    let all_alike = parse(&[(RateX, "z"), (RateY, "z"), (RateZ, "1:2"), (Speed, "3")]).unwrap();
    assert_eq!(all_alike.free().collect::<Vec<_>>(), [RateZ]);
}

#[test]
fn with_body_keeps_the_launches() {
    let (paper, disc) = (parse(&BOX).unwrap(), parse(&BOX).unwrap().with_body(Coin::DISC).unwrap());
    let toss = disc.toss(&paper.fixed_values());
    assert_eq!((toss.body, toss.launch), (Coin::DISC.into(), paper.toss(&paper.fixed_values()).launch));
    assert_ne!(paper.coin(), disc.coin());
    let body = Body::from_moments([1.0, 2.0, 2.5]).unwrap();
    let other = paper.with_body(body).unwrap();
    assert_eq!((other.coin(), *other.body(), other.toss(&paper.fixed_values()).coin()), (None, body, None));
    assert_eq!(other.toss(&paper.fixed_values()), Toss { body, launch: toss.launch });
}

#[test]
fn launches_have_the_gravity_and_the_tilt() {
    let space = parse(&[BOX.to_vec(), vec![(Gravity, "1:9"), (Tilt, "0:3")]].concat()).unwrap();
    let toss = space.toss(&[1.0, 1.0, 30.0, 4.0, 2.0, 0.5, 0.0, 0.0, 0.0]);
    assert_eq!(toss.launch.flight_time(), 4.0);
    assert_eq!(toss.launch.attitude(), dynamics::Attitude::about_x(0.5));
}

#[test]
fn a_drop_lengthens_every_flight_and_has_to_be_reached() {
    let space = parse(&BOX).unwrap().with_drop(Some(1.5)).unwrap();
    let toss = space.with_body(Coin::DISC).unwrap().toss(&space.fixed_values());
    let expected = TimeOfFlight::BallisticTo { speed: 3.0, gravity: 9.81, drop: 1.5 };
    assert_eq!(toss.launch.time_of_flight(), expected);
    assert_eq!(space.with_axis(RateZ, 7.0).unwrap().drop(), Some(Axis::fixed(1.5)));
    // One that varies.
    let space = parse(&with(Drop, "-0.458:2")).unwrap();
    let values = [1.0, 1.0, 30.0, 4.0, 9.81, 0.0, 0.0, 0.0, -0.3];
    let expected = TimeOfFlight::BallisticTo { speed: 4.0, gravity: 9.81, drop: -0.3 };
    assert_eq!((space.toss(&values).launch.time_of_flight(), space.free().last()), (expected, Some(Drop)));
    assert!(parse(&with(Drop, "-0.459:2")).unwrap_err().to_string().starts_with("drop [m] = -0.459"));
    assert!(parse(&with(Drop, "x")).is_err());
    // A throw at 3 m/s rises by 0.4587 m, and the slowest one has to reach the landing.
    assert!(space.with_drop(Some(-0.458)).is_ok());
    for (drop, speed) in [(-0.459, "3:5"), (f64::NAN, "3:5"), (-1.0, "4:5"), (-0.01, "normal:4:0.48")] {
        let refused = parse(&with(Speed, speed)).unwrap().with_drop(Some(drop)).unwrap_err();
        assert!(refused.to_string().starts_with("drop [m] = "), "{refused}");
        assert_eq!(refused.to_string().contains("the slowest launch"), drop.is_finite(), "{refused}");
    }
    assert_eq!(parse(&BOX).unwrap().with_drop(None), parse(&BOX));
}

#[test]
fn axes_of_the_command_line_and_of_files_may_have_units() {
    let rev = std::f64::consts::TAU;
    let space = parse(&[BOX.to_vec(), vec![(RateX, "0:10rev/s:5"), (Tilt, "normal:180deg:90°")]].concat()).unwrap();
    assert_eq!(space.axis(RateX), Axis::range(0.0..=10.0 * rev).with_points(5));
    assert_eq!(space.axis(Tilt), Axis::normal(rev / 2.0, rev / 4.0));
    for (text, words) in [("1:10rev/s", "a unit after each"), ("1deg:2deg", "rev/s or rpm"), ("-3m", "rev/s or rpm")] {
        let error = parse(&with(RateX, text)).unwrap_err().to_string();
        assert!(error.starts_with("rate x [rad/s] = ") && error.contains(words), "{error}");
    }
}

const PRECESSION: [(Coordinate, &str); 3] = [(Turn, "normal:6rev/s:0.1rev/s"), (Psi, "60deg:80deg"), (Speed, "2:3")];

fn precession(texts: &[(Coordinate, &str)]) -> Result<Space, InputError> {
    let given = |of: Coordinate| texts.iter().any(|(other, _)| *other == of);
    let others = PRECESSION.into_iter().filter(|(of, _)| !given(*of));
    Space::parse(Coin::PAPER, &others.chain(texts.iter().copied()).collect::<Vec<_>>())
}

#[test]
fn the_rates_of_a_precession_follow_from_its_turn_and_psi() {
    let space = precession(&[]).unwrap();
    assert_eq!(space.free().collect::<Vec<_>>(), [Speed, Turn, Psi]);
    let plan = Plan::Random { points: 700, seed: 3 };
    for Drawn { values: [x, y, z, ..], toss } in space.drawn(plan).unwrap().flatten() {
        assert_eq!([x, y, z], <[f64; 3]>::from(toss.launch.rate()));
        for (of, value) in [RateX, RateY, RateZ].into_iter().zip([x, y, z]) {
            let [lo, hi] = space.axis(of).bounds();
            assert!(lo - 1e-12 <= value && value <= hi + 1e-12, "{of}: {value} of {lo} to {hi}");
        }
        let motion = exact::CoinMotion::new(&toss.coin().unwrap());
        let psi = motion.cone_angle().to_degrees();
        assert!((60.0 - 1e-9..80.0 + 1e-9).contains(&psi) && y == 0.0, "{psi}");
    }
}

/// Independent of the solvers: cos θ = cos²ψ + sin²ψ cos(turn T) of launches from horizontal, on a fine grid.
#[test]
fn probabilities_of_turns_and_angles_are_those_of_the_formula() {
    let space = precession(&[(Turn, "6rev/s:7rev/s"), (Speed, "2.4")]).unwrap();
    const SIDE: u32 = 1500;
    let time = 2.0 * 2.4 / 9.81;
    let part = |index: u32| (f64::from(index) + 0.5) / f64::from(SIDE);
    let heads = |turn: f64, psi: f64| psi.cos().powi(2) + psi.sin().powi(2) * (turn * time).cos() > 0.0;
    let turns = (0..SIDE).map(|index| (6.0 + part(index)) * 2.0 * PI);
    let angles: Vec<f64> = (0..SIDE).map(|index| (60.0 + 20.0 * part(index)).to_radians()).collect();
    let count: usize = turns.map(|turn| angles.iter().filter(|psi| heads(turn, **psi)).count()).sum();
    let expected = count as f64 / f64::from(SIDE * SIDE);
    let sampler = Sampler::exact();
    let grid = space.with_grid_of(1 << 20).unwrap();
    let found = |space: &Space, plan| sampler.estimate(space, plan).unwrap();
    for (of, plan, within) in [
        (&grid, Plan::Grid, 2e-3),
        (&space, Plan::Random { points: 1 << 20, seed: 1 }, 2e-3),
        (&space, Plan::Sobol(Scrambled::new(1 << 20, 1)), 2e-5),
        (&space, Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1 << 16, 1))), 2e-4),
        (&space, Plan::Enclosure { accuracy: 1e-5 }, 2e-5),
    ] {
        let found = found(of, plan).probability;
        assert!((found - expected).abs() < within, "{plan:?}: {found}, {expected}");
    }
}

#[test]
fn a_precession_that_cannot_be_is_refused() {
    for (texts, message) in [
        (vec![(Psi, "normal:70deg:9deg")], "psi [rad] = -0.0"),
        (vec![(Psi, "170deg:181deg")], "psi [rad] = 3.1"),
        (vec![(Turn, "normal:1:0.2")], "turn [rad/s] = -0.6"),
        (vec![(RateX, "3")], "rate x [rad/s] = 'given twice'"),
    ] {
        let error = precession(&texts).unwrap_err().to_string();
        assert!(error.starts_with(message), "'{error}' for '{message}'");
    }
    let error = parse(&[(Turn, "1:2"), (Speed, "3")]).unwrap_err().to_string();
    assert!(error.starts_with("psi [rad] is missing"), "{error}");
    let body = Body::from_moments([1.0, 2.0, 2.5]).unwrap();
    assert_eq!(precession(&[]).unwrap().with_body(body).unwrap_err().field(), "turn");
    assert_eq!(
        precession(&[]).unwrap().with_body(Coin::from_moments(1.0, 0.0).unwrap()).unwrap_err().field(),
        "psi [rad]"
    );
}

#[test]
fn a_cube_has_a_dimension_for_each_free_coordinate() {
    let space = parse(&with(Gravity, "9:10")).unwrap();
    let cube = Cube::new(&space, space.free());
    assert_eq!(cube.axes(), [RateX, Speed, Gravity].map(|of| (of, space.axis(of))));
}

#[test]
fn rejects_invalid_values_and_names_the_coordinate() {
    for (texts, message) in [
        (with(Speed, "-1:5"), "speed [m/s] = -1.0"),
        (with(Speed, "normal:4:0.5"), "speed [m/s] = -0.15"),
        (with(Gravity, "0"), "gravity [m/s²] = 0.0"),
        (with(Gravity, "-9:9"), "gravity [m/s²] = -9.0"),
        (with(Gravity, "1e-308"), "time of flight"),
        (with(RateX, "0:inf"), "rate x [rad/s] = inf"),
        (with(Tilt, "nan"), "tilt [rad] = NaN"),
    ] {
        let error = parse(&texts).unwrap_err().to_string();
        assert!(error.starts_with(message), "'{error}' for '{message}'");
    }
}

#[test]
fn a_tie_needs_a_partner_with_an_axis_of_its_own() {
    for (texts, field) in [
        (vec![(RateY, "x"), (RateZ, "30"), (Speed, "3:5")], "rate y"),
        (with(RateX, "x"), "rate x"),
        (with(RateX, "y"), "rate x"),
        (with(RateX, "0:1").into_iter().chain([(Gravity, "x")]).collect(), "gravity"),
        (with(Speed, "x"), "speed"),
    ] {
        let error = parse(&texts).unwrap_err().to_string();
        assert!(error.starts_with(field) && error.contains("tie"), "'{error}' for {field}");
    }
}

#[test]
fn a_missing_coordinate_is_named() {
    let error = parse(&BOX[..3]).unwrap_err().to_string();
    assert!(error.starts_with("speed [m/s] is missing"), "{error}");
}
