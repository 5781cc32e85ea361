//! What authors of solvers get wrong, as a table. A hypothesis says which numbers a wrong program takes in place of those
//! of the question, and how its answer is put right. If it is true, the answers put right are the landings of the other
//! numbers, which may be those of no body.

use std::f64::consts::{PI, TAU};

use dynamics::body::principal_acceleration;
use dynamics::integrate::{OdeSystem, integrate};
use nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3};
use numerics::scale::power_of_two_scale;
use toss::{Attitude, Scheme, Stepping};

/// The tolerance of a flight by numbers that are those of no coin.
const TOLERANCE: f64 = 1e-11;

/// A body turns at most √3 times as fast as at its launch. By wrong equations, rates may grow without end, and with them the
/// rounding errors of whoever integrates them: above so many times that at launch a landing says nothing.
const FASTEST: f64 = 10.0;

/// The numbers of a question, in its units and along principal axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numbers {
    /// About x, y and z.
    pub(super) moments: [f64; 3],
    /// (I2 - I3)/I1 and so on in cycles, by which Euler's equations multiply the products of two rates.
    pub(super) couplings: [f64; 3],
    pub(super) rate: [f64; 3],
    pub(super) time: f64,
    pub(super) attitude: [f64; 4],
    /// From the principal axes to BF.
    pub(super) axes: Attitude,
}

impl Numbers {
    /// About the axes of BF.
    pub(crate) fn new(moments: [f64; 3], rate: [f64; 3], time: f64, attitude: [f64; 4]) -> Self {
        Self { moments, couplings: [0.0; 3], rate, time, attitude, axes: Attitude::IDENTITY }.with_moments(moments)
    }

    /// The same numbers about other axes, which `axes` turns to those of BF.
    pub(crate) fn about(self, axes: Attitude) -> Self {
        Self { axes, ..self }
    }

    /// k = I3/I1.
    pub(super) fn k(&self) -> f64 {
        self.moments[2] / self.moments[0]
    }

    /// The least moment divided by the largest.
    pub(super) fn thinness(&self) -> f64 {
        let [least, _, largest] = self.sorted();
        least / largest
    }

    /// 2 T I2/S² with the energy T, the angular momentum S and the moment I2 in the middle: 1 on the separatrix, above it
    /// about the axis of the least moment, below about that of the largest.
    pub(super) fn side_of_the_separatrix(&self) -> f64 {
        let (moments, rate) = (Vector3::from(self.moments), Vector3::from(self.rate));
        let momentum = moments.component_mul(&rate);
        momentum.dot(&rate) * self.sorted()[1] / momentum.norm_squared()
    }

    fn sorted(&self) -> [f64; 3] {
        let mut sorted = self.moments;
        sorted.sort_by(f64::total_cmp);
        sorted
    }

    /// The angle (rad) from where these numbers land to `answer`; `None` where they have no landing.
    pub(super) fn angle_to(&self, answer: &Attitude) -> Option<f64> {
        let Self { couplings: [a, b, c], rate, time, attitude, .. } = *self;
        let given = [a, b, c, rate[0], rate[1], rate[2], time];
        if !given.iter().all(|number| number.is_finite()) {
            return None;
        }
        // Flights of coins are long, and in closed form they need no steps.
        if c == 0.0 && a == -b {
            let landed = self.launched() * self.precession(1.0 - a) * self.spin(a);
            return Some(Attitude::from_components(components(landed)).ok()?.angle_to(answer));
        }
        let scale = power_of_two_scale(Vector3::from(rate).amax());
        let ([w, x, y, z], [p, q, r]) = (attitude, rate.map(|part| part / scale));
        let stepping = Stepping::adaptive(Scheme::DOP853, TOLERANCE).ok()?;
        let flown = Flown { couplings: self.couplings, fastest: FASTEST * Vector3::new(p, q, r).norm() };
        let (landed, _) = integrate(&flown, SVector::from([w, x, y, z, p, q, r]), time, scale, &stepping).ok()?;
        let [w, x, y, z, p, q, r] = landed.data.0[0];
        let has_landing = Vector3::new(p, q, r).norm() <= flown.fastest;
        Some(Attitude::from_components([w, x, y, z]).ok()?.angle_to(answer)).filter(|_| has_landing)
    }

