//! No option is ignored: each option of each command, beside command lines of many kinds, changes the answer or is refused.
//! What does neither stands in [`EXCEPTIONS`] with the reason.

use std::ffi::OsString;
use std::path::Path;

use clap::{Arg, Command};
use serde_json::Value;
use toss::Registry;
use unfair_toss::{Streams, run_with};

/// Command lines that are answered, each of another kind. `{}` is a folder with a scene, a space and a part.
const BASES: &[&str] = &[
    "toss --rate 20,5,3 --speed 3",
    "toss --rate 20,5,3 --time 0.6",
    "toss --rate 20,5,3 --speed 3 --tilt 0.5 --drop 0.1",
    "toss --turn 38rev/s --psi 60deg --speed 2.4",
    "toss --rate 20,5,3 --speed 3 --solver gamma",
    "toss --rate 20,5,3 --speed 3 --solver euler --tilt 1 --formulation vertical",
    "toss --rate 20,5,3 --speed 3 --solver quaternion",
    "toss --rate 20,5,3 --speed 3 --solver quaternion --scheme rk4",
    "toss --rate 20,5,3 --speed 3 --solver quaternion --prove",
    "toss --rate 20,5,3 --speed 3 --coin racket",
    "toss --rate 20,5,3 --speed 3 --moments 1,2,2.5 --solver quaternion --prove",
    "trace --rate 20,5,3 --speed 3 --points 4",
    "trace --rate 20,5,3 --speed 3 --dt 0.2",
    "trace --rate 20,5,3 --speed 3 --points 4 --coin racket",
    "trace --rate 20,5,3 --speed 3 --points 4 --solver quaternion --scheme rk4 --step 0.01",
    "trace --rate 20,5,3 --speed 3 --points 4 --solver euler --tilt 1",
    "trace --rate 20,5,3 --speed 3 --points 4 --solver quaternion --prove",
    "compare --rate 20,5,3 --speed 3 --tilt 1 --repeats 0",
    "spread --rate 20,5,3 --speed 3 --heads 0.9 --points 64",
    "spread --coin us-quarter --turn 38rev/s --psi 60deg --speed 2.45 --heads 0.9 --points 64",
    "intervals --rate 20,5,3 --speed 3:4",
    "inverse --probability 0.7",
    "inverse --counts 178078/350757",
    "limit --points 9",
    "probability --rate-x 1:40:9 --rate-y 5 --rate-z 10:30:7 --speed 3:4:8 --method grid",
    "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method random --points 1000",
    "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method sobol --points 1024",
    "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method exact-speed --points 1024",
    "probability --rate-x 20 --rate-y 0 --rate-z 10:30 --speed 3:4 --method enclosure --accuracy 1e-2",
    "probability --rate-x 20 --rate-y 5 --rate-z 10:30 --speed 3:4 --accuracy 1e-2",
    "probability --coin us-quarter --turn 38rev/s --psi 60deg --speed 2.4 --spread 5% --accuracy 1e-2",
    "probability --space paper-fig4 --method random --points 1000",
    "probability --space {}/space.toml --method random --points 1000",
    "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method random --points 500 --solver quaternion --scheme rk4 --step 0.004",
    "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method random --points 1000 --solver quaternion --prove",
    "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method random --points 300 --coin racket",
    "sample --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --points 8",
    "sample --space {}/space.toml --points 8",
    "sample --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --points 8 --solver quaternion --scheme rk4 --step 0.02",
    "sample -",
    "convergence --rate-x 1:40:8 --rate-y 5 --rate-z 10:30:8 --speed 3:4:4",
    "convergence --rate-x 1:40:8 --rate-y 5 --rate-z 10:30:8 --speed 3 --solver quaternion --scheme rk4 --step 0.002",
    "errors --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --up-to 8 --replicates 1",
    "map --rate-x 1:40:3 --rate-y 5 --rate-z 10:30:3 --speed 3:4",
    "map --rate-x 1:40:3 --rate-y 5 --rate-z 10:30:3 --speed 3:4 --method random --points 64",
    "map --rate-x 1:40:3 --rate-y 5 --rate-z 10:30:3 --speed 3:4 --method random --points 64 --solver quaternion --scheme rk4 --step 0.002",
    "merge {}/part-1.json {}/part-2.json",
    "plan --rate 20,5,3 --speed 3 --want tilt --accuracy 1e-9",
    "plan --rate 20,5,3 --speed 3 --want outcome --accuracy 1e-9",
    "plan --rate 20,5,3 --speed 3 --want attitude --accuracy 1e-9 --solver quaternion",
    "plan --rate 20,5,3 --speed 3 --want trace --accuracy 1e-9",
    "plan --space paper-fig4 --want probability --accuracy 1e-3",
    "plan --scene {}/scene.json",
];

