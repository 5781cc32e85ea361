//! `verify list`: the checks.

use verify::{CHECKS, Check, files};

pub(super) fn list() -> anyhow::Result<u8> {
    let line = |check: &Check| format!("{:<36} [{}] {}\n", check.id, check.basis.name(), check.claim);
    files::print(&CHECKS.iter().map(|check| line(check)).collect::<String>())?;
    Ok(0)
}
