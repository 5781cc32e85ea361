//! A body without forces in the physics engine `rapier`, in SI units and with the engine's own settings, but for the
//! time step. The engine keeps the size of the angular momentum, not its direction.

use rapier3d_f64::prelude::{MassProperties, PhysicsWorld, Pose, RigidBodyBuilder, Rotation, Vector};
use toss::{
    Attitude, CoinToss, Landing, Scheme, SolveError, Solver, SolverEntry, State, StepControl, Stepping, Toss, Vector3,
    Work,
};

/// More steps than this are refused.
const STEP_LIMIT: u32 = 1_000_000;

/// The engine's entry.
pub fn entry() -> SolverEntry {
    let scheme = Scheme::new("step", Some(1)).with_fixed_steps();
    SolverEntry::new("rapier", "the physics engine rapier3d-f64 0.36", |settings| Box::new(Engine(settings.stepping)))
        .with_schemes(&[scheme])
        .with_color([0, 114, 178])
}

struct Engine(Stepping);

impl Solver for Engine {
    fn name(&self) -> &str {
        "rapier"
    }

    fn stepping(&self) -> Option<Stepping> {
        Some(self.0)
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let coin = toss.of_coin(self.name(), "only coins are given to the engine")?;
        let error = self.0.error_estimate(toss)?;
        let StepControl::Step(step) = self.0.control() else {
            return Err(SolveError::NotOffered { scheme: self.0.scheme().name() });
        };
        let time = toss.launch.flight_time();
        let steps = (time / step * (1.0 - 4.0 * f64::EPSILON)).ceil();
        if steps > f64::from(STEP_LIMIT) {
            return Err(SolveError::StepLimit { time: 0.0, limit: STEP_LIMIT });
        }
        let (mut world, body) = launched(&coin);
        world.integration_parameters.dt = time / steps;
        for _ in 0..steps as u64 {
            world.step();
        }
        let body = &world.bodies[body];
        let turn = body.position().rotation;
        let attitude = Attitude::from_components([turn.w, turn.x, turn.y, turn.z]);
        let attitude = attitude.map_err(|error| SolveError::failed(self.name(), error))?;
        let rate = body.angvel();
        let rate = attitude.lab_to_body(&Vector3::new(rate.x, rate.y, rate.z));
        let work = Work { accepted_steps: steps as u64, ..Work::default() };
        Ok(Landing::new(State { attitude, rate }, work).with_error(error))
    }
}

/// A world with the coin alone, as it leaves the hand.
fn launched(toss: &CoinToss) -> (PhysicsWorld, rapier3d_f64::prelude::RigidBodyHandle) {
    let (coin, launch) = (toss.coin, toss.launch);
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::ZERO;
    let moments = Vector::new(coin.i1(), coin.i1(), coin.i3());
    let [w, x, y, z] = launch.attitude().components();
    let rate = launch.attitude().body_to_lab(&launch.rate());
    // The mass does not matter in free flight; that of a coin is a few grams.
    let body = RigidBodyBuilder::dynamic()
        .pose(Pose::from_parts(Vector::ZERO, Rotation::from_xyzw(x, y, z, w)))
        .angvel(Vector::new(rate.x, rate.y, rate.z))
        .additional_mass_properties(MassProperties::new(Vector::ZERO, 0.005, moments))
        .can_sleep(false);
    let handle = world.insert_body(body);
    (world, handle)
}
