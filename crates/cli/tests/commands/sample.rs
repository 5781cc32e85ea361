//! Single launches, drawn from a space or read from standard input.

use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Output, Stdio};
use std::sync::mpsc;
use std::time::Duration;

use crate::common::{json, run, stderr, stdout};
use serde_json::Value;

const DOCUMENT: &str = include_str!("../../../../docs/json.md");

const HEADING: &str = "wx,wy,wz,speed,time,gravity,drop,tilt,flight_time,cos_tilt,outcome,certified";

/// The program with its streams piped.
fn piped(arguments: &str) -> std::process::Child {
    Command::new(env!("CARGO_BIN_EXE_unfair-toss"))
        .args(arguments.split_whitespace())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

/// The program with `input` on its standard input.
fn fed(arguments: &str, input: impl AsRef<[u8]>) -> Output {
    let mut child = piped(arguments);
    let (mut stdin, input) = (child.stdin.take().expect("it is piped"), input.as_ref().to_owned());
    // On a thread of its own, because the program writes while it reads. If it refuses its options it reads nothing.
    let feeder = std::thread::spawn(move || _ = stdin.write_all(&input));
    let output = child.wait_with_output().expect("it ends");
    feeder.join().expect("it ends");
    output
}

fn rows(text: &str) -> Vec<Vec<String>> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(HEADING));
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn as_many_rows_land_heads_as_an_estimate_counts() {
    let space = "--space paper-fig4";
    for (options, counted) in [
        ("--points 5000 --seed 3 --drop 1m", "--method random --points 5000 --seed 3 --drop 1m"),
        ("--points 20000 --method random", "--method random --points 20000"),
    ] {
        let rows = rows(&stdout(&run(&format!("sample {space} {options}"))));
        let answer = json(&format!("probability {space} {counted}"), 0);
        let heads = rows.iter().filter(|row| row[10] == "heads").count() as u64;
        assert_eq!((rows.len() as u64, heads), (answer["points"].as_u64().unwrap(), answer["heads"].as_u64().unwrap()));
        assert!(rows.iter().all(|row| row[11] == "true" && row[0] == row[1] && row[2] == "30.0"));
    }
    let grid = rows(&stdout(&run("sample --space tails --method grid")));
    assert!(grid.len() == 500 && grid.iter().all(|row| row[10] == "tails"));
    assert_eq!((grid[0][3].as_str(), grid[499][3].as_str()), ("3.0", "5.0"));
    assert_eq!(rows(&stdout(&run("sample --space tails --method sobol --points 33"))).len(), 33);
}

#[test]
fn each_row_lands_as_its_toss_does() {
    let space =
        "--rate-x -60:60 --rate-y normal:0:9 --rate-z 1:60 --speed 3:5 --gravity 9:10 --tilt -3:3 --coin us-dime";
    for solver in ["--drop 30cm", "--drop 30cm --solver quaternion --scheme taylor", ""] {
        for row in rows(&stdout(&run(&format!("sample {space} --points 5 --seed 8 {solver}")))) {
            let drop = if row[6].is_empty() { String::new() } else { format!("--drop {}", row[6]) };
            let solver = solver.trim_start_matches("--drop 30cm");
            let toss = format!(
                "toss --coin us-dime --rate={},{},{} --speed {} --gravity {} --tilt {} {drop} {solver}",
                row[0], row[1], row[2], row[3], row[5], row[7]
            );
            let answer = json(&toss, 0);
            // Compared as text, because the reader of JSON is off by an ulp at times.
            let text = stdout(&run(&format!("{toss} --format json")));
            assert!(text.contains(&format!("\"cos_tilt\":{},", row[9])), "{toss}: {text}");
            assert_eq!(
                (&answer["outcome"], &answer["certified"]),
                (&row[10].as_str().into(), &(row[11] == "true").into())
            );
            assert!(text.contains(&format!("\"flight_time\":{},", row[8])), "{toss}: {text}");
        }
    }
}

#[test]
fn rows_do_not_depend_on_the_number_of_threads() {
    let sample = |threads: &str| stdout(&run(&format!("sample --space paper-fig4 --points 40000 --threads {threads}")));
    assert_eq!(sample("1"), sample("3"));
}

#[test]
fn an_output_can_be_read_again() {
    let first = stdout(&run("sample --space paper-fig4 --points 20000 --drop 0.5"));
    let again = fed("sample -", &first);
    assert_eq!((again.status.code(), stdout(&again)), (Some(0), first), "{}", stderr(&again));
}

