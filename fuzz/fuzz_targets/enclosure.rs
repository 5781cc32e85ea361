//! libFuzzer over [`unfair_toss_fuzz::enclosure::check`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| unfair_toss_fuzz::enclosure::check(data));
