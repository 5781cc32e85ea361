//! Every target over its seeds.

use std::path::Path;

use unfair_toss_fuzz::TARGETS;

#[test]
fn every_target_accepts_its_seeds() {
    for (name, check) in TARGETS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds").join(name);
        let entries = std::fs::read_dir(&folder).expect("a folder of seeds");
        let mut seeds = 0;
        for entry in entries {
            let path = entry.expect("an entry").path();
            eprintln!("{}", path.display());
            check(&std::fs::read(&path).expect("a seed"));
            seeds += 1;
        }
        assert!(seeds >= 2, "{name}");
    }
}
