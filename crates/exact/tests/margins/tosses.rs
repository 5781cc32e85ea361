//! Tosses on which margins are checked.

use dynamics::{Attitude, Coin, CoinToss, Launch, TimeOfFlight, Vector3};

/// Tosses of rods, spheres, real coins and flat discs, some at rest and some about a diameter, from horizontal, from a tilt and from any attitude, caught at the same
/// height, below and above, or flying for a given time; by Weyl's sequence.
pub(crate) fn random_tosses() -> impl Iterator<Item = CoinToss> {
    (1..).map(|index| {
        let part = |root: f64| (f64::from(index) * root.sqrt()).fract();
        let signed = |root: f64| 2.0 * part(root) - 1.0;
        let most = [3.0, 30.0, 300.0][index as usize % 3];
        let rate = match index % 13 {
            0 => Vector3::zeros(),
            5 => Vector3::new(0.0, most * signed(3.0), 0.0),
            _ => Vector3::new(most * signed(2.0), most * signed(3.0), most * signed(5.0)),
        };
        let (speed, gravity) = (2.0 + 3.0 * part(7.0), 1.0 + 9.0 * part(13.0));
        let time_of_flight = match index % 7 {
            0 => TimeOfFlight::Given(part(7.0)),
            1 => TimeOfFlight::BallisticTo { speed, gravity, drop: 2.0 * part(17.0) },
            2 => TimeOfFlight::BallisticTo { speed, gravity, drop: -0.5 * speed * speed / gravity * part(17.0) },
            _ => TimeOfFlight::Ballistic { speed, gravity },
        };
        let launch = Launch::new(rate, time_of_flight).expect("a valid toss");
        let launch = match index % 4 {
            0 => launch.with_tilt(3.0 * signed(11.0)).expect("a valid toss"),
            1 => launch
                .with_attitude(Attitude::from_components([19.0, 23.0, 29.0, 31.0].map(signed)).expect("a valid toss")),
            _ => launch,
        };
        let ratio = [0.5, 1.0, 1.98, 2.0, 0.03, 0.0, 2.0 * part(37.0)][index as usize % 11 % 7];
        CoinToss { coin: Coin::from_moments(1.0, ratio).expect("a valid toss"), launch }
    })
}
