//! What helps at the shell: help texts with their examples, completions and manual pages, and the other names of options.

use crate::common::{run, stderr, stdout};
use toss::Registry;

/// The commands in the order in which the help text lists them.
const COMMANDS: &str = "toss trace probability sample compare spread convergence \
     errors map merge intervals inverse power limit plan coins solvers models spaces completions man";

#[test]
fn the_example_of_every_help_text_runs() {
    // The parts that the example of `merge` names.
    let folder = tempfile::tempdir().unwrap();
    for part in 1..=2 {
        let path = folder.path().join(format!("part-{part}.json"));
        let output =
            run(&format!("probability --space paper-fig4 --method random --shard {part}/2 --out {}", path.display()));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    for command in COMMANDS.split(' ') {
        let help = stdout(&run(&format!("{command} --help")));
        let (_, after) = help.split_once("\nExample:\n  unfair-toss ").unwrap_or_else(|| panic!("{command}: {help}"));
        let example = after.lines().next().unwrap();
        assert!(example.starts_with(command), "{example}");
        let output = run(&example.replace("part-", &format!("{}/part-", folder.path().display())));
        assert_eq!(output.status.code(), Some(0), "{example}: {}", stderr(&output));
        assert!(!output.stdout.is_empty(), "{example}");
    }
    let listed = stdout(&run("--help"));
    let listed =
        listed.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next()).filter(|name| !name.is_empty());
    let listed: Vec<&str> = listed.filter(|name| !name.starts_with('-') && *name != "help").collect();
    assert_eq!(listed.join(" "), COMMANDS);
}

#[test]
fn help_groups_its_options_and_shows_what_is_required() {
    for command in COMMANDS.split(' ') {
        let help = stdout(&run(&format!("{command} --help")));
        let options =
            help.split_once("\nOptions:\n").map_or("", |(_, rest)| rest.split("\n\n").next().unwrap_or_default());
        let ungrouped: Vec<&str> = options.lines().filter(|line| line.trim_start().starts_with("--")).collect();
        assert!(ungrouped.is_empty(), "{command}: {ungrouped:?}");
    }
    let toss = stdout(&run("toss --help"));
    for words in ["\nCoin (", "\nLaunch (", "\nSolver:", "\nOutput:", "Heads: ", "towards -y", "15deg"] {
        assert_eq!(toss.matches(words).count(), 1, "{words}");
    }
    assert!(toss.contains("Usage: unfair-toss toss (--rate WX,WY,WZ | --turn RATE --psi PSI) (--speed V0 | --time T)"));
    // Every column that a table of data has is explained.
    for (command, run_of_it) in [
        ("trace", "trace --rate 1,1,1 --speed 3 --points 2"),
        ("sample", "sample --space tails --points 1"),
        ("convergence", "convergence --space tails --steps 1"),
        ("errors", "errors --space paper-fig4 --up-to 8 --replicates 1"),
        ("limit", "limit --points 1"),
    ] {
        let help = stdout(&run(&format!("{command} --help"))).split_whitespace().collect::<Vec<_>>().join(" ");
        let (_, columns) = help.split_once("Columns: ").unwrap_or_else(|| panic!("{command}"));
        let csv = stdout(&run(run_of_it));
        for column in csv.lines().next().unwrap().split(',').filter(|column| !column.ends_with("_y")) {
            assert!(columns.contains(column), "{command}: {column}");
        }
    }
}

#[test]
fn completions_and_manual_pages_name_the_options() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = stdout(&run(&format!("completions {shell}")));
        assert!(script.contains("psi") && script.contains("spread"), "{shell}");
    }
    assert!(stdout(&run("man")).contains(".TH unfair-toss 1"));
    let page = stdout(&run("man toss"));
    assert!(page.contains("psi") && page.contains("Heads: "), "{page}");
    for (arguments, words) in [
        ("man dance", ["command = 'dance'", "toss, trace"]),
        ("completions tcsh", ["invalid value 'tcsh'", "bash"]),
        ("completions", ["SHELL", "required"]),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(words.iter().all(|word| stderr(&output).contains(word)), "{}", stderr(&output));
    }
}

