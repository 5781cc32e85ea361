//! Where answers go: standard output that is full, closed or a chart's, and files that cannot be written.
//!
//! A full device is only ever inherited as an open stream, and every path is in a temporary folder: a program that replaced
//! what it should write through could not harm the machine, whoever runs the test.

use std::fs::{self, OpenOptions};
use std::io::BufRead;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::common::{json, run, stderr, stdout};

const MAP: &str = "map --rate-x 0:9:3 --rate-y 0 --rate-z 1:9:3 --speed 3:5";

fn full() -> Stdio {
    OpenOptions::new().write(true).open("/dev/full").expect("a full device").into()
}

fn program(arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_unfair-toss"));
    command.args(arguments.split_whitespace());
    command
}

fn drawn(path: &Path) -> Output {
    run(&format!("{MAP} --svg {}", path.display()))
}

/// The whole flight takes minutes.
#[test]
fn a_trace_is_printed_as_it_is_computed_and_ends_when_its_reader_has_gone() {
    let trace = "trace --rate 2000,500,3000 --time 10 --solver quaternion --prove --points 1000000";
    let mut running = program(trace).stdout(Stdio::piped()).spawn().unwrap();
    let mut lines = std::io::BufReader::new(running.stdout.take().unwrap()).lines();
    assert!(lines.next().unwrap().unwrap().ends_with("cos_tilt,error_bound,attitude_error_bound"));
    assert!(lines.next().unwrap().unwrap().starts_with("0.0,1.0,"));
    drop(lines);
    assert_eq!(running.wait().unwrap().code(), Some(0));
}

/// A singular point comes after the launch.
#[test]
fn the_points_before_an_error_are_printed_before_it() {
    let trace = "trace --rate 1,0,0 --tilt 1 --time 9 --points 6 --solver euler --formulation vertical";
    let output = run(trace);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    let lines = stdout(&output).lines().count();
    assert!(lines > 1 && stderr(&output).starts_with("error: "), "{}", stdout(&output));
    // One object has the same points, and the error.
    let answer = json(trace, 1);
    assert_eq!(
        (answer["points"].as_array().map(Vec::len), &answer["error"]["kind"]),
        (Some(lines - 1), &"singular".into())
    );
}

#[test]
fn a_full_standard_output_is_an_error() {
    for arguments in
        ["--help", "--version", "toss --help", "coins", "toss --rate 1,1,2 --speed 3", &format!("{MAP} --svg -")]
    {
        let output = program(arguments).stdout(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments}");
        assert!(
            stderr(&output).starts_with("error: cannot write standard output: "),
            "{arguments}: {}",
            stderr(&output)
        );
    }
}

#[test]
fn an_error_that_cannot_be_told_keeps_its_code() {
    for (arguments, code) in
        [("toss --rate 1,1 --speed 3", 2), ("toss --nonsense", 2), ("toss --rate 1,1,1e300 --time 1", 1)]
    {
        let output = program(arguments).stderr(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments}");
        let output = program(&format!("{arguments} --format json")).stdout(full()).stderr(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments}");
    }
}

#[test]
fn a_reader_that_closes_the_pipe_is_no_failure() {
    let (chart, rows) = (format!("{MAP} --svg -"), "sample --space paper-fig4 --points 1e9");
    for arguments in ["--help", &chart, "trace --rate 9,4,3 --speed 4 --points 20000", rows] {
        let mut child = program(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()), "{arguments}");
    }
}

#[test]
fn a_chart_for_standard_output_stands_there_alone() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("chart.svg");
    assert!(stdout(&drawn(&file)).starts_with("rate_x,"));
    let output = program(&format!("{MAP} --svg -")).current_dir(folder.path()).output().unwrap();
    assert_eq!(stdout(&output).trim_end(), fs::read_to_string(&file).unwrap().trim_end());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no file is called -");
    // The file that standard output leads to is not replaced under it.
    let printed = folder.path().join("printed");
    let open = OpenOptions::new().write(true).create_new(true).open(&printed).unwrap();
    let status = program(&format!("{MAP} --svg {}", printed.display())).stdout(open).status().unwrap();
    assert!(status.success());
    assert_eq!(fs::read(&printed).unwrap(), output.stdout);
    for format in ["csv", "json"] {
        let output = run(&format!("{MAP} --svg - --format {format}"));
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("--format has no effect with --svg on standard output"));
    }
    let output = drawn(&folder.path().join("chart.png"));
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("chart.png' can't be used: expected a name that ends in .svg"));
}

#[test]
fn a_read_only_file_and_a_folder_are_refused_and_stay_what_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("read-only"), "old").unwrap();
    fs::set_permissions(path("read-only"), fs::Permissions::from_mode(0o444)).unwrap();
    fs::create_dir(path("folder")).unwrap();
    for (name, words) in [("read-only", "read-only"), ("folder", "directory")] {
        let output = drawn(&path(name));
        assert_eq!((output.status.code(), stdout(&output)), (Some(2), String::new()), "{name}");
        assert!(stderr(&output).contains("cannot write") && stderr(&output).contains(words), "{}", stderr(&output));
        let error = json(&format!("{MAP} --svg {}", path(name).display()), 2);
        assert_eq!(
            (&error["error"]["kind"], &error["error"]["path"]),
            (&"write".into(), &path(name).display().to_string().into())
        );
    }
    assert_eq!(fs::read(path("read-only")).unwrap(), b"old");
}