#[test]
fn columns_are_found_by_their_heading_and_may_have_units() {
    let text = "tilt, speed, wz ,wy,wx\n15deg,2.4m/s,5,0,38rev/s\n,3,2.5,1,1\n";
    let found = rows(&stdout(&fed("sample - --coin us-quarter", text)));
    assert_eq!(found[0][0], "238.7610416728243");
    let toss = json("toss --coin us-quarter --rate 1,1,2.5 --speed 3", 0);
    assert!((toss["cos_tilt"].as_f64().unwrap() - found[1][9].parse::<f64>().unwrap()).abs() < 1e-15);
    assert_eq!(found[1][5], "9.81");
    let timed = rows(&stdout(&fed("sample -", "wx,wy,wz,time,speed\n1,1,2.5,0.5,\n1,1,2.5,,3\n")));
    assert_eq!((timed[0][3].as_str(), timed[0][4].as_str(), timed[0][5].as_str()), ("", "0.5", ""));
    assert_eq!((timed[1][3].as_str(), timed[1][4].as_str()), ("3.0", ""));
    assert_eq!(stdout(&fed("sample -", "wx,wy,wz,time\n")), format!("{HEADING}\n"));
    let turned = stdout(&fed("sample - --coin us-quarter", "turn,psi,speed\n38rev/s,60deg,2.4m/s\n"));
    let toss = json("toss --coin us-quarter --turn 38rev/s --psi 60deg --speed 2.4m/s", 0);
    assert_eq!(rows(&turned)[0][9].parse::<f64>().unwrap(), toss["cos_tilt"].as_f64().unwrap());
    assert_eq!(stdout(&fed("sample - --coin us-quarter", &turned)), turned);
}

#[test]
fn mistakes_in_the_input_are_found_by_line_and_column() {
    let good = "wx,wy,wz,speed\n1,1,2.5,3\n";
    for (text, line, column, words) in [
        ("wx,wy,wz,spin\n", 1, 4, "column 'spin' is unknown"),
        ("wx,wy,wx,wz,speed\n", 1, 3, "column 'wx' is there twice"),
        ("wx,wy,speed\n", 1, 4, "column wz is missing"),
        ("wx,wy,wz\n", 1, 4, "column speed or time is missing"),
        ("", 1, 1, "column wx is missing"),
        (&format!("{good}1,x,2.5,3\n"), 3, 2, "rate y [rad/s] = 'x'"),
        (&format!("{good}1,1m,2.5,3\n"), 3, 2, "rev/s or rpm"),
        (&format!("{good}1,1,2.5,-3\n"), 3, 4, "speed [m/s] = -3.0"),
        (&format!("{good}1,1,2.5,\n"), 3, 4, "speed is missing"),
        (&format!("{good}1,,2.5,3\n"), 3, 2, "rate y [rad/s] is missing"),
        ("turn,speed\n", 1, 3, "column psi is missing"),
        ("turn,psi,speed\n1,181deg,3\n", 2, 2, "psi [rad] = 3.1"),
        (&format!("{good}1,1,2.5\n"), 3, 1, "3 cells, but the heading has 4"),
        (&format!("{good}1,nan,2.5,3\n"), 3, 2, "rate y [rad/s] = NaN"),
        ("wx,wy,wz,speed,time\n1,1,1,1,1\n", 2, 5, "given twice"),
        ("wx,wy,wz,time,drop\n1,1,1,1,1\n", 2, 4, "given twice"),
        ("wx,wy,wz,speed,drop\n1,1,1,1,-1\n", 2, 5, "drop [m] = -1.0"),
    ] {
        let output = fed("sample -", text);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{text}: {message}");
        let place = format!("standard input, line {line}, column {column}: ");
        assert!(message.contains(&place) && message.contains(words), "{text}: {message}");
        // What was solved before is printed before.
        assert_eq!(stdout(&output).lines().count(), if line == 3 { 2 } else { 0 }, "{text}");
        let json = stdout(&fed("sample - --format json", text));
        let error: Value = serde_json::from_str(json.lines().last().unwrap()).unwrap();
        assert_eq!((&error["error"]["line"], &error["error"]["column"]), (&line.into(), &column.into()));
    }
}

/// Another program asks launch by launch, and waits for each answer before it writes the next.
#[test]
fn a_launch_is_answered_before_the_next_one_arrives() {
    let mut child = piped("sample -");
    let mut to = child.stdin.take().unwrap();
    let (send, lines) = mpsc::channel();
    let stdout = BufReader::new(child.stdout.take().unwrap());
    std::thread::spawn(move || stdout.lines().map_while(Result::ok).try_for_each(|line| send.send(line)));
    let mut answer = |text: &str, rows: usize| {
        to.write_all(text.as_bytes()).unwrap();
        let next = |_| lines.recv_timeout(Duration::from_secs(60)).unwrap_or_else(|_| panic!("no answer to {text:?}"));
        (0..rows).map(next).collect::<Vec<String>>()
    };
    assert_eq!(answer("wx,wy,wz,speed\r\n1,1,2.5,3\r\n", 2)[0], HEADING);
    assert!(answer("2,1,2.5,3\r\n", 1)[0].starts_with("2.0,1.0,2.5,3.0,"));
    assert!(answer("3,1,2.5,3\r\n\r\n,,,\r\n4,1,", 1)[0].starts_with("3.0,"));
    assert!(answer("2.5,3\n5,1,2.5,3\n", 2)[1].starts_with("5.0,"));
    assert!(answer("6,1,2.5,3\nx,1,2.5,3\n", 1)[0].starts_with("6.0,"));
    // The mistake ends it although standard input is still open.
    let mut said = String::new();
    BufReader::new(child.stderr.take().unwrap()).read_line(&mut said).unwrap();
    assert!(said.contains("standard input, line 10, column 1: rate x [rad/s] = 'x'"), "{said}");
    assert_eq!(child.wait().unwrap().code(), Some(2));
}

