//! `verify list` prints the id, the evidence and the claim of every check, one line each. The ids are what `--only`
//! takes.

use verify::CHECKS;

pub(super) fn list() -> u8 {
    for check in CHECKS {
        println!("{:<36} [{}] {}", check.id, check.basis.name(), check.claim);
    }
    0
}
