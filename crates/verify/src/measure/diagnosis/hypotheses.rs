//! What authors of solvers get wrong, as a table. A hypothesis says which numbers a wrong program takes in place of those
//! of the question, and how its answer is put right. If it is true, the answers put right are those of the reference to
//! the other numbers.

use std::f64::consts::{PI, TAU};

use dynamics::Toss;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The numbers of a question about a coin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Numbers {
    pub(super) i1: f64,
    /// k = I3/I1.
    pub(super) k: f64,
    pub(super) rate: [f64; 3],
    pub(super) time: f64,
    pub(super) attitude: [f64; 4],
}

impl Numbers {
    pub(super) fn of(toss: &Toss) -> Option<Self> {
        let coin = toss.coin()?.coin;
        let launch = &toss.launch;
        let (rate, attitude) = (launch.rate().into(), launch.attitude().components());
        Some(Self { i1: coin.i1(), k: coin.inertia_ratio(), rate, time: launch.flight_time(), attitude })
    }

    fn with_rate(self, by: f64) -> Self {
        Self { rate: self.rate.map(|part| part * by), ..self }
    }

    /// The angular momentum divided by I1.
    fn momentum(&self) -> Vector3<f64> {
        let [x, y, z] = self.rate;
        Vector3::new(x, y, self.k * z)
    }

    /// The turn by the precession about the angular momentum (BF at launch).
    fn precession(&self) -> Quaternion<f64> {
        UnitQuaternion::from_scaled_axis(self.momentum() * self.time).into_inner()
    }

    /// The turn about n by `times` its angle.
    fn spin(&self, times: f64) -> Quaternion<f64> {
        let angle = times * (1.0 - self.k) * self.rate[2] * self.time;
        UnitQuaternion::from_scaled_axis(Vector3::z() * angle).into_inner()
    }

    fn launched(&self) -> Quaternion<f64> {
        quaternion(self.attitude)
    }
}

/// A wrong way to answer.
pub(super) struct Hypothesis {
    pub(super) words: &'static str,
    pub(super) ask: fn(Numbers) -> Numbers,
    /// The answer put right.
    pub(super) read: fn(&Numbers, [f64; 4]) -> [f64; 4],
}

impl Hypothesis {
    const fn of_answer(words: &'static str, read: fn(&Numbers, [f64; 4]) -> [f64; 4]) -> Self {
        Self { words, ask: |numbers| numbers, read }
    }

    const fn of_question(words: &'static str, ask: fn(Numbers) -> Numbers) -> Self {
        Self { words, ask, read: |_, answer| answer }
    }

    const fn read_as(self, read: fn(&Numbers, [f64; 4]) -> [f64; 4]) -> Self {
        Self { read, ..self }
    }
}

