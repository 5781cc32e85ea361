//! This file computes how far conserved quantities of a free body have drifted between launch and landing, relative to
//! their values at launch. Any drift is an error of the solver, and is found without a reference solution.
//!
//! S is the angular momentum, n the coin's normal and TF the transport frame, in which S is
//! constant. Where the energy and S as a vector are conserved, so are |S| and n·S.

use dynamics::Toss;
use toss::{State, Vector3};

fn both<T>(toss: &Toss, landing: &State, of: impl Fn(&State) -> T) -> [T; 2] {
    let launch = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
    [of(&launch), of(landing)]
}

/// S in TF at launch and at landing.
fn momenta(toss: &Toss, landing: &State) -> [Vector3<f64>; 2] {
    both(toss, landing, |state| state.attitude.body_to_lab(&toss.body.angular_momentum(&state.rate)))
}

/// Relative drift of the kinetic energy.
pub(super) fn energy(toss: &Toss, landing: &State) -> f64 {
    let [before, after] = both(toss, landing, |state| toss.body.kinetic_energy(&state.rate));
    (after - before).abs() / before
}

/// Drift of S as a vector in TF, relative to |S|; of a body that is no coin, as [`of_body`] has it.
pub(super) fn momentum_vector(toss: &Toss, landing: &State) -> f64 {
    if toss.coin().is_none() {
        return of_body(toss, landing)[1];
    }
    let [before, after] = momenta(toss, landing);
    (after - before).norm() / before.norm()
}

/// Drifts of a landing of any body: of the kinetic energy, and of S as a vector in TF. They are relative to
/// those of a body that turns as fast about its largest axis, because a rod that spins about itself has next to none.
pub(super) fn of_body(toss: &Toss, landing: &State) -> [f64; 2] {
    let (largest, rate) = (toss.body.principal_moments()[2], toss.launch.rate().norm());
    let [before, after] = momenta(toss, landing);
    let energy = toss.body.kinetic_energy(&landing.rate) - toss.body.kinetic_energy(&toss.launch.rate());
    [2.0 * energy.abs() / (largest * rate * rate), (after - before).norm() / (largest * rate)]
}
