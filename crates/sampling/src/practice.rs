//! Whether people change as they flip on: the later half of each person's flips against the earlier one.
//!
//! With the shares of person i differing by d_i, later less earlier, and n_i flips that count as w_i, at most twice the median,
//! the change is Σ w_i d_i / Σ w_i. Its interval is Student's, with the standard error √(k/(k - 1) Σ w_i² (d_i - change)²) /
//! Σ w_i, and the p-value that of Student's test of the w_i d_i against 0; both hold however the variances of people differ.
//! For one person, and where all changes are equal, the standard error is that of binomial shares.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::estimate::LEVEL;
use crate::interval::Interval;
use crate::people_file::Named;
use crate::same_side::SameSide;

/// How much the share of same-side landings changes from the earlier half of each person's flips to the later.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Practice {
    /// The mean change over people.
    pub change: f64,
    /// Its interval, at the confidence [`LEVEL`].
    pub interval: Interval,
    /// Probability of a change as large or larger if nobody changes.
    pub p_value: f64,
}

/// A person's change.
struct Change {
    difference: f64,
    flips: f64,
    /// The variance of the difference if every flip had the share of all.
    variance: f64,
}

impl Practice {
    /// The change of `people`; `None` if not all of their flips are known in order, if nobody has two, or if all landings are
    /// the same.
    pub fn of(people: &[Named]) -> Option<Self> {
        let halves = people.iter().map(|person| {
            let (earlier, later) = person.landings.as_ref()?.split_at(person.landings.as_ref()?.len() / 2);
            Some([SameSide::of_landings(earlier), SameSide::of_landings(later)])
        });
        Self::of_halves(&halves.collect::<Option<Vec<_>>>()?)
    }

    #[expect(clippy::cast_precision_loss, reason = "nobody tosses 2^53 coins")]
    fn of_halves(halves: &[[SameSide; 2]]) -> Option<Self> {
        let present = halves.iter().filter(|[earlier, _]| earlier.tosses() > 0);
        let present: Vec<&[SameSide; 2]> = present.collect();
        let all = SameSide::sum(present.iter().copied().flatten().copied()).ok().filter(|all| all.tosses() > 0)?;
        let (share, number) = (all.share(), present.len() as f64);
        let change = |[earlier, later]: &[SameSide; 2]| {
            let [before, after] = [earlier, later].map(|half| half.tosses() as f64);
            let variance = share * (1.0 - share) * (1.0 / before + 1.0 / after);
            Change { difference: later.share() - earlier.share(), flips: before + after, variance }
        };
        let changes: Vec<Change> = present.into_iter().map(change).collect();
        let mut flips: Vec<f64> = changes.iter().map(|change| change.flips).collect();
        flips.sort_unstable_by(f64::total_cmp);
        let cap = flips[(flips.len() - 1) / 2] + flips[flips.len() / 2];
        let weighted: Vec<(f64, &Change)> = changes.iter().map(|change| (change.flips.min(cap), change)).collect();
        let sum = |of: &dyn Fn(f64, &Change) -> f64| weighted.iter().map(|(w, change)| of(*w, change)).sum::<f64>();
        let weight = sum(&|w, _| w);
        let mean = sum(&|w, change| w * change.difference) / weight;
        let scatter = sum(&|w, change| (w * (change.difference - mean)).powi(2));
        let student = (number > 1.0).then(|| StudentsT::new(0.0, 1.0, number - 1.0).ok()).flatten();
        let normal = Normal::new(0.0, 1.0).ok()?;
        let quantile =
            |part: f64| student.map_or_else(|| normal.inverse_cdf(part), |student| student.inverse_cdf(part));
        let beyond = |t: f64| 2.0 * student.map_or_else(|| normal.sf(t), |student| student.sf(t));
        let (error, t) = if student.is_some() && scatter > 1e-20 * weight * weight {
            let squares = sum(&|w, change| (w * change.difference - weight * mean / number).powi(2));
            let t = weight * mean / (number * squares / (number - 1.0)).sqrt();
            ((number / (number - 1.0) * scatter).sqrt() / weight, t)
        } else {
            let error = sum(&|w, change| w * w * change.variance).sqrt() / weight;
            (error, mean / error)
        };
        let half = quantile(0.5 * (1.0 + LEVEL)) * error;
        let interval = Interval { lo: (mean - half).max(-1.0), hi: (mean + half).min(1.0) };
        (error > 0.0).then(|| Self { change: mean, interval, p_value: beyond(t.abs()).min(1.0) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::people_file::people;

    fn halves(of: &[[u64; 4]]) -> Option<Practice> {
        let half = |same, tosses| SameSide::new(same, tosses).unwrap();
        Practice::of_halves(&of.iter().map(|[x, n, y, m]| [half(*x, *n), half(*y, *m)]).collect::<Vec<_>>())
    }

    fn is_close(found: Option<Practice>, [change, lo, hi, p_value]: [f64; 4]) -> bool {
        let Some(found) = found else { return false };
        let numbers = [found.change, found.interval.lo, found.interval.hi, found.p_value];
        numbers.into_iter().zip([change, lo, hi, p_value]).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    /// Five people by SciPy, and one by the normal distribution of two shares.
    #[test]
    fn the_change_is_that_of_the_reference() {
        let class = [[60, 100, 52, 100], [31, 50, 26, 50], [210, 400, 204, 400], [15, 25, 12, 25], [88, 150, 80, 150]];
        let expected = [-0.051_428_571_4, -0.100_955_305_5, -0.001_901_837_3, 0.008_580_918_7];
        assert!(is_close(halves(&class), expected), "{:?}", halves(&class));
        let one = halves(&[[60, 100, 45, 100]]);
        assert!(is_close(one, [-0.15, -0.288_417_0, -0.011_583_0, 0.033_672_1]), "{one:?}");
        // People who change alike by chance are no proof of it.
        let alike = halves(&[[5, 10, 6, 10], [10, 20, 12, 20]]).unwrap();
        assert!(alike.interval.lo < -0.5 && alike.p_value > 0.05, "{alike:?}");
        assert_eq!(halves(&[[10, 10, 11, 11]]), None);
    }

    #[test]
    fn halves_follow_the_order_of_a_persons_rows() {
        let of = |text: &str| Practice::of(&people(text.as_bytes()).unwrap());
        // Ada: same, same, other | same, other, other, other; the middle flip of 7 is of the later half.
        let ada = of("person,start,lands,rule\nAda,H,HHT,fixed\nAda,H,HTTT,fixed\n").unwrap();
        assert!((ada.change - (0.25 - 2.0 / 3.0)).abs() < 1e-15, "{ada:?}");
        assert_eq!(of("person,same,tosses\nAda,3,7\n"), None);
        assert_eq!(of("start,lands\nH,T\n"), None);
    }
}
