//! `cargo xtask figures`: draws the figures of `docs/figures`, or tells which of them are not current.

use std::path::Path;
use std::process::{ExitCode, Stdio};

use clap::Args;

use crate::{output, program, root};

/// Draw the figures of docs/figures
#[derive(Debug, Args)]
pub(crate) struct Figures {
    /// Draw them elsewhere instead, and end with 1 if a committed one is not current
    #[arg(long)]
    check: bool,
}

/// A file and what draws it: a program and its arguments, to which `--svg FILE` is added.
struct Figure {
    file: &'static str,
    program: &'static str,
    arguments: &'static str,
}

const TOSS: &str = "unfair-toss";
const VERIFY: &str = "verify";

/// All figures.
const FIGURES: &[Figure] = &[
    Figure { file: "fig2-cheated.svg", program: TOSS, arguments: "trace --rate 1,1,2.5 --speed 3 --points 121" },
    Figure { file: "fig3-tails.svg", program: TOSS, arguments: "trace --rate 2,2,0.5 --speed 3 --points 121" },
    Figure {
        file: "racket.svg",
        program: TOSS,
        arguments: "trace --coin racket --rate 0.12,12,0 --time 1.0472 --points 121",
    },
    Figure {
        file: "engraved.svg",
        program: TOSS,
        arguments: "trace --coin us-quarter-engraved --rate 20,5,20 --speed 3 --points 121",
    },
    Figure { file: "fig4-convergence.svg", program: TOSS, arguments: "convergence --space paper-fig4" },
    Figure {
        file: "map.svg",
        program: TOSS,
        arguments: "map --rate-x 0:30:61 --rate-y 0 --rate-z 0:60:61 --speed 3:5",
    },
    Figure { file: "long-flights.svg", program: TOSS, arguments: "limit" },
    Figure { file: "work-precision.svg", program: VERIFY, arguments: "figure work-precision" },
    Figure { file: "proven-error.svg", program: VERIFY, arguments: "figure proven-error" },
    Figure { file: "atlas-matrix.svg", program: VERIFY, arguments: "figure atlas-matrix" },
];

/// Where the figures are, from the root of the workspace.
const FOLDER: &str = "docs/figures";

impl Figures {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        let committed = root().join(FOLDER);
        if !self.check {
            return draw(&committed).map(|()| ExitCode::SUCCESS);
        }
        let fresh = root().join("target/figures");
        draw(&fresh)?;
        let stale: Vec<&str> = stale(&committed, &fresh).collect();
        for file in &stale {
            output::say(format_args!("not current: {FOLDER}/{file}; `cargo xtask figures` draws it"));
        }
        Ok(ExitCode::from(u8::from(!stale.is_empty())))
    }
}

/// Draws every figure into `folder`.
fn draw(folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    for figure in FIGURES {
        let mut command = program::built(figure.program);
        command.args(figure.arguments.split(' ')).arg("--svg").arg(folder.join(figure.file));
        let status = command.stdout(Stdio::null()).status().map_err(|error| format!("cannot start cargo: {error}"))?;
        if !status.success() {
            return Err(format!("{} was not drawn", figure.file));
        }
    }
    Ok(())
}

/// The figures that differ between `committed` and `fresh`, or that cannot be read.
fn stale(committed: &Path, fresh: &Path) -> impl Iterator<Item = &'static str> {
    let differs = |file: &&str| match (std::fs::read(committed.join(file)), std::fs::read(fresh.join(file))) {
        (Ok(committed), Ok(fresh)) => committed != fresh,
        _ => true,
    };
    FIGURES.iter().map(|figure| figure.file).filter(differs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_folder_holds_the_figures_and_no_other_file() {
        let mut found: Vec<String> = std::fs::read_dir(root().join(FOLDER))
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        let mut expected: Vec<&str> = FIGURES.iter().map(|figure| figure.file).chain(["README.md"]).collect();
        found.sort();
        expected.sort_unstable();
        assert_eq!(found, expected);
    }

    #[test]
    fn the_text_beside_them_names_each_with_its_command() {
        let text = std::fs::read_to_string(root().join(FOLDER).join("README.md")).unwrap();
        for Figure { file, program, arguments } in FIGURES {
            let command = format!("cargo run -q --release --bin {program} -- {arguments} --svg {file}");
            assert!(text.contains(&format!("]({file})")), "{file}");
            assert!(text.contains(&command), "{command}");
        }
    }

    #[test]
    fn a_figure_that_differs_or_lacks_is_named() {
        let committed = root().join(FOLDER);
        assert_eq!(stale(&committed, &committed).count(), 0);
        let files: Vec<&str> = stale(&committed, &root().join("no/such/folder")).collect();
        assert_eq!(files.len(), FIGURES.len());
    }
}
