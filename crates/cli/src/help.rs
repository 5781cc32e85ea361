//! What `--help` says beside the options themselves: the usage line of each command with what it requires, the groups of
//! options, an example, and what the words and columns of its answer mean. It is kept here in one table, so that all
//! commands say it in the same way.

use clap::{Arg, Command};

/// A group of options.
struct Group {
    /// Its heading in `--help`, with how numbers are given.
    heading: &'static str,
    /// Its heading in a manual page, which is printed in capitals: there 2.4m/s would be 2.4M/S, which is another unit.
    manual: &'static str,
    /// The names of its options.
    names: &'static str,
}

const GROUPS: [Group; 6] = [
    Group {
        heading: "Coin (or any rigid body; SI units without a unit, with one as in 5.67g, 24mm or 1.7g·cm²)",
        manual: "Coin options",
        names: "coin cylinder moments inertia",
    },
    Group {
        heading: "Launch (SI units and radians without a unit; with one as in 15deg, 38rev/s, 600rpm, 2.4m/s, 24mm or 500ms)",
        manual: "Launch options",
        names: "rate turn psi rate_x rate_y rate_z speed time gravity drop tilt attitude space spread drag bounce from scene",
    },
    Group { heading: "Solver", manual: "Solver options", names: "solver scheme tolerance step formulation prove" },
    Group {
        heading: "Sampling",
        manual: "Sampling options",
        names: "method accuracy points seed steps replicates up_to reference across up threads seconds heads shard",
    },
    Group { heading: "People", manual: "People options", names: "share sd power people flips" },
    Group {
        heading: "Output",
        manual: "Output options",
        names: "format margin out svg dt repeats want probability counts shell command",
    },
];

/// How quantities are given, for a manual page.
const UNITS: &str = "A quantity without a unit is in SI units, and an angle in radians. With a unit it is written as in 5.67g, 24mm, \
1.7g·cm², 15deg, 38rev/s, 600rpm, 2.4m/s or 500ms; capitals count.";

/// What heads is, for commands whose answer has an outcome.
const HEADS: &str = "Heads: the coin lands with cos θ > 0, where θ is the angle between the normal of its heads side and the \
vertical. It is thrown with heads up, unless it is tilted.";

/// What a command requires, and what stands after its options: an example, and what its answer means.
struct Text {
    command: &'static str,
    usage: &'static str,
    example: &'static str,
    meaning: &'static str,
}

