//! What the counts of people's flips say.

use sampling::{SameSide, SameSideBias};
use serde::Serialize;
use toss::Error;

/// The answer: the bias of all, and the interval of each person's share.
#[derive(Debug, Serialize)]
pub(crate) struct Counted {
    #[serde(flatten)]
    found: SameSideBias,
    /// The share of all flips.
    share: f64,
    /// ψ of the mean over people (rad).
    cone_angle: Option<f64>,
    each: Vec<[f64; 2]>,
}

/// What the `counts` of people say, each the landings on the side that had been up, and the flips.
pub(crate) fn counted(counts: &[[u64; 2]]) -> Result<Counted, Error> {
    let people: Vec<SameSide> =
        counts.iter().map(|[same, tosses]| SameSide::new(*same, *tosses)).collect::<Result<_, _>>()?;
    let found = SameSideBias::of(&people)?;
    let alone = |person: &SameSide| match SameSideBias::of(&[*person]) {
        Ok(alone) => alone.interval.into(),
        // Without a flip.
        Err(_) => [0.0, 1.0],
    };
    let each = people.iter().map(alone).collect();
    Ok(Counted { share: found.share, cone_angle: found.cone.map(|cone| cone.angle), each, found })
}
