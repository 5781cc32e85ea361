//! This file times the exact motion of a body with three moments: a launch with its landing, further times of the same
//! launch, and the proof of an outcome, alone and in batches.

use toss::{Attitude, Batch, Body, ExactMotion, SimdLevel, Toss, certify};

use super::contest::Contest;
use super::tosses::{Columns, attitude_error};

/// Number of times that each launch is solved for, where its constants are to cost nothing.
const TIMES: usize = 64;

/// The numbers that the motion is computed in, but for a few launches.
const NUMBERS: &str = "in double-double";

/// A body of moments 1, 2 and 2.25, as far from symmetric as most things are.
pub(super) fn body() -> Body {
    Body::from_moments([1.0, 2.0, 2.25]).expect("moments of a body")
}

/// All ways to solve the launches of the columns.
pub(super) fn contests<'a>(columns: &'a Columns, many: &'a Columns) -> Vec<Contest<'a>> {
    let tosses = columns.each_of(body());
    let mut contests = Vec::new();
    let launches = tosses.clone();
    let cos_tilt = |toss: &Toss| ExactMotion::new(toss).cos_tilt(toss.launch.time_of_flight()).unwrap_or(f64::NAN);
    let run = move || launches.iter().for_each(|toss| _ = std::hint::black_box(cos_tilt(toss)));
    contests.push(contest("cos θ", NUMBERS, tosses.len(), None, run));
    let launches = tosses.clone();
    let attitude = |toss: &Toss| {
        ExactMotion::new(toss).state(toss.launch.time_of_flight()).map_or(Attitude::IDENTITY, |state| state.attitude)
    };
    let error = attitude_error(&tosses, tosses.iter().map(attitude));
    let run = move || launches.iter().for_each(|toss| _ = std::hint::black_box(attitude(toss)));
    contests.push(contest("attitude", NUMBERS, tosses.len(), Some(error), run));
    contests.push(further_times(&tosses));
    let launches = tosses.clone();
    let run = move || launches.iter().for_each(|toss| _ = std::hint::black_box(certify(toss)));
    contests.push(contest("proven outcome", "one by one", tosses.len(), None, run));
    contests.extend(SimdLevel::all().into_iter().map(|level| batch(many, level)));
    contests
}

/// Proven outcomes of many launches.
fn batch(columns: &Columns, level: SimdLevel) -> Contest<'_> {
    let batch = Batch::new(columns.tosses_of(body())).on(level);
    let count = move || _ = std::hint::black_box(batch.count().expect("valid tosses"));
    contest("proven outcome", &format!("batch, {}", level.name()), columns.speeds.len(), None, count)
}

/// cos θ at many times of a few launches, whose constants are computed before.
fn further_times<'a>(tosses: &[Toss]) -> Contest<'a> {
    let few: Vec<(ExactMotion, f64)> =
        tosses.iter().take(TIMES).map(|toss| (ExactMotion::new(toss), toss.launch.flight_time())).collect();
    let solved = few.len() * TIMES;
    let run = move || {
        for (motion, flight_time) in &few {
            for step in 1..=TIMES {
                let time = flight_time * step as f64 / TIMES as f64;
                std::hint::black_box(motion.cos_tilt(time).unwrap_or(f64::NAN));
            }
        }
    };
    contest("cos θ at a further time", NUMBERS, solved, None, run)
}

fn contest<'a>(what: &str, name: &str, tosses: usize, error: Option<f64>, run: impl FnMut() + 'a) -> Contest<'a> {
    const GROUP: &str = "exact motion of a body with moments 1, 2, 2.25";
    Contest { group: GROUP, name: format!("{what}, {name}"), error, tosses, run: Box::new(run) }
}
