//! How far what a free coin conserves has drifted from launch to landing, each relative to its value at launch.
//!
//! For n·S, S at launch, fixed in TF, is carried into the landed body by its attitude, because n·S as I3 ωz would hold by
//! definition. Both frames then see the same number, by two ways through the attitude; S as a vector is the stronger check.

use dynamics::body_rate::{angular_momentum, angular_momentum_tf, kinetic_energy};
use toss::{State, Toss};

/// Where the flight of `toss` starts.
pub fn at_launch(toss: &Toss) -> State {
    State { attitude: toss.launch.attitude(), rate: toss.launch.rate() }
}

/// Of |S|.
pub fn momentum(toss: &Toss, landing: &State) -> f64 {
    let [before, after] = [&at_launch(toss), landing].map(|state| angular_momentum(&toss.coin, &state.rate).norm());
    (after - before).abs() / before
}

/// Of the kinetic energy.
pub fn energy(toss: &Toss, landing: &State) -> f64 {
    let [before, after] = [&at_launch(toss), landing].map(|state| kinetic_energy(&toss.coin, &state.rate));
    (after - before).abs() / before
}

/// Of n·S in BF, relative to |S|.
pub fn normal_momentum_body(toss: &Toss, landing: &State) -> f64 {
    let launch = at_launch(toss);
    let momentum = angular_momentum_tf(&toss.coin, &launch);
    let [before, after] = [&launch, landing].map(|state| state.attitude.lab_to_body(&momentum));
    (after.z - before.z).abs() / momentum.norm()
}

/// Of n·S in TF, relative to |S|.
pub fn normal_momentum(toss: &Toss, landing: &State) -> f64 {
    let launch = at_launch(toss);
    let momentum = angular_momentum_tf(&toss.coin, &launch);
    let [before, after] = [&launch, landing].map(|state| state.attitude.normal().dot(&momentum));
    (after - before).abs() / momentum.norm()
}

/// Of S as a vector in TF.
pub fn momentum_vector(toss: &Toss, landing: &State) -> f64 {
    let [before, after] = [&at_launch(toss), landing].map(|state| angular_momentum_tf(&toss.coin, state));
    (after - before).norm() / before.norm()
}
