//! Lists of values from which the cases choose.

use std::sync::LazyLock;

/// The words of a text.
type Words = LazyLock<Vec<&'static str>>;

/// Numbers that many quantities may have.
pub(crate) static ORDINARY: Words = Words::new(|| {
    "1 2 0.5 0.3 0.7 0.95 2.5 3 4 9.81 30 1e-3 1.5707963267948966 0 -1 -2.5 1e-6 1e-9".split_whitespace().collect()
});

/// Numbers at the ends of what numbers can be, and some that are none.
pub(crate) static EXTREME: Words = Words::new(|| {
    "-0 -0.0 5e-324 -5e-324 1e-308 1e-300 1e-16 1e16 1e100 1e300 -1e300 1e308 1.797e308 -1.797e308 1e999 -1e999 inf
     -inf infinity nan -nan 9007199254740993 18446744073709551616 340282366920938463463374607431768211456
     00000000000000000000000001 .5 5. +3 1_000 0x10 1e 1e-999 1e99999999999999999999"
        .split_whitespace()
        .collect()
});

/// Counts that are quickly computed.
pub(crate) const SMALL: &[&str] = &["1", "2", "3", "8", "16", "1e1", "1.6e1"];

/// Counts that are none, too small, or so large that they have to be refused.
pub(crate) static HUGE: Words = Words::new(|| {
    "0 -1 9007199254740993 9223372036854775807 9223372036854775808 18446744073709551615 18446744073709551616
     99999999999999999999999999 1e15 1.5 100000000000000"
        .split_whitespace()
        .collect()
});

pub(crate) const UNITS: &[&str] = &[
    "deg", "°", "rad", "turn", "rev", "rev/s", "rpm", "rad/s", "deg/s", "m/s", "km/h", "m", "mm", "cm", "g", "kg", "s",
    "ms", "min", "m/s²", "m/s^2", "kg·m²", "kg m²", "g·cm²", "%", "furlong", "M", "µs", " m/s", "/s", "°C",
];

pub(crate) static NAMES: Words = Words::new(|| {
    "paper us-quarter racket disc rod sphere exact gamma euler quaternion dop853 dopri5 rk4 taylor momentum vertical
     raw cheated tails rate_x rate_y rate_z speed gravity tilt toss map Exact rk rate-x"
        .split_whitespace()
        .collect()
});

pub(crate) static GARBAGE: Words = Words::new(|| {
    "¦ ¦,¦,,¦:¦::¦1,,2¦1:¦:1¦1:2:3:4¦normal:¦normal:1¦normal:1:2:3:4¦-¦--¦---¦--rate¦--format¦-h¦=¦a=b¦é¦ω¦\
     日本語¦🪙¦\u{202e}right¦\u{7f}¦\u{1b}[31mred¦\t¦\n¦a\r\nb¦{}¦{0}¦%s%n¦$HOME¦'¦\"¦\\¦<svg>¦&amp;¦x¦y¦z¦null¦\
     true¦[1,2,3]¦1 2 3¦1;2;3¦NaN,NaN,NaN¦\u{feff}1¦１¦−1"
        .split('¦')
        .collect()
});

/// Outputs in the working folder, and some that can't be written.
pub(crate) static OUTPUTS: Words = Words::new(|| {
    "chart.svg¦chart.svg¦chart.svg¦ω.svg¦a b¦.hidden¦-¦¦.¦missing/chart.svg¦line\nbreak.svg¦chart.svg/inner¦\
     ./chart.svg"
        .split('¦')
        .collect()
});

/// Values of options that accept few. An option that is not here has values of its kind.
pub(crate) const FITTING: &[(&str, &[&str])] = &[
    ("up_to", &["8", "9"]),
    ("coin", &["paper", "us-quarter", "disc", "racket", "us-quarter-engraved"]),
    ("moments", &["1,1", "1,2", "2,3,4", "1,2,3", "0,1,1", "2,2,3", "1.2g·cm²,1.5g·cm²,2g·cm²"]),
    ("inertia", &["2,3,4,0.1,0.2,0.3", "2,3,4,0,0,0", "2,2,3,0,0,0", "5e-7,5e-7,9e-7,1e-9,0,0"]),
    ("solver", &["exact", "exact", "gamma", "euler", "quaternion"]),
    ("scheme", &["dop853", "dopri5", "rk4", "taylor"]),
    ("formulation", &["momentum", "vertical", "raw"]),
    ("across", &["rate_x", "rate_y", "speed", "tilt"]),
    ("up", &["rate_z", "rate_z", "speed", "gravity"]),
    ("tolerance", &["1e-6", "1e-9", "1e-12"]),
    ("step", &["1e-2", "1e-3"]),
    ("parts", &["part.json", "part.json", "part.json", "missing.json"]),
    ("shard", &["1/1", "1/2", "2/2", "3/97", "0/2"]),
    ("accuracy", &["1e-2", "1e-3", "1e-6", "1e-9"]),
    ("probability", &["0.6", "0.95", "0.75", "1"]),
    ("counts", &["178078/350757", "3/4", "9/9", "1/9", "5/4", "0/0"]),
    ("heads", &["0.6", "0.95", "0.5"]),
    ("attitude", &["1,0,0,0", "0.5,-0.5,0.5,0.7", "0,1,0,0", "0,0,0,0"]),
    ("psi", &["15deg", "0.3", "1"]),
    ("turn", &["38rev/s", "20", "3"]),
    ("drop", &["0", "1", "24mm", "-0.1"]),
    ("command", &["toss", "map", "sample", "man"]),
    ("reference", &["0", "0.5", "1"]),
    ("gravity", &["9.81", "1.62", "1", "0.5"]),
];
