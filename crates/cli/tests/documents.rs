//! Runs every command that README.md, DESIGN.md and the pages of `docs` show, and compares its output with the output shown
//! there, so that these pages cannot become outdated. A block of another kind is listed in [`ELSEWHERE`] with what runs
//! it, or with the reason why nothing does. Links have to lead to files and headings that exist.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PROMPT: &str = "$ unfair-toss ";

/// The blocks that this test does not run: document, kind, number of such blocks, the test that runs them or nothing, and
/// what that test does or why there is none.
const ELSEWHERE: &[(&str, &str, usize, &str, &str)] = &[
    ("README.md", "text", 1, "", "a report, which has the date and the times of its run"),
    ("README.md", "sh", 1, "", "it would judge a program of the reader's own"),
    ("README.md", "toml", 1, ".ci/packages", "a crate outside the workspace depends on toss by this line"),
    ("README.md", "sh", 1, ".ci/python", "builds, installs and tests the package for Python"),
    ("README.md", "sh", 1, "", "it would install the program"),
    ("README.md", "rust", 1, "crates/toss/tests/examples.rs", "runs it"),
    ("README.md", "python", 1, "bindings/python/tests/test_package.py", "runs it"),
    ("docs/ci.md", "sh", 1, "crates/verify/tests/all/pages.rs", "runs them in their order"),
    ("docs/ci.md", "sh", 1, "crates/verify/tests/all/pages.rs", "runs the template, without building the checks"),
    ("docs/ci.md", "yaml", 1, "crates/verify/tests/all/pages.rs", "runs the options of the workflow"),
    ("docs/ci.md", "yaml", 1, "", "it needs GitLab; its options are among those of the workflow"),
    ("docs/more-machines.md", "python", 2, "bindings/python/tests/test_more_machines.py", "runs them, with less to do"),
    ("docs/more-machines.md", "python notest", 1, "", "no test has Ray"),
    ("docs/more-machines.md", "sh image", 1, "", "it needs Docker"),
    ("docs/more-machines.md", "sh", 2, "crates/cli/tests/documents.rs", "a job for each part, and their sum, below"),
    ("docs/more-machines.md", "yaml", 1, "bindings/python/tests/test_more_machines.py", "runs the command of each pod"),
    ("docs/guide/machines.md", "sh", 1, "crates/cli/tests/documents.rs", "the parts and their sum, below"),
    ("docs/guide/python.md", "python", 9, "bindings/python/tests/test_package.py", "runs them"),
    ("docs/guide/python.md", "sh", 1, ".ci/python", "builds and installs the package"),
    ("docs/your-solver.md", "text", 1, "crates/verify/tests/process.rs", "compares the columns"),
    (
        "docs/your-solver.md",
        "sh program",
        1,
        "crates/verify/tests/all/pages.rs",
        "runs it with the program of the page",
    ),
    ("docs/your-solver.md", "text program", 1, "crates/verify/tests/all/pages.rs", "compares the report"),
    ("docs/your-solver.md", "rust", 1, "tests/lib.rs", "compiles it"),
    ("docs/your-solver.md", "sh crate", 1, "crates/verify/tests/all/pages.rs", "runs it with the crate of the page"),
    ("docs/your-solver.md", "text crate", 1, "crates/verify/tests/all/pages.rs", "compares the report"),
];

