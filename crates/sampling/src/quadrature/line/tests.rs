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
            density: 10.0,
        };
        Ok(positions.map(point))
    }

    fn marks(&self, position: f64) -> Result<Marks, Error> {
        let mut marks = [0.0; MARKS];
        marks[0] = position / std::f64::consts::PI;
        marks[ROOT] = (position - self.root) / 30.0;
        Ok(marks)
    }

    fn is_plain(&self, from: f64, to: f64) -> Result<bool, Error> {
        Ok(changed(&self.marks(from)?, &self.marks(to)?).is_none())
    }

    fn unproven(&self, _: f64, _: f64) -> Result<f64, Error> {
        Ok(0.0)
    }
}

fn integral(root: f64) -> Integral {
    let limits = Limits { tolerance: 1e-6, most_panels: 1000, most_shares: u64::MAX };
    integrate(&Waves { root }, &Parts { ends: vec![1.0, 30.0], are_roots: false }, limits).unwrap()
}

#[test]
fn a_line_is_divided_at_its_kinks_and_nowhere_else() {
    // 9 kinks and a square root make 11 panels of 15 nodes.
    let found = integral(7.0);
    let waves = |x: f64| {
        let turns = (x / std::f64::consts::PI).floor();
        2.0 * turns + 1.0 - (x - turns * std::f64::consts::PI).cos()
    };
    let expected = waves(30.0) - waves(1.0) + 23_f64.powf(1.5) / 1.5;
    assert!((found.value - expected).abs() < 1e-8 && found.shares == 11 * 15, "{found:?}, not {expected}");
    assert!(found.rule_error < 1e-6);
}

/// 1, but 0 between two places that are closer than any nodes; or a function of which nothing is known.
struct Hidden {
    ends: [f64; 2],
    is_known: bool,
}

impl Integrand for Hidden {
    fn points(&self, positions: [f64; NODES]) -> Result<[Point; NODES], Error> {
        let value = |at: f64| f64::from(u8::from(!(self.ends[0]..=self.ends[1]).contains(&at)));
        Ok(positions.map(|at| Point { value: value(at), errors: [0.0; 2], shares: 1, density: 1.0 }))
    }

    fn marks(&self, position: f64) -> Result<Marks, Error> {
        let mut marks = [0.0; MARKS];
        marks[0] = (position - self.ends[0]) * (position - self.ends[1]);
        Ok(marks)
    }

    fn is_plain(&self, from: f64, to: f64) -> Result<bool, Error> {
        Ok(self.is_known && !self.ends.iter().any(|end| (from..=to).contains(end)))
    }

    fn unproven(&self, _: f64, _: f64) -> Result<f64, Error> {
        Ok(if self.is_known { 0.0 } else { 0.5 })
    }
}

#[test]
fn a_pair_of_kinks_between_all_nodes_is_found_and_what_is_not_proven_is_an_error() {
    let limits = Limits { tolerance: 1e-9, most_panels: 1000, most_shares: 10_000 };
    let parts = Parts { ends: vec![0.0, 1.0], are_roots: false };
    let hidden = Hidden { ends: [0.123_456, 0.123_457], is_known: true };
    let found = integrate(&hidden, &parts, limits).unwrap();
    assert!((found.value - (1.0 - 1e-6)).abs() < 3e-9 && found.rule_error < 1e-8, "{found:?}");
    // Equal samples are no proof, neither of a line that is not plain nor of one face.
    let unknown = integrate(&Hidden { is_known: false, ..hidden }, &parts, limits).unwrap();
    assert!(unknown.rule_error >= 1.5 - 1e-3, "{unknown:?}");
}

#[test]
fn the_number_of_panels_and_of_shares_is_limited() {
    let limits = Limits { tolerance: 0.0, most_panels: 13, most_shares: u64::MAX };
    let parts = Parts { ends: vec![1.0, 30.0], are_roots: false };
    let few_panels = integrate(&Waves { root: 7.0 }, &parts, limits).unwrap();
    // 11 panels at once, of which two are divided.
    assert_eq!(few_panels.shares, 15 * 15);
    let few_shares = integrate(&Waves { root: 7.0 }, &parts, Limits { most_panels: 100, most_shares: 50, ..limits });
    assert_eq!(few_shares.unwrap().shares, 11 * 15);
    assert!(few_panels.rule_error > 0.0);
}
