//! Runs one case in this process, in a folder of its own.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::{Mutex, mpsc};
use std::time::{Duration, Instant};

use unfair_toss::Streams;

use crate::case::Case;
use crate::check::Ran;

/// A run that takes longer than this is not waited for.
const GIVEN_UP: Duration = Duration::from_secs(20);

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
    // For a case that ends the whole process, as a failed allocation does.
    fs::write(concat!(env!("CARGO_TARGET_TMPDIR"), "/fuzz-case"), pasted(case))
        .expect("the folder of the build is writable");
    forget_peak_of_memory();
    let input = case.input.clone();
    let began = Instant::now();
    let (send, receive) = mpsc::channel();
    // A thread of its own, which can be given up.
    let runs = std::thread::spawn(move || {
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let streams = Streams { input: &mut input.as_slice(), out: &mut out, err: &mut err };
        let code = panic::catch_unwind(AssertUnwindSafe(|| unfair_toss::run(&arguments, streams)));
        _ = send.send(());
        (code.ok().map(i32::from), out, err)
    });
    if receive.recv_timeout(GIVEN_UP).is_err() {
        eprintln!("after {GIVEN_UP:?} no end: {}", pasted(case));
        std::process::exit(101);
    }
    let wall = began.elapsed();
    let (code, out, err) = runs.join().expect("panics of the program are caught");
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

/// The case as it can be pasted into a shell.
pub(crate) fn pasted(case: &Case) -> String {
    let file = |(name, content): &(String, Vec<u8>)| {
        format!("printf %b '{}' > {name}; ", quoted(content, |byte| format!("\\0{byte:03o}")))
    };
    let plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"-_.,:=+/".contains(byte);
    let arguments = case.flat().map(|argument| {
        let text = quoted(argument.as_bytes(), |byte| format!("\\x{byte:02x}"));
        if !text.is_empty() && text.bytes().all(|byte| plain(&byte)) { text } else { format!("$'{text}'") }
    });
    let files: String = case.files.iter().map(file).collect();
    let input = quoted(&case.input, |byte| format!("\\0{byte:03o}"));
    let piped = if input.is_empty() { String::new() } else { format!("printf %b '{input}' | ") };
    format!("{files}{piped}unfair-toss {}", arguments.collect::<Vec<_>>().join(" "))
}

/// Bytes as a word of bash, with the escapes of `$'..'` and of `printf %b`. Long ones are cut in the middle.
fn quoted(bytes: &[u8], escape: fn(u8) -> String) -> String {
    const LONG: usize = 600;
    let readable = |byte: &u8| match byte {
        b'\'' | b'\\' => escape(*byte),
        b' '..=b'~' => char::from(*byte).to_string(),
        _ => escape(*byte),
    };
    let text = |bytes: &[u8]| bytes.iter().map(readable).collect::<String>();
    if bytes.len() <= 2 * LONG {
        return text(bytes);
    }
    let cut = bytes.len() - 2 * LONG;
    format!("{}<{cut} bytes>{}", text(&bytes[..LONG]), text(&bytes[bytes.len() - LONG..]))
}
