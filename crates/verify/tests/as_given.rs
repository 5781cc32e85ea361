//! Outcomes within one unit in the last place of an edge, of each input in turn, against 256 bits.
//!
//! A proof that starts from a rounded tilt, a rounded inertia ratio or a rounded quaternion is wrong for some of these.

use exact::compensated_cos_tilt;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use toss::quantity::{Angle, AngleUnit, Quantity, Unit};
use toss::{Attitude, Batch, Coin, CoinToss, Launch, Outcome, Solver, TimeOfFlight, Tosses, Vector3, certify};
use verify::measure::reference::Reference;

/// The numbers of a toss, each of which can be moved.
#[derive(Debug, Clone, Copy)]
struct Inputs {
    values: [f64; 16],
    coin: CoinKind,
    start: Start,
    flight: Flight,
    /// Of the rates.
    unit: AngleUnit,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum CoinKind {
    Moments,
    Cylinder,
    Millimetres,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Start {
    Flat,
    Radians,
    Degrees,
    Quaternion,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Flight {
    Time,
    Thrown,
    Dropped,
}

/// The values of [`Inputs`], and what they are drawn from.
const VALUES: [(&str, [f64; 2]); 16] = [
    ("rate x", [-60.0, 60.0]),
    ("rate y", [-60.0, 60.0]),
    ("rate z", [-60.0, 60.0]),
    ("time", [0.3, 1.0]),
    ("speed", [2.0, 5.0]),
    ("gravity", [9.0, 10.0]),
    ("drop", [-0.19, 1.5]),
    ("i1", [3e-7, 6e-7]),
    ("i3", [1e-7, 6e-7]),
    ("radius", [0.008, 0.02]),
    ("thickness", [0.0005, 0.01]),
    ("tilt", [-3.1, 3.1]),
    ("w", [-1.0, 1.0]),
    ("x", [-1.0, 1.0]),
    ("y", [-1.0, 1.0]),
    ("z", [-1.0, 1.0]),
];

const RATE: usize = 0;
const TIME: usize = 3;
const SPEED: usize = 4;
const GRAVITY: usize = 5;
const DROP: usize = 6;
const I1: usize = 7;
const I3: usize = 8;
const RADIUS: usize = 9;
const THICKNESS: usize = 10;
const TILT: usize = 11;
const COMPONENTS: usize = 12;

/// One of the choices, in turn.
fn one<T: Copy>(turn: u64, choices: &[T]) -> T {
    choices[(turn % choices.len() as u64) as usize]
}

impl Inputs {
    /// Toss `index` of those in which the value `moved` counts.
    fn random(moved: usize, index: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(moved as u64);
        rng.set_stream(index);
        let values = VALUES.map(|(_, [low, high])| rng.random_range(low..high));
        let coin = match moved {
            I1 | I3 => CoinKind::Moments,
            RADIUS | THICKNESS => one(index, &[CoinKind::Cylinder, CoinKind::Millimetres]),
            _ => one(index, &[CoinKind::Moments, CoinKind::Cylinder, CoinKind::Millimetres]),
        };
        let start = match moved {
            TILT => one(index, &[Start::Radians, Start::Degrees]),
            COMPONENTS.. => Start::Quaternion,
            _ => one(index, &[Start::Flat, Start::Radians, Start::Degrees, Start::Quaternion]),
        };
        let flight = match moved {
            TIME => Flight::Time,
            DROP => Flight::Dropped,
            SPEED | GRAVITY => one(index, &[Flight::Thrown, Flight::Dropped]),
            _ => one(index, &[Flight::Thrown, Flight::Time, Flight::Dropped, Flight::Thrown, Flight::Time]),
        };
        let degree = Unit::ratio(1, 360).expect("a unit");
        let units = [AngleUnit::RADIAN, AngleUnit::Turns(degree), AngleUnit::RADIAN, AngleUnit::Turns(Unit::ONE)];
        Self { values, coin, start, flight, unit: one(index / 5, &units) }
    }

    /// The toss, if there is one.
    fn toss(&self) -> Option<CoinToss> {
        let v = self.values;
        let millimetres = |metres: f64| Quantity::new(1e3 * metres, Unit::ratio(1, 1000).expect("a unit"));
        let coin = match self.coin {
            CoinKind::Moments => Coin::from_moments(v[I1], v[I3]),
            CoinKind::Cylinder => Coin::from_cylinder(0.005, v[RADIUS], v[THICKNESS]),
            CoinKind::Millimetres => Coin::from_cylinder(0.005, millimetres(v[RADIUS]), millimetres(v[THICKNESS])),
        };
        let (speed, gravity) = (v[SPEED], v[GRAVITY]);
        let time = match self.flight {
            Flight::Time => TimeOfFlight::Given(v[TIME]),
            Flight::Thrown => TimeOfFlight::Ballistic { speed, gravity },
            Flight::Dropped => TimeOfFlight::BallisticTo { speed, gravity, drop: v[DROP] },
        };
        let rate = Vector3::new(v[RATE], v[RATE + 1], v[RATE + 2]) / self.unit.times(1.0).radians();
        let launch = Launch::in_unit(rate, self.unit, time).ok()?;
        let degrees = |radians: f64| Quantity::new(57.0 * radians, Unit::ratio(1, 360).expect("a unit"));
        let attitude = match self.start {
            Start::Flat => Attitude::IDENTITY,
            Start::Radians => Attitude::about_x(v[TILT]),
            Start::Degrees => Attitude::about_x(Angle::Turns(degrees(v[TILT]))),
            Start::Quaternion => Attitude::from_components(std::array::from_fn(|at| v[COMPONENTS + at])).ok()?,
        };
        Some(CoinToss { coin: coin.ok()?, launch: launch.with_attitude(attitude) })
    }

    fn with(self, moved: usize, value: f64) -> Self {
        let mut values = self.values;
        values[moved] = value;
        Self { values, ..self }
    }

    /// The outcome in 256 bits with the value `moved` at `value`; far from an edge in f64.
    fn outcome(self, moved: usize, value: f64) -> Option<Outcome> {
        let toss = self.with(moved, value).toss()?;
        let cos_tilt = compensated_cos_tilt(&toss).expect("an ordinary phase");
        let far = cos_tilt.abs() > 1e-12;
        Some(if far { Outcome::of(cos_tilt, 0.0) } else { Reference::new(&toss).outcome() })
    }

    /// Two neighbouring f64 of the value `moved` between which the outcome changes.
    fn edge(self, moved: usize) -> Option<[f64; 2]> {
        let start = self.values[moved];
        let outcome = self.outcome(moved, start)?;
        let changed = |part: &f64| self.outcome(moved, start * (1.0 + part)).is_some_and(|other| other != outcome);
        let part =
            [1e-3, -1e-3, 1e-2, -1e-2, 0.05, -0.05, 0.2, -0.2, 0.4, -0.4, 0.6, -0.6].into_iter().find(changed)?;
        let mut ends = [start, start * (1.0 + part)].map(f64::to_bits);
        while ends[0].abs_diff(ends[1]) > 1 {
            let middle = ends[0].midpoint(ends[1]);
            let is_first = self.outcome(moved, f64::from_bits(middle))? == outcome;
            ends[usize::from(!is_first)] = middle;
        }
        Some(ends.map(f64::from_bits))
    }
}

/// Whether everything that proves an outcome says `outcome`, and cos θ has its sign.
fn is_right(toss: &CoinToss, outcome: Outcome) -> bool {
    let proven = certify(&(*toss).into()).expect("an ordinary phase").outcome();
    let cos_tilt = toss::ExactSolver.tilt(&(*toss).into()).expect("an ordinary phase").cos_tilt;
    let landed = toss::ExactSolver.land(&(*toss).into()).expect("an ordinary phase").cos_tilt;
    let of_sign = Outcome::of(cos_tilt, 0.0);
    let batched = batched(toss);
    proven == outcome && of_sign == outcome && landed == cos_tilt && batched.is_none_or(|batched| batched == outcome)
}

/// The outcome of a batch of one toss, by its outcomes and by its counts, if there is a batch of its kind.
fn batched(toss: &CoinToss) -> Option<Outcome> {
    let TimeOfFlight::Ballistic { speed, gravity } = toss.launch.time_of_flight() else { return None };
    let (rate, AngleUnit::RADIAN) = toss.launch.given_rate() else { return None };
    let (rates, speeds) = ([[rate.x], [rate.y], [rate.z]], [speed]);
    let rates = rates.each_ref().map(|column| &column[..]);
    let tosses = Tosses::new(toss.coin, toss.launch.attitude(), gravity, rates, &speeds).expect("a batch");
    let mut out = [Outcome::Undecided];
    Batch::new(tosses).outcomes(&mut out).expect("ordinary phases");
    let counted = Batch::new(tosses).count().expect("ordinary phases");
    let number = |outcome| u64::from(out[0] == outcome);
    assert_eq!([counted.heads(), counted.tails()], [number(Outcome::Heads), number(Outcome::Tails)], "{toss:?}");
    Some(out[0])
}

/// The number of tosses next to edges of the value `moved`, and of those that are wrong, among `tries` tosses.
fn next_to_edges(moved: usize, tries: u64) -> [usize; 2] {
    let mut found = [0, 0];
    for index in 0..tries {
        let inputs = Inputs::random(moved, index);
        let Some(edge) = inputs.edge(moved) else { continue };
        for value in edge {
            let toss = inputs.with(moved, value).toss().expect("a toss between two others");
            let outcome = Reference::new(&toss).outcome();
            found[0] += 1;
            found[1] += usize::from(!is_right(&toss, outcome));
        }
    }
    found
}

/// The number of tosses for each input and of those that are wrong, in words.
fn survey(tries: u64) -> (Vec<String>, [usize; 2]) {
    let found: Vec<[usize; 2]> = std::thread::scope(|scope| {
        let surveys = [0, 1].map(|part| {
            scope.spawn(move || {
                (part..VALUES.len()).step_by(2).map(|moved| next_to_edges(moved, tries)).collect::<Vec<_>>()
            })
        });
        let [even, odd] = surveys.map(|survey| survey.join().expect("a survey"));
        even.into_iter().zip(odd).flat_map(|(even, odd)| [even, odd]).collect()
    });
    let lines = VALUES.iter().zip(&found).map(|((name, _), [tosses, wrong])| format!("{name}: {wrong} of {tosses}"));
    let total = found.iter().fold([0, 0], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    (lines.collect(), total)
}

#[test]
fn ten_thousand_outcomes_next_to_an_edge_are_right_for_the_numbers_as_given() {
    let (lines, [tosses, wrong]) = survey(900);
    assert!(tosses >= 10_000 && wrong == 0, "{tosses} {lines:#?}");
}
