//! One toss: how it lands, whether that is proven, how far each input is from the other outcome, and the motion in numbers.
//! The fields that the command line has too carry its names and digits.

use exact::certify;
use serde::Serialize;
use toss::{CoinMotion, CoinToss, Error, ExactMotion, ExactSolver, Margin, Solver, TimeOfFlight, margin};

use crate::thrown::Thrown;

#[derive(Debug, Serialize)]
pub(crate) struct Answer {
    coin: Moments,
    flight_time: f64,
    cos_tilt: f64,
    outcome: &'static str,
    certified: bool,
    /// The stage of the proof that decided.
    stage: &'static str,
    /// `None` for a body with I1 ≠ I2, whose search takes long: see [`margins`].
    margin: Option<Margins>,
    attitude: [f64; 4],
    rate: [f64; 3],
    /// Heights are above the launch (m); `None` if the time of flight was given.
    apex: Option<f64>,
    input: Input,
    motion: Option<Precession>,
    regime: Option<String>,
}

#[derive(Debug, Serialize)]
struct Moments {
    i1: f64,
    i2: f64,
    i3: f64,
}

/// As in the answer of `unfair-toss toss --margin`.
#[derive(Debug, Serialize)]
pub(crate) struct Margins {
    time: Option<f64>,
    speed: Option<f64>,
    gravity: Option<f64>,
    tilt: Option<f64>,
    rate: [Option<f64>; 3],
    rate_range: [f64; 3],
    time_range: Option<[f64; 2]>,
}

/// The inputs in SI units.
#[derive(Debug, Serialize)]
struct Input {
    rate: [f64; 3],
    speed: Option<f64>,
    gravity: Option<f64>,
    drop: Option<f64>,
    tilt: f64,
}

/// The motion of a body with I1 = I2.
#[derive(Debug, Serialize)]
struct Precession {
    /// I3/I1.
    k: f64,
    /// ψ, the angle between n and S (rad).
    cone_angle: f64,
    /// φ, the angle between S and the vertical (rad).
    momentum_tilt: f64,
    /// ωL (rad/s).
    precession_rate: f64,
    /// The least cos θ of the motion, cos(φ + ψ).
    least_cos_tilt: f64,
    /// The first time at which it changes its face (s).
    first_flip: Option<f64>,
}

/// The answer about `thrown`.
pub(crate) fn answer(thrown: &Thrown) -> Result<Answer, Error> {
    let (toss, coin) = (&thrown.toss, thrown.coin());
    let motion = ExactMotion::new(toss);
    let certificate = certify(toss)?;
    let landing = ExactSolver.land(toss)?;
    let [i1, i2, i3] = toss.body.moments().unwrap_or_else(|| toss.body.principal_moments());
    Ok(Answer {
        coin: Moments { i1, i2, i3 },
        flight_time: toss.launch.flight_time(),
        cos_tilt: without_sign_of_zero(landing.cos_tilt),
        outcome: certificate.outcome().name(),
        certified: certificate.is_proven() && thrown.rounding.keeps(toss, certificate.outcome())?,
        stage: certificate.stage().name(),
        margin: coin.is_some().then(|| margins(thrown)).transpose()?,
        attitude: landing.state.attitude.components().map(without_sign_of_zero),
        rate: landing.state.rate.into(),
        apex: thrown.thrown_up().map(|(speed, gravity, _)| speed * speed / (2.0 * gravity)),
        input: Input::new(thrown),
        motion: coin.as_ref().map(Precession::new),
        regime: coin.is_none().then(|| format!("{:?}", motion.regime())),
    })
}

/// The nearest flip in each input. For a body with I1 ≠ I2 the search takes up to some seconds.
pub(crate) fn margins(thrown: &Thrown) -> Result<Margins, Error> {
    let Margin { time, speed, gravity, tilt, rate, rate_range, time_range } = margin(&thrown.toss)?;
    let time_range = if thrown.coin().is_some() { None } else { Some(time_range) };
    Ok(Margins { time, speed, gravity, tilt, rate, rate_range, time_range })
}

impl Input {
    fn new(thrown: &Thrown) -> Self {
        let launch = &thrown.toss.launch;
        let (speed, gravity, drop) = match launch.time_of_flight() {
            TimeOfFlight::Ballistic { speed, gravity } => (Some(speed), Some(gravity), None),
            TimeOfFlight::BallisticTo { speed, gravity, drop } => (Some(speed), Some(gravity), Some(drop)),
            TimeOfFlight::Given(_) => (None, None, None),
        };
        Self { rate: launch.rate().into(), speed, gravity, drop, tilt: thrown.tilt }
    }
}

impl Precession {
    fn new(toss: &CoinToss) -> Self {
        let motion = CoinMotion::new(toss);
        let (cone_angle, momentum_tilt) = (motion.cone_angle(), motion.momentum_tilt());
        Self {
            k: toss.coin.inertia_ratio(),
            cone_angle,
            momentum_tilt,
            precession_rate: motion.precession_rate(),
            least_cos_tilt: (momentum_tilt + cone_angle).cos(),
            first_flip: motion.first_flip(),
        }
    }
}

/// The same number, but 0 for -0.
fn without_sign_of_zero(number: f64) -> f64 {
    number + 0.0
}
