//! Tests of the fields of a toss: their table, what contradicts itself, and texts that are read back.

use numerics::Unit;

use super::*;

fn thrown(text: &str) -> Result<Thrown, InputError> {
    let mut thrown = Thrown::default();
    for field in text.split_whitespace() {
        let (name, value) = field.split_once('=').expect("NAME=VALUE");
        thrown.set(Field::named(name)?, value)?;
    }
    Ok(thrown)
}

fn toss(text: &str) -> Result<Toss, InputError> {
    thrown(text)?.toss()
}

#[test]
fn the_table_has_each_field_at_its_place_and_every_unit_in_words() {
    for (place, info) in FIELDS.iter().enumerate() {
        assert_eq!((info.field as usize, Field::named(info.name)), (place, Ok(info.field)));
        let kinds = match info.holds {
            Holds::List(kinds) => kinds.to_vec(),
            Holds::Several(kind) => vec![kind],
            Holds::Name | Holds::One(_) | Holds::Refused => continue,
        };
        let units = kinds.iter().flat_map(|kind| kind.units());
        assert!(units.into_iter().all(|unit| info.expected.contains(unit.name())), "{}", info.expected);
    }
    assert!(Field::named("spin").unwrap_err().to_string().starts_with("field = 'spin' is unknown; known: coin, "));
}

#[test]
fn what_contradicts_itself_or_is_missing_is_refused_with_its_field() {
    let rate = "rate=1,1,2.5";
    for (text, message) in [
        ("speed=3".to_owned(), "rate is missing: expected a rate, or turn with psi"),
        (rate.to_owned(), "speed is missing: expected a speed, or a time of flight"),
        (format!("{rate} gravity=9"), "speed is missing"),
        (format!("{rate} speed=3 time=1"), "time = 'given twice' can't be used: expected a time alone, without speed"),
        (format!("{rate} time=1 gravity=9"), "time = 'given twice'"),
        (format!("{rate} time=1 drop=1"), "time = 'given twice'"),
        (format!("{rate} time=1 time=1"), "time = 'given twice' can't be used: expected one value"),
        (format!("{rate} time=1 wx=1"), "rate = 'given twice' can't be used: expected either a rate or its components"),
        ("time=1 wx=1 wz=1".to_owned(), "rate y [rad/s] is missing: expected a number"),
        ("time=1 rate-y=1 wz=1".to_owned(), "rate x [rad/s] is missing"),
        ("time=1 rate_x=1 wy=1".to_owned(), "rate z [rad/s] is missing"),
        (format!("{rate} time=1 turn=3 psi=1"), "rate = 'given twice' can't be used: expected either a rate, or turn"),
        (format!("{rate} time=1 psi=1"), "rate = 'given twice'"),
        ("time=1 psi=1".to_owned(), "turn is missing"),
        ("time=1 turn=1".to_owned(), "psi is missing"),
        ("time=1 turn=1 psi=1 coin=racket".to_owned(), "turn is outside the model: n of a body with I1 ≠ I2"),
        (format!("{rate} time=1 coin=disc coin=disc"), "coin = 'given twice' can't be used: expected one value"),
        (format!("{rate} time=1 coin=disc inertia=1,1,1,0,0,0"), "coin = 'given twice' can't be used: expected one of"),
        (format!("{rate} time=1 moments=1,1 cylinder=1,1,1"), "cylinder = 'given twice'"),
        (format!("{rate} time=1 coin=groat"), "coin = 'groat' is unknown"),
        (format!("{rate} time=1 moments=1,2,3,4"), "moments [kg m²] = '[1.0, 2.0, 3.0, 4.0]' can't be used"),
        (
            format!("{rate} time=1 tilt=1 attitude=1,0,0,0"),
            "attitude = 'given twice' can't be used: expected either tilt",
        ),
        (format!("{rate} time=1 tilt=inf"), "tilt [rad] = inf is outside"),
        (format!("{rate} time=1 attitude=1,0,0"), "attitude = '1,0,0' can't be used: expected W,X,Y,Z, four numbers"),
        (format!("{rate} time=1 unit_quaternion=1,1,0,0"), "unit_quaternion (norm) = 1.41"),
        (format!("{rate} drag=0.4"), "drag is outside the model: the flight is free"),
        (format!("{rate} bounce=0.4"), "bounce is outside the model: the flight ends"),
        ("rate=1,2".to_owned(), "rate = '1,2' can't be used: expected WX,WY,WZ [rad/s], or each with a unit"),
        ("rate=1,2,3rev/s".to_owned(), "rate = '1,2,3rev/s' can't be used: expected a unit after each"),
        ("cylinder=1g,2mm".to_owned(), "cylinder = '1g,2mm' can't be used: expected MASS,"),
        ("speed=3mm".to_owned(), "speed [m/s] = '3mm' can't be used: expected a speed in m/s"),
        ("speed=1,2".to_owned(), "speed [m/s] = '1,2' can't be used"),
    ] {
        let found = toss(&text).unwrap_err().to_string();
        assert!(found.starts_with(message), "'{found}' for '{text}'");
    }
    let too_few = Thrown::default().put(Field::Rate, vec![Dimension::TurnRate.in_si(1.0)]).unwrap_err();
    assert!(too_few.to_string().starts_with("rate = '1.0' can't be used: expected WX,WY,WZ"), "{too_few}");
}

