//! How close the bounds of Runge-Kutta schemes and of Taylor series are to the errors, and what they cost: for each scheme,
//! tolerance and phase, the median of the bound of the attitude divided by its error, how many flights have no bound, and the
//! right-hand sides and the time of all flights divided by those of flights without a proof.
//!
//! `cargo run --release -p kinematics-quat --example bounds` prints these numbers.

use std::hint::black_box;
use std::time::{Duration, Instant};

use dynamics::{
    Attitude, Body, Coin, Formulation, Launch, RigidToss, Scheme, Solver, Stepping, TimeOfFlight, Toss, Work,
};
use exact::{ExactMotion, RigidMotion};
use kinematics_quat::{IntegratedCertificate, QuaternionSolver};

/// Numbers in [0, 1) from a linear congruential generator.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2f64.powi(53)
    }

    /// A launch that turns by about this phase.
    fn launch(&mut self, phase: f64) -> Launch {
        let rate = [0; 3].map(|_| 2.0 * self.next() - 1.0);
        let size = rate.iter().map(|part| part * part).sum::<f64>().sqrt();
        Launch::new(rate, TimeOfFlight::Given(phase * (0.5 + 0.5 * self.next()) / size)).expect("finite")
    }

    fn coin(&mut self, phase: f64) -> RigidToss {
        let coin = Coin::from_moments(1.0, 2.0 * self.next()).expect("a body");
        RigidToss { body: coin.into(), launch: self.launch(phase) }
    }

    fn body(&mut self, phase: f64) -> RigidToss {
        let [a, b, c] = [0; 3].map(|_| 0.01 + 0.99 * self.next());
        RigidToss { body: Body::from_moments([b + c, c + a, a + b]).expect("a body"), launch: self.launch(phase) }
    }
}

/// The attitude at landing by the closed form.
fn landed(toss: &RigidToss) -> Attitude {
    let time = toss.launch.time_of_flight();
    match toss.symmetric() {
        Some(Toss { coin, launch }) => ExactMotion::new(&Toss { coin, launch }).state(time).map(|state| state.attitude),
        None => RigidMotion::compensated(toss).state(time).map(|state| state.attitude),
    }
    .expect("a landing")
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// The landings, and the least time of several runs that they took.
fn timed<T>(flights: &[RigidToss], fly: impl Fn(&RigidToss) -> T) -> (Vec<T>, Duration) {
    let mut least = Duration::MAX;
    let mut run = || -> Vec<T> {
        let start = Instant::now();
        let landed = flights.iter().map(|toss| black_box(fly(toss))).collect();
        least = least.min(start.elapsed());
        landed
    };
    (1..if flights.len() > 10 { 10 } else { 2 }).for_each(|_| drop(run()));
    (run(), least)
}

fn row(scheme: Scheme, tolerance: f64, flights: &[RigidToss], exact: &[Attitude]) -> String {
    let stepping = Stepping::adaptive(scheme, tolerance).expect("a tolerance");
    let solver = QuaternionSolver::new(stepping, Formulation::default());
    let (plain, of_plain) = timed(flights, |toss| solver.propagate_rigid(toss).map(|landing| landing.work));
    let (proven, of_proven) = timed(flights, |toss| solver.enclose_rigid(toss));
    let proven: Result<Vec<IntegratedCertificate>, _> = proven.into_iter().collect();
    let (Ok(proven), Ok(plain)) = (proven, plain.into_iter().collect::<Result<Vec<Work>, _>>()) else {
        return "too many steps".to_owned();
    };
    let has_bound = |found: &&IntegratedCertificate| found.attitude_error_bound() < 2.0;
    let ratios = proven.iter().zip(exact).filter(|(found, _)| has_bound(found)).map(|(found, exact)| {
        // Half the angle is the distance of the quaternions.
        found.attitude_error_bound() / (0.5 * found.landing().state.attitude.angle_to(exact)).max(1e-17)
    });
    let ratios: Vec<f64> = ratios.collect();
    let without = proven.len() - ratios.len();
    let ratio = if ratios.is_empty() { f64::NAN } else { median(ratios) };
    let bound = median(proven.iter().map(IntegratedCertificate::attitude_error_bound).collect());
    let calls = |works: Vec<Work>| works.iter().map(|work| work.rhs_calls).sum::<u64>() as f64;
    let of_calls = calls(proven.iter().map(IntegratedCertificate::work).collect()) / calls(plain);
    let of_time = of_proven.as_secs_f64() / of_plain.as_secs_f64();
    format!("{bound:.0e} | {ratio:.3} | {without} | {of_calls:.2} | {of_time:.2}")
}

fn main() {
    for kind in ["coins", "bodies"] {
        println!("| {kind} | tolerance | phase (rad) | bound | bound / error | without | right-hand sides | time |");
        println!("|---|---|---|---|---|---|---|---|");
        for (phase, number) in [(1e1, 200), (1e3, 40), (1e5, 3)] {
            let mut numbers = Numbers(7);
            let mut flight = || if kind == "coins" { numbers.coin(phase) } else { numbers.body(phase) };
            let flights: Vec<RigidToss> = (0..number).map(|_| flight()).collect();
            let exact: Vec<Attitude> = flights.iter().map(landed).collect();
            for scheme in [Scheme::DOPRI5, Scheme::DOP853, Scheme::TAYLOR] {
                for tolerance in [1e-6, 1e-9, 1e-12] {
                    let row = row(scheme, tolerance, &flights, &exact);
                    println!("| {scheme} | {tolerance:e} | {phase:e} | {row} |");
                }
            }
        }
    }
}