#[test]
fn tables_are_read_as_spreadsheets_write_them() {
    let expected = stdout(&fed("sample -", "wx,wy,wz,speed\n1,1,2.5,3\n"));
    for text in [
        "\u{feff}wx;wy;wz;speed\r\n1;1;2.5;3\r\n",
        "wx\twy\twz\tspeed\n1\t1\t2.5\t3\n",
        "WX, Wy ,\"wz\",Speed\r1,1, \"2.5\" ,3\r,,,\r",
    ] {
        assert_eq!(stdout(&fed("sample -", text)), expected, "{text:?}");
    }
    for (text, words) in [
        (&b"wx,wy\xff\n"[..], "standard input, line 1, column 2: the text is not UTF-8\n"),
        (
            b"\xff\xfew\0x\0",
            "standard input, line 1, column 1: the text is not UTF-8 but looks like UTF-16; save it as UTF-8\n",
        ),
        (b"wx,wy,wz,speed\n1,1,1,\"1\n", "standard input, line 2, column 1: a quotation mark is not closed\n"),
        (b"wx;wy;wz;speed\n1;1;2,5;3\n", "line 2, column 3: rate z [rad/s] = '2,5' can't be used"),
    ] {
        let output = fed("sample -", text);
        assert!(output.status.code() == Some(2) && stderr(&output).contains(words), "{}", stderr(&output));
    }
}

#[test]
fn options_that_do_not_fit_are_refused() {
    let failing =
        json("sample --rate-x 9 --rate-y x --rate-z 0 --speed 3 --points 1 --solver gamma --formulation vertical", 1);
    assert_eq!(failing["error"]["launch"]["rate"][0], 9.0);
    // The launch is counted from the first one, however many are solved together, and those before it are printed.
    let mut text = "wx,wy,wz,speed\n".to_owned() + &"1,1,2.5,3\n".repeat(20_001);
    text += "1,1,1e17,3\n1,1,2.5,3\n";
    let output = fed("sample -", &text);
    assert_eq!((output.status.code(), stdout(&output).lines().count()), (Some(1), 20_002));
    assert!(stderr(&output).contains("launch 20002 (rate 1.0, 1.0, 1e17 rad/s"), "{}", stderr(&output));
}

#[test]
fn lines_of_json_have_the_documented_fields() {
    let (_, section) = DOCUMENT.split_once("\n## `sample`, each line\n").unwrap();
    let section = section.split("\n## ").next().unwrap();
    let documented = section.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next());
    assert_eq!(documented.collect::<Vec<_>>(), HEADING.split(',').collect::<Vec<_>>());
    let text = stdout(&run("sample --space paper-fig4 --points 3 --format json"));
    assert_eq!(text.lines().count(), 3);
    let csv = rows(&stdout(&run("sample --space paper-fig4 --points 3")));
    for (line, row) in text.lines().zip(csv) {
        let value: Value = serde_json::from_str(line).unwrap();
        assert_eq!(value.as_object().unwrap().len(), 12);
        assert!(line.contains(&format!("\"time\":null,\"gravity\":{},", row[5])), "{line}");
        assert!(line.contains(&format!("\"cos_tilt\":{},", row[9])), "{line}");
    }
}

#[test]
fn a_table_without_rows_has_its_heading_and_columns_may_be_called_as_options() {
    let text = |arguments: &str, input: &str| {
        let output = fed(arguments, input);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output)
    };
    assert_eq!(text("sample -", "wx,wy,wz,speed\n"), format!("{HEADING}\n"));
    assert_eq!(text("sample - --format json", "wx,wy,wz,speed\n"), "");
    let expected = text("sample -", "wx,wy,wz,speed\n1,2,3,4\n");
    assert_eq!(text("sample -", "rate_x,rate-y,wz,speed\n1,2,3,4\n"), expected);
    assert_eq!(rows(&expected).len(), 1);
    let twice = fed("sample -", "rate_x,wx,wy,wz,speed\n1,1,2,3,4\n");
    assert!(twice.status.code() == Some(2) && stderr(&twice).contains("column 'wx' is there twice"));
    // An error before the first row has no table before it.
    assert!(fed("sample -", "wx,wy,wz,speed\n1,2,3,x\n").stdout.is_empty());
}
