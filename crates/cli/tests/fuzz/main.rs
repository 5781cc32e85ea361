//! Runs the program on thousands of command lines and files that are nearly right, or absurd, and checks what has to hold
//! for every input: the exit code is 0, 1 or 2, nothing panics, an answer in JSON is one object, a chart is written whole or
//! not at all, and time and memory are bounded.
//!
//! The cases are the same in every run, and those that are run by default are part of the full number. A case that fails is
//! printed with its number, by which `Case::new` makes it again, with its files. One that ends the whole process, as a failed
//! allocation does, or that never ends stands in the file `tmp/fuzz-case` of the build's folder.
//!
//! ```sh
//! cargo test --release -p unfair-toss --test fuzz -- --include-ignored --nocapture
//! ```
#![cfg(unix)]

mod case;
mod case_run;
mod check;
#[path = "../common/fields.rs"]
mod fields;
#[path = "../common/lines.rs"]
mod lines;

use std::collections::BTreeMap;

use case::Case;
use case_run::run;
use check::violations;

/// Runs `number` cases from the one with the number `first`, and panics with those in which something does not hold.
fn fuzz(first: u64, number: u64) {
    let program = unfair_toss::program();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut failures, mut codes) = (Vec::new(), BTreeMap::<(String, Option<i32>), u64>::new());
    for index in first..first + number {
        let case = Case::new(&program, index);
        let said = format!("case {index}: {:?}", case.arguments.concat());
        std::fs::write(concat!(env!("CARGO_TARGET_TMPDIR"), "/fuzz-case"), &said)
            .expect("the build's folder is writable");
        let ran = run(&case, folder.path());
        *codes.entry((case.command(), ran.code)).or_default() += 1;
        let found = violations(&case, &ran);
        if !found.is_empty() {
            failures.push(format!("{said}\n  {}\n", found.join("\n  ")));
            eprintln!("{}", failures[failures.len() - 1]);
        }
        if failures.len() == 20 {
            break;
        }
    }
    for ((command, code), number) in &codes {
        println!("{command:12} ended {number:6} times with {code:?}");
    }
    assert!(failures.is_empty(), "{} cases, of which the first is {}", failures.len(), failures[0]);
    // Cases that are all refused would show nothing.
    for command in program.get_subcommands().map(|command| command.get_name().to_owned()) {
        let ended = |code| codes.get(&(command.clone(), Some(code))).copied().unwrap_or_default();
        assert!(
            number < 1000 || ended(0) > 0 && ended(2) > 0,
            "{command}: {} answers, {} refusals",
            ended(0),
            ended(2)
        );
    }
}

#[test]
fn generated_input() {
    fuzz(0, 2_000);
}

#[test]
#[ignore = "takes minutes"]
fn more_generated_input() {
    fuzz(2_000, 98_000);
}