const TEXTS: &[Text] = &[
    Text {
        command: "toss",
        usage: "(--rate WX,WY,WZ | --turn RATE --psi PSI) (--speed V0 | --time T) [OPTIONS]",
        example: "unfair-toss toss --coin us-quarter --turn 38rev/s --psi 60deg --speed 2.4m/s",
        meaning: "",
    },
    Text {
        command: "trace",
        usage: "(--rate WX,WY,WZ | --turn RATE --psi PSI) (--speed V0 | --time T) (--points N | --dt H | --svg FILE) [OPTIONS]",
        example: "unfair-toss trace --rate 1,1,2.5 --speed 3 --dt 50ms",
        meaning: "Columns: time (s); w, x, y, z, the quaternion from the body to the laboratory; alpha, beta, gamma, its Euler \
                  angles (rad): precession, nutation, spin; normal_x to normal_z, the normal of the heads side, and face_x to \
                  face_z, the body's x axis, both in the laboratory; cos_tilt, cos θ.",
    },
    Text {
        command: "probability",
        usage: "(--space NAME | --rate-x AXIS --rate-y AXIS --rate-z AXIS --speed AXIS | --turn RATE --psi PSI --speed AXIS) \
                [OPTIONS]",
        example: "unfair-toss probability --coin us-quarter --turn 38rev/s --psi 60deg --speed 2.4m/s --spread 1%",
        meaning: "",
    },
    Text {
        command: "sample",
        usage: "(--space NAME | --rate-x AXIS --rate-y AXIS --rate-z AXIS --speed AXIS | --turn RATE --psi PSI --speed AXIS) \
                --points N [OPTIONS]\n       unfair-toss sample - [OPTIONS] < LAUNCHES.csv",
        example: "unfair-toss sample --space paper-fig4 --points 1000",
        meaning: "Columns: wx, wy, wz, the body rate (rad/s); speed (m/s) or time (s), gravity (m/s²), drop (m) and tilt (rad) as \
                  they were given; flight_time (s); cos_tilt, cos θ at landing; outcome; certified, whether the outcome is \
                  proven. With --format json each line is an object with these fields.",
    },
    Text {
        command: "compare",
        usage: "(--rate WX,WY,WZ | --turn RATE --psi PSI) (--speed V0 | --time T) [OPTIONS]",
        example: "unfair-toss compare --rate 20,5,3 --speed 3 --repeats 0",
        meaning: "Columns: cos θ at landing; error, its distance from that of the exact motion; attitude/rad, the angle between \
                  the attitude at landing and that of the exact motion; outcome; calls of the right-hand side; steps; time, the \
                  median of several measurements of one flight.",
    },
    Text {
        command: "spread",
        usage: "(--rate WX,WY,WZ | --turn RATE --psi PSI) --speed V0 --heads P [OPTIONS]",
        example: "unfair-toss spread --coin us-quarter --turn 38rev/s --psi 60deg --speed 2.4m/s --heads 95%",
        meaning: "Spread: with a spread S each rate and the speed is normal around its value x, with the standard deviation S·|x|, \
                  independent of the others. The answer is the largest S, up to 12 %, such that heads has at least the \
                  probability P at S and at every smaller spread.",
    },
    Text {
        command: "convergence",
        usage: "(--space NAME | --rate-x AXIS --rate-y AXIS --rate-z AXIS --speed AXIS) [OPTIONS]",
        example: "unfair-toss convergence --space paper-fig4 --steps 50",
        meaning: "Columns: launches so far; grid, the share of heads among the first launches of the grid; random, the share among \
                  the first random launches, with its 95 % interval from random_lo to random_hi.",
    },
    Text {
        command: "errors",
        usage: "(--space NAME | --rate-x AXIS --rate-y AXIS --rate-z AXIS --speed AXIS) [OPTIONS]",
        example: "unfair-toss errors --space paper-fig4 --up-to 10 --replicates 4",
        meaning: "Columns: method; launches; rms_error, the root mean square of the errors of the replicates; replicates, their \
                  number; reference, the probability that is taken as true; reference_error, half the width of its interval.",
    },
    Text {
        command: "map",
        usage: "(--space NAME | --rate-x AXIS --rate-y AXIS --rate-z AXIS --speed AXIS) [OPTIONS]",
        example: "unfair-toss map --rate-x 0:40:5 --rate-y 0 --rate-z 20:60:3 --speed 3:5",
        meaning: "With a space by its name, both axes have to have points: unfair-toss map --space paper-fig4 --up speed.\n\n\
                  Columns: the coordinate across, the coordinate up, and the probability of heads at this node. If launches are \
                  undecided, a column undecided has their number, and a node of which none is decided has no probability.",
    },
    Text {
        command: "merge",
        usage: "PART... [OPTIONS]",
        example: "unfair-toss merge part-1.json part-2.json",
        meaning: "The parts are those of one space, method, number of launches and seed, each written by \
                  unfair-toss probability --shard I/N --out PART. Together they have every launch once. The sum has the counts \
                  and the interval of the whole; its outcomes do not count as proven, because a file proves nothing.",
    },
    Text {
        command: "intervals",
        usage: "(--rate WX,WY,WZ | --turn RATE --psi PSI) --speed LO:HI [OPTIONS]",
        example: "unfair-toss intervals --rate 20,5,3 --speed 3:4",
        meaning: "",
    },
    Text {
        command: "inverse",
        usage: "(--probability P | --counts K/N|FILE.csv) [OPTIONS]",
        example: "unfair-toss inverse --counts 178078/350757",
        meaning: "With --counts: of N coins, K landed on the side that had been up. The answer is the angle ψ between the normal and \
                  the angular momentum that explains this, with its 95 % interval, if all launches left flat, turned many times and \
                  had the same ψ; 180° - ψ explains it as well. A file has one person per row, in the columns same and tosses, or start and lands with flips as letters.",
    },
    Text {
        command: "power",
        usage: "[--share P] [--people N] [--flips M] [OPTIONS]",
        example: "unfair-toss power --share 0.508 --people 25 --flips 200",
        meaning: "An experiment finds the share if the 95 % interval of inverse --counts leaves out 1/2. Many flips of few people do \
                  not help where people differ: each is a sample of one hand.",
    },
    Text {
        command: "limit",
        usage: "[OPTIONS]",
        example: "unfair-toss limit --coin us-quarter --points 100",
        meaning: "Columns: cone_angle, the angle ψ between the normal and the angular momentum (rad); limit, the probability of \
                  heads in the limit of long flights; launches, the number of long flights; share, that of heads among them, \
                  with its 95 % interval from share_lo to share_hi. Both are the same for all coins.",
    },
    Text {
        command: "plan",
        usage: "--want WANT --accuracy EPS (--rate WX,WY,WZ --speed V0 | --space NAME) [OPTIONS]\n       \
                unfair-toss plan --scene FILE [OPTIONS]",
        example: "unfair-toss plan --rate 1,1,2.5 --speed 3 --want tilt --accuracy 1e-9",
        meaning: "",
    },
    Text { command: "coins", usage: "[OPTIONS]", example: "unfair-toss coins", meaning: "" },
    Text { command: "solvers", usage: "[OPTIONS]", example: "unfair-toss solvers", meaning: "" },
    Text { command: "models", usage: "[OPTIONS]", example: "unfair-toss models", meaning: "" },
    Text { command: "spaces", usage: "[OPTIONS]", example: "unfair-toss spaces", meaning: "" },
    Text { command: "completions", usage: "SHELL", example: "unfair-toss completions bash", meaning: "" },
    Text { command: "man", usage: "[COMMAND]", example: "unfair-toss man toss", meaning: "" },
];

