//! Launches of coins with all that a launch may have: any two moments, any attitude Q or -Q, slow and fast rates, no time
//! and long flights. Random launches of a hand start level or tilted about one axis, and a solver that ignores the rest is
//! right on them. A diagnosis of a wrong solver is made from its answers to these, and to the same of other bodies.

use dynamics::{Body, Phases, Toss};
use nalgebra::{Matrix3, UnitQuaternion};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use toss::{Attitude, Coin, Formulation, InputError, Launch, Scheme, SolverEntry, TimeOfFlight, Vector3};

use super::subject::{Subject, by_kind};
use super::tosses::{decades, one, stream};

const SEED: u64 = 20_280_229;

/// That of other bodies than coins.
const SEED_OF_BODIES: u64 = 20_281_130;

pub(crate) const TOLERANCE: f64 = 1e-9;

/// The step of schemes without a tolerance, in units of 1/|ω|.
const STEP: f64 = 0.02;

/// The phase (rad) above which a solver may return an error.
const DECLINED: f64 = 1e3;

/// So many launches of coins, of which the first are given by few digits each.
pub(crate) fn tosses(number: u64) -> Result<Vec<Toss>, InputError> {
    let coins = [(1.0, 0.5), (2.0, 3.0)].map(|(i1, i3)| Coin::from_moments(i1, i3).map(Body::from));
    all(coins, number, |index| drawn(&mut stream(SEED, index), index))
}

/// The same of bodies with three moments, of rods and plates along any axis, and of inertia tensors.
pub(crate) fn bodies(number: u64) -> Result<Vec<Toss>, InputError> {
    let bodies = [[1.0, 2.0, 2.5], [3.0, 1.5, 2.0]].map(Body::from_moments);
    all(bodies, number, |index| drawn_body(&mut stream(SEED_OF_BODIES, index), index))
}

fn all(
    bodies: [Result<Body, InputError>; 2],
    number: u64,
    drawn: impl Fn(u64) -> Result<Toss, InputError>,
) -> Result<Vec<Toss>, InputError> {
    let mut tosses = Vec::new();
    for body in bodies {
        tosses.extend(simple(body?)?);
    }
    let first = tosses.len() as u64;
    tosses.extend((first..number).map(drawn).collect::<Result<Vec<_>, _>>()?);
    Ok(tosses)
}

/// The solver of `entry` with a scheme, at a tolerance if the scheme takes one.
pub(crate) fn subject(
    entry: &SolverEntry,
    scheme: Option<Scheme>,
    tolerance: f64,
    toss: &Toss,
) -> Result<Subject, InputError> {
    let step = (STEP / toss.launch.turn_rate()).min(f64::MAX);
    let stepping = |scheme: Scheme| by_kind(scheme, tolerance, step);
    Ok(Subject::new(entry, scheme.map(stepping).transpose()?, Formulation::default()))
}

/// Whether the flight is so long that an error is no fault.
pub(crate) fn may_be_declined(toss: &Toss) -> bool {
    !Phases::new(toss).is_ok_and(|phases| phases.largest <= DECLINED)
}

/// Launches whose numbers anybody can follow by hand.
fn simple(body: Body) -> Result<Vec<Toss>, InputError> {
    let attitudes = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.5, 0.5, 0.5, 0.5]];
    let rates = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 2.0], [1.0, 2.0, 3.0]];
    let mut all = Vec::new();
    for attitude in attitudes {
        for rate in rates {
            for time in [0.5, 1.0] {
                let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(time))?;
                all.push(Toss { body, launch: launch.with_attitude(Attitude::from_components(attitude)?) });
            }
        }
    }
    Ok(all)
}

fn drawn(rng: &mut ChaCha8Rng, index: u64) -> Result<Toss, InputError> {
    let k = match index % 5 {
        0 => one(rng, [0.0, 0.5, 1.0, 1.5, 2.0]),
        _ => rng.random_range(0.01..2.0),
    };
    // A power of two keeps every digit of the ratio.
    let i1 = 2f64.powi(rng.random_range(-20..10));
    let rate = rate(rng);
    let turn_rate = Vector3::new(rate.x, rate.y, k * rate.z).norm().max(((k - 1.0) * rate.z).abs());
    let phase = match index % 80 {
        0 | 40 => 0.0,
        1 => decades(rng, 3.1, 3.4),
        _ => decades(rng, -2.0, 2.5),
    };
    let launch = Launch::new(rate, TimeOfFlight::Given(phase / turn_rate))?;
    Ok(Toss::new(Coin::from_moments(i1, k * i1)?, launch.with_attitude(attitude(rng, index)?)))
}

fn drawn_body(rng: &mut ChaCha8Rng, index: u64) -> Result<Toss, InputError> {
    let [a, b, c] = [0; 3].map(|_| rng.random_range(0.05..1.0));
    // Not about z, of which it would be a coin.
    let (axis, unit) = (one(rng, [0, 2]), 2f64.powi(rng.random_range(-20..10)));
    let mut moments = match index % 8 {
        0 => [0.0, a, a],
        1 => [a, b, a + b],
        2 => [a, b + a, b + a],
        _ => [b + c, c + a, a + b],
    }
    .map(|moment| moment * unit);
    moments.rotate_left(axis);
    let body = match index % 8 {
        3 => turned(rng, moments),
        _ => Body::from_moments(moments),
    };
    let rate = rate(rng);
    let phase = if index.is_multiple_of(40) { 0.0 } else { decades(rng, -2.0, 1.5) };
    let launch = Launch::new(rate, TimeOfFlight::Given(phase / rate.norm()))?;
    Ok(Toss { body: body?, launch: launch.with_attitude(attitude(rng, index)?) })
}

/// A body with these principal moments, to rounding, about axes in any directions.
fn turned(rng: &mut ChaCha8Rng, moments: [f64; 3]) -> Result<Body, InputError> {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0)));
    let axes = turn.to_rotation_matrix();
    let tensor = axes.matrix() * Matrix3::from_diagonal(&moments.into()) * axes.matrix().transpose();
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = <[[f64; 3]; 3]>::from(tensor);
    Body::from_inertia([xx, yy, zz, xy, xz, yz])
}

fn rate(rng: &mut ChaCha8Rng) -> Vector3<f64> {
    let direction = Vector3::<f64>::from_fn(|_, _| rng.random_range(-1.0..1.0));
    direction / direction.amax() * decades(rng, -2.9, 2.9)
}

/// One in eight is level, one level and turned about the vertical, one tilted about x, the others are any; half of all are
/// -Q of such a one.
fn attitude(rng: &mut ChaCha8Rng, index: u64) -> Result<Attitude, InputError> {
    let angle: f64 = rng.random_range(-3.0..3.0);
    let attitude = match index % 8 {
        0 => Attitude::IDENTITY,
        1 => Attitude::about_z(angle),
        2 => Attitude::about_x(angle),
        _ => Attitude::from_components([0; 4].map(|_| rng.random_range(-1.0..1.0)))?,
    };
    match index / 8 % 2 {
        0 => Ok(attitude),
        _ => Attitude::from_components(attitude.components().map(|part| -part)),
    }
}
