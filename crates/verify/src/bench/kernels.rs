//! This file times and measures landings by the exact motion: one toss after the other and in batches, at every SIMD
//! level of the machine. It shows what the batches gain, and that their errors are those of rounding.

use exact::{compensated_cos_tilt, compensated_landing};
use toss::{Attitude, Batch, CoinMotion, CoinToss, ExactSolver, Outcome, SimdLevel, Solver, Toss, certify};

use super::Row;
use super::contest::Contest;
use super::reference::{Reference, scalar};
use super::tosses::{Columns, TOSSES, attitude_error};

const COS_TILT: &str = "cos θ of a toss";
const OUTCOME: &str = "proven outcome of a toss";
const ATTITUDE: &str = "attitude of a toss";

/// The row of the reference, whose process measures its own time.
pub(super) fn reference(columns: &Columns, reference: &Reference, nanoseconds: f64) -> Row {
    let error = Some(cos_tilt_error(columns, &reference.cos_tilts));
    Row { group: COS_TILT, name: "reference".to_owned(), error, nanoseconds, by_reference: 1.0 }
}

/// All kernels. The first is the reference's loop in Rust, which is the unit of time if there is no C compiler.
pub(super) fn contests(columns: &Columns) -> Vec<Contest<'_>> {
    let mut out = vec![0.0; TOSSES];
    scalar(columns, &mut out);
    let error = cos_tilt_error(columns, &out);
    let plain = contest(COS_TILT, "plain f64, one by one", Some(error), move || scalar(columns, &mut out));
    let mut contests = vec![plain];
    contests.extend(one_by_one(columns));
    contests.extend(SimdLevel::all().into_iter().flat_map(|level| batches(columns, level)));
    contests.sort_by_key(|contest| [COS_TILT, OUTCOME, ATTITUDE].iter().position(|group| *group == contest.group));
    contests
}

fn contest<'a>(group: &'static str, name: &str, error: Option<f64>, run: impl FnMut() + 'a) -> Contest<'a> {
    Contest { group, name: name.to_owned(), error, tosses: TOSSES, run: Box::new(run) }
}

fn one_by_one<'a>(columns: &Columns) -> Vec<Contest<'a>> {
    let tosses = columns.each();
    let over_all = |solve: fn(&Toss) -> f64| {
        let tosses = tosses.clone();
        move || {
            for toss in &tosses {
                std::hint::black_box(solve(std::hint::black_box(toss)));
            }
        }
    };
    let cos_tilt =
        |solve: fn(&Toss) -> f64| Some(cos_tilt_error(columns, &tosses.iter().map(solve).collect::<Vec<_>>()));
    let compensated = |toss: &Toss| compensated_cos_tilt(&coin(toss)).unwrap_or(f64::NAN);
    let exact = |toss: &Toss| ExactSolver.tilt(toss).map_or(f64::NAN, |tilt| tilt.cos_tilt);
    let certified = |toss: &Toss| certify(toss).map_or(f64::NAN, |found| f64::from(found.outcome() as u8));
    let landing = |toss: &Toss| compensated_landing(&coin(toss)).map_or(f64::NAN, |landing| landing.rate.x);
    vec![
        contest(COS_TILT, "compensated, one by one", cos_tilt(compensated), over_all(compensated)),
        contest(COS_TILT, "to the last bit, one by one", cos_tilt(exact), over_all(exact)),
        contest(OUTCOME, "one by one", None, over_all(certified)),
        contest(ATTITUDE, "compensated, one by one", None, over_all(landing)),
    ]
}

fn batches<'a>(columns: &'a Columns, level: SimdLevel) -> Vec<Contest<'a>> {
    let batch = columns.batch(level);
    let name = format!("batch, {}", level.name());
    let (mut cos_tilts, mut outcomes) = (vec![0.0; TOSSES], vec![Outcome::Undecided; TOSSES]);
    let mut attitudes: [Vec<f64>; 4] = std::array::from_fn(|_| vec![0.0; TOSSES]);
    solve_cos_tilts(&batch, &mut cos_tilts);
    solve_attitudes(&batch, &mut attitudes);
    let quaternion = |index: usize| attitudes.each_ref().map(|column| column[index]);
    let found = (0..TOSSES).map(|index| Attitude::from_components(quaternion(index)).expect("a unit quaternion"));
    let errors = [cos_tilt_error(columns, &cos_tilts), attitude_error(&columns.each(), found)];
    vec![
        contest(COS_TILT, &name, Some(errors[0]), move || solve_cos_tilts(&batch, &mut cos_tilts)),
        contest(OUTCOME, &format!("{name}, counted"), None, move || {
            std::hint::black_box(batch.count().expect("valid tosses"));
        }),
        contest(OUTCOME, &format!("{name}, each"), None, move || {
            batch.outcomes(&mut outcomes).expect("valid tosses");
        }),
        contest(ATTITUDE, &name, Some(errors[1]), move || solve_attitudes(&batch, &mut attitudes)),
    ]
}

fn solve_cos_tilts(batch: &Batch<'_>, out: &mut [f64]) {
    batch.cos_tilts(out).expect("valid tosses");
}

fn solve_attitudes(batch: &Batch<'_>, out: &mut [Vec<f64>; 4]) {
    batch.attitudes(out.each_mut().map(Vec::as_mut_slice)).expect("valid tosses");
}

/// The largest error of cos θ against the exact motion in double-double arithmetic.
fn cos_tilt_error(columns: &Columns, found: &[f64]) -> f64 {
    let error = |(toss, found): (&Toss, &f64)| {
        let parts = CoinMotion::new(&coin(toss)).cos_tilt_parts(toss.launch.time_of_flight());
        parts.map_or(f64::NAN, |(exact, _)| ((found - exact.hi()) - exact.lo()).abs())
    };
    columns.each().iter().zip(found).map(error).fold(0.0, f64::max)
}

fn coin(toss: &Toss) -> CoinToss {
    toss.coin().expect("columns of a coin")
}