    fn with_moments(self, moments: [f64; 3]) -> Self {
        let [a, b, c] = moments;
        // No torque acts about the axis of a rod.
        let part = |torque: f64, moment: f64| if torque == 0.0 { 0.0 } else { torque / moment };
        Self { moments, couplings: [part(b - c, a), part(c - a, b), part(a - b, c)], ..self }
    }

    /// With the moments `which` of its own about x, y and z.
    fn by_moments(self, which: [usize; 3]) -> Self {
        self.with_moments(which.map(|axis| self.moments[axis]))
    }

    /// With each of Euler's equations multiplied by a number.
    fn with_torques(self, times: [f64; 3]) -> Self {
        Self { couplings: [0, 1, 2].map(|axis| times[axis] * self.couplings[axis]), ..self }
    }

    fn with_rate(self, by: f64) -> Self {
        Self { rate: self.rate.map(|part| part * by), ..self }
    }

    /// The turn of a coin with the inertia ratio `k` by the precession about the angular momentum (BF at launch).
    fn precession(&self, k: f64) -> Quaternion<f64> {
        let [x, y, z] = self.rate;
        UnitQuaternion::from_scaled_axis(Vector3::new(x, y, k * z) * self.time).into_inner()
    }

    /// The turn about n by so many times the angle of ωz: a coin's is by 1 - k.
    fn spin(&self, times: f64) -> Quaternion<f64> {
        UnitQuaternion::from_scaled_axis(Vector3::z() * (times * self.rate[2] * self.time)).into_inner()
    }

    fn launched(&self) -> Quaternion<f64> {
        quaternion(self.attitude)
    }

    /// Rate and attitude in BF, with the moments where they are.
    fn in_body(&self) -> Self {
        let rate = self.axes.body_to_lab(&self.rate.into()).into();
        Self { rate, attitude: turned_back(self.attitude, self.axes), ..*self }
    }

    /// The moments about x, y and z of BF.
    fn about_body_axes(&self) -> [f64; 3] {
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| {
            let along = self.axes.lab_to_body(&axis);
            along.component_mul(&along).dot(&Vector3::from(self.moments))
        })
    }
}

/// Q' = ½ Q ω and Euler's equations with any couplings. A rate that grows beyond `fastest` is not followed.
struct Flown {
    couplings: [f64; 3],
    fastest: f64,
}

