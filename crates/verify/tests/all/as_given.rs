//! Outcomes within one unit in the last place of an edge, of each input in turn, against 256 bits.
//!
//! A proof that starts from a rounded tilt, a rounded inertia ratio or a rounded quaternion is wrong for some of these.

use exact::compensated_cos_tilt;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use reference::Reference;
use toss::quantity::{Quantity, Unit};
use toss::{
    Attitude, Batch, Coin, CoinToss, InputError, Launch, Outcome, Solver, TimeOfFlight, Tosses, Vector3, certify,
};

/// The numbers of a toss, each of which can be moved, and how the toss is made of them.
#[derive(Clone, Copy)]
struct Inputs {
    values: [f64; 16],
    coin: CoinOf,
    start: StartOf,
    time: TimeOf,
    /// Of the rates.
    unit: Unit,
}

/// How the values make a coin, an attitude at launch and a time of flight.
type CoinOf = fn(&[f64; 16]) -> Result<Coin, InputError>;
type StartOf = fn(&[f64; 16]) -> Result<Attitude, InputError>;
type TimeOf = fn(&[f64; 16]) -> TimeOfFlight;

/// The names of the values, and what they are drawn from.
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

fn in_unit(value: f64, of_one: u32) -> Quantity {
    Unit::ratio(1, of_one).expect("a unit").times(value)
}

const MOMENTS: CoinOf = |v| Coin::from_moments(v[7], v[8]);
const CYLINDER: CoinOf = |v| Coin::from_cylinder(0.005, v[9], v[10]);
const MILLIMETRES: CoinOf = |v| Coin::from_cylinder(0.005, in_unit(1e3 * v[9], 1000), in_unit(1e3 * v[10], 1000));

const FLAT: StartOf = |_| Ok(Attitude::IDENTITY);
const RADIANS: StartOf = |v| Ok(Attitude::about_x(v[11]));
const DEGREES: StartOf = |v| Ok(Attitude::about_x(Unit::DEGREE.times(57.0 * v[11])));
const QUATERNION: StartOf = |v| Attitude::from_components([v[12], v[13], v[14], v[15]]);

const GIVEN: TimeOf = |v| TimeOfFlight::Given(v[3]);
const THROWN: TimeOf = |v| TimeOfFlight::Ballistic { speed: v[4], gravity: v[5] };
const DROPPED: TimeOf = |v| TimeOfFlight::BallisticTo { speed: v[4], gravity: v[5], drop: v[6] };

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
        let name = VALUES[moved].0;
        let coin = match name {
            "i1" | "i3" => MOMENTS,
            "radius" | "thickness" => one(index, &[CYLINDER, MILLIMETRES]),
            _ => one(index, &[MOMENTS, CYLINDER, MILLIMETRES]),
        };
        let start = match name {
            "tilt" => one(index, &[RADIANS, DEGREES]),
            "w" | "x" | "y" | "z" => QUATERNION,
            _ => one(index, &[FLAT, RADIANS, DEGREES, QUATERNION]),
        };
        let time = match name {
            "time" => GIVEN,
            "drop" => DROPPED,
            "speed" | "gravity" => one(index, &[THROWN, DROPPED]),
            _ => one(index, &[THROWN, GIVEN, DROPPED, THROWN, GIVEN]),
        };
        let units = [Unit::ONE, Unit::DEGREE, Unit::ONE, Unit::TURN];
        Self { values, coin, start, time, unit: one(index / 5, &units) }
    }

    /// The toss, if there is one.
    fn toss(&self) -> Option<CoinToss> {
        let v = &self.values;
        let rate = Vector3::new(v[0], v[1], v[2]) / self.unit.times(1.0).to_f64();
        let launch = Launch::in_unit(rate, self.unit, (self.time)(v)).ok()?;
        Some(CoinToss { coin: (self.coin)(v).ok()?, launch: launch.with_attitude((self.start)(v).ok()?) })
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
    let (rate, Unit::ONE) = toss.launch.given_rate() else { return None };
    let (rates, speeds) = ([[rate.x], [rate.y], [rate.z]], [speed]);
    let rates = rates.each_ref().map(|column| &column[..]);
    let tosses = Tosses::new(toss.coin, toss.launch.attitude(), gravity, rates, &speeds).expect("a batch");
    let mut out = [Outcome::Undecided];
    Batch::new(tosses).outcomes(&mut out).expect("ordinary phases");
    let counted = Batch::new(tosses).count().expect("ordinary phases");
    let number = |outcome| u64::from(out[0] == outcome);
    assert_eq!([counted.heads, counted.tails], [number(Outcome::Heads), number(Outcome::Tails)], "{toss:?}");
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
    let found: Vec<[usize; 2]> =
        (0..VALUES.len()).into_par_iter().with_max_len(1).map(|moved| next_to_edges(moved, tries)).collect();
    let lines = VALUES.iter().zip(&found).map(|((name, _), [tosses, wrong])| format!("{name}: {wrong} of {tosses}"));
    let total = found.iter().fold([0, 0], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    (lines.collect(), total)
}

#[test]
fn ten_thousand_outcomes_next_to_an_edge_are_right_for_the_numbers_as_given() {
    let (lines, [tosses, wrong]) = survey(900);
    assert!(tosses >= 10_000 && wrong == 0, "{tosses} {lines:#?}");
}