/// All hypotheses. Of two that explain the same answers, the first is told.
pub(super) const HYPOTHESES: [Hypothesis; 36] = [
    Hypothesis::of_answer("its quaternion is read as x,y,z,w", |_, answer| scalar_first(answer)),
    Hypothesis::of_answer("its quaternion is conjugated, so that it leads from BF to LF", |_, answer| {
        conjugated(answer)
    }),
    Hypothesis::of_answer("its quaternion is read as x,y,z,w and conjugated", |_, answer| {
        conjugated(scalar_first(answer))
    }),
    Hypothesis::of_question("the quaternion at launch is given to it as x,y,z,w", as_scalar_last),
    Hypothesis::of_question("quaternions are given to it and read as x,y,z,w", as_scalar_last)
        .read_as(|_, answer| scalar_first(answer)),
    Hypothesis::of_question("the quaternion at launch is given to it conjugated", as_conjugated),
    Hypothesis::of_question("quaternions are given to it and read conjugated, as from LF to BF", as_conjugated)
        .read_as(|_, answer| conjugated(answer)),
    Hypothesis::of_answer(
        "the rate is given to it in LF: it multiplies its turn and the attitude at launch in the wrong order",
        |numbers, answer| {
            let launched = numbers.launched();
            components(launched * quaternion(answer) * launched.conjugate())
        },
    ),
    Hypothesis::of_question("the rate is given to it in LF instead of BF", |numbers| {
        let launched = UnitQuaternion::new_normalize(numbers.launched());
        Numbers { rate: launched.inverse_transform_vector(&numbers.rate.into()).into(), ..numbers }
    }),
    Hypothesis::of_question("the rate is left in BF: it turns it by the attitude at launch", |numbers| {
        let launched = UnitQuaternion::new_normalize(numbers.launched());
        Numbers { rate: launched.transform_vector(&numbers.rate.into()).into(), ..numbers }
    }),
    Hypothesis::of_question("its Q' = ½ ω Q is written Q' = ½ Q ω", |numbers| Numbers {
        k: 2.0 - numbers.k,
        ..as_conjugated(numbers.with_rate(-1.0))
    })
    .read_as(|_, answer| conjugated(answer)),
    Hypothesis::of_question("the attitude at launch is 1,0,0,0: it answers the turn since launch", |numbers| Numbers {
        attitude: [1.0, 0.0, 0.0, 0.0],
        ..numbers
    }),
    Hypothesis::of_question("its rate, or its time, is reversed", |numbers| numbers.with_rate(-1.0)),
    Hypothesis::of_answer("its spin about n is reversed", |numbers, answer| {
        components(quaternion(answer) * numbers.spin(2.0))
    }),
    Hypothesis::of_answer("its precession about the angular momentum is reversed", |numbers, answer| {
        let (launched, precession) = (numbers.launched(), numbers.precession());
        components(launched * precession * precession * launched.conjugate() * quaternion(answer))
    }),
    Hypothesis::of_answer("a spin about n is added, which it leaves out", |numbers, answer| {
        components(quaternion(answer) * numbers.spin(1.0))
    }),
    Hypothesis::of_answer(
        "the precession about the angular momentum is added, which it leaves out",
        |numbers, answer| {
            let launched = numbers.launched();
            components(launched * numbers.precession() * launched.conjugate() * quaternion(answer))
        },
    ),
    Hypothesis::of_question("the rate is given to it in degrees per unit of time", |numbers| {
        numbers.with_rate(PI / 180.0)
    }),
    Hypothesis::of_question("the rate that it turns by is taken for radians: it computes in degrees", |numbers| {
        numbers.with_rate(180.0 / PI)
    }),
    Hypothesis::of_question("the rate is given to it in turns per unit of time", |numbers| numbers.with_rate(TAU)),
    Hypothesis::of_question("the rate is divided by 2π, as it does", |numbers| numbers.with_rate(1.0 / TAU)),
    Hypothesis::of_question("the rate is given to it in turns per 60 units of time", |numbers| {
        numbers.with_rate(TAU / 60.0)
    }),
    Hypothesis::of_question("the time is given to it in thousandths of its unit", |numbers| numbers.with_rate(1e-3)),
    Hypothesis::of_question("the time is divided by 1000, by which it multiplies", |numbers| numbers.with_rate(1e3)),
    Hypothesis::of_question("all its angles are halved: it turns by twice the angle", |numbers| numbers.with_rate(2.0)),
    Hypothesis::of_question("all its angles are doubled: it turns by half the angle", |numbers| numbers.with_rate(0.5)),
    Hypothesis::of_question("its Q' = Q ω is halved to Q' = ½ Q ω", |numbers| with_kinematics(numbers, 2.0)),
    Hypothesis::of_question("its Q' = ¼ Q ω is doubled to Q' = ½ Q ω", |numbers| with_kinematics(numbers, 0.5)),
    Hypothesis::of_question("i1 and i3 are exchanged", |numbers| Numbers { k: 1.0 / numbers.k, ..numbers }),
    Hypothesis::of_question("i1 is 1: it takes i3 for i3/i1", |numbers| Numbers {
        k: numbers.k * numbers.i1,
        ..numbers
    }),
    Hypothesis::of_question("i1 equals i3: it ignores the moments", |numbers| Numbers { k: 1.0, ..numbers }),
    Hypothesis::of_question("Euler's equations have the opposite sign, ω' = I⁻¹ (ω × I ω)", |numbers| Numbers {
        k: 2.0 - numbers.k,
        ..numbers
    }),
    Hypothesis::of_question("the rate is divided by its length, or the time is taken for the angle", |numbers| {
        numbers.with_rate(1.0 / Vector3::from(numbers.rate).norm())
    }),
    Hypothesis::of_question("the rate is divided by its largest component", |numbers| {
        numbers.with_rate(1.0 / Vector3::from(numbers.rate).amax())
    }),
    Hypothesis::of_question("the time is 1", |numbers| Numbers { time: 1.0, ..numbers }),
    Hypothesis::of_question("nothing moves: it answers the attitude at launch", |numbers| Numbers {
        time: 0.0,
        ..numbers
    }),
];

/// A coin whose attitude turns by `times` its rate, while Euler's equations move that rate as ever.
fn with_kinematics(numbers: Numbers, times: f64) -> Numbers {
    Numbers { k: 1.0 + (numbers.k - 1.0) / times, ..numbers.with_rate(times) }
}

fn as_scalar_last(numbers: Numbers) -> Numbers {
    Numbers { attitude: scalar_first(numbers.attitude), ..numbers }
}

fn as_conjugated(numbers: Numbers) -> Numbers {
    Numbers { attitude: conjugated(numbers.attitude), ..numbers }
}

/// (w, x, y, z) of (x, y, z, w).
fn scalar_first([x, y, z, w]: [f64; 4]) -> [f64; 4] {
    [w, x, y, z]
}

fn conjugated([w, x, y, z]: [f64; 4]) -> [f64; 4] {
    [w, -x, -y, -z]
}

fn quaternion([w, x, y, z]: [f64; 4]) -> Quaternion<f64> {
    Quaternion::new(w, x, y, z)
}

fn components(q: Quaternion<f64>) -> [f64; 4] {
    [q.w, q.i, q.j, q.k]
}
