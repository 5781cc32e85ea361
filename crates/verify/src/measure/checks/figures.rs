//! These checks compare probabilities of heads by the method `exact-speed`, which integrates over the speed in closed
//! form, with reference numbers of many digits. They test the probabilities themselves, where a sampled estimate would
//! hide small errors in its noise.
//!
//! ψ is the cone angle between the coin's normal and its angular momentum S, k = I3/I1 the inertia ratio, and p(ψ) the
//! probability of heads of long flights.

use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::{Coordinate, Found, Plan, Rest, Sampler, Scrambled, Space, long_flight_probability};
use toss::Coin;

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::measurement::Measurement;

pub(super) const SHARES: Check = Check {
    id: "exact-speed-share",
    claim: "With all inputs but the speed fixed, P(heads) by exact-speed differs from the reference numbers by at \
            most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-9,
    unit: "1",
    measure: |context| worst_share(context, SHARES.id, |error, _| error),
};

pub(super) const SHARE_BOUNDS: Check = Check {
    id: "exact-speed-error-bound",
    claim: "With all inputs but the speed fixed, the error of P(heads) by exact-speed is within the error bound that \
            the method states. Measured: the largest error divided by that error bound; it fails above the bound of \
            this check.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: |context| worst_share(context, SHARE_BOUNDS.id, |error, bound| error / bound),
};

pub(super) const ISOTROPIC: Check = Check {
    id: "isotropic-long-flights",
    claim: "The mean of the long-flight probability p(ψ) over all directions of the angular momentum differs from \
            1/√2, and over all directions of the body rate from the reference number, by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-6,
    unit: "1",
    measure: isotropic,
};

pub(super) const FIGURES: Check = Check {
    id: "probability-figures",
    claim: "P(heads) by exact-speed with Sobol points differs from the reference numbers by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-3,
    unit: "1",
    measure: figures,
};

fn worst_share(context: &Context, check: &str, measure: fn(f64, f64) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let mut worst = (f64::NEG_INFINITY, String::new());
    for reference in &context.reference_probabilities.shares {
        let found = Sampler::exact().estimate(&reference.space, Plan::ExactSpeed(Rest::Grid))?;
        let Found::Shares { rounding_error } = found.found else {
            anyhow::bail!("exact-speed gave counts instead of a share")
        };
        let measured = measure((found.probability - reference.probability).abs(), rounding_error);
        if measured > worst.0 {
            worst = (measured, reference.name.clone());
        }
    }
    let cases = context.reference_probabilities.shares.len() as u64;
    Ok(vec![Measurement::figure(check, "exact", worst.0, cases, worst.1)])
}

/// Compares means of p(ψ) over isotropic directions with the reference, by the midpoint rule. Directions that are
/// uniform on the sphere have a uniform cosine of the polar angle, and both hemispheres have the same mean, so one
/// is enough. The polar angle of S is ψ; that of ω gives tan ψ = tan(polar)/k.
fn isotropic(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    const PARTS: u32 = 1_000_000;
    let mean = |k: f64| {
        let probability = |part: u32| {
            let cosine = (f64::from(part) + 0.5) / f64::from(PARTS);
            let cone = (1.0 - cosine * cosine).sqrt().atan2(k * cosine);
            long_flight_probability(cone, cone)
        };
        (0..PARTS).map(probability).sum::<f64>() / f64::from(PARTS)
    };
    [
        ("isotropic angular momentum", 1.0),
        ("isotropic rate, k = 0.5", 0.5),
        ("isotropic rate, k = 1.0", 1.0),
        ("isotropic rate, k = 1.98", 1.98),
        ("isotropic rate, k = 2.0", 2.0),
    ]
    .into_iter()
    .map(|(name, k)| {
        let (found, figure) = (mean(k), context.reference_probabilities.figure(name)?);
        let input = format!("{found:.9} for {figure:.9}");
        Ok(Measurement::figure(ISOTROPIC.id, name, (found - figure).abs(), u64::from(PARTS), input))
    })
    .collect()
}

/// The name of a reference probability, and the space of launches that it belongs to.
pub(super) struct Figure {
    pub(super) name: &'static str,
    coin: Coin,
    axes: [(Coordinate, String); 4],
}

