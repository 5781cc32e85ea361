//! Programs that answer as solvers, for the tests.

use std::path::Path;
use std::process::Command;

/// A loop of the shell that reads the header and then answers each question by `body`, which has the number in `$id`
/// and the time of flight in `$time`.
pub(crate) fn answering(body: &str) -> String {
    format!("read -r header; while IFS=, read -r id i1 i3 a b c w x y z time tolerance i2; do {body}; done")
}

/// The program in Python that the page for authors shows, as a file.
pub(crate) fn example(folder: &Path) -> String {
    let page = include_str!("../../../../docs/your-solver.md");
    let script = page.split("```python mine.py\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a program");
    let file = folder.join("mine.py");
    std::fs::write(&file, script).expect("a file");
    format!("python3 '{}'", file.display())
}

/// Whether there is this program; says so if not.
pub(crate) fn has(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("skipped: there is no {program}");
    }
    found
}
