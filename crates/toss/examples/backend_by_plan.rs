//! A backend that is chosen while the program runs: the planner takes the cheapest model that serves each scene.
//!
//! `cargo run --release --example backend_by_plan`

use toss::choice::Nanoseconds;
use toss::{Answer, Coin, Launch, Scene, TimeOfFlight, Toss, Vector3, Want};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The paper's cheated toss, caught 30 cm below the hand that threw it.
    let thrown = TimeOfFlight::thrown(3.0, 9.81, Some(0.3));
    let toss = Toss { coin: Coin::PAPER, launch: Launch::new(Vector3::new(1.0, 1.0, 2.5), thrown)? };
    let scenes = [
        Scene::new(Want::Outcome(toss), 1e-6),
        Scene::new(Want::Tilt(toss), 1e-6),
        Scene::new(Want::Attitude(toss), 1e-6),
        Scene::new(Want::Trace { toss, points: 25 }, 1e-6),
        Scene::new(Want::Attitude(toss), 1e-6).by("gamma", None),
        Scene::new(Want::Probability(sampling::named_space("paper-fig4")?), 1e-2),
    ];
    for scene in scenes {
        let choice = scene.plan()?.choice;
        let said = match scene.solve()?.answer {
            Answer::Outcome(verdict) => verdict.outcome.name().to_owned(),
            Answer::Tilt(cos_tilt) => format!("cos θ = {cos_tilt:.6}"),
            Answer::Attitude(state) => format!("n = {:.6?}", state.attitude.normal().as_slice()),
            Answer::Trace(points) => {
                format!("{} points, the last one with cos θ = {:.6}", points.len(), points[24].cos_tilt)
            }
            Answer::Probability(found) => format!("P(heads) = {:.3}", found.probability),
        };
        println!("{:<12} {said}, expected in {}", choice.model.name(), Nanoseconds(choice.expected_cost_ns));
    }
    Ok(())
}
