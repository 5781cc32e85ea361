//! One toss: how it lands, whether that is proven, how far each input is from the other outcome, and the motion in numbers.
//! The fields that the command line has too carry its names and digits.

use serde::Serialize;
use toss::report::Landing;
use toss::{CoinMotion, CoinToss, Error, ExactMotion, Margin, Registry, Settings, Stage, margin};

use crate::thrown::Thrown;

#[derive(Debug, Serialize)]
pub(crate) struct Outcome {
    /// As in the answer of `unfair-toss toss`. The search for the margin of a body with I1 ≠ I2 takes long: see [`margins`].
    #[serde(flatten)]
    landing: Landing,
    /// The stage of the proof that decided.
    stage: Option<&'static str>,
    /// Heights are above the launch (m); `None` if the time of flight was given.
    apex: Option<f64>,
    input: Input,
    motion: Option<Precession>,
    regime: Option<String>,
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
pub(crate) fn answer(thrown: &Thrown) -> Result<Outcome, Error> {
    let (toss, coin) = (&thrown.toss, thrown.coin());
    let exact = Registry::standard().backend("exact", &Settings::default())?;
    let landing = Landing::new(toss, &exact)?;
    let landing = if coin.is_some() { landing.with_margin(toss)? } else { landing };
    let landing = landing.rounded(toss, &thrown.rounding)?;
    Ok(Outcome {
        stage: landing.stage.map(Stage::name),
        landing,
        apex: toss.launch.time_of_flight().throw().map(|[speed, gravity]| speed * speed / (2.0 * gravity)),
        input: Input::new(thrown),
        motion: coin.as_ref().map(Precession::new),
        regime: coin.is_none().then(|| format!("{:?}", ExactMotion::new(toss).regime())),
    })
}

/// The nearest flip in each input. For a body with I1 ≠ I2 the search takes up to some seconds.
pub(crate) fn margins(thrown: &Thrown) -> Result<Margin, Error> {
    Ok(margin(&thrown.toss)?)
}

impl Input {
    fn new(thrown: &Thrown) -> Self {
        let launch = &thrown.toss.launch;
        let flight = launch.time_of_flight();
        let [speed, gravity] = flight.throw().map_or([None; 2], |throw| throw.map(Some));
        Self { rate: launch.rate().into(), speed, gravity, drop: flight.drop(), tilt: thrown.tilt }
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
