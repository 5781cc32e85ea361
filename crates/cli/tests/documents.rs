//! The README's commands print what it says they print.

use std::process::Command;

const README: &str = include_str!("../../../README.md");
const PREFIX: &str = "$ cargo run -q --release --bin unfair-toss -- ";

#[test]
fn console_blocks_are_current() {
    let blocks: Vec<&str> =
        README.split("```console\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    assert!(blocks.len() >= 2);
    for block in blocks {
        let (command, expected) = block.split_once('\n').unwrap();
        let arguments = command.strip_prefix(PREFIX).unwrap().split(' ');
        let output = Command::new(env!("CARGO_BIN_EXE_unfair-toss")).args(arguments).output().unwrap();
        assert_eq!(String::from_utf8(output.stdout).unwrap(), expected, "{command}");
    }
}
