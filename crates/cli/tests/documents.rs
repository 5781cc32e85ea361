//! Runs every command that README.md, docs/paper-audit.md and docs/engraved.md show, and compares its output with the output shown there.
//! So the numbers in these documents cannot become outdated.

use std::process::Command;

const DOCUMENTS: [&str; 3] = [
    include_str!("../../../README.md"),
    include_str!("../../../docs/paper-audit.md"),
    include_str!("../../../docs/engraved.md"),
];
const PREFIX: &str = "$ unfair-toss ";

#[test]
fn the_console_blocks_of_the_documents_show_the_output_of_their_commands() {
    for document in DOCUMENTS {
        let blocks: Vec<&str> =
            document.split("```console\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
        assert!(blocks.len() >= 2);
        for block in blocks {
            let runs = block.strip_prefix(PREFIX).unwrap().split(PREFIX);
            for run in runs {
                let (command, expected) = run.split_once('\n').unwrap();
                assert_eq!(printed(command), expected, "{command}");
            }
        }
    }
}

/// The output of `command` as a terminal shows it; the command may end in `| head -n LINES`.
fn printed(command: &str) -> String {
    let (arguments, lines) = match command.split_once(" | head -n ") {
        Some((arguments, lines)) => (arguments, lines.parse().expect("a number of lines")),
        None => (command, usize::MAX),
    };
    let arguments = arguments.split(' ');
    let output = Command::new(env!("CARGO_BIN_EXE_unfair-toss")).args(arguments).output().expect("the program starts");
    let [answer, error] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("UTF-8"));
    answer.split_inclusive('\n').take(lines).collect::<String>() + &error
}