/// What bash offers for the last word of a command line, by the script.
#[cfg(unix)]
fn offered(script: &std::path::Path, line: &str) -> Vec<String> {
    const ASK: &str = r#"
        source "$1"; shift
        [[ $(complete -p unfair-toss) =~ -F\ ([^ ]+) ]]
        COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
        "${BASH_REMATCH[1]}" unfair-toss "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}" 2>/dev/null
        printf '%s\n' "${COMPREPLY[@]}""#;
    let mut bash = std::process::Command::new("bash");
    bash.args(["--norc", "-c", ASK, "bash"]).arg(script).arg("unfair-toss").args(line.split(' '));
    stdout(&bash.output().expect("bash starts")).lines().map(str::to_owned).collect()
}

#[test]
#[cfg(unix)]
fn bash_completes_options_and_their_values() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("unfair-toss.bash");
    std::fs::write(&script, run("completions bash").stdout).unwrap();
    for (line, expected) in [
        ("pro", "probability"),
        ("toss --tur", "--turn"),
        ("toss --rate 1,2,3 --ps", "--psi"),
        ("toss --coin us-q", "us-quarter us-quarter-engraved"),
        ("toss --coin = us-q", "us-quarter us-quarter-engraved"),
        ("probability --space pap", "paper-fig4"),
        ("toss --solver q", "quaternion"),
        ("plan --solver e", "euler"),
        ("toss --solver quaternion --scheme dop", "dop853 dopri5"),
        ("compare --formulation a", "all"),
        ("toss --format j", "json"),
        ("trace --format c", "csv"),
        ("probability --method exact", "exact-speed"),
        ("map --across rate_", "rate_x rate_y rate_z"),
        ("plan --want att", "attitude"),
        ("man pro", "probability"),
        ("help pro", "probability"),
        ("completions z", "zsh"),
    ] {
        assert_eq!(offered(&script, line).join(" "), expected, "{line}");
    }
    // A number is no file.
    assert_eq!(offered(&script, "toss --rate "), [""]);
}

#[test]
fn manual_pages_keep_units_and_name_no_page_that_does_not_exist() {
    let pages = COMMANDS.split(' ').map(|command| (command, stdout(&run(&format!("man {command}")))));
    for (command, page) in pages {
        let headings: Vec<&str> = page.lines().filter_map(|line| line.strip_prefix(".SH ")).collect();
        assert_eq!(headings[..3], ["NAME", "SYNOPSIS", "DESCRIPTION"], "{command}");
        assert!(headings.ends_with(&["EXAMPLES"]) && !headings.contains(&"EXTRA"), "{command}: {headings:?}");
        for heading in headings {
            assert!(heading.chars().all(|letter| letter.is_ascii_uppercase() || " \"".contains(letter)), "{heading}");
        }
        assert!(page.contains(&format!("unfair\\-toss {command}")), "{command}");
    }
    let toss = stdout(&run("man toss"));
    for words in
        [".SH UNITS", "2.4m/s", "1.7g·cm²", ".SH OUTPUT\n.PP\nHeads: ", "\\-\\-coin us\\-quarter \\-\\-turn 38rev/s"]
    {
        assert!(toss.contains(words), "{words}: {toss}");
    }
    let whole = stdout(&run("man"));
    let named = whole.lines().filter_map(|line| line.strip_prefix("unfair\\-toss\\-")?.strip_suffix("(1)"));
    assert_eq!(named.collect::<Vec<_>>().join(" "), COMMANDS);
    assert!(stderr(&run("man help")).contains("command = 'help' is unknown"));
}

#[test]
fn help_names_every_solver_and_scheme_of_the_registry() {
    let help = stdout(&run("toss --help"));
    for entry in Registry::standard().entries() {
        assert!(help.contains(entry.name()), "{}", entry.name());
        assert!(entry.schemes().iter().all(|scheme| help.contains(scheme.name())), "{:?}", entry.schemes());
    }
    for words in
        ["Step of rk4", "momentum (no flight is singular)", "raw (as the paper prints it: an answer may be wrong"]
    {
        assert!(help.contains(words), "{words}");
    }
}