/// Values for each option that is not in the command line. None is a default.
const VALUES: &[(&str, &[&str])] = &[
    ("coin", &["us-quarter", "racket"]),
    ("cylinder", &["5g,12mm,4mm"]),
    ("moments", &["1,1.7", "1,2,2.5"]),
    ("inertia", &["2,3,4,0.1,0.2,0.3"]),
    ("rate", &["2,5,1"]),
    ("turn", &["20"]),
    ("psi", &["1"]),
    ("speed", &["3.3"]),
    ("time", &["0.37"]),
    ("gravity", &["9.7"]),
    ("drop", &["0.3"]),
    ("tilt", &["0.2"]),
    ("attitude", &["0.5,0.5,0.5,0.6"]),
    ("drag", &["1"]),
    ("bounce", &["1"]),
    ("rate_x", &["3:9"]),
    ("rate_y", &["3:9"]),
    ("rate_z", &["3:9"]),
    ("space", &["cheated", "{}/space.toml"]),
    ("spread", &["5%"]),
    ("solver", &["gamma", "quaternion"]),
    ("scheme", &["dopri5", "rk4", "taylor"]),
    ("tolerance", &["1e-5"]),
    ("step", &["3e-2"]),
    ("formulation", &["vertical", "raw"]),
    ("prove", &[""]),
    ("margin", &[""]),
    ("method", &["grid", "random", "sobol", "exact-speed", "enclosure"]),
    ("accuracy", &["1e-4"]),
    ("points", &["96"]),
    ("seed", &["7"]),
    ("steps", &["3"]),
    ("replicates", &["2"]),
    ("up_to", &["9"]),
    ("reference", &["0.4"]),
    ("across", &["speed", "rate_z"]),
    ("up", &["speed", "rate_x"]),
    ("heads", &["0.8"]),
    ("want", &["outcome", "trace", "probability"]),
    ("probability", &["0.8"]),
    ("counts", &["3/4"]),
    ("shard", &["1/2"]),
    ("out", &["{}/other.json"]),
    ("dt", &["0.1"]),
    ("scene", &["{}/scene.json"]),
    ("repeats", &["3"]),
    ("threads", &["2"]),
    ("seconds", &["1min"]),
    ("svg", &["{}/chart.svg"]),
    ("format", &["json"]),
];

/// Options, with a value if only that is meant, beside which command lines they change nothing, and why.
type Exception = (&'static str, fn(&str) -> bool, &'static str);

const EXCEPTIONS: &[Exception] = &[
    ("seconds", |_| true, "how long it may take, which is longer than it takes"),
    ("threads", |_| true, "how fast the answer is there, which is the same for any number"),
    ("svg", |_| true, "draws a chart beside the answer"),
    ("format", |_| true, "the form of the answer"),
    (
        "margin",
        |base| !base.contains("racket") && !base.contains("--moments"),
        "that of a coin is always there, as its help says",
    ),
    ("scheme=taylor", |base| base.contains("--prove"), "the default of --prove, as its help says"),
    (
        "tolerance",
        |base| base.starts_with("probability") && base.contains("--prove"),
        "for outcomes that the coarse flights of a proof leave open",
    ),
    ("method=random", |base| base.starts_with("sample"), "the default, as its help says"),
    ("method=exact-speed", |base| base.starts_with("map"), "the default, as its help says"),
    (
        "coin cylinder moments",
        |base| base.starts_with("limit"),
        "the limit and the shares are the same for all coins, as its help says",
    ),
    (
        "solver",
        |base| ["limit", "convergence", "map"].iter().any(|command| base.starts_with(command)),
        "a solver finds the outcomes that the exact motion has",
    ),
    (
        OF_A_TOSS,
        |base| ["tilt", "outcome", "trace"].iter().any(|want| base.starts_with("plan --rate") && base.contains(want)),
        "a closed form takes as long for every toss",
    ),
    ("coin cylinder moments", |base| base.starts_with("plan --space"), "a sample takes as long for every coin"),
];

/// Whether it is left out, because integrators take a minute for such long flights.
fn is_too_long(base: &str, option: &str) -> bool {
    base.starts_with("limit") && option == "solver"
}

/// Options that change the toss.
const OF_A_TOSS: &str = "coin cylinder moments gravity drop tilt attitude";

