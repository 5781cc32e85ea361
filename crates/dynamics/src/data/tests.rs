use std::fmt::Debug;

use numerics::Unit;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::attitude::Attitude;
use crate::body::Body;
use crate::coin::Coin;
use crate::config::SolverConfig;
use crate::formulation::Formulation;
use crate::launch::Launch;
use crate::quantity::Dimension;
use crate::time_of_flight::{DEFAULT_GRAVITY, TimeOfFlight};
use crate::toss::Toss;

fn read(text: &str) -> Result<Toss, String> {
    toml::from_str(text).map_err(|error| error.message().to_owned())
}

#[test]
fn a_toss_is_read_with_its_defaults() {
    let toss = read("[launch]\nrate = [1.0, 1.0, 2.5]\nspeed = 3").unwrap();
    assert_eq!(toss.body, Coin::PAPER.into());
    assert_eq!(toss.launch.time_of_flight(), TimeOfFlight::Ballistic { speed: 3.0, gravity: DEFAULT_GRAVITY });
    assert_eq!(toss.launch.attitude(), Attitude::IDENTITY);
    let toss = read("coin = 'disc'\n[launch]\nrate = [1, 1, 2.5]\ntime = 3\ntilt = 0.5").unwrap();
    assert_eq!((toss.body, toss.launch.flight_time()), (Coin::DISC.into(), 3.0));
    assert_eq!(toss.launch.attitude(), Attitude::about_x(0.5));
}

#[test]
fn invalid_input_is_refused_with_the_field_at_fault() {
    let launch = "[launch]\nrate = [1, 1, 2]\nspeed = 3\n";
    for (text, message) in [
        (format!("coin = {{ moments = [1, 1, 2, 3] }}\n{launch}"), "moments [kg m²] = '[1.0, 1.0, 2.0, 3.0]' can't"),
        (format!("coin = {{ moments = [1] }}\n{launch}"), "moments [kg m²] = '[1.0]' can't be used"),
        (format!("{launch}bounce = true"), "bounce is outside the model: the flight ends at the first landing"),
        (format!("{launch}wind = 3"), "unknown field `wind`"),
        (
            format!("coin = {{ moments = [1, 1], cylinder = [1, 1, 1] }}\n{launch}"),
            "cylinder = 'given twice' can't be used: expected one of coin, cylinder, moments and inertia",
        ),
        (format!("coin = {{ moments = [1, 1], mass = 1 }}\n{launch}"), "unknown field `mass`"),
        (
            format!("coin = {{ cylinder = [1, 1, 1, 1] }}\n{launch}"),
            "cylinder = '[1.0, 1.0, 1.0, 1.0]' can't be used: expected MASS",
        ),
        (format!("coin = {{ }}\n{launch}"), "coin is missing: expected a name, { moments = [I1, I3] }"),
        (format!("coin = 3\n{launch}"), "invalid type: integer `3`, expected a name, { moments"),
        (format!("{launch}attitude = 3"), "invalid type: integer `3`, expected [w, x, y, z], { tilt"),
        (format!("{launch}attitude = [1, 0, 0, 0, 0]"), "attitude = '[1.0, 0.0, 0.0, 0.0, 0.0]'"),
        (
            "[launch]\nrate = [1, 1, 2, 9]\nspeed = 3".to_owned(),
            "rate = '[1.0, 1.0, 2.0, 9.0]' can't be used: expected WX",
        ),
        ("[launch]\nrate = [1, 1]\nspeed = 3".to_owned(), "rate = '[1.0, 1.0]'"),
        ("[launch]\nrate = ['1rev/s', '2deg/s', 0]\nspeed = 3".to_owned(), "rate = '1.0rev/s,2.0deg/s,0.0rad/s' can't"),
        (format!("{launch}attitude = {{ tilt = 1, unit_quaternion = [1, 0, 0, 0] }}"), "attitude = 'given twice'"),
        (format!("{launch}tilt = 1\nattitude = {{ tilt = 2 }}"), "tilt = 'given twice'"),
        (format!("{launch}attitude = {{ }}"), "attitude is missing: expected [w, x, y, z], {"),
    ] {
        let found = read(&text).unwrap_err();
        assert!(found.starts_with(message), "'{found}' for '{text}'");
    }
}

