//! The program `unfair-toss`: the library of the same name with the solvers of this workspace. Tests call the library
//! with arguments and streams of their own, so that they can run many command lines in one process.

use std::process::ExitCode;

use toss::Registry;

fn main() -> ExitCode {
    unfair_toss::main(Registry::standard())
}
