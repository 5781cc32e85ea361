//! This file measures the error of an answer to a scene, against the 256-bit reference or, for a probability, against
//! another method. The errors that the planner expects are judged by these.

use dynamics::coin::NO_COIN;
use sampling::{Coordinate, Estimate, Plan, Rest, Sampler, Scrambled, Space};
use toss::{
    Answer, CoinToss, Error, InputError, Launch, Outcome, Scene, TimeOfFlight, TracePoint, Vector3,
    level_speeds_of_heads,
};

use crate::measure::reference::Reference;

/// The exact answer to every scene about one toss.
pub struct Truth {
    landing: Reference,
    toss: CoinToss,
}

impl Truth {
    /// Solves `toss` with the 256-bit reference.
    pub fn new(toss: &CoinToss) -> Self {
        Self { landing: Reference::new(toss), toss: *toss }
    }

    /// The error of an answer to a scene: that of cos θ, or the angle between attitudes (rad). The error of an outcome
    /// is 0 or infinite. If the scene asks for an integrator, an undecided outcome has no error where |cos θ| is at
    /// most twice the scene's accuracy.
    ///
    /// # Errors
    /// Never: the times of a trace are valid.
    pub fn error(&self, scene: &Scene, answer: &Answer) -> Result<f64, InputError> {
        let wrong = |is_wrong: bool| if is_wrong { f64::INFINITY } else { 0.0 };
        Ok(match answer {
            Answer::Outcome(verdict) if verdict.outcome() == Outcome::Undecided && scene.by.is_some() => {
                wrong(self.landing.cos_tilt_error(0.0) > 2.0 * scene.accuracy)
            }
            Answer::Outcome(verdict) => wrong(verdict.outcome() != self.landing.outcome()),
            Answer::Tilt(cos_tilt) => self.landing.cos_tilt_error(*cos_tilt),
            Answer::Attitude(state) => self.landing.attitude_error(&state.attitude),
            Answer::Enclosed(found) => {
                let of_attitude = self.landing.attitude_error(&found.landing().state.attitude);
                of_attitude.max(self.landing.cos_tilt_error(found.cos_tilt()))
            }
            Answer::Trace(points) => self.trace_error(points)?,
            Answer::Probability(_) => f64::INFINITY,
        })
    }

    fn trace_error(&self, points: &[TracePoint]) -> Result<f64, InputError> {
        let mut largest = 0.0_f64;
        let launch = self.toss.launch;
        for point in points {
            // The last point is the landing, whose time is not rounded to f64.
            let error = if point.time == launch.flight_time() {
                self.landing.attitude_error(&point.attitude)
            } else {
                let until = launch.with_time_of_flight(TimeOfFlight::Given(point.time))?;
                Reference::new(&CoinToss { launch: until, ..self.toss }).attitude_error(&point.attitude)
            };
            largest = largest.max(error);
        }
        Ok(largest)
    }
}

/// The probability of heads in `space`, computed in another way than by the models under test: from the lengths of the
/// intervals of speeds that land heads if only the speed is free, otherwise by `points` launches with another seed,
/// many more than the models use.
///
/// # Errors
/// Never for the spaces of [`scenes`](super::scenes).
pub fn true_probability(space: &Space, points: u64) -> Result<f64, Error> {
    const OTHER_SEED: u64 = 987_654_321;
    let free: Vec<Coordinate> = space.free().collect();
    let scrambled = Scrambled::new(points, OTHER_SEED);
    let is_of_coins = space.coin().is_some();
    if free == [Coordinate::Speed] && is_of_coins {
        return share_by_intervals(space);
    }
    let plan = if free.contains(&Coordinate::Speed) && is_of_coins {
        Plan::ExactSpeed(Rest::Sobol(scrambled))
    } else {
        Plan::Sobol(scrambled)
    };
    let Estimate { probability, .. } = Sampler::exact().estimate(space, plan)?;
    Ok(probability)
}

fn share_by_intervals(space: &Space) -> Result<f64, Error> {
    let value = |of| space.axis(of).bounds()[0];
    let [slowest, fastest] = space.axis(Coordinate::Speed).bounds();
    let rate = Vector3::new(value(Coordinate::RateX), value(Coordinate::RateY), value(Coordinate::RateZ));
    let time = TimeOfFlight::thrown(fastest, value(Coordinate::Gravity), None);
    let coin = space.coin().ok_or(NO_COIN)?;
    let toss = CoinToss { coin, launch: Launch::new(rate, time)?.with_tilt(value(Coordinate::Tilt))? };
    let intervals = level_speeds_of_heads(&toss, slowest)?;
    let length: f64 = intervals.into_iter().flatten().map(|[slow, fast]| fast - slow).sum();
    Ok(length / (fastest - slowest))
}