#[test]
fn a_body_that_was_written_is_read_back() {
    let launch = Launch::new([0.1, -7.0, 1e-300], TimeOfFlight::Given(0.3)).unwrap();
    let tensor = Body::from_inertia([2.0, 3.0, 4.0, 0.1, -0.2, 1e-9]).unwrap();
    let quarter: Body = "us-quarter".parse().unwrap();
    for body in [tensor, Body::from_moments([0.3, 0.1, 0.35]).unwrap(), quarter, Coin::PAPER.into()] {
        assert_read_back(&body);
        assert_read_back(&Toss { body, launch });
    }
    for other in ["'racket'", "{ moments = [1, 1.1, 2] }"] {
        assert_refused::<Coin>(other, "coin is outside the model: with I1 ≠ I2 ");
    }
    let launch = "[launch]\nrate = [1, 1, 2]\nspeed = 3\n";
    for (text, moments) in [
        ("coin = 'racket'", [0.00121, 0.01638, 0.01748]),
        ("body = { moments = [3, '2kg·m²', 4] }", [3.0, 2.0, 4.0]),
        ("coin = { inertia = ['3e7g·cm²', 2, 4, 0, 0, 0] }", [3.0, 2.0, 4.0]),
    ] {
        assert_eq!(read(&format!("{text}\n{launch}")).unwrap().body.moments(), Some(moments), "{text}");
    }
    for (text, message) in [
        ("coin = { moments = [1, nan, 2] }", "I2 [kg m²] = NaN is outside"),
        ("coin = { inertia = [1, 1, 1] }", "inertia = '[1.0, 1.0, 1.0]' can't be used"),
        ("coin = { inertia = [1, 1, 1, '2m', 0, 0] }", "inertia = '2m' can't be used"),
        ("coin = 'book'\nbody = 'book'", "coin = 'given twice' can't be used"),
    ] {
        let found = read(&format!("{text}\n{launch}")).unwrap_err();
        assert!(found.starts_with(message), "'{found}' for '{text}'");
    }
}

/// A document with one value, since TOML has no value without a name.
#[derive(Serialize, Deserialize)]
struct File<T> {
    of: T,
}

#[track_caller]
fn assert_read_back<T: Serialize + DeserializeOwned + PartialEq + Debug>(of: &T) {
    let text = toml::to_string(&File { of }).unwrap();
    assert_eq!(toml::from_str::<File<T>>(&text).unwrap().of, *of, "{text}");
}

#[track_caller]
fn assert_refused<T: DeserializeOwned + Debug>(text: &str, message: &str) {
    let error = toml::from_str::<File<T>>(&format!("of = {text}")).map(|file| file.of).unwrap_err();
    assert!(error.message().starts_with(message), "'{}' for {text}", error.message());
}

