//! The program `unfair-toss`: the library of the same name with the arguments, the standard output and the standard
//! error of the process. Tests call the library with others, so that they can run many command lines in one process.

use std::ffi::OsString;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    // These two leave the colours out where there is no terminal.
    let (mut out, mut err) = (anstream::stdout(), anstream::stderr());
    ExitCode::from(unfair_toss::run(&arguments, &mut out, &mut err))
}
