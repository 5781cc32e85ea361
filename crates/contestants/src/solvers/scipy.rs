//! DOP853 of SciPy, as a program in Python; see `python/dop853.py`.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use toss::SolverEntry;
use verify::process::{Limits, Program};

/// The entry of SciPy in the Python that has it.
///
/// # Errors
/// Why there is none, in words.
pub fn entry(folder: &Path) -> Result<SolverEntry, String> {
    let python = python(folder)?;
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/dop853.py");
    let command = format!("exec '{}' '{}'", python.display(), script.display());
    Ok(named(&command))
}

/// The entry of SciPy for the program that `command` starts.
pub fn named(command: &str) -> SolverEntry {
    // A long flight to a small tolerance takes a minute.
    let limits = Limits { answer: Duration::from_secs(30), total: Duration::from_secs(3600), ..Limits::default() };
    let summary = "DOP853 of SciPy 1.17 in Python".to_owned();
    Program { summary, limits, ..Program::new(command) }.entry("scipy").with_color([140, 86, 75])
}

/// A Python with SciPy: that of the system, or that of a virtual environment in `folder`, which is made if need be.
fn python(folder: &Path) -> Result<PathBuf, String> {
    let system = PathBuf::from("python3");
    if has_scipy(&system) {
        return Ok(system);
    }
    let own = folder.join("bin/python3");
    if has_scipy(&own) {
        return Ok(own);
    }
    let folder = folder.display().to_string();
    run(&system, &["-m", "venv", &folder])?;
    run(&own, &["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "scipy==1.17.1"])?;
    if has_scipy(&own) { Ok(own) } else { Err("SciPy was installed, but cannot be imported".to_owned()) }
}

fn has_scipy(python: &Path) -> bool {
    run(python, &["-c", "import scipy.integrate"]).is_ok()
}

fn run(program: &Path, arguments: &[&str]) -> Result<(), String> {
    let mut command = Command::new(program);
    let ended = command.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).output();
    let failed = |why: String| Err(format!("`{} {}` failed: {why}", program.display(), arguments.join(" ")));
    match ended {
        Ok(ended) if ended.status.success() => Ok(()),
        Ok(ended) => failed(String::from_utf8_lossy(&ended.stderr).lines().last().unwrap_or_default().to_owned()),
        Err(error) => failed(error.to_string()),
    }
}
