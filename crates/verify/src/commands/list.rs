//! `verify list`: the checks.

use verify::CHECKS;

pub(super) fn list() -> u8 {
    for check in CHECKS {
        println!("{:<36} [{}] {}", check.id, check.basis.name(), check.claim);
    }
    0
}
