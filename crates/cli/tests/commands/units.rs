//! Quantities may be typed with a unit, and a toss may be described by what can be seen of it.

use std::f64::consts::TAU;

use crate::common::{assert_near, json};

#[test]
fn a_toss_is_the_same_in_any_units() {
    let with_units = "--cylinder 5.67g,12.13mm,1.75mm --rate 10rev/s,0,-300rpm --speed 240cm/s --gravity 981cm/s² --drop 50cm \
                      --tilt 15deg";
    let si = "--cylinder 0.00567,0.01213,0.00175 --rate 62.83185307179586,0,-31.41592653589793 --speed 2.4 --gravity 9.81 \
              --drop 0.5 --tilt 0.26179938779914946";
    let landing = |options: &str| json(&format!("toss {options}"), 0)["cos_tilt"].clone();
    // With units fewer numbers are rounded, so that the last digits may differ, by up to u for each of 70 rad.
    assert_near(&landing(with_units), landing(si).as_f64().unwrap(), 1e-14);
}

#[test]
fn turn_and_psi_stand_for_the_rate_that_they_give() {
    // ωL = 2π, ψ = 60°, k = 0.5: Ω = 2π sin 60° and ωz = 2π cos 60°/0.5 = 2π.
    let seen = json("toss --turn 1rev/s --psi 60deg --speed 3", 0);
    let rate = format!("toss --rate {},0,{} --speed 3", TAU * 0.75_f64.sqrt(), TAU);
    assert_near(&seen["cos_tilt"], json(&rate, 0)["cos_tilt"].as_f64().unwrap(), 1e-14);
    // cos θ = cos²ψ + sin²ψ cos(ωL T).
    let expected = 0.25 + 0.75 * (TAU * 6.0 / 9.81).cos();
    assert_near(&seen["cos_tilt"], expected, 1e-14);
}
