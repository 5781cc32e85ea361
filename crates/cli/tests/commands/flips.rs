//! Runs the commands about how a launch changes its outcome as a user does: `intervals` and `inverse`.

use crate::common::{assert_near, json, run, stdout};

#[test]
fn speeds_of_heads_are_found_and_add_up_to_the_probability() {
    for (drop, number) in [("", 2), ("--drop 1.2", 3)] {
        let toss = format!("--rate 20,5,3 --tilt 0.4 {drop}");
        let answer = json(&format!("intervals --speed 3:9 {toss}"), 0);
        let intervals = answer["heads"].as_array().unwrap();
        assert!(intervals.len() > number);
        let outcome = |speed: f64| json(&format!("toss {toss} --speed {speed}"), 0)["outcome"].clone();
        let mut length = 0.0;
        for interval in intervals {
            let [slow, fast] = [0, 1].map(|end| interval[end].as_f64().unwrap());
            length += fast - slow;
            assert_eq!((outcome(slow + 1e-9), outcome(fast - 1e-9)), ("heads".into(), "heads".into()));
            assert!(slow == 3.0 || outcome(slow - 1e-9) == "tails", "{slow}");
            assert!(fast == 9.0 || outcome(fast + 1e-9) == "tails", "{fast}");
        }
        assert_near(&answer["probability"], length / 6.0, 1e-15);
    }
    let exact = json("probability --rate-x 20 --rate-y 5 --rate-z 3 --tilt 0.4 --speed 3:9 --method exact-speed", 0);
    let answer = json("intervals --rate 20,5,3 --tilt 0.4 --speed 3:9", 0);
    assert_near(&answer["probability"], exact["probability"].as_f64().unwrap(), 1e-13);
    assert!(stdout(&run("intervals --rate 2,2,0.5 --speed 3:5")).ends_with("share of the range  0.000000000000\n"));
}

#[test]
fn the_inverse_launch_has_the_wanted_probability() {
    // p(60°) from the reference numbers; there cot²ψ = 1/3.
    let answer = json("inverse --probability 0.6081734479693927 --coin disc", 0);
    assert_near(&answer["cone_angle"], std::f64::consts::FRAC_PI_3, 1e-14);
    assert_near(&answer["rate_ratio"], 2.0 * 3f64.sqrt(), 1e-13);
}