#[test]
fn a_toss_is_made_of_its_fields_in_their_units() {
    let found = toss("rate=1rev/s,0,2rev/s speed=250cm/s drop=-50mm tilt=15deg cylinder=5.67g,12.13mm,1.75mm").unwrap();
    assert_eq!(found.launch.given_rate().0.as_slice(), [1.0, 0.0, 2.0]);
    assert_eq!(found.launch.time_of_flight(), TimeOfFlight::thrown(2.5, DEFAULT_GRAVITY, Some(-0.05)));
    assert_eq!(found.launch.attitude().tilt().unwrap().to_f64(), Dimension::Angle.read("", "15deg").unwrap());
    assert_eq!(found.body.coin().unwrap().cylinder().unwrap()[1].value(), 12.13);
    let precessing = toss("turn=6 psi=60deg time=1 coin=disc").unwrap();
    let psi = Dimension::Angle.read("", "60deg").unwrap();
    assert_eq!(precessing.launch.rate(), rate_of_precession(&Coin::DISC, 6.0, psi).unwrap());
    assert_eq!(toss("wx=1 wy=2 wz=3 time=1"), toss("rate=1,2,3 time=1"));
    assert_eq!(toss("rate=1,2,3 time=1").unwrap().body, Coin::PAPER.into());
    let in_si = thrown("rate=1rev/s,0,2rev/s time=500ms").unwrap().in_si();
    assert_eq!(in_si.text(), "rate=6.283185307179586,0.0,12.566370614359172 time=0.5");
}

#[test]
fn what_is_rounded_is_known() {
    for (text, rate, flight) in [
        ("rate=1rev/s,0,2rev/s speed=2.5", false, false),
        ("rate=1rev/s,0,2rad/s speed=250cm/s", true, false),
        ("wx=1 wy=2 wz=2rad/s time=1.1ms", false, true),
        ("turn=1 psi=1 speed=1 gravity=1.1ft/s²", true, true),
        ("rate=1,1,1 speed=1 drop=0.1in", false, true),
    ] {
        let thrown = thrown(text).unwrap();
        assert_eq!((thrown.rounds_rate(), thrown.rounds_flight()), (rate, flight), "{text}");
    }
}

#[test]
fn the_fields_of_a_toss_are_those_of_the_same_toss() {
    let [thousandth, degree, seventh] = [(1, 1000), (1, 360), (3, 7)].map(|(n, d)| Unit::ratio(n, d).unwrap());
    let millimetres = |value: f64| thousandth.times(value);
    let bodies: [Body; 6] = [
        Coin::PAPER.into(),
        Coin::from_cylinder(millimetres(5.67), millimetres(24.26), seventh.times(0.1)).unwrap().into(),
        Coin::from_cylinder(0.003, millimetres(24.26), 0.0).unwrap().into(),
        Body::from_moments([1.0, 2.0, 2.25]).unwrap(),
        Body::from_inertia([2.0, 3.0, 4.0, 0.1, -0.2, 1e-300]).unwrap(),
        "us-quarter".parse().unwrap(),
    ];
    let times =
        [TimeOfFlight::Given(3.0), TimeOfFlight::thrown(3.1, 9.78, None), TimeOfFlight::thrown(3.1, 9.78, Some(-0.2))];
    let units = [Unit::ONE, degree.of_turn(), seventh.of_turn(), seventh];
    let mut turned = Attitude::from_components([0.3, -7.0, 0.5, 4e-5]).unwrap();
    for turn in 0..60 {
        let unit = units[turn % 4];
        let launch = Launch::in_unit([-0.0, 5e-324, 1e300], unit, times[turn % 3]).unwrap();
        let launches = [launch, launch.with_tilt(unit.times(-0.1)).unwrap(), launch.with_attitude(turned)];
        // Products of turns are unit quaternions to rounding, and dividing them by their norm again changes some of them.
        turned = turned * Attitude::about_z(turn as f64) * Attitude::about_x(0.7 * turn as f64);
        for launch in launches {
            let given = Toss { body: bodies[turn % 6], launch };
            let text = Thrown::of(&given).text();
            assert_eq!(toss(&text), Ok(given), "{text}");
            assert_eq!(thrown(&text).unwrap().text(), text);
        }
    }
    let text = Thrown::of(&toss("cylinder=5.67g,24.26mm,1.75mm rate=1deg/s,0,0 time=1 tilt=15deg").unwrap()).text();
    assert_eq!(text, "cylinder=5.67g,24.26mm,1.75mm rate=1.0deg/s,0.0deg/s,0.0deg/s time=1.0 tilt=15.0deg");
}