/// Exit code, standard output and standard error.
fn ran(line: &[String]) -> (u8, String, String) {
    let arguments: Vec<OsString> =
        std::iter::once("unfair-toss").chain(line.iter().map(String::as_str)).map(OsString::from).collect();
    let (mut out, mut err) = (Vec::new(), anstream::StripStream::new(Vec::new()));
    let mut input: &[u8] =
        if line[0] == "sample" && line[1] == "-" { b"wx,wy,wz,speed\n20,5,3,3\n1,2,3,4\n" } else { b"" };
    let code = run_with(Registry::standard(), &arguments, Streams { input: &mut input, out: &mut out, err: &mut err });
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (code, text(out), text(err.into_inner()))
}

/// The answer as JSON without its input; of a command that prints lines, the lines.
fn answer(line: &[String]) -> Result<Value, (u8, String)> {
    let line: Vec<String> = line.iter().cloned().chain(["--format".to_owned(), "json".to_owned()]).collect();
    let (code, out, err) = ran(&line);
    if code != 0 {
        return Err((code, err));
    }
    let mut answer = serde_json::from_str(&out).unwrap_or(Value::String(out));
    answer.as_object_mut().map(|fields| fields.remove("input"));
    Ok(answer)
}

/// The files that command lines name.
fn write_files(folder: &Path) {
    let scene = r#"{"accuracy":1e-9,"want":{"tilt":{"launch":{"rate":[1,1,2.5],"speed":3}}}}"#;
    std::fs::write(folder.join("scene.json"), scene).expect("a file");
    let space = "rate_x = '1:40'\nrate_y = 5\nrate_z = '10:30'\nspeed = 3\n";
    std::fs::write(folder.join("space.toml"), space).expect("a file");
    for part in 1..=2 {
        let line = "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method random --points 100";
        let line = format!("{line} --shard {part}/2 --out {}/part-{part}.json", folder.display());
        let (code, _, err) = ran(&words(&line));
        assert_eq!(code, 0, "{err}");
    }
}

fn words(line: &str) -> Vec<String> {
    line.split(' ').map(str::to_owned).collect()
}

/// How many pairs there are, and how many of them were refused, could not be solved, or are exceptions.
#[derive(Debug, Default)]
struct Tried {
    pairs: u32,
    refused: u32,
    failed: u32,
    exceptions: u32,
}

impl Tried {
    /// Tries a value of an option beside a command line. What is ignored is returned.
    fn tries(&mut self, (base, before): (&str, &Value), option: &Arg, value: &str) -> Option<String> {
        let id = option.get_id().as_str();
        let long = format!("--{}", option.get_long()?);
        let given = [long].into_iter().chain((!value.is_empty()).then(|| value.to_owned()));
        let line: Vec<String> = words(base).into_iter().chain(given).collect();
        self.pairs += 1;
        let is_meant = |option: &str| option == id || option == format!("{id}={value}");
        let is_excepted = |(options, beside, _): &Exception| options.split(' ').any(is_meant) && beside(base);
        if is_too_long(base, id) {
            self.exceptions += 1;
            return None;
        }
        match answer(&line) {
            Err((1, _)) => self.failed += 1,
            Err((code, message)) => {
                assert_eq!(code, 2, "{}: {message}", line.join(" "));
                self.refused += 1;
            }
            Ok(now) if now != *before => {}
            Ok(_) if EXCEPTIONS.iter().any(is_excepted) => self.exceptions += 1,
            Ok(_) => return Some(line.join(" ")),
        }
        None
    }
}

#[test]
fn every_option_changes_the_answer_or_is_refused() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    write_files(folder.path());
    let placed = |text: &str| text.replace("{}", &folder.path().display().to_string());
    let program = unfair_toss::program();
    let (mut tried, mut ignored) = (Tried::default(), Vec::new());
    for base in BASES.iter().map(|base| placed(base)) {
        let before = answer(&words(&base)).unwrap_or_else(|(_, message)| panic!("{base}: {message}"));
        let command = program.find_subcommand(&words(&base)[0]).expect("a command");
        for option in absent(command, &base) {
            let id = option.get_id().as_str();
            let values = VALUES.iter().find(|(of, _)| *of == id).map(|(_, values)| *values);
            for value in values.unwrap_or_else(|| panic!("{base}: no values for {id}")) {
                ignored.extend(tried.tries((&base, &before), option, &placed(value)));
            }
        }
    }
    println!("{tried:?}");
    assert!(ignored.is_empty(), "ignored:\n{}", ignored.join("\n"));
    assert!(tried.pairs > 1200 && tried.refused > 300, "{tried:?}");
}

/// The options of `command` that are not in its command line.
fn absent<'a>(command: &'a Command, base: &str) -> Vec<&'a Arg> {
    let given = words(base);
    let is_absent = |option: &&Arg| option.get_long().is_some_and(|long| !given.contains(&format!("--{long}")));
    command.get_arguments().filter(|option| option.get_id() != "help").filter(is_absent).collect()
}
