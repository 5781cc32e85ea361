//! Tests of the contest: what is flown, and what its rows say.

use super::*;

fn flown(err_attitude_rad: f64, failures: u64) -> Flown {
    let failure = (failures > 0).then(|| "it went astray".to_owned());
    let setting = "tolerance 1e-10".to_owned();
    Flown {
        setting,
        err_cos_tilt: 0.0,
        err_attitude_rad,
        failures,
        failure,
        beyond_estimate: 0,
        estimate: 0.0,
        calls: 1.0,
        ns: 1.0,
    }
}

fn contest(name: &str, usual: Flown) -> Contest {
    let (summary, tight) = (String::new(), flown(0.0, 0));
    let contestant = Contestant {
        name: name.to_owned(),
        summary,
        usual,
        tight,
        hazards: Vec::new(),
        speeds: Vec::new(),
        long_flight: None,
    };
    Contest { host: Host::here(), launches: 1, contestants: vec![contestant] }
}

#[test]
fn what_became_worse_than_the_record_is_named() {
    let record = contest("a", flown(1e-9, 0));
    assert_eq!(contest("a", flown(1.2e-9, 0)).worse_than(&record), [""; 0]);
    for (now, says) in [
        (contest("a", flown(1.3e-9, 0)), "a tolerance 1e-10: off by 1.3e-9 rad"),
        (contest("a", flown(0.0, 1)), "a tolerance 1e-10: it went astray"),
        (contest("b", flown(0.0, 0)), "b: the record does not have it"),
    ] {
        let worse = now.worse_than(&record);
        assert!(worse.len() == 1 && worse[0].starts_with(says), "{worse:?}");
    }
}

#[test]
fn a_coin_at_another_speed_turns_as_far() {
    let survey = Survey::random(&[], 3).unwrap();
    for (toss, factor) in survey.tosses.iter().zip([1e-12, 1e6, 1e12]) {
        let other = at_speed(toss, factor).unwrap();
        let turn = |toss: &Toss| toss.launch.turn_rate() * toss.launch.flight_time();
        assert!((turn(&other) / turn(toss) - 1.0).abs() < 1e-14);
        assert_eq!(other.launch.attitude(), toss.launch.attitude());
    }
}
