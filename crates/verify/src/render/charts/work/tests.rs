//! Tests of the charts of work against error.

use toss::Registry;

use super::*;
use crate::measure::effort::Effort;
use crate::measure::work_precision::problems::{self, Problem};

/// A sweep of the problem of the paper's cheated toss, whose errors go down to the last bit.
fn sweep() -> Sweep {
    let problems: Vec<Problem> = problems::all().unwrap();
    let cheated: Vec<Problem> = problems.into_iter().filter(|problem| problem.name == "cheated").collect();
    Sweep::new(Registry::standard().entries(), &cheated, Effort::Quick).unwrap()
}

fn numbers(svg: &str, tag: &str, attribute: &str) -> Vec<i32> {
    let value = |line: &str| line.split_once(&format!(" {attribute}=\""))?.1.split('"').next()?.parse().ok();
    svg.lines().filter(|line| line.starts_with(tag)).filter_map(value).collect()
}

#[test]
fn no_point_lies_on_the_frame_and_every_line_has_its_name() {
    let (sweep, registry) = (sweep(), Registry::standard());
    let svg = work_precision(&sweep, ("cheated", 1), "cheated", &Palette::new(registry.entries())).unwrap();
    let half = i32::try_from(SIZE.0 / 2).unwrap();
    let (left, right) = (152, half - i32::try_from(RIGHT).unwrap());
    let discs: Vec<i32> = numbers(&svg, "<circle", "cx").into_iter().map(|x| x % half).collect();
    assert!(discs.len() > 20);
    assert!(discs.iter().all(|x| left + 8 <= *x && *x <= right - 8), "{discs:?}");
    // The squares of the Taylor series, which reach the smallest errors.
    let squares = numbers(&svg, "<rect", "x").into_iter().filter(|x| *x > 0).map(|x| x % half);
    assert!(squares.clone().count() > 3 && squares.clone().all(|x| x + 12 <= right - 2), "{:?}", squares.max());
    for name in sweep.subjects() {
        assert!(svg.lines().any(|line| line.starts_with(&name)), "{name}");
    }
}
