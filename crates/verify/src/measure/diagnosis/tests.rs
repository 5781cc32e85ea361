//! Wrong solvers, each with a mistake of its own, and what each is told. They are closed forms and integrators in this file
//! alone, so that a mistake is written as an author makes it and not as the table of hypotheses undoes it.

use std::f64::consts::PI;
use std::sync::LazyLock;

use super::*;
use dynamics::Body;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use toss::{ExactSolver, Landing, SolveError, Solver};

type Q = Quaternion<f64>;

/// All programs are asked for the same launches.
static EXACT: LazyLock<ExactLandings> = LazyLock::new(ExactLandings::default);

/// What an author's program reads.
#[derive(Clone, Copy)]
struct Row {
    i1: f64,
    i2: f64,
    i3: f64,
    rate: Vector3<f64>,
    launched: Q,
    time: f64,
}

fn turn(by: Vector3<f64>) -> Q {
    UnitQuaternion::from_scaled_axis(by).into_inner()
}

fn momentum(row: &Row) -> Vector3<f64> {
    let k = row.i3 / row.i1;
    Vector3::new(row.rate.x, row.rate.y, k * row.rate.z) * row.time
}

fn spin(row: &Row) -> Vector3<f64> {
    Vector3::new(0.0, 0.0, (1.0 - row.i3 / row.i1) * row.rate.z * row.time)
}

/// The larger one of the angles of the two turns (rad).
fn phase(row: &Row) -> f64 {
    momentum(row).norm().max(spin(row).norm())
}

fn right(row: &Row) -> Q {
    row.launched * turn(momentum(row)) * turn(spin(row))
}

/// A program that is wrong on some launches alone.
fn wrong_where(is_wrong: fn(&Row) -> bool) -> impl Fn(&Row) -> [f64; 4] {
    move |row| {
        let off = if is_wrong(row) { Vector3::new(0.1, 0.2, 0.3) } else { Vector3::zeros() };
        components(right(row) * turn(off))
    }
}

fn components(q: Q) -> [f64; 4] {
    [q.w, q.i, q.j, q.k]
}

/// Q' = ½ `product`(Q, ω) and Euler's equations with their sign times `euler`, by Runge-Kutta steps of the fourth order.
fn integrated(row: &Row, product: fn(Q, Q) -> Q, euler: f64) -> Q {
    in_steps(row, product, euler, 25.0)
}

/// The same in so many steps a radian.
fn in_steps(row: &Row, product: fn(Q, Q) -> Q, euler: f64, per_radian: f64) -> Q {
    let k = row.i3 / row.i1;
    runge_kutta(row, per_radian, |q, rate| {
        let torque = Vector3::new((1.0 - k) * rate.y * rate.z, (k - 1.0) * rate.x * rate.z, 0.0);
        (product(q, Q::from_imag(rate)) * 0.5, torque * euler)
    })
}

/// The motion of a body by Euler's equations, ω' by the moments and ω.
fn flown(row: &Row, moments: [f64; 3], euler: impl Fn([f64; 3], Vector3<f64>) -> Vector3<f64>) -> Q {
    runge_kutta(row, 50.0, |q, rate| (q * Q::from_imag(rate) * 0.5, euler(moments, rate)))
}

fn runge_kutta(row: &Row, per_radian: f64, slope: impl Fn(Q, Vector3<f64>) -> (Q, Vector3<f64>)) -> Q {
    let angle = row.rate.norm() * row.time;
    if angle > 1e3 {
        // It declines.
        return Q::from_real(f64::NAN);
    }
    let steps = (per_radian * angle).ceil().max(1.0);
    let h = row.time / steps;
    let mut y = (row.launched, row.rate);
    let slope = |y: (Q, Vector3<f64>)| slope(y.0, y.1);
    let along = |y: (Q, Vector3<f64>), by: (Q, Vector3<f64>), h: f64| (y.0 + by.0 * h, y.1 + by.1 * h);
    for _ in 0..steps as u64 {
        let a = slope(y);
        let b = slope(along(y, a, h / 2.0));
        let c = slope(along(y, b, h / 2.0));
        let d = slope(along(y, c, h));
        y = along(y, (a.0 + (b.0 + c.0) * 2.0 + d.0, a.1 + (b.1 + c.1) * 2.0 + d.1), h / 6.0);
    }
    y.0
}

