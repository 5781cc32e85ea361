//! What the margin of a toss costs.
use dynamics::{Coin, Launch, TimeOfFlight, Toss, Vector3};
use exact::margin;
use std::hint::black_box;
use std::time::Instant;
fn main() {
    for (r, t, s) in [
        ([1.0, 1.0, 2.5], 0.0, 3.0),
        ([2.0, 5.0, 1.0], 1.2, 2.0),
        ([20.0, 5.0, 3.0], 0.4, 3.0),
        ([0.0, 5.0, 3.0], std::f64::consts::FRAC_PI_2, 3.0),
    ] {
        let l = Launch::new(Vector3::from(r), TimeOfFlight::Ballistic { speed: s, gravity: 9.81 })
            .unwrap()
            .with_tilt(t)
            .unwrap();
        let t0 = Instant::now();
        println!("{r:?} {t} {:?} {:?}", margin(&Toss { coin: Coin::PAPER, launch: l }).unwrap(), t0.elapsed());
    }
    let part = |i: u32, x: f64| (f64::from(i) * x.sqrt()).fract();
    let tosses: Vec<Toss> = (0..10000u32)
        .map(|i| {
            let rate = [2.0, 3.0, 5.0].map(|x| 80.0 * (2.0 * part(i, x) - 1.0));
            let l = Launch::new(
                Vector3::from(rate),
                TimeOfFlight::Ballistic { speed: 1.0 + 4.0 * part(i, 7.0), gravity: 9.81 },
            )
            .unwrap()
            .with_tilt(if i % 2 == 0 { 0.0 } else { 6.0 * part(i, 11.0) - 3.0 })
            .unwrap();
            Toss { coin: Coin::from_moments(1.0, [0.5, 1.0, 1.98, 0.2, 2.0][(i % 5) as usize]).unwrap(), launch: l }
        })
        .collect();
    let mut each: Vec<f64> = tosses
        .iter()
        .map(|t| {
            (0..5)
                .map(|_| {
                    let t0 = Instant::now();
                    black_box(margin(black_box(t)).unwrap());
                    t0.elapsed().as_secs_f64() * 1e6
                })
                .fold(f64::MAX, f64::min)
        })
        .collect();
    let t0 = Instant::now();
    for t in &tosses {
        black_box(margin(black_box(t)).unwrap());
    }
    println!("mean {:.2} us", t0.elapsed().as_secs_f64() * 1e6 / 1e4);
    let mut n = 0;
    for (i, e) in each.iter().enumerate() {
        if *e > 60.0 {
            n += 1;
            if n < 12 {
                println!(
                    "{i} {e} k={} {:?} {:?}",
                    tosses[i].coin.inertia_ratio(),
                    tosses[i].launch,
                    margin(&tosses[i]).unwrap()
                );
            }
        }
    }
    println!("over 60us: {n}");
    each.sort_by(f64::total_cmp);
    println!("mean of best {}", each.iter().sum::<f64>() / 1e4);
    println!("median {} 90% {} 99% {} max {}", each[5000], each[9000], each[9900], each[9999]);
}
