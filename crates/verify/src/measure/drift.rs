//! This file computes how far conserved quantities of a free coin have drifted between launch and landing, relative to
//! their values at launch. Any drift is an error of the solver, and is found without a reference solution.
//!
//! S is the angular momentum, n the coin's normal, BF the body frame and TF the transport frame, in which S is
//! constant. For n·S the value of S at launch is carried from TF into the landed body by the landed attitude. Computing
//! n·S as I3 ωz instead would test nothing, because the solvers keep ωz constant. Both frames give the same number by
//! two ways through the attitude; the drift of S as a vector is the stronger test.

use dynamics::Toss;
use dynamics::body_rate::{angular_momentum, angular_momentum_tf, kinetic_energy};
use toss::{CoinToss, State};

/// The state of `toss` at launch.
pub fn at_launch(toss: &CoinToss) -> State {
    State { attitude: toss.launch.attitude(), rate: toss.launch.rate() }
}

/// Relative drift of |S|.
pub fn momentum(toss: &CoinToss, landing: &State) -> f64 {
    let [before, after] = [&at_launch(toss), landing].map(|state| angular_momentum(&toss.coin, &state.rate).norm());
    (after - before).abs() / before
}

/// Relative drift of the kinetic energy.
pub fn energy(toss: &CoinToss, landing: &State) -> f64 {
    let [before, after] = [&at_launch(toss), landing].map(|state| kinetic_energy(&toss.coin, &state.rate));
    (after - before).abs() / before
}

/// Drift of n·S, computed in BF, relative to |S|.
pub fn normal_momentum_body(toss: &CoinToss, landing: &State) -> f64 {
    let launch = at_launch(toss);
    let momentum = angular_momentum_tf(&toss.coin, &launch);
    let [before, after] = [&launch, landing].map(|state| state.attitude.lab_to_body(&momentum));
    (after.z - before.z).abs() / momentum.norm()
}

/// Drift of n·S, computed in TF, relative to |S|.
pub fn normal_momentum(toss: &CoinToss, landing: &State) -> f64 {
    let launch = at_launch(toss);
    let momentum = angular_momentum_tf(&toss.coin, &launch);
    let [before, after] = [&launch, landing].map(|state| state.attitude.normal().dot(&momentum));
    (after - before).abs() / momentum.norm()
}

/// Drift of S as a vector in TF, relative to |S|.
pub fn momentum_vector(toss: &CoinToss, landing: &State) -> f64 {
    let [before, after] = [&at_launch(toss), landing].map(|state| angular_momentum_tf(&toss.coin, state));
    (after - before).norm() / before.norm()
}

/// Drifts of a landing of any body: of |S|, of the kinetic energy, and of S as a vector in TF. They are relative to
/// those of a body that turns as fast about its largest axis, because a rod that spins about itself has next to none.
pub fn of_rigid(toss: &Toss, landing: &State) -> [f64; 3] {
    let launch = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
    let body = &toss.body;
    let (largest, rate) = (body.principal_moments()[2], launch.rate.norm());
    let [before, after] =
        [&launch, landing].map(|state| state.attitude.body_to_lab(&body.angular_momentum(&state.rate)));
    let energy = body.kinetic_energy(&landing.rate) - body.kinetic_energy(&launch.rate);
    let vector = (after - before).norm();
    [
        (after.norm() - before.norm()).abs() / (largest * rate),
        2.0 * energy.abs() / (largest * rate * rate),
        vector / (largest * rate),
    ]
}
