//! Columns of tosses: a header of the moments, the tilt and gravity, and rows of ωx, ωy, ωz and the speed.

use toss::{Attitude, Batch, Certificate, Coin, ExactSolver, Outcome, SimdLevel, Solver, Toss, Tosses, certify};

/// The most tosses of an input.
const MOST: usize = 256;

/// The columns are solved with the same bits at every SIMD level. Each toss of them has the proven outcome, cos θ and
/// attitude that it has alone, or the batch names the first one that has none.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let numbers: Vec<f64> = data.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let Some((&[i1, ratio, tilt, gravity], rest)) = numbers.split_first_chunk() else { return };
    let Ok(coin) = Coin::from_moments(i1, ratio * i1).map_err(|error| crate::assert_said(&error)) else { return };
    if !tilt.is_finite() {
        return;
    }
    let rows = &rest.as_chunks::<4>().0[..(rest.len() / 4).min(MOST)];
    let [x, y, z, speeds] = [0, 1, 2, 3].map(|of| rows.iter().map(|row| row[of]).collect::<Vec<f64>>());
    let attitude = Attitude::about_x(tilt);
    let tosses = match Tosses::new(coin, attitude, gravity, [&x, &y, &z], &speeds) {
        Ok(tosses) => tosses,
        Err(error) => return crate::assert_said(&error),
    };
    let levels: Vec<Solved> = SimdLevel::all().into_iter().map(|level| solved(tosses, level)).collect();
    for level in &levels[1..] {
        assert!(level.has_the_bits_of(&levels[0]), "{level:?} is not {:?}", levels[0]);
    }
    check_alone(&tosses, &levels[0]);
}

/// The answers of a batch; `Err` has the message, which names the first toss that has none.
#[derive(Debug)]
struct Solved {
    cos_tilts: Result<Vec<f64>, String>,
    attitudes: Result<[Vec<f64>; 4], String>,
    outcomes: Result<Vec<Outcome>, String>,
    counted: Result<[u64; 3], String>,
}

fn solved(tosses: Tosses<'_>, level: SimdLevel) -> Solved {
    let (batch, number) = (Batch::new(tosses).on(level), tosses.len());
    let mut cos_tilts = vec![0.0; number];
    let mut parts = [(); 4].map(|()| vec![0.0; number]);
    let mut outcomes = vec![Outcome::Undecided; number];
    Solved {
        cos_tilts: batch.cos_tilts(&mut cos_tilts).map(|()| cos_tilts).map_err(|error| error.to_string()),
        attitudes: {
            let [w, x, y, z] = &mut parts;
            let done = batch.attitudes([w, x, y, z]);
            done.map(|()| parts).map_err(|error| error.to_string())
        },
        outcomes: batch.outcomes(&mut outcomes).map(|()| outcomes).map_err(|error| error.to_string()),
        counted: batch
            .count()
            .map(|counts| [counts.heads, counts.tails, counts.undecided])
            .map_err(|error| error.to_string()),
    }
}

impl Solved {
    fn has_the_bits_of(&self, other: &Self) -> bool {
        fn bits(column: &[f64]) -> Vec<u64> {
            column.iter().map(|number| number.to_bits()).collect()
        }
        let of_attitudes =
            |solved: &Self| solved.attitudes.clone().map(|parts| parts.each_ref().map(|column| bits(column)));
        self.cos_tilts.as_deref().map(bits) == other.cos_tilts.as_deref().map(bits)
            && of_attitudes(self) == of_attitudes(other)
            && self.outcomes == other.outcomes
            && self.counted == other.counted
    }
}

/// Compares the answers with those of each toss alone.
fn check_alone(tosses: &Tosses<'_>, batch: &Solved) {
    let alone: Vec<Option<Toss>> = (0..tosses.len()).map(|index| tosses.toss(index).ok()).collect();
    let mut expected = [0_u64; 3];
    for (index, toss) in alone.iter().enumerate() {
        let proven = toss.as_ref().and_then(|toss| certify(toss).ok()).map(Certificate::outcome);
        let Some(outcome) = proven else {
            let named = format!("launch {index}");
            for error in [batch.outcomes.as_ref().err(), batch.counted.as_ref().err(), batch.cos_tilts.as_ref().err()] {
                let error = error.unwrap_or_else(|| panic!("{named} has no outcome, and the batch has"));
                assert!(error.starts_with(&named), "{error} instead of {named}");
            }
            return;
        };
        let toss = toss.as_ref().expect("it has an outcome");
        if let Ok(outcomes) = &batch.outcomes {
            assert_eq!(outcomes[index], outcome, "{toss:?}");
        }
        expected[outcome as usize] += 1;
        check_landing(toss, index, batch);
    }
    let counted = batch.counted.as_ref().expect("every toss has an outcome");
    let [heads, tails, undecided] =
        [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(|of| expected[of as usize]);
    assert_eq!(*counted, [heads, tails, undecided]);
    assert!(batch.outcomes.is_ok() && batch.cos_tilts.is_ok() && batch.attitudes.is_ok(), "{batch:?}");
}

/// cos θ and the attitude of a batch are those of the toss to some roundings.
fn check_landing(toss: &Toss, index: usize, batch: &Solved) {
    const ROUNDINGS: f64 = 4e-15;
    let exact = ExactSolver.land(toss).expect("a toss with an outcome lands");
    if let Ok(cos_tilts) = &batch.cos_tilts {
        let found = cos_tilts[index];
        assert!((-1.0..=1.0).contains(&found), "{toss:?}: {found}");
        assert!((found - exact.cos_tilt).abs() <= ROUNDINGS, "{toss:?}: {found}, not {}", exact.cos_tilt);
    }
    if let Ok(parts) = &batch.attitudes {
        let found = Attitude::from_components(parts.each_ref().map(|part| part[index])).expect("a unit quaternion");
        let off = found.angle_to(&exact.state.attitude);
        assert!(off <= 4.0 * ROUNDINGS, "{toss:?}: off by {off} rad");
    }
}
