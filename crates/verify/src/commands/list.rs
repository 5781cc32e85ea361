//! `verify list` prints the id, the evidence and the claim of every check, one line each. The ids are what `--only`
//! takes.

use verify::{CHECKS, Check, files};

pub(super) fn list() -> anyhow::Result<u8> {
    let line = |check: &Check| format!("{:<36} [{}] {}\n", check.id, check.basis.name(), check.claim);
    files::print(&CHECKS.iter().map(line).collect::<String>())?;
    Ok(0)
}