/// A fenced block: what stands behind its opening fence, and its lines.
struct Block {
    kind: String,
    lines: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// README.md, DESIGN.md and the pages of `docs` and `docs/guide`, from the root of the workspace.
fn documents() -> Vec<String> {
    let pages = ["docs", "docs/guide"].into_iter().flat_map(|folder| {
        let entries = fs::read_dir(root().join(folder)).expect("a folder of documents");
        let names = entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"));
        names.filter(|name| name.ends_with(".md")).map(move |name| format!("{folder}/{name}"))
    });
    ["README.md", "DESIGN.md"].map(str::to_owned).into_iter().chain(pages).collect()
}

fn blocks(document: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for line in document.lines() {
        match (line.trim_start().strip_prefix("```"), &mut open) {
            (Some(kind), None) => open = Some(Block { kind: kind.to_owned(), lines: String::new() }),
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (None, Some(block)) => block.lines += &format!("{line}\n"),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block without an end");
    blocks
}

/// The name of the file that a block shows, as in "```toml hand.toml".
fn shown_file(block: &Block) -> Option<&str> {
    block.kind.split_once(' ').map(|(_, name)| name).filter(|name| name.contains('.'))
}

#[test]
fn the_console_blocks_of_the_documents_show_the_output_of_their_commands() {
    let documents = documents();
    let run: usize = std::thread::scope(|scope| {
        let threads: Vec<_> = documents.iter().map(|path| scope.spawn(move || run_console_blocks(path))).collect();
        threads.into_iter().map(|thread| thread.join().expect("the document is current")).sum()
    });
    assert!(run >= 80, "{run} commands");
}

/// Runs the commands of a document in a folder with the files that it shows, and returns how many there are.
fn run_console_blocks(path: &str) -> usize {
    let folder = tempfile::tempdir().expect("a folder");
    let mut run = 0;
    for block in blocks(&read(path)) {
        if let Some(name) = shown_file(&block) {
            let file = folder.path().join(name);
            fs::create_dir_all(file.parent().expect("a folder")).expect("the folder is writable");
            fs::write(file, &block.lines).expect("the folder is writable");
        }
        if block.kind != "console" {
            continue;
        }
        let commands = block.lines.strip_prefix(PROMPT).unwrap_or_else(|| panic!("{path}: {}", block.lines));
        for shown in commands.split(PROMPT) {
            let (command, expected) = shown.split_once('\n').expect("a line for the command");
            assert_eq!(printed(command, folder.path()), expected, "{path}: {command}");
            run += 1;
        }
    }
    run
}

/// The output of `command` as a terminal shows it; the command may end in `| head -n LINES`.
fn printed(command: &str, folder: &Path) -> String {
    let (arguments, lines) = match command.split_once(" | head -n ") {
        Some((arguments, lines)) => (arguments, lines.parse().expect("a number of lines")),
        None => (command, usize::MAX),
    };
    let mut program = Command::new(env!("CARGO_BIN_EXE_unfair-toss"));
    let output = program.args(arguments.split(' ')).current_dir(folder).output().expect("the program starts");
    let [answer, error] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("UTF-8"));
    answer.split_inclusive('\n').take(lines).collect::<String>() + &error
}

#[test]
fn every_other_block_is_run_by_a_test_that_is_named_or_is_left_out_for_a_reason() {
    let mut expected: BTreeMap<(String, String), usize> = BTreeMap::new();
    for (document, kind, count, test, reason) in ELSEWHERE {
        *expected.entry((document.to_string(), kind.to_string())).or_default() += count;
        let name = Path::new(document).file_name().expect("a file").to_str().expect("UTF-8");
        let is_run = || test.starts_with(".ci/") && root().join(test).exists() || read(test).contains(name);
        assert!(!reason.is_empty() && (test.is_empty() || is_run()), "{document}: {test}");
    }
    let mut found = BTreeMap::new();
    for path in documents() {
        for block in blocks(&read(&path)).into_iter().filter(|block| shown_file(block).is_none()) {
            if block.kind != "console" {
                *found.entry((path.clone(), block.kind)).or_default() += 1;
            }
        }
    }
    assert_eq!(found, expected);
}

/// Runs a script with the program in its path and a ten-thousandth of the launches.
fn run_script(script: &str, folder: &Path, environment: &[(&str, String)]) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_unfair-toss")).parent().expect("a folder").display().to_string();
    let script = format!("PATH={program}:$PATH\n{}", script.replace("0000000000 ", "0000 "));
    let mut bash = Command::new("bash");
    bash.args(["-ec", &script]).envs(environment.iter().cloned()).current_dir(folder);
    let output = bash.output().expect("bash starts");
    assert!(output.status.success(), "{script}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

/// The answer of `merge` without its last lines, which say what is proven, beside that of the estimate as a whole.
fn assert_whole(merged: &Output, points: &str) {
    let merged = String::from_utf8_lossy(&merged.stdout);
    let whole = printed(
        &format!("probability --space paper-fig4 --method random --points {points} | head -n 3"),
        Path::new("."),
    );
    assert!(merged.contains(&whole), "{merged}, not {whole}");
}

#[test]
fn the_scripts_for_parts_merge_to_the_whole() {
    let scripts = |document: &str| {
        let blocks = blocks(&read(document)).into_iter().filter(|block| block.kind == "sh");
        let scripts: Vec<String> = blocks.map(|block| block.lines).filter(|lines| lines.contains("parts")).collect();
        scripts
    };
    let folder = tempfile::tempdir().unwrap();
    let loops: Vec<String> = blocks(&read("docs/guide/machines.md"))
        .into_iter()
        .filter(|block| block.kind == "sh" && block.lines.contains("--shard"))
        .map(|block| block.lines)
        .collect();
    assert_eq!(loops.len(), 1);
    assert_whole(&run_script(&loops[0], folder.path(), &[]), "10000");
    let [job, merge] = &scripts("docs/more-machines.md")[..] else { panic!("a job and a sum") };
    for part in 1..=97 {
        let environment = [("SLURM_ARRAY_TASK_ID", part.to_string()), ("SLURM_CPUS_PER_TASK", "2".to_owned())];
        run_script(job, folder.path(), &environment);
    }
    assert_whole(&run_script(merge, folder.path(), &[]), "100000");
}

/// The name by which a link finds a heading: letters, digits and hyphens, in small letters.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

/// The documents whose links are followed: more than those whose blocks are run.
fn linked_documents() -> Vec<String> {
    let others = ["ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/figures/README.md"].map(str::to_owned);
    documents().into_iter().chain(others).collect()
}

#[test]
fn links_lead_to_files_and_headings_that_exist() {
    for path in linked_documents() {
        let text = read(&path);
        let folder = Path::new(&path).parent().expect("a file").to_owned();
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        for target in targets.filter(|target| !target.starts_with("http")) {
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let linked = if file.is_empty() { PathBuf::from(&path) } else { folder.join(file) };
            assert!(root().join(&linked).exists(), "{path}: {target}");
            if !heading.is_empty() {
                let linked = read(linked.to_str().expect("UTF-8"));
                let mut headings = linked.lines().filter(|line| line.starts_with('#'));
                let is_meant = |line: &str| anchor(line.trim_start_matches('#').trim()) == heading;
                assert!(headings.any(is_meant), "{path}: {target}");
            }
        }
    }
}

#[test]
fn blocks_are_found_with_their_kinds_and_anchors_are_those_of_headings() {
    let found = blocks("a\n```toml hand.toml\nx = 1\n```\n```console\n$ b\n```\n");
    assert_eq!(found.len(), 2);
    assert_eq!((shown_file(&found[0]), found[0].lines.as_str()), (Some("hand.toml"), "x = 1\n"));
    assert_eq!((shown_file(&found[1]), found[1].lines.as_str()), (None, "$ b\n"));
    assert_eq!(anchor("Fig. 4: 66 %"), "fig-4-66-");
    assert_eq!(anchor("The γ-ODE: (10) and (11)"), "the-γ-ode-10-and-11");
}
