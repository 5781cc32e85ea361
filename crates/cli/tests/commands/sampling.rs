//! Runs the commands about many launches as a user does, and checks their numbers, their refusals and their charts. The
//! libraries have tests of their own; these show that options reach them and answers come back unchanged.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{json, run, stderr, stdout};

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

/// Commands that take minutes, and a part of what each knows early.
const LONG: [(&str, &str); 11] = [
    (
        "probability --rate-x 10:20 --rate-y 0:30 --rate-z 20:30 --tilt 1 --speed 3:5 --method enclosure --accuracy 3e-6",
        "(proven)",
    ),
    ("probability --space paper-fig4 --method random --points 1e12", "clopper-pearson"),
    ("map --rate-x 0:40:900 --rate-y 5 --rate-z 10:20:900 --speed 3:5 --method sobol --tilt 1", "0,10,"),
    ("convergence --rate-x 1:60:9000 --rate-y 4 --rate-z 1:9:99 --speed 3:5:999", "grid"),
    ("errors --space paper-fig4 --up-to 24 --reference 0.5", "grid,256,"),
    ("limit --points 1e10", "cone_angle"),
    ("sample --space paper-fig4 --points 1e9 --solver quaternion --scheme rk4 --step 1e-3", "cos_tilt"),
    ("trace --rate 2000,500,3000 --time 10 --solver quaternion --prove --points 1e5", "cos_tilt"),
    ("spread --rate 1,1,2.5 --speed 3 --heads 0.9999999999 --points 65536", "at least"),
    ("compare --rate 2000,500,3000 --time 10 --step 2e-5 --repeats 1000", "exact"),
    ("toss --coin racket --rate 0.1,200,0.1 --speed 30 --margin", "sensitivity"),
];

#[test]
fn a_command_whose_time_is_up_answers_what_it_knows() {
    for (command, known) in LONG {
        // On a busy machine the first of them may pass before anything is known.
        let mut outputs = [0.4, 8.0].iter().map(|seconds| {
            let began = Instant::now();
            let output = run(&format!("{command} --seconds {seconds}"));
            assert!(began.elapsed() < Duration::from_secs_f64(9.6 + seconds), "{command}: {:?}", began.elapsed());
            output
        });
        let output = outputs.find(|output| output.status.success());
        let output = output.unwrap_or_else(|| panic!("{command}: nothing is known after 8 s"));
        assert!(stdout(&output).contains(known), "{command}: {}", stdout(&output));
        assert!(stderr(&output).contains("note: out of time, by --seconds"), "{command}: {}", stderr(&output));
    }
    let refused = json("toss --rate 1,1,1 --speed 3 --seconds 0", 2);
    assert_eq!(refused["error"]["field"], "seconds");
    // Parts of a grid are no answer, and a plan is whole.
    let ended =
        run("probability --rate-x 1:60:9000 --rate-y 4 --rate-z 1:9:999 --speed 3:5:9999 --method grid --seconds 0.2");
    let flown = "plan --want trace --points 1e6 --rate 20,3,30 --speed 4 --accuracy 1e-9 --solver quaternion";
    for ended in [ended, run(&format!("{flown} --seconds 0.2"))] {
        assert_eq!((ended.status.code(), stdout(&ended)), (Some(1), String::new()));
        assert_eq!(stderr(&ended), "error: out of time, by --seconds before there was an answer\n");
    }
}

/// Ctrl-C ends each within a second. Processes of the background ignore it, unless `env` lets them not.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_command_answers_what_it_knows() {
    for (command, known) in [LONG[0], LONG[6], LONG[7]] {
        let words = command.split(' ').chain(["--format", if command.starts_with("prob") { "text" } else { "json" }]);
        let child = Command::new("env")
            .args(["--default-signal=INT", env!("CARGO_BIN_EXE_unfair-toss")])
            .args(words)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(700));
        let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        let began = Instant::now();
        let output = child.wait_with_output().unwrap();
        assert!(sent.success() && began.elapsed() < Duration::from_secs(2), "{command}: {:?}", began.elapsed());
        assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
        let text = stdout(&output);
        assert!(text.contains(known) && stderr(&output).contains("note: interrupted"), "{command}: {text}");
        if command.starts_with("trace") {
            let answer: serde_json::Value = serde_json::from_str(&text).unwrap();
            assert!(answer["ended"] == "interrupted" && !answer["points"].as_array().unwrap().is_empty(), "{answer}");
        }
    }
}
