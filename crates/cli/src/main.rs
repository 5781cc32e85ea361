//! The program `unfair-toss`: the library of the same name with the arguments and the standard streams of the process.
//! Tests call the library with others, so that they can run many command lines in one process.

use std::ffi::OsString;
use std::process::ExitCode;

use unfair_toss::{Streams, run};

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    // The two of anstream leave the colours out where there is no terminal.
    let (mut input, mut out, mut err) = (std::io::stdin(), anstream::stdout(), anstream::stderr());
    ExitCode::from(run(&arguments, Streams { input: &mut input, out: &mut out, err: &mut err }))
}
