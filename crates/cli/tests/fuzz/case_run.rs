//! Runs one case in this process, in a folder of its own.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

use unfair_toss::Streams;

use crate::case::Case;
use crate::check::Ran;

/// One case at a time has the working folder and the hook for panics of this process.
static ALONE: Mutex<()> = Mutex::new(());

/// The messages of panics since the last case.
static PANICS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Runs the case by the library of the program.
pub(crate) fn run(case: &Case, folder: &Path) -> Ran {
    let _alone = ALONE.lock().expect("no case ends this thread");
    write_files(case, folder);
    std::env::set_current_dir(folder).expect("the folder is there");
    panic::set_hook(Box::new(|what| PANICS.lock().expect("no panic while one is noted").push(what.to_string())));
    let arguments: Vec<OsString> = std::iter::once("unfair-toss".into()).chain(case.flat().cloned()).collect();
    forget_peak_of_memory();
    let began = Instant::now();
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let streams = Streams { input: &mut case.input.as_slice(), out: &mut out, err: &mut err };
    let code = panic::catch_unwind(AssertUnwindSafe(|| unfair_toss::run(&arguments, streams))).ok().map(i32::from);
    let wall = began.elapsed();
    _ = panic::take_hook();
    let panics = std::mem::take(&mut *PANICS.lock().expect("no panic while one is noted"));
    Ran { code, out, err, panics, wall, memory: peak_of_memory(), files: taken_files(folder) }
}

/// The largest memory of this process (KiB) since it was last forgotten; 0 where the system does not tell.
fn peak_of_memory() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB")?.parse().ok());
    peak.unwrap_or_default()
}

/// Makes the memory of now the largest. Where the system can't, the largest of all cases is compared, which is stricter.
fn forget_peak_of_memory() {
    _ = fs::write("/proc/self/clear_refs", "5");
}

fn write_files(case: &Case, folder: &Path) {
    for (name, content) in &case.files {
        fs::write(folder.join(name), content).expect("the folder is writable");
    }
}

/// The files in the folder, which is empty afterwards.
fn taken_files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries =
        fs::read_dir(folder).expect("the folder is there").map(|entry| entry.expect("the folder is readable"));
    entries
        .map(|entry| {
            let content = fs::read(entry.path()).expect("files are readable");
            fs::remove_file(entry.path()).expect("files can be removed");
            (entry.file_name().to_string_lossy().into_owned(), content)
        })
        .collect()
}