/// Euler's equations. A rod has no torque about its axis.
fn euler([a, b, c]: [f64; 3], rate: Vector3<f64>) -> Vector3<f64> {
    let part = |torque: f64, moment: f64| if torque == 0.0 { 0.0 } else { torque / moment };
    products(rate, [part(b - c, a), part(c - a, b), part(a - b, c)])
}

/// Euler's equations with each multiplied by a number.
fn multiplied(row: &Row, times: [f64; 3]) -> Q {
    flown(row, moments(row), |moments, rate| euler(moments, rate).component_mul(&Vector3::from(times)))
}

fn products(rate: Vector3<f64>, [a, b, c]: [f64; 3]) -> Vector3<f64> {
    Vector3::new(a * rate.y * rate.z, b * rate.z * rate.x, c * rate.x * rate.y)
}

fn moments(row: &Row) -> [f64; 3] {
    [row.i1, row.i2, row.i3]
}

/// What is found of a program that answers so, at errors allowed as by the tolerance.
fn told(answer: impl Fn(&Row) -> [f64; 4]) -> Option<Diagnosis> {
    told_within(100.0 * any_launch::TOLERANCE, answer)
}

/// The same at an allowed error of cos θ, which is multiplied by 1 + φ.
fn told_within(error: f64, answer: impl Fn(&Row) -> [f64; 4]) -> Option<Diagnosis> {
    let [coins, _] = launches().unwrap();
    diagnosis("mine", KINDS[0], coins.iter().filter_map(|toss| asked(toss, error, &answer)).collect(), &[])
}

/// The same of a program that takes bodies.
fn told_of_bodies(answer: impl Fn(&Row) -> Q + Sync) -> Option<Diagnosis> {
    let answer = |row: &Row| components(answer(row));
    let once = |toss: &Toss, by: f64| {
        if by == TOLERANCES[0] { asked(toss, 100.0 * any_launch::TOLERANCE, &answer) } else { None }
    };
    of_solver("mine", &once).unwrap()
}

fn asked(toss: &Toss, error: f64, answer: &impl Fn(&Row) -> [f64; 4]) -> Option<Asked> {
    let question = Question::new(toss, any_launch::TOLERANCE);
    let Numbers { moments: [i1, i2, i3], rate, attitude: [w, x, y, z], time, .. } = question.numbers();
    let row = Row { i1, i2, i3, rate: rate.into(), launched: Q::new(w, x, y, z), time };
    let Phases { largest, growth } = Phases::new(toss).ok()?;
    let answer = Some(answer(&row)).filter(|answer| !answer[0].is_nan()).ok_or_else(|| "declined".to_owned());
    let answer = answer.map(|answer| question.in_body(answer));
    let allowed = Allowance::by_estimate(error * (1.0 + largest) * growth);
    Some(Asked::new(toss, case::text(toss), &question, None, answer, allowed, EXACT.of(toss)?))
}

fn unanswered(asked: Asked, why: &str) -> Asked {
    Asked { answer: Err(why.to_owned()), errors: None, is_right: false, ..asked }
}

