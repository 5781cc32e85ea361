//! libFuzzer over the target that the environment variable `TARGET` names.
#![no_main]

use std::sync::LazyLock;

use unfair_toss_fuzz::{TARGETS, Target};

static CHECK: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("TARGET").unwrap_or_default();
    let named = TARGETS.into_iter().find(|(target, _)| *target == name);
    named.unwrap_or_else(|| panic!("TARGET={name} is none of the targets")).1
});

libfuzzer_sys::fuzz_target!(|data: &[u8]| CHECK(data));
