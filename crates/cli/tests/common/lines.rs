//! Command lines of all kinds that are answered, and values for each option: what the tests begin with that try many of them.

use std::ffi::OsString;
use std::path::Path;

use toss::Registry;
use unfair_toss::{Streams, run_with};

/// Command lines that are answered, each of another kind. `{}` is a folder with a scene, a space, counts and parts.
pub(crate) const BASES: &[&str] = &[
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
    "probability --turn 30:40 --psi 40deg:80deg --speed 3:4 --method random --points 10000",
    "probability --turn 30:40 --psi normal:60deg:5deg --speed 3:4 --method exact-speed --points 1024",
    "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --drop 0:0.5 --method random --points 10000",
    "probability --turn 38 --psi 50deg:60deg --speed 2.4 --drop normal:0.2:0.05 --method sobol --points 1024",
    "sample --turn 30:40 --psi 40deg:80deg --speed 3:4 --drop 0:0.5 --points 8",
    "map --turn 30:40:3 --psi 40deg:80deg:3 --speed 3:4 --across turn --up psi",
    "map --turn 30:40 --psi 40deg:80deg:3 --speed 2:4:3 --drop 0.2 --across psi --up speed --method random --points 64",
    "map --rate-x 1:40:3 --rate-y 5 --rate-z 10:30 --speed 3 --drop 0:1:3 --across rate_x --up drop --method random --points 64",
    "convergence --turn 30:40:8 --psi 40deg:80deg:8 --speed 3 --drop 0:1:4",
    "errors --turn 30:40 --psi 40deg:80deg --speed 3:4 --up-to 8 --replicates 1",
    "intervals --coin us-quarter --turn 38rev/s --psi 60deg --speed 2:3",
    "trace --turn 38rev/s --psi 60deg --speed 2.4 --points 4",
    "compare --turn 38rev/s --psi 60deg --speed 2.4 --tilt 1 --repeats 0",
    "plan --turn 38rev/s --psi 60deg --speed 2.4 --want tilt --accuracy 1e-9",
    "inverse --counts {}/counts.csv",
    "power",
    "power --people 25",
    "power --flips 200",
    "power --people 25 --flips 200",
    "coins",
    "solvers",
    "models",
    "spaces",
    "merge {}/part-1.json {}/part-2.json",
    "plan --rate 20,5,3 --speed 3 --want tilt --accuracy 1e-9",
    "plan --rate 20,5,3 --speed 3 --want outcome --accuracy 1e-9",
    "plan --rate 20,5,3 --speed 3 --want attitude --accuracy 1e-9 --solver quaternion",
    "plan --rate 20,5,3 --speed 3 --want trace --accuracy 1e-9",
    "plan --space paper-fig4 --want probability --accuracy 1e-3",
    "plan --scene {}/scene.json",
];

/// Values for each option that is not in the command line. None is a default.
pub(crate) const VALUES: &[(&str, &[&str])] = &[
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
    ("share", &["0.52"]),
    ("sd", &["0.03"]),
    ("power", &["0.9"]),
    ("people", &["30"]),
    ("flips", &["150"]),
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

/// What [`BASES`] read on standard input.
pub(crate) const ROWS: &str = "wx,wy,wz,speed\n20,5,3,3\n1,2,3,4\n";

/// Exit code, standard output and standard error.
pub(crate) fn ran(line: &[String]) -> (u8, String, String) {
    let arguments: Vec<OsString> =
        std::iter::once("unfair-toss").chain(line.iter().map(String::as_str)).map(OsString::from).collect();
    let (mut out, mut err) = (Vec::new(), anstream::StripStream::new(Vec::new()));
    let mut input: &[u8] = if line[0] == "sample" && line[1] == "-" { ROWS.as_bytes() } else { b"" };
    let code = run_with(Registry::standard(), &arguments, Streams { input: &mut input, out: &mut out, err: &mut err });
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (code, text(out), text(err.into_inner()))
}

/// The files that command lines name.
pub(crate) fn write_files(folder: &Path) {
    let scene = r#"{"accuracy":1e-9,"want":{"tilt":{"launch":{"rate":[1,1,2.5],"speed":3}}}}"#;
    std::fs::write(folder.join("scene.json"), scene).expect("a file");
    let space = "rate_x = '1:40'\nrate_y = 5\nrate_z = '10:30'\nspeed = 3\n";
    std::fs::write(folder.join("space.toml"), space).expect("a file");
    std::fs::write(folder.join("counts.csv"), "same,tosses\n60,100\n55,100\n52,100\n").expect("a file");
    for part in 1..=2 {
        let line = "probability --rate-x 1:40 --rate-y 5 --rate-z 10:30 --speed 3:4 --method random --points 100";
        let line = format!("{line} --shard {part}/2 --out {}/part-{part}.json", folder.display());
        let (code, _, err) = ran(&words(&line));
        assert_eq!(code, 0, "{err}");
    }
}

pub(crate) fn words(line: &str) -> Vec<String> {
    line.split(' ').map(str::to_owned).collect()
}
