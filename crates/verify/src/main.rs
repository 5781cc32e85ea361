//! This is the program `verify`, which `cargo xtask` starts: the suite of this workspace, with all its commands.

use std::process::ExitCode;

use verify::Suite;

fn main() -> ExitCode {
    verify::main(Suite::standard())
}
