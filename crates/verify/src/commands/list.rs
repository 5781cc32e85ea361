//! The command `list` prints the id, the evidence, what is judged and the claim of every check, one line each. The ids are what `--only`
//! takes.

use crate::{CHECKS, Check, files};

pub(super) fn list() -> anyhow::Result<u8> {
    let line =
        |check: &Check| format!("{:<36} [{}; {}] {}\n", check.id, check.basis.name(), check.judges.name(), check.claim);
    files::print(&CHECKS.iter().map(line).collect::<String>())?;
    Ok(0)
}
