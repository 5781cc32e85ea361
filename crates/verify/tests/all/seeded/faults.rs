//! The faults that are seeded, one a solver, each with the checks that must catch it. A solver with a fault is the exact
//! motion with one change of the toss that it is given or of the landing that it answers.

use std::f64::consts::PI;

use toss::{
    Attitude, Coin, CoinToss, ExactSolver, Landing, Launch, SolveError, Solver, State, TimeOfFlight, Toss, Vector3,
    Work,
};

/// What a foreign solver answers.
pub(super) type Solved = Result<Landing, SolveError>;

/// A foreign solver with a fault.
pub(super) struct Foreign {
    pub(super) name: &'static str,
    pub(super) fly: fn(&CoinToss) -> Solved,
}

impl Solver for Foreign {
    fn name(&self) -> &str {
        self.name
    }
    fn land(&self, toss: &Toss) -> Solved {
        let landing = (self.fly)(&toss.of_coin(self.name, "it is made for coins")?)?;
        let claim = CLAIMS.iter().find(|(name, _)| *name == self.name).map_or(HONEST, |(_, claim)| *claim);
        Ok(landing.with_error(claim))
    }
}

/// A fault: the solver's name, its flight, and the checks that must fail.
pub(super) type Fault = (&'static str, fn(&CoinToss) -> Solved, &'static [&'static str]);

/// What an honest solver of this accuracy claims, unless [`CLAIMS`] says otherwise.
const HONEST: Option<f64> = Some(1e-12);

pub(super) const FAULTS: &[Fault] = &[
    // Inputs that are ignored or misread.
    ("ignores-drop", |toss| fly(timed(toss, level)), &["reference-cos-tilt", "random-attitude", SILENCE]),
    ("first-crossing", |toss| fly(timed(toss, rising)), &["reference-attitude", "random-attitude", SILENCE]),
    (
        "hard-codes-g",
        |toss| fly(timed(toss, |time| gravity(time, |_| 9.81))),
        &["reference-cos-tilt", "random-attitude"],
    ),
    ("standard-gravity", |toss| fly(timed(toss, standard)), &["reference-cos-tilt", "random-attitude"]),
    ("ignores-tilt", |toss| fly(held(toss, |_| Attitude::IDENTITY)), TURNED),
    ("tilts-back", |toss| fly(held(toss, |tilt| tilt.inverse())), TURNED),
    ("unit-i1", |toss| fly(body(toss, |_, i3| (1.0, i3.min(2.0)))), TURNED),
    (
        "no-small-moments",
        |toss| fly(body(toss, |i1, i3| if i1 < 1e-9 { (1.0, 1.0) } else { (i1, i3) })),
        &["reference-attitude", "random-attitude", SILENCE],
    ),
    ("all-discs", |toss| fly(body(toss, |i1, _| (i1, 2.0 * i1))), TURNED),
    (
        "swapped-moments",
        |toss| fly(body(toss, |i1, i3| (i3, i1))),
        &["reference-cos-tilt", "random-attitude", "invariant-momentum-vector", "first-flip"],
    ),
    ("no-rods", |toss| fly(body(toss, |i1, i3| (i1, i3.max(0.4 * i1)))), &["reference-attitude", SILENCE]),
    ("left-handed", |toss| fly(spun(toss, |rate| Vector3::new(rate.x, rate.y, -rate.z))), TURNED),
    ("swapped-axes", |toss| fly(spun(toss, |rate| Vector3::new(rate.y, rate.x, rate.z))), TURNED),
    // Times.
    ("fast-clock", |toss| fly(timed(toss, |time| TimeOfFlight::Given(time.seconds() * (1.0 + 1e-9)))), TURNED),
    ("single-precision", |toss| fly(timed(toss, single)), TURNED),
    (
        "milliseconds",
        |toss| fly(timed(toss, |time| TimeOfFlight::Given((time.seconds() * 1e3).floor() / 1e3))),
        &["reference-attitude", "random-attitude", "first-flip"],
    ),
    // Answers.
    ("lost-half", without_the_half, LOST_HALF),
    ("flipped", |toss| Ok(turned(fly(*toss)?, Attitude::about_x(PI))), FLIPPED),
    (
        "negated",
        |toss| fly(*toss).map(|landing| landing.with_cos_tilt(-landing.cos_tilt)),
        &["random-cos-tilt", "invariant-projection", "fig4-same-counts"],
    ),
    (
        "yawed",
        |toss| Ok(turned(fly(*toss)?, Attitude::about_z(1e-3))),
        &["random-attitude", "invariant-momentum-vector"],
    ),
    (
        "conjugate",
        |toss| {
            fly(*toss).map(|Landing { state, work, .. }| {
                Landing::new(State { attitude: state.attitude.inverse(), ..state }, work)
            })
        },
        &["random-attitude", "invariant-momentum-vector"],
    ),
    (
        "rate-of-launch",
        |toss| {
            fly(*toss)
                .map(|Landing { state, work, .. }| Landing::new(State { rate: toss.launch.rate(), ..state }, work))
        },
        &["invariant-momentum-vector"],
    ),
    (
        "slow-is-still",
        |toss| if toss.launch.turn_rate() < 1e-3 { Ok(still(toss)) } else { fly(*toss) },
        &["random-attitude", SILENCE],
    ),
    (
        "long-is-still",
        |toss| if toss.launch.turn_rate() * toss.launch.flight_time() > 1e3 { Ok(still(toss)) } else { fly(*toss) },
        &[SILENCE, "atlas-answers"],
    ),
    // Refusals.
    ("refuses-all", |_| Err(SolveError::NotFinite { time: 0.0 }), &["random-attitude", "adversarial-refusals"]),
    (
        "refuses-tilts",
        |toss| {
            if toss.launch.attitude() == Attitude::IDENTITY {
                fly(*toss)
            } else {
                Err(SolveError::NotFinite { time: 0.0 })
            }
        },
        &["random-attitude", "adversarial-refusals"],
    ),
    // Claims.
    ("claims-2", |toss| fly(*toss), &["claims-measured", "random-cos-tilt", "random-attitude", SILENCE]),
    ("claims-a-thousand-times", |toss| Ok(turned(fly(*toss)?, Attitude::about_x(1e-9))), &["claims-measured"]),
    (
        "claims-0",
        |toss| Ok(turned(fly(*toss)?, Attitude::about_x(1e-9))),
        &["random-cos-tilt", "random-attitude", SILENCE],
    ),
    ("claims-2-and-is-flipped", |toss| Ok(turned(fly(*toss)?, Attitude::about_x(PI))), FLIPPED),
];

/// The errors that solvers claim, where it is not that of an honest one.
pub(super) const CLAIMS: [(&str, Option<f64>); 7] = [
    ("rough", Some(2e-3)),
    ("silent", None),
    ("claims-nan", Some(f64::NAN)),
    ("claims-2", Some(2.0)),
    ("claims-a-thousand-times", Some(3e-6)),
    ("claims-0", Some(0.0)),
    ("claims-2-and-is-flipped", Some(2.0)),
];

/// The checks that see another attitude at landing.
const TURNED: &[&str] = &["reference-attitude", "random-attitude"];

/// The checks that must see a quaternion that turns at twice its rate, as by an equation without its factor of one half.
const LOST_HALF: &[&str] = &[
    "reference-cos-tilt",
    "random-attitude",
    "invariant-momentum-vector",
    "tails-in-flight",
    "first-flip",
    "fig4-same-counts",
];

pub(super) const SILENCE: &str = "adversarial-silence";

/// The checks that a solver with heads for tails cannot pass by any table of limits.
pub(super) const FLIPPED: &[&str] = &[
    "reference-cos-tilt",
    "reference-attitude",
    "random-cos-tilt",
    "random-attitude",
    "invariant-momentum-vector",
    "cheated-heads-in-flight",
    "tails-in-flight",
    "first-flip",
    "fig4-same-counts",
    SILENCE,
];

pub(super) fn fly(toss: CoinToss) -> Solved {
    ExactSolver.land(&toss.into())
}

/// The coin turns twice as far as it should.
fn without_the_half(toss: &CoinToss) -> Solved {
    let Landing { state: State { attitude, rate }, work, .. } = fly(*toss)?;
    let turn = toss.launch.attitude().inverse() * attitude;
    Ok(Landing::new(State { attitude: attitude * turn, rate }, work))
}

fn still(toss: &CoinToss) -> Landing {
    Landing::new(State { attitude: toss.launch.attitude(), rate: toss.launch.rate() }, Work::default())
}

/// The landing turned by `turn` about an axis of the laboratory, and cos θ accordingly.
pub(super) fn turned(landing: Landing, turn: Attitude) -> Landing {
    let State { attitude, rate } = landing.state;
    Landing::new(State { attitude: turn * attitude, rate }, landing.work)
}

/// The toss with another time of flight, or unchanged where that one is not valid.
fn timed(toss: &CoinToss, change: fn(TimeOfFlight) -> TimeOfFlight) -> CoinToss {
    let changed = Launch::new(toss.launch.rate(), change(toss.launch.time_of_flight()));
    let attitude = toss.launch.attitude();
    CoinToss { launch: changed.map_or(toss.launch, |launch| launch.with_attitude(attitude)), ..*toss }
}

fn held(toss: &CoinToss, change: fn(Attitude) -> Attitude) -> CoinToss {
    CoinToss { launch: toss.launch.with_attitude(change(toss.launch.attitude())), ..*toss }
}

fn spun(toss: &CoinToss, change: fn(Vector3<f64>) -> Vector3<f64>) -> CoinToss {
    let launch = Launch::new(change(toss.launch.rate()), toss.launch.time_of_flight()).expect("as valid as it was");
    CoinToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss }
}

/// The toss of a coin with other moments, or unchanged where they are not valid.
fn body(toss: &CoinToss, change: fn(f64, f64) -> (f64, f64)) -> CoinToss {
    let (i1, i3) = change(toss.coin.i1(), toss.coin.i3());
    CoinToss { coin: Coin::from_moments(i1, i3).unwrap_or(toss.coin), ..*toss }
}

fn level(time: TimeOfFlight) -> TimeOfFlight {
    match time {
        TimeOfFlight::BallisticTo { speed, gravity, .. } => TimeOfFlight::Ballistic { speed, gravity },
        other => other,
    }
}

/// Caught above the launch on the way up.
fn rising(time: TimeOfFlight) -> TimeOfFlight {
    match time {
        TimeOfFlight::BallisticTo { speed, gravity, drop } if drop < 0.0 => {
            TimeOfFlight::Given(2.0 * speed / gravity - time.seconds())
        }
        other => other,
    }
}

fn gravity(time: TimeOfFlight, change: fn(f64) -> f64) -> TimeOfFlight {
    match time {
        TimeOfFlight::Ballistic { speed, gravity } => TimeOfFlight::Ballistic { speed, gravity: change(gravity) },
        TimeOfFlight::BallisticTo { speed, gravity, drop } => {
            TimeOfFlight::BallisticTo { speed, gravity: change(gravity), drop }
        }
        other => other,
    }
}

fn standard(time: TimeOfFlight) -> TimeOfFlight {
    gravity(time, |given| if given == 9.81 { 9.80665 } else { given })
}

#[expect(clippy::cast_possible_truncation, reason = "the fault")]
fn single(time: TimeOfFlight) -> TimeOfFlight {
    TimeOfFlight::Given(f64::from(time.seconds() as f32))
}