impl Figure {
    pub(super) fn space(&self) -> anyhow::Result<Space> {
        let texts: Vec<_> = self.axes.iter().map(|(of, text)| (*of, text.as_str())).collect();
        Ok(Space::parse(self.coin, &texts)?)
    }
}

/// All reference probabilities with their spaces.
pub(super) fn all() -> anyhow::Result<Vec<Figure>> {
    Ok(known()?.into_iter().chain(finite_flights()?).collect())
}

/// Range of speeds (m/s) whose flights last some 10^8 turns, so the long-flight limit holds.
const LONG: &str = "0:1e9";

fn known() -> anyhow::Result<Vec<Figure>> {
    let coin = |k: f64| Coin::from_moments(1.0, k);
    // Three independent normal components of equal deviation have an isotropic direction. S = (I1 ωx, I1 ωy, I3 ωz), so
    // with k = 0.5 an isotropic S needs twice the deviation in ωz.
    let isotropic = |deviation_z: f64| {
        let [x, z] = [1.0, deviation_z].map(|deviation| format!("normal:0:{deviation}"));
        [(RateX, x.clone()), (RateY, x), (RateZ, z), (Speed, LONG.to_owned())]
    };
    let turns = |number: f64| number * std::f64::consts::TAU;
    Ok(vec![
        Figure { name: "isotropic angular momentum", coin: coin(0.5)?, axes: isotropic(2.0) },
        Figure { name: "isotropic rate, k = 0.5", coin: coin(0.5)?, axes: isotropic(1.0) },
        Figure { name: "isotropic rate, k = 1.0", coin: coin(1.0)?, axes: isotropic(1.0) },
        Figure { name: "isotropic rate, k = 1.98", coin: coin(1.98)?, axes: isotropic(1.0) },
        Figure { name: "isotropic rate, k = 2.0", coin: coin(2.0)?, axes: isotropic(1.0) },
        // J. B. Keller, Am. Math. Mon. 93 (1986), 191: no spin, 36 to 40 turns a second.
        Figure {
            name: "Keller's box",
            coin: Coin::DISC,
            axes: axes(format!("{}:{}", turns(36.0), turns(40.0)), "0", "0", "2.1:2.7"),
        },
        Figure {
            name: "box of four coordinates",
            coin: Coin::PAPER,
            axes: axes("1:60".to_owned(), "1:60", "1:60", "3:5"),
        },
    ])
}

/// Flights too short for the long-flight limit, with precession rates ωL from 2 to 20 rad/s.
fn finite_flights() -> anyhow::Result<Vec<Figure>> {
    let figure = |(name, degrees): (&'static str, f64)| {
        // ψ is fixed by k ωz/ωx = cot ψ, here with ωz = ωx; then ωx = ωL sin ψ.
        let cone = degrees.to_radians();
        let (x, cot) = (format!("{}:{}", 2.0 * cone.sin(), 20.0 * cone.sin()), cone.cos() / cone.sin());
        let z = if degrees == 90.0 { "0" } else { "x" };
        Ok(Figure { name, coin: Coin::from_moments(1.0, cot)?, axes: axes(x, "0", z, "3:5") })
    };
    let flights = [
        ("finite flights, 60 degrees", 60.0),
        ("finite flights, 75 degrees", 75.0),
        ("finite flights, 90 degrees", 90.0),
    ];
    flights.into_iter().map(figure).collect()
}

fn axes(x: String, y: &str, z: &str, speed: &str) -> [(Coordinate, String); 4] {
    [(RateX, x), (RateY, y.to_owned()), (RateZ, z.to_owned()), (Speed, speed.to_owned())]
}

fn figures(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let points = match context.effort {
        Effort::Quick => 1 << 19,
        Effort::Standard | Effort::Deep => 1 << 22,
    };
    let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, 1)));
    all()?
        .into_iter()
        .map(|of| {
            let (name, found) = (of.name, Sampler::exact().estimate(&of.space()?, plan)?);
            let figure = context.reference_probabilities.figure(name)?;
            let interval = found.interval.map_or(String::new(), |i| format!(", {:.8} to {:.8}", i.lo, i.hi));
            let input = format!("{:.8} for {figure:.8}{interval}", found.probability);
            Ok(Measurement::figure(FIGURES.id, name, (found.probability - figure).abs(), points, input))
        })
        .collect()
}