#[test]
fn rates_tilts_and_cylinders_are_read_back_in_the_unit_that_they_were_given_in() {
    let per_minute = Dimension::TurnRate.given("rate", "1rpm").unwrap().unit().size();
    let milli = Unit::ratio(1, 1000).unwrap();
    let launch = Launch::in_unit([0.1, 0.0, 2280.0], per_minute, TimeOfFlight::Given(0.3)).unwrap();
    let launch = launch.with_tilt(Unit::DEGREE.times(15.1)).unwrap();
    let [mass, radius, thickness] = [5.67, 12.13, 1.75].map(|value| milli.times(value));
    let toss = Toss::new(Coin::from_cylinder(mass, radius, thickness).unwrap(), launch);
    assert_read_back(&toss);
    let text = toml::to_string(&toss).unwrap();
    for written in ["\"5.67g\"", "\"12.13mm\"", "\"2280.0rpm\"", "tilt = \"15.1deg\""] {
        assert!(text.contains(written), "{text}");
    }
    let toss = read("coin = 'disc'\n[launch]\nturn = '6rad/s'\npsi = 1\ntime = '500ms'").unwrap();
    assert_eq!(toss.launch.rate(), crate::rate_of_precession(&Coin::DISC, 6.0, 1.0).unwrap());
    let mixed =
        read("[launch]\nrate = ['2rev/s', 0, '3rev/s']\nspeed = '250cm/s'\ndrop = '-50mm'\ntilt = '3deg'").unwrap();
    assert_eq!(mixed.launch.given_rate().0.as_slice(), [2.0, 0.0, 3.0]);
    assert_eq!(mixed.launch.time_of_flight(), TimeOfFlight::thrown(2.5, DEFAULT_GRAVITY, Some(-0.05)));
    // A unit without a name is written by its size.
    let odd = Launch::in_unit([1.0, 2.0, 3.0], Unit::ratio(1, 7).unwrap().of_turn(), TimeOfFlight::Given(1.0));
    assert_read_back(&odd.unwrap());
}

#[test]
fn attitudes_are_read_back_to_the_bit() {
    let mut attitude = Attitude::from_components([0.3, -7.0, 0.5, 4e-5]).unwrap();
    assert_read_back(&attitude);
    assert_read_back(&Attitude::IDENTITY);
    assert_read_back(&Attitude::about_x(-1.25));
    // Products of turns are unit quaternions to rounding, and dividing them by their norm again changes some of them.
    for turn in 1..200 {
        attitude = attitude * Attitude::about_z(f64::from(turn)) * Attitude::about_x(0.7 * f64::from(turn));
        assert_read_back(&attitude);
    }
    assert_refused::<Attitude>(
        "[1, 0, 0]",
        "attitude = '[1.0, 0.0, 0.0]' can't be used: expected W,X,Y,Z, four numbers",
    );
    assert_refused::<Attitude>("{ unit_quaternion = [0.6, 0.8, 0.1, 0] }", "unit_quaternion (norm) = 1.004");
    assert_refused::<Attitude>("{ unit_quaternion = [nan, 0, 0, 0] }", "unit_quaternion (norm) = NaN");
    assert_refused::<Attitude>("{ tilt = inf }", "tilt [rad] = inf");
    assert_refused::<Attitude>("{ }", "attitude is missing");
    assert_refused::<Attitude>("{ tilt = 1, unit_quaternion = [1, 0, 0, 0] }", "attitude = 'given twice'");
}

#[test]
fn choices_of_solvers_are_read_back_and_refused_with_the_field_at_fault() {
    // The scheme is known to the solver alone, and what it takes.
    for (text, message) in [
        ("{ name = 'own', tolerance = 0 }", "tolerance = 0.0 is outside its valid range: 2.220446049250313e-16 <= "),
        ("{ name = 'own', step = 0 }", "step [s] = 0.0 is outside"),
        ("{ name = 'own', step = '3mm' }", "step [s] = '3mm'"),
        ("{ name = 'own', step = [] }", "expected a number in SI units"),
        ("{ name = 'own', tolerance = 1e-9, step = 1 }", "step [s] = 'given twice'"),
        ("{ name = 'own', formulation = 'spin' }", "formulation = 'spin' is unknown"),
        ("{ name = 'own', method = 'rk4' }", "unknown field `method`, expected one of `name`, `scheme`"),
        ("{ scheme = 'rk4' }", "missing field `name`"),
    ] {
        assert_refused::<SolverConfig>(text, message);
    }
    let config = SolverConfig::new("own").with_scheme("heun").with_formulation(Formulation::VERTICAL);
    let stepped = config.clone().with_step(0.002).unwrap();
    assert_read_back(&config);
    assert_read_back(&config.with_tolerance(1.0 / 3e9).unwrap());
    assert_read_back(&stepped);
    let text = "name = 'own'\nscheme = 'heun'\nstep = '2ms'\nformulation = 'vertical'";
    assert_eq!(toml::from_str(text), Ok(stepped));
}
