//! These checks compare the motion of any rigid body with the 256-bit reference.

use dynamics::Toss;
use exact::{ExactMotion, certify};
use rayon::prelude::*;
use toss::{Certificate, Launch, TimeOfFlight};

use crate::measure::bodies::{FAMILIES, Family, LONG, launches};
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::reference::rigid::RigidReference;
use crate::measure::rigid_errors::{Judged, tosses_of_a_family};

pub(super) const COS_TILT: Check = Check {
    id: "rigid-cos-tilt",
    claim: "cos θ at landing of any rigid body differs from the 256-bit reference by at most the bound, for phases \
            from 1 to 1e9 rad.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    unit: "1",
    ceiling: 1e-15,
    measure: |context| Ok(largest(context, COS_TILT.id, |judged| judged.motion.cos_tilt)),
};

pub(super) const COMPENSATED_COS_TILT: Check = Check {
    id: "rigid-compensated-cos-tilt",
    claim: "cos θ at landing of any rigid body by the compensated motion, whose sums are in f64, differs from the \
            256-bit reference by at most the bound, for phases from 1 to 1e9 rad.",
    measure: |context| Ok(largest(context, COMPENSATED_COS_TILT.id, |judged| judged.compensated.cos_tilt)),
    ceiling: 1e-14,
    ..COS_TILT
};

pub(super) const ATTITUDE: Check = Check {
    id: "rigid-attitude",
    claim: "The attitude at landing of any rigid body differs from the 256-bit reference by at most the bound, for \
            phases from 1 to 1e9 rad.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    unit: "rad",
    ceiling: 1e-14,
    measure: |context| Ok(largest(context, ATTITUDE.id, |judged| judged.motion.attitude)),
};

pub(super) const COMPENSATED_ATTITUDE: Check = Check {
    id: "rigid-compensated-attitude",
    claim: "The attitude at landing of any rigid body by the compensated motion, whose sums are in f64, differs from \
            the 256-bit reference by at most the bound, for phases from 1 to 1e9 rad.",
    measure: |context| Ok(largest(context, COMPENSATED_ATTITUDE.id, |judged| judged.compensated.attitude)),
    ..ATTITUDE
};

pub(super) const OUTCOMES: Check = Check {
    id: "rigid-outcomes",
    claim: "The proven outcomes of any rigid body are those of the 256-bit reference within 3 ulp of a time at which \
            the outcome changes. Measured: the number of tosses that differ or are undecided; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    unit: "tosses",
    ceiling: 0.0,
    measure: |context| {
        let measure = |family: &Family| {
            let tosses: Vec<Toss> = launches(family, tosses_of_a_family(context.effort), LONG)
                .filter_map(|toss| at_an_edge(&toss))
                .collect();
            let differs = |toss: &Toss| {
                let outcome = certify(toss).map(Certificate::outcome).ok();
                outcome.is_none() || outcome != RigidReference::new(toss).map(|reference| reference.outcome())
            };
            let found: Vec<bool> = tosses.par_iter().map(differs).collect();
            let first = found.iter().position(|differs| *differs).map(|index| format!("{:?}", tosses[index]));
            let wrong = found.iter().filter(|differs| **differs).count() as f64;
            Measurement::figure(OUTCOMES.id, family.name, wrong, found.len() as u64, first.unwrap_or_default())
        };
        Ok(FAMILIES.iter().map(measure).collect())
    },
};

/// The largest of an error in each family.
fn largest(context: &Context, check: &str, error: fn(&Judged) -> f64) -> Vec<Measurement> {
    let measure = |(family, tosses): &(&Family, Vec<Judged>)| {
        let worst = tosses.iter().max_by(|a, b| error(a).total_cmp(&error(b)));
        let (measured, input) =
            worst.map_or((f64::INFINITY, String::new()), |worst| (error(worst), format!("{:?}", worst.toss)));
        Measurement::figure(check, family.name, measured, tosses.len() as u64, input)
    };
    context.rigid_errors().iter().map(measure).collect()
}

/// The same toss with a time within 3 ulp of one at which the outcome changes, near the time of the toss. `None` if
/// none is found.
pub(super) fn at_an_edge(toss: &Toss) -> Option<Toss> {
    let motion = ExactMotion::new(toss);
    let rate = toss.launch.rate().norm();
    let heads = |time: f64| motion.cos_tilt(time).map(|cos_tilt| cos_tilt > 0.0).ok();
    let start = toss.launch.flight_time();
    let first = heads(start)?;
    let end = (1..100).map(|step| start + f64::from(step) * 0.3 / rate).find(|time| heads(*time) == Some(!first))?;
    let (mut before, mut after) = (start.max(end - 0.3 / rate), end);
    if heads(before)? != first {
        return None;
    }
    while before.next_up() < after {
        let middle = before + 0.5 * (after - before);
        if heads(middle)? == first { before = middle } else { after = middle }
    }
    // By turns 3 ulp before and behind the edge.
    let ulps = (start.to_bits() % 7) as i64 - 3;
    let time = f64::from_bits(after.to_bits().wrapping_add_signed(ulps));
    let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(time)).ok()?;
    Some(Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
}
