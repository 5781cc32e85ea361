//! Which model answers which question at the least cost?
//!
//! This example lets the planner choose the backend while the program runs: for each scene it takes the cheapest model
//! that is accurate enough. The scenes ask about the paper's cheated toss, caught 30 cm below the hand that threw it,
//! and about the probability of heads in the space of launches `paper-fig4`. The planner takes an integrator only if a
//! scene asks for one by name.
//!
//! ```text
//! outcome      heads
//! tilt         cos θ = 0.57818
//! attitude     n = [0.77682, -0.24954, 0.57818]
//! trace        25 points, the last one with cos θ = 0.57818
//! integrator   n = [0.77682, -0.24954, 0.57818]
//! share-sobol  P(heads) = 0.66
//! ```
//!
//! `cargo run --release -p toss --example backend_by_plan`

use toss::sampling::named_space;
use toss::{Answer, Coin, Launch, Scene, TimeOfFlight, Toss, Vector3, Want};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let thrown = TimeOfFlight::thrown(3.0, 9.81, Some(0.3));
    let toss = Toss::new(Coin::PAPER, Launch::new(Vector3::new(1.0, 1.0, 2.5), thrown)?);
    let scenes = [
        Scene::new(Want::Outcome(toss), 1e-6),
        Scene::new(Want::Tilt(toss), 1e-6),
        Scene::new(Want::Attitude(toss), 1e-6),
        Scene::new(Want::Trace { toss, points: 25 }, 1e-6),
        Scene::new(Want::Attitude(toss), 1e-6).by("gamma", None),
        Scene::new(Want::Probability(named_space("paper-fig4")?), 1e-3),
    ];
    for scene in scenes {
        let solution = scene.solve()?;
        println!("{:<12} {}", solution.model.name, text(&solution.answer));
    }
    Ok(())
}

fn text(answer: &Answer) -> String {
    match answer {
        Answer::Outcome(verdict) => verdict.outcome().name().to_owned(),
        Answer::Tilt(cos_tilt) => format!("cos θ = {cos_tilt:.5}"),
        Answer::Attitude(state) => format!("n = {:.5?}", state.attitude.normal().as_slice()),
        Answer::Enclosed(found) => format!("cos θ = {:.5} ± {:.1e}", found.cos_tilt(), found.error_bound()),
        Answer::Trace(points) => {
            let landing = points.iter().map(|point| point.cos_tilt).next_back().unwrap_or(1.0);
            format!("{} points, the last one with cos θ = {landing:.5}", points.len())
        }
        Answer::Probability(found) => format!("P(heads) = {:.2}", found.probability),
    }
}
