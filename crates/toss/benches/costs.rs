//! Measures what a flight of an integrator costs without its calls of the right-hand side, and what each call costs: the
//! tables of `crates/toss/src/integrators.rs` and `proofs.rs`. Each is the smallest of many times, of flights of a few
//! radians and of some hundred, on one core. `cargo bench --package toss --bench costs`

use std::hint::black_box;
use std::time::{Duration, Instant};

use toss::catalogue::named_body;
use toss::{
    Body, Coin, Formulation, Launch, QuaternionSolver, Registry, Settings, Stepping, TAYLOR, TimeOfFlight, Toss,
};

/// Flights of `body` through these angles (rad).
fn tosses(body: Body, phases: [f64; 2]) -> Vec<Toss> {
    let part = |index: u32, square: f64| (f64::from(index) * square.sqrt()).fract();
    let toss = |index: u32| {
        let rate = [2.0, 3.0, 5.0].map(|square| 40.0 * part(index, square) - 20.0);
        let size = rate.iter().map(|part| part * part).sum::<f64>().sqrt();
        let phase = phases[0] + (phases[1] - phases[0]) * part(index, 7.0);
        let launch = Launch::new(rate, TimeOfFlight::Given(phase / size)).expect("a valid launch");
        Toss { body, launch }
    };
    (1..=64).map(toss).collect()
}

/// The mean time of a flight (ns), each the smallest of some, and its mean number of calls.
fn mean(tosses: &[Toss], fly: &dyn Fn(&Toss) -> u64) -> [f64; 2] {
    let calls: u64 = tosses.iter().map(fly).sum();
    let once = |toss: &Toss| {
        let start = Instant::now();
        black_box(fly(black_box(toss)));
        start.elapsed()
    };
    let smallest = |toss: &Toss| (0..100).map(|_| once(toss)).min().unwrap_or(Duration::ZERO);
    let time: Duration = tosses.iter().map(smallest).sum();
    #[expect(clippy::cast_precision_loss, reason = "few flights")]
    let [count, calls] = [tosses.len() as f64, calls as f64];
    [1e9 * time.as_secs_f64() / count, calls / count]
}

/// Prints the cost of a flight without calls, and that of a call.
fn measured(what: &str, bodies: &[Body], fly: &dyn Fn(&Toss) -> u64) {
    let of = |phases: [f64; 2]| {
        let flown: Vec<Toss> = bodies.iter().flat_map(|body| tosses(*body, phases)).collect();
        mean(&flown, fly)
    };
    let ([short, few], [long, many]) = (of([2.0, 8.0]), of([60.0, 95.0]));
    let call = (long - short) / (many - few);
    println!("{what:<36} [{:.0}, {call:.1}]", short - call * few);
}

fn main() {
    let named = |name: &str| named_body(name).expect("a body of the catalogue");
    let kinds = [
        ("coins", vec![Body::from(Coin::PAPER), named("us-quarter")]),
        ("other bodies", vec![named("racket"), named("book"), named("nasa-brick")]),
    ];
    for (kind, bodies) in kinds {
        for entry in Registry::standard().entries().iter().filter(|entry| entry.integrates()) {
            for scheme in entry.schemes().iter().filter(|scheme| scheme.is_adaptive()) {
                let stepping = Stepping::adaptive(*scheme, 1e-8).expect("a valid tolerance");
                let solver =
                    entry.solver(&Settings { stepping, ..Settings::default() }).expect("a scheme that it offers");
                if bodies.iter().any(|body| solver.land(&tosses(*body, [2.0, 8.0])[0]).is_err()) {
                    continue;
                }
                let fly = |toss: &Toss| solver.land(toss).map_or(0, |landing| landing.work.rhs_calls);
                measured(&format!("{kind}, {}, {}", entry.name(), scheme.name()), &bodies, &fly);
            }
        }
        let stepping = Stepping::adaptive(TAYLOR, 1e-8).expect("a valid tolerance");
        let solver = QuaternionSolver::new(stepping, Formulation::default());
        let fly = |toss: &Toss| solver.enclose(toss).map_or(0, |found| found.work().rhs_calls);
        measured(&format!("{kind}, taylor with a bound"), &bodies, &fly);
    }
}
