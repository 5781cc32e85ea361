use super::*;

/// |sin x| with its kinks, which the mark counts, and beyond `root` a square root.
struct Waves {
    root: f64,
}

impl Integrand for Waves {
    fn points(&self, positions: [f64; NODES]) -> Result<[Point; NODES], Error> {
        let point = |at: f64| Point {
            value: at.sin().abs() + (at - self.root).max(0.0).sqrt(),
            errors: [0.0; 2],
            shares: 1,
            marks: self.marks(at).unwrap(),
        };
        Ok(positions.map(point))
    }

    fn marks(&self, position: f64) -> Result<Marks, Error> {
        let mut marks = [0.0; MARKS];
        marks[0] = position / std::f64::consts::PI;
        marks[ROOT] = position - self.root;
        Ok(marks)
    }
}

fn integral(root: f64, divides_at_kinks: bool) -> Integral {
    let limits = Limits { tolerance: 1e-6, divides_at_kinks, most_panels: 1000, most_shares: u64::MAX };
    integrate(&Waves { root }, &Parts { ends: vec![1.0, 30.0], are_roots: false }, limits).unwrap()
}

#[test]
fn a_line_is_divided_at_its_kinks_and_nowhere_else() {
    // 9 kinks and a square root make 11 panels, which are divided further into 20, after 38 panels of 15 nodes.
    let found = integral(7.0, true);
    let waves = |x: f64| {
        let turns = (x / std::f64::consts::PI).floor();
        2.0 * turns + 1.0 - (x - turns * std::f64::consts::PI).cos()
    };
    let expected = waves(30.0) - waves(1.0) + 23_f64.powf(1.5) / 1.5;
    assert!((found.value - expected).abs() < 1e-8 && found.shares == 38 * 15, "{found:?}, not {expected}");
    assert!(found.rule_error < 1e-6);
}

#[test]
fn kinks_that_are_met_later_are_divided_at_too() {
    let (at_once, later) = (integral(7.0, true), integral(7.0, false));
    assert!((at_once.value - later.value).abs() < 1e-7, "{at_once:?} {later:?}");
    assert!(later.shares > at_once.shares && later.shares < 80 * 15, "{later:?}");
}

#[test]
fn the_number_of_panels_and_of_shares_is_limited() {
    let limits = Limits { tolerance: 0.0, divides_at_kinks: false, most_panels: 5, most_shares: u64::MAX };
    let parts = Parts { ends: vec![1.0, 30.0], are_roots: false };
    let few_panels = integrate(&Waves { root: 7.0 }, &parts, limits).unwrap();
    assert_eq!(few_panels.shares, 9 * 15);
    let few_shares = integrate(&Waves { root: 7.0 }, &parts, Limits { most_panels: 100, most_shares: 50, ..limits });
    assert_eq!(few_shares.unwrap().shares, 75);
    assert!(few_panels.rule_error > 1e-6);
}