/// `program` with its help texts.
pub(crate) fn described(program: Command) -> Command {
    TEXTS.iter().fold(program, |program, text| program.mut_subcommand(text.command, |command| text.added_to(command)))
}

/// The group of an option.
fn group(option: &Arg) -> Option<&'static Group> {
    GROUPS.iter().find(|group| group.names.split(' ').any(|name| name == option.get_id()))
}

/// A section of a manual page: its heading and its paragraphs.
pub(crate) type Section = (&'static str, Vec<&'static str>);

/// `command` with the headings of a manual page for its options, and what stands in the page after them.
pub(crate) fn manual(command: Command) -> (Command, Vec<Section>) {
    let text = TEXTS.iter().find(|text| text.command == command.get_name());
    let has_quantities = command.get_arguments().filter_map(group).any(|group| group.heading.contains('('));
    let sections = [
        ("UNITS", if has_quantities { vec![UNITS] } else { Vec::new() }),
        ("OUTPUT", text.map_or_else(Vec::new, Text::paragraphs)),
        ("EXAMPLES", text.map_or_else(Vec::new, |text| vec![text.example])),
    ];
    let headed = command.mut_args(|option| match group(&option) {
        Some(group) => option.help_heading(group.manual),
        None => option,
    });
    (headed, sections.into_iter().filter(|(_, paragraphs)| !paragraphs.is_empty()).collect())
}

impl Text {
    fn added_to(&self, command: Command) -> Command {
        let after: String = self.paragraphs().iter().map(|paragraph| format!("\n\n{paragraph}")).collect();
        let grouped = command.mut_args(|option| match group(&option) {
            Some(group) => option.help_heading(group.heading),
            None => option,
        });
        grouped
            .override_usage(format!("unfair-toss {} {}", self.command, self.usage))
            .after_help(format!("Example:\n  {}{after}", self.example))
    }

    /// What the words and columns of the answer mean.
    fn paragraphs(&self) -> Vec<&'static str> {
        let has_outcome = !matches!(
            self.command,
            "inverse" | "plan" | "coins" | "solvers" | "models" | "spaces" | "completions" | "man"
        );
        let heads = if has_outcome { HEADS } else { "" };
        self.meaning.split("\n\n").chain([heads]).filter(|paragraph| !paragraph.is_empty()).collect()
    }
}
