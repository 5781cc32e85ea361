//! What GitHub would read.

use std::sync::Arc;

use super::*;
use crate::judge::Row;
use crate::judge::time::Timing;
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::render::report::Compared;
use crate::render::tests::row;

fn with_report<T>(rows: &[Row], of: impl Fn(&Report) -> T) -> T {
    let context = Arc::new(Context::new(&[], Effort::Quick).unwrap());
    let checks =
        vec![Timing { check: "random-attitude".to_owned(), t_wall_s: 1.0, t_processor_s: None, limit_s: 50.0 }];
    let baseline = Compared { file: "baseline/x86_64/quick.csv".to_owned(), found: true, written: false };
    of(&Report::new(context, rows.to_vec(), checks, baseline, Vec::new(), Vec::new()))
}

#[test]
fn an_annotation_is_one_line_with_the_command_and_everything_escaped() {
    let mut bad = row("random-attitude", "a:b,c", 8.3e-9, 1e-11);
    bad.failure = Some("100 % of\nit".to_owned());
    let text = with_report(&[bad, row("random-attitude", "fine", 0.5, 1.0)], annotations);
    assert_eq!(
        text,
        "::error title=random-attitude / a%3Ab%2Cc::FAIL: 8.3e-9 > 1.0e-11 rad (830 times over)%0A100 %25 of%0Ait%0ARepeat \
         with: fly 'i1=0x1.0p+0' by a:b,c\n"
    );
}

#[test]
fn the_worst_nine_of_many_are_annotated_and_the_rest_is_counted() {
    let rows: Vec<Row> =
        (0..30).map(|index| row("random-attitude", &format!("s{index}"), f64::from(index), 0.5)).collect();
    let text = with_report(&rows, annotations);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 10);
    assert!(lines[0].contains("/ s29::"), "{text}");
    assert!(lines[9].starts_with("::error title=and 20 more::"), "{text}");
}

#[test]
fn a_summary_of_thousands_of_failing_rows_is_below_the_limit_of_one_mebibyte() {
    let long = "x".repeat(300);
    let rows: Vec<Row> = (0..5000).map(|index| row("random-attitude", &format!("{long}{index}"), 2.0, 1.0)).collect();
    assert!(with_report(&rows, summary).len() < 1 << 20);
}
