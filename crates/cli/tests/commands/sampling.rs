//! Runs the commands about many launches as a user does, and checks their numbers, their refusals and their charts. The
//! libraries have tests of their own; these show that options reach them and answers come back unchanged.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::{assert_near, json, run, stderr, stdout};

#[test]
fn probabilities_do_not_depend_on_threads() {
    let answers = [1, 2, 8].map(|threads| {
        json(&format!("probability --space paper-fig4 --method random --points 20000 --seed 7 --threads {threads}"), 0)
    });
    assert!(answers.iter().all(|answer| *answer == answers[0]));
}

#[test]
fn a_space_is_read_from_a_file_and_its_errors_have_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let command = format!("probability --space {} --method grid", path.display());
    std::fs::write(&path, "coin = 'disc'\nrate_x = '0:40:20'\nrate_y = 'x'\nrate_z = 30\nspeed = '3:5:20'\n").unwrap();
    assert_eq!(json(&command, 0)["heads"], 400);
    assert!(json(&format!("{command} --coin paper"), 0)["tails"].as_u64() > Some(0));
    std::fs::write(&path, "rate_x = 1\nrate_y = 1\nrate_z = 1\nspeed = '5:3'\n").unwrap();
    let error = json(&command, 2);
    assert_eq!((&error["error"]["line"], &error["error"]["column"]), (&4.into(), &9.into()));
    let message = stderr(&run(&command));
    assert!(message.contains("mine.toml, line 4, column 9: speed [m/s] = 3.0 is outside"), "{message}");
}

#[test]
fn the_last_step_of_a_convergence_is_the_result_of_probability() {
    let series = json("convergence --space paper-fig4 --steps 50", 0);
    let last = &series["series"].as_array().unwrap()[49];
    assert_eq!(last["launches"], 250_000);
    for method in ["grid", "random"] {
        let whole = json(&format!("probability --space paper-fig4 --method {method}"), 0);
        assert_eq!(last[method], whole["probability"]);
    }
    let csv = stdout(&run("convergence --space tails --steps 4"));
    assert_eq!(csv.lines().next(), Some("launches,grid,random,random_lo,random_hi"));
    assert_eq!(csv.lines().count(), 5);
}

#[test]
fn errors_are_measured_from_an_accurate_reference_and_smaller_by_exact_speed() {
    let space = "--rate-x 1:60 --rate-y 1:60 --rate-z 1:60 --speed 3:5";
    let lines = json(&format!("errors {space} --up-to 10 --replicates 4"), 0);
    let lines = lines["series"].as_array().unwrap();
    assert_eq!(lines.len(), 5 * 3);
    for line in lines {
        // The probability over this box, from enclosure.
        assert_near(&line["reference"], 0.580_665_055_2, line["reference_error"].as_f64().unwrap());
        assert!(line["rms_error"].as_f64() > Some(0.0), "{line}");
    }
    let error = |method: &str| {
        lines.iter().rfind(|line| line["method"] == method).and_then(|line| line["rms_error"].as_f64()).unwrap()
    };
    assert!(4.0 * error("exact-speed") < error("random"));
    let from_zero = json(&format!("errors {space} --up-to 8 --reference 0"), 0);
    assert!(from_zero["series"][0]["rms_error"].as_f64() > Some(0.5));
}

#[cfg(unix)]
#[test]
fn a_command_that_is_killed_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("chart.svg");
    let mut child = Command::new(env!("CARGO_BIN_EXE_unfair-toss"))
        .args("errors --space paper-fig4 --up-to 24 --replicates 10000 --svg".split(' '))
        .arg(&path)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(child.try_wait().unwrap(), None, "it is still at work");
    // SIGTERM instead of the SIGINT of Ctrl-C: both end the program, but a test that runs in the background ignores
    // SIGINT.
    let stopped = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(stopped.success());
    let output = child.wait_with_output().unwrap();
    assert!(!output.status.success() && output.stdout.is_empty());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
