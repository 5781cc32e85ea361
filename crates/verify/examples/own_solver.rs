//! A solver of coins: two turns, one after the other, about the angular momentum and about the normal.

use std::process::ExitCode;

use toss::{Attitude, Landing, Registry, SolveError, Solver, SolverEntry, State, Toss, Vector3, Work};
use verify::Suite;

struct TwoTurns;

impl Solver for TwoTurns {
    fn name(&self) -> &str {
        "two-turns"
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let toss = toss.of_coin(self.name(), "its turns are those of I1 = I2")?;
        let (rate, time, k) = (toss.launch.rate(), toss.launch.flight_time(), toss.coin.inertia_ratio());
        // The turns by precession and by spin (rad). Rates times the time first: the square of a slow rate may be 0.
        let (precession, spin) = (Vector3::new(rate.x, rate.y, k * rate.z) * time, (1.0 - k) * rate.z * time);
        let axis = precession.try_normalize(0.0).unwrap_or(Vector3::z());
        let about_momentum = Attitude::about_unit_axis(&axis, (0.5 * precession.norm()).sin_cos());
        let attitude = toss.launch.attitude() * about_momentum * Attitude::about_z(spin);
        let (sin, cos) = (-spin).sin_cos();
        let rate = Vector3::new(cos * rate.x - sin * rate.y, sin * rate.x + cos * rate.y, rate.z);
        let error = (3e-16 * (4.0 + 2.0 * toss.launch.turn_rate() * time)).min(2.0);
        Ok(Landing::new(State { attitude, rate }, Work::default()).with_error(error))
    }
}

pub(crate) fn entry() -> SolverEntry {
    SolverEntry::new("two-turns", "two turns in f64", |_| Box::new(TwoTurns))
}

fn main() -> ExitCode {
    let registry = Registry::empty().with(entry()).expect("a name of its own");
    verify::main(Suite::new(registry))
}