#[test]
fn each_mistake_is_found_and_named() {
    type Mistake = (&'static str, fn(&Row) -> [f64; 4]);
    let mistakes: [Mistake; 27] = [
        ("its quaternion is conjugated", |row| components(right(row).conjugate())),
        ("its quaternion is read as x,y,z,w: 1000 of 1000", |row| {
            let [w, x, y, z] = components(right(row));
            [x, y, z, w]
        }),
        ("quaternions are given to it and read as x,y,z,w", |row| {
            let [x, y, z, w] = components(row.launched);
            let [w, x, y, z] = components(right(&Row { launched: Q::new(w, x, y, z), ..*row }));
            [x, y, z, w]
        }),
        ("the rate is given to it in LF instead of BF", |row| {
            let rate = UnitQuaternion::new_normalize(row.launched).inverse() * row.rate;
            components(right(&Row { rate, ..*row }))
        }),
        ("it multiplies its turn and the attitude at launch in the wrong order", |row| {
            components(turn(momentum(row)) * turn(spin(row)) * row.launched)
        }),
        ("its Q' = ½ ω Q is written Q' = ½ Q ω", |row| components(integrated(row, |q, rate| rate * q, 1.0))),
        ("its Q' = Q ω is halved", |row| components(integrated(row, |q, rate| q * rate * 2.0, 1.0))),
        ("Euler's equations have the opposite sign", |row| components(integrated(row, |q, rate| q * rate, -1.0))),
        ("it answers the turn since launch", |row| components(right(&Row { launched: Q::identity(), ..*row }))),
        ("its spin about n is reversed", |row| components(row.launched * turn(momentum(row)) * turn(-spin(row)))),
        ("its precession about the angular momentum is reversed", |row| {
            components(row.launched * turn(-momentum(row)) * turn(spin(row)))
        }),
        ("its rate, or its time, is reversed", |row| components(right(&Row { time: -row.time, ..*row }))),
        ("a spin about n is added", |row| components(row.launched * turn(momentum(row)))),
        ("in degrees per unit of time", |row| components(right(&Row { rate: row.rate * PI / 180.0, ..*row }))),
        ("all its angles are halved", |row| components(right(&Row { time: 2.0 * row.time, ..*row }))),
        ("all its angles are doubled", |row| components(right(&Row { time: 0.5 * row.time, ..*row }))),
        ("the rate is divided by its length", |row| components(right(&Row { rate: row.rate.normalize(), ..*row }))),
        ("i1 and i3 are exchanged", |row| components(right(&Row { i1: row.i3, i3: row.i1, ..*row }))),
        ("i1 is 1", |row| components(right(&Row { i1: 1.0, ..*row }))),
        ("all moments are equal: it ignores them", |row| components(row.launched * turn(row.rate * row.time))),
        ("its quaternion is divided by its norm", |row| components(right(row) * 3.0)),
        ("its quaternion is divided by its norm: 1000 of 1000", |row| {
            components(right(row) * (1.0 + 1e-5 * phase(row)))
        }),
        ("in turns per 60 units of time", |row| components(right(&Row { rate: row.rate * PI / 30.0, ..*row }))),
        ("the time is given to it in thousandths", |row| components(right(&Row { time: row.time / 1000.0, ..*row }))),
        ("right up to a tolerance of about 1e-6, looser than asked or claimed: ", |row| {
            components(right(&Row { time: row.time * (1.0 + 1e-6), ..*row }))
        }),
        ("right only where k = i3/i1 < 1", |row| {
            let wrong = Row { rate: row.rate * 1.5, ..*row };
            components(right(if row.i3 < row.i1 { row } else { &wrong }))
        }),
        ("right only where the tilt at launch (rad) = 0: ", |row| {
            let is_level = row.launched.i.hypot(row.launched.j) < 1e-9;
            components(if is_level { right(row) } else { right(row) * turn(Vector3::new(1.0, 0.3, 0.0)) })
        }),
    ];
    for (cause, answer) in mistakes {
        let found = told(answer).unwrap_or_else(|| panic!("{cause}: nothing is found"));
        assert!(found.cause.contains(cause), "{cause}: {found:#?}");
        assert!(found.right < found.launches && found.launches >= 950, "{cause}: {found:?}");
    }
}

/// The mistakes of a program that takes bodies, with 1000 coins or, if these are right, 1000 bodies.
#[test]
fn each_mistake_with_three_moments_is_found_and_named() {
    type Mistake = (&'static str, fn(&Row) -> Q);
    let mistakes: [Mistake; 16] = [
        ("i2 equals i1: it ignores i2", |row| flown(row, [row.i1, row.i1, row.i3], euler)),
        ("i1 equals i2: it takes i2 for both", |row| flown(row, [row.i2, row.i2, row.i3], euler)),
        ("i1 and i2 are their mean", |row| {
            let mean = 0.5 * (row.i1 + row.i2);
            flown(row, [mean, mean, row.i3], euler)
        }),
        ("i1 and i2 are exchanged", |row| flown(row, [row.i2, row.i1, row.i3], euler)),
        ("i2 and i3 are exchanged", |row| flown(row, [row.i1, row.i3, row.i2], euler)),
        ("i1 and i3 are exchanged beside i2", |row| flown(row, [row.i3, row.i2, row.i1], euler)),
        ("i2, i3, i1 stand for i1, i2, i3", |row| flown(row, [row.i2, row.i3, row.i1], euler)),
        ("i3, i1, i2 stand for i1, i2, i3", |row| flown(row, [row.i3, row.i1, row.i2], euler)),
        ("all moments are equal: it ignores them", |row| {
            flown(row, if row.i1 == row.i2 { moments(row) } else { [1.0; 3] }, euler)
        }),
        ("its ωx' = (i2 - i3)/i1 ωy ωz has the opposite sign", |row| multiplied(row, [-1.0, 1.0, 1.0])),
        ("its ωy' = (i3 - i1)/i2 ωz ωx has the opposite sign", |row| multiplied(row, [1.0, -1.0, 1.0])),
        ("its ωz' = (i1 - i2)/i3 ωx ωy has the opposite sign", |row| multiplied(row, [1.0, 1.0, -1.0])),
        ("ωz' = (i1 - i2)/i3 ωx ωy is added, which it leaves out", |row| multiplied(row, [1.0, 1.0, 0.0])),
        // The motion of a coin by such equations.
        ("each of its Euler's equations is divided by its moment", |row| {
            right(&Row { i1: 1.0, i3: 1.0 - (row.i1 - row.i3), ..*row })
        }),
        ("its Euler's equations for y and z are divided by i2 and i3 instead of by i1", |row| {
            flown(row, moments(row), |[a, b, c], rate| products(rate, [(b - c) / a, (c - a) / a, (a - b) / a]))
        }),
        ("its rate, or its time, is reversed", |row| {
            let rate = if row.i1 == row.i2 { row.rate } else { -row.rate };
            flown(&Row { rate, ..*row }, moments(row), euler)
        }),
    ];
    for (cause, answer) in mistakes {
        let found = told_of_bodies(answer).unwrap_or_else(|| panic!("{cause}: nothing is found"));
        assert!(found.cause.contains(cause), "{cause}: {found:#?}");
        let (told, all) = found.cause.rsplit_once(": ").unwrap().1.split_once(" of ").unwrap();
        assert!(found.explains_all && all.split(',').next() == Some(told), "{cause}: {found:#?}");
    }
    assert_eq!(told_of_bodies(|row| flown(row, moments(row), euler)), None);
}

/// Only a solver in Rust is given products of inertia. Here it flies another body.
#[test]
fn a_solver_that_ignores_products_of_inertia_or_their_axes_is_told_so() {
    struct Flies(fn(&Body) -> [f64; 3]);
    impl Solver for Flies {
        fn name(&self) -> &str {
            "flies"
        }
        fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
            let is_tensor = toss.body.moments().is_none();
            let body = if is_tensor { Body::from_moments(self.0(&toss.body)).unwrap() } else { toss.body };
            ExactSolver.land(&Toss { body, ..*toss })
        }
    }
    let told = |moments| {
        let entry = SolverEntry::new("flies", "", move |_| Box::new(Flies(moments)));
        of_entry(&entry, &|_| true, &EXACT).unwrap().pop().map(|found| (found.cause, found.explains_all))
    };
    let cause = |words: &str| Some((format!("right if {words}: 1000 of 1000"), true));
    assert_eq!(
        told(|body| [0, 1, 2].map(|axis| body.tensor()[axis][axis])),
        cause("the products of inertia are 0: it ignores them")
    );
    assert_eq!(
        told(Body::principal_moments),
        cause("x, y and z are the principal axes: it turns neither rate nor attitude")
    );
}

#[test]
fn a_solver_that_is_right_up_to_a_looser_tolerance_is_told_which_one() {
    for (steps, tolerance) in [(2.0, "5e-5"), (10.0, "1e-7")] {
        for claimed in [1e-15, 1e-9] {
            let found = told_within(claimed, |row| components(in_steps(row, |q, rate| q * rate, 1.0, steps))).unwrap();
            let words = format!("right up to a tolerance of about {tolerance}, looser than asked or claimed: ");
            assert!(found.cause.starts_with(&words), "{steps} {claimed}: {found:#?}");
        }
    }
}

#[test]
fn a_mistake_that_nothing_explains_is_shown_by_the_smallest_question() {
    let found = told(wrong_where(|row| row.rate.x > 0.0 && row.launched.i > 0.1)).unwrap();
    assert!(found.cause.contains("for a reason that none of the"), "{found:#?}");
    assert!(found.example.question.starts_with("moments=1.0,0.5 rate=1.0,0.0,0.0 "), "{found:#?}");
    assert!(found.example.expected.contains("cos θ = "), "{found:#?}");
}

/// Of the launches that a cause leaves open, the smallest is shown, and first those with a wrong answer.
#[test]
fn the_question_that_is_shown_is_one_that_the_cause_does_not_explain() {
    let with = |other: fn(&Row) -> Q, is_other: fn(&Row) -> bool| {
        let found = told(|row| components(if is_other(row) { other(row) } else { right(row).conjugate() })).unwrap();
        assert!(found.cause.starts_with("right if its quaternion is conjugated") && !found.explains_all, "{found:#?}");
        found.example
    };
    let of_spin = with(|_| Q::identity(), |row| row.time == 1.0 && row.rate == Vector3::new(1.0, 0.0, 2.0));
    assert!(of_spin.question.starts_with("moments=1.0,0.5 rate=1.0,0.0,2.0 time=1.0 tilt=0.0"), "{of_spin:?}");
    let of_right = with(right, |row| row.time == 1.0 && row.rate == Vector3::new(1.0, 2.0, 3.0));
    assert!(of_right.question.starts_with("moments=1.0,0.5 rate=1.0,2.0,3.0 time=1.0 tilt=0.0"), "{of_right:?}");
    let of_both = with(
        |row| if row.rate.y == 2.0 { right(row) } else { Q::identity() },
        |row| row.time == 0.5 && (row.rate == Vector3::new(1.0, 2.0, 3.0) || row.rate == Vector3::new(1.0, 0.0, 2.0)),
    );
    assert!(of_both.question.starts_with("moments=1.0,0.5 rate=1.0,0.0,2.0 time=0.5 tilt=0.0"), "{of_both:?}");
}

#[test]
fn a_right_solver_has_no_diagnosis() {
    assert_eq!(told(|row| components(right(row))), None);
    assert_eq!(told(|row| components(-right(row))), None);
    assert_eq!(told(|row| components(integrated(row, |q, rate| q * rate, 1.0))), None);
}

#[test]
fn a_solver_without_answers_is_told_why() {
    let [launches, _] = launches().unwrap();
    let asked = |(index, toss): (usize, &Toss)| {
        let why = if index == 0 { "ended" } else { "is no longer asked: it ended" };
        unanswered(asked(toss, 1e-9, &|row| components(right(row))).unwrap(), why)
    };
    let found = diagnosis("mine", KINDS[0], launches.iter().enumerate().map(asked).collect(), &[]).unwrap();
    assert!(found.explains_all && found.cause == "no answer to any of the launches: ended", "{found:?}");
}

/// What a program does not answer is told like what it answers wrong, also if it is given up after some such launches.
#[test]
fn launches_with_a_wrong_answer_or_none_are_told_from_the_others() {
    type Mistake = (&'static str, &'static str, fn(&Row) -> bool);
    let mistakes: [Mistake; 5] = [
        ("k = i3/i1 > 0", "969 of 969, elsewhere 0 of 31", |row| row.i3 == 0.0),
        ("w ≥ 0", "527 of 527, elsewhere 0 of 473", |row| row.launched.w < 0.0),
        ("the time > 0", "977 of 977, elsewhere 0 of 23", |row| row.time == 0.0),
        ("the phase (rad) < 100", "892 of 892, elsewhere 0 of 108", |row| phase(row) > 100.0),
        ("the phase (rad) < 1000", "988 of 988, elsewhere 0 of 12", |row| phase(row) > 1e3),
    ];
    let [coins, _] = launches().unwrap();
    for (bound, numbers, is_silent) in mistakes {
        let words = format!("right only where {bound}: {numbers}");
        assert_eq!(told(wrong_where(is_silent)).unwrap().cause, words);
        let answer = |row: &Row| if is_silent(row) { [f64::NAN; 4] } else { components(right(row)) };
        let told_silent = |most: usize| {
            let mut silent = 0;
            let once = |toss: &Toss| {
                let one = asked(toss, 1e-7, &answer)?;
                silent += usize::from(one.answer.is_err());
                Some(if silent > most { unanswered(one, &format!("{GIVEN_UP}hangs")) } else { one }.late(true))
            };
            diagnosis("mine", KINDS[0], coins.iter().filter_map(once).collect(), &[]).unwrap().cause
        };
        assert_eq!(told_silent(usize::MAX), format!("{words}; no answer there: declined"));
        let of_few = told_silent(4);
        assert!(of_few.starts_with(&format!("right only where {bound}: ")) && of_few.contains(" of 4; no"), "{of_few}");
    }
}

#[test]
fn a_bound_is_the_roundest_number_between() {
    for (low, high, expected) in
        [(0.97, 1.03, 1.0), (-0.2, 0.3, 0.0), (812.0, 1301.0, 1e3), (0.1234, 0.1249, 0.1234), (2.0, 2.2, 2.0)]
    {
        assert_eq!(roundest(low, high), expected);
    }
}
