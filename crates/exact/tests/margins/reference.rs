//! cos θ of a toss with one input changed, in 160 binary digits: what the margins are measured against.
//!
//! It turns the launch as a quaternion, Q = Q0 ⊗ exp(½ T (ωx, ωy, k ωz)), and shares neither formula nor code with the search.

use dynamics::{CoinToss, TimeOfFlight};
use numerics::Big;
use numerics::big::exactly;

/// An input that is changed alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Input {
    Rate(usize),
    Time,
    Speed,
    Gravity,
    Tilt,
}

const DIGITS: usize = 160;

pub(crate) fn big(value: f64) -> Big {
    exactly(value).with_precision(DIGITS).value()
}

/// cos θ at landing, with `change` added to the input.
pub(crate) fn cos_tilt(toss: &CoinToss, input: Input, change: &Big) -> Big {
    let k = toss.coin.inertia_ratio_in_digits(DIGITS);
    let with_change = |value: f64, changed: bool| if changed { big(value) + change } else { big(value) };
    let rate = toss.launch.rate();
    let rate = [0, 1, 2].map(|axis| with_change(rate[axis], input == Input::Rate(axis)));
    let half_time = time(toss, input, change) / big(2.0);
    let [x, y, z] = rate;
    let turn = [x, y, z * k].map(|part| part * &half_time);
    let mut attitude = match toss.launch.attitude().tilt() {
        Some(tilt) => {
            let (sin, cos) = (big(tilt.to_f64()) / big(2.0)).sin_cos();
            [cos, sin, big(0.0), big(0.0)]
        }
        None => toss.launch.attitude().given_components().map(big),
    };
    if input == Input::Tilt {
        let (sin, cos) = (change / big(2.0)).with_precision(DIGITS).value().sin_cos();
        attitude = product(&[cos, sin, big(0.0), big(0.0)], &attitude);
    }
    let [w, x, y, z] = product(&attitude, &exponential(turn));
    let [up, down] = [&w * &w + &z * &z, &x * &x + &y * &y];
    (&up - &down) / (up + down)
}

fn time(toss: &CoinToss, input: Input, change: &Big) -> Big {
    let with_change = |value: f64, of: Input| if input == of { big(value) + change } else { big(value) };
    let time = match toss.launch.time_of_flight() {
        TimeOfFlight::Given(time) => big(time),
        TimeOfFlight::Ballistic { speed, gravity } => {
            big(2.0) * with_change(speed, Input::Speed) / with_change(gravity, Input::Gravity)
        }
        TimeOfFlight::BallisticTo { speed, gravity, drop } => {
            let (speed, gravity) = (with_change(speed, Input::Speed), with_change(gravity, Input::Gravity));
            let squared = &speed * &speed + big(2.0) * &gravity * big(drop);
            (speed + squared.sqrt()) / gravity
        }
    };
    if input == Input::Time { time + change } else { time }
}

/// exp of half the turn whose half is `turn`.
fn exponential(turn: [Big; 3]) -> [Big; 4] {
    let [x, y, z] = &turn;
    let half_phase = (x * x + y * y + z * z).sqrt();
    if half_phase == big(0.0) {
        return [1.0, 0.0, 0.0, 0.0].map(big);
    }
    let (sin, cos) = half_phase.sin_cos();
    let [x, y, z] = turn.map(|part| part * &sin / &half_phase);
    [cos, x, y, z]
}

fn product(a: &[Big; 4], b: &[Big; 4]) -> [Big; 4] {
    [
        &a[0] * &b[0] - &a[1] * &b[1] - &a[2] * &b[2] - &a[3] * &b[3],
        &a[0] * &b[1] + &a[1] * &b[0] + &a[2] * &b[3] - &a[3] * &b[2],
        &a[0] * &b[2] - &a[1] * &b[3] + &a[2] * &b[0] + &a[3] * &b[1],
        &a[0] * &b[3] + &a[1] * &b[2] - &a[2] * &b[1] + &a[3] * &b[0],
    ]
}