impl OdeSystem<7> for Flown {
    fn derivative(&self, y: &SVector<f64, 7>) -> SVector<f64, 7> {
        let &[w, x, y, z, p, q, r] = &y.data.0[0];
        if Vector3::new(p, q, r).norm() > self.fastest {
            return SVector::zeros();
        }
        let turned = quaternion([w, x, y, z]) * Quaternion::new(0.0, p, q, r) * 0.5;
        let [w, x, y, z] = components(turned);
        let [p, q, r] = principal_acceleration(self.couplings, [p, q, r]);
        SVector::from([w, x, y, z, p, q, r])
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
pub(super) const HYPOTHESES: [Hypothesis; 52] = [
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
    Hypothesis::of_question("its Q' = ½ ω Q is written Q' = ½ Q ω", |numbers| {
        as_conjugated(numbers.with_rate(-1.0)).with_torques([-1.0; 3])
    })
    .read_as(|_, answer| conjugated(answer)),
    Hypothesis::of_question("the attitude at launch is 1,0,0,0: it answers the turn since launch", |numbers| Numbers {
        attitude: [1.0, 0.0, 0.0, 0.0],
        ..numbers
    }),
    Hypothesis::of_question("its rate, or its time, is reversed", |numbers| numbers.with_rate(-1.0)),
    Hypothesis::of_answer("its spin about n is reversed", |numbers, answer| {
        components(quaternion(answer) * numbers.spin(2.0 * (1.0 - numbers.k())))
    }),
    Hypothesis::of_answer("its precession about the angular momentum is reversed", |numbers, answer| {
        let (launched, precession) = (numbers.launched(), numbers.precession(numbers.k()));
        components(launched * precession * precession * launched.conjugate() * quaternion(answer))
    }),
    Hypothesis::of_answer("a spin about n is added, which it leaves out", |numbers, answer| {
        components(quaternion(answer) * numbers.spin(1.0 - numbers.k()))
    }),
    Hypothesis::of_answer(
        "the precession about the angular momentum is added, which it leaves out",
        |numbers, answer| {
            let launched = numbers.launched();
            components(launched * numbers.precession(numbers.k()) * launched.conjugate() * quaternion(answer))
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
    Hypothesis::of_question("i1 and i3 are exchanged", |numbers| numbers.by_moments([2, 2, 0])),
    Hypothesis::of_question("i1 is 1: it takes i3 for i3/i1", |numbers| {
        numbers.with_moments([1.0, 1.0, numbers.moments[2]])
    }),
    Hypothesis::of_question("all moments are equal: it ignores them", |numbers| numbers.with_moments([1.0; 3])),
    Hypothesis::of_question("i2 equals i1: it ignores i2", |numbers| numbers.by_moments([0, 0, 2])),
    Hypothesis::of_question("i1 equals i2: it takes i2 for both", |numbers| numbers.by_moments([1, 1, 2])),
    Hypothesis::of_question("i1 and i2 are their mean: it takes any body for a coin", |numbers| {
        let [i1, i2, i3] = numbers.moments;
        numbers.with_moments([0.5 * (i1 + i2), 0.5 * (i1 + i2), i3])
    }),
    Hypothesis::of_question("i1 and i2 are exchanged", |numbers| numbers.by_moments([1, 0, 2])),
    Hypothesis::of_question("i2 and i3 are exchanged", |numbers| numbers.by_moments([0, 2, 1])),
    Hypothesis::of_question("i1 and i3 are exchanged beside i2", |numbers| numbers.by_moments([2, 1, 0])),
    Hypothesis::of_question("i2, i3, i1 stand for i1, i2, i3", |numbers| numbers.by_moments([1, 2, 0])),
    Hypothesis::of_question("i3, i1, i2 stand for i1, i2, i3", |numbers| numbers.by_moments([2, 0, 1])),
    Hypothesis::of_question("the products of inertia are 0: it ignores them", |numbers| {
        numbers.in_body().with_moments(numbers.about_body_axes())
    })
    .read_as(in_body),
    Hypothesis::of_question("x, y and z are the principal axes: it turns neither rate nor attitude", |numbers| {
        numbers.in_body()
    })
    .read_as(in_body),
    Hypothesis::of_question("Euler's equations have the opposite sign, ω' = I⁻¹ (ω × I ω)", |numbers| {
        numbers.with_torques([-1.0; 3])
    }),
    Hypothesis::of_question("its ωx' = (i2 - i3)/i1 ωy ωz has the opposite sign", |numbers| {
        numbers.with_torques([-1.0, 1.0, 1.0])
    }),
    Hypothesis::of_question("its ωy' = (i3 - i1)/i2 ωz ωx has the opposite sign", |numbers| {
        numbers.with_torques([1.0, -1.0, 1.0])
    }),
    Hypothesis::of_question("its ωz' = (i1 - i2)/i3 ωx ωy has the opposite sign", |numbers| {
        numbers.with_torques([1.0, 1.0, -1.0])
    }),
    Hypothesis::of_question("ωz' = (i1 - i2)/i3 ωx ωy is added, which it leaves out", |numbers| {
        numbers.with_torques([1.0, 1.0, 0.0])
    }),
    Hypothesis::of_question("each of its Euler's equations is divided by its moment", |numbers| {
        numbers.with_torques(numbers.moments)
    }),
    Hypothesis::of_question("its Euler's equations for y and z are divided by i2 and i3 instead of by i1", |numbers| {
        numbers.with_torques(numbers.moments.map(|moment| moment / numbers.moments[0]))
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

/// A body whose attitude turns by `times` its rate, while Euler's equations move that rate as ever.
fn with_kinematics(numbers: Numbers, times: f64) -> Numbers {
    numbers.with_rate(times).with_torques([1.0 / times; 3])
}

/// A quaternion that leads from BF, if `attitude` leads from axes that `axes` turns to BF.
pub(crate) fn turned_back(attitude: [f64; 4], axes: Attitude) -> [f64; 4] {
    components(quaternion(attitude) * quaternion(axes.components()).conjugate())
}

/// An answer in BF, as a solver has it that is given a tensor.
fn in_body(numbers: &Numbers, answer: [f64; 4]) -> [f64; 4] {
    turned_back(answer, numbers.axes)
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
