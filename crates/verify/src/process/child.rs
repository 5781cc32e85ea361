//! One running process of a program. It is asked one question at a time; what it writes is read by threads of its own,
//! so that a process that hangs, floods or dies is noticed within its limits. It is ended with its children when
//! dropped.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use super::Limits;
use super::protocol::{self, HEADER, Reply, numbered};

/// The longest line that is read in one piece. An answer is far shorter.
const LONGEST_LINE: u64 = 4096;

/// How many times as long as for an answer a process has for its first one.
pub(super) const STARTS: u32 = 6;

/// How often the memory of a process is looked at.
const MEMORY_EVERY: Duration = Duration::from_millis(100);

/// Why a process did not answer.
#[derive(Debug)]
pub(super) struct Fault {
    /// What it did, in words that follow its name.
    pub(super) words: String,
    /// What it wrote, if anything.
    pub(super) line: Option<String>,
    /// Whether it took too long, so that another one may be faster.
    pub(super) is_late: bool,
}

impl From<String> for Fault {
    fn from(words: String) -> Self {
        Self { words, line: None, is_late: false }
    }
}

pub(super) struct Answered {
    pub(super) reply: Reply,
    pub(super) line: String,
}

#[derive(Debug)]
pub(super) struct Process {
    child: Child,
    stdin: Option<ChildStdin>,
    lines: Receiver<String>,
    /// The last line of its standard error, when that was closed.
    last_words: Receiver<String>,
    asked: u64,
    looked: Instant,
}

impl Process {
    /// Starts `command` in the shell, and tells it the columns.
    pub(super) fn start(command: &str) -> Result<Self, String> {
        let mut shell = if cfg!(windows) { Command::new("cmd") } else { Command::new("sh") };
        shell.arg(if cfg!(windows) { "/C" } else { "-c" }).arg(command);
        let piped = shell.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().map_err(|error| format!("could not be started: {error}"))?;
        // A process that writes without end is held up by the pipe behind these lines.
        let (line, lines) = sync_channel(2);
        let (words, last_words) = sync_channel(1);
        if let (Some(stdout), Some(stderr)) = (child.stdout.take(), child.stderr.take()) {
            std::thread::spawn(move || read_lines(BufReader::new(stdout), &line));
            std::thread::spawn(move || read_last_words(BufReader::new(stderr), &words));
        }
        let stdin = child.stdin.take();
        let mut process = Self { child, stdin, lines, last_words, asked: 0, looked: Instant::now() };
        process.write(HEADER)?;
        Ok(process)
    }

    pub(super) fn next(&self) -> u64 {
        self.asked + 1
    }

    /// The answer to `question`, to which this process gives a number. The first answer may take as long as `start`.
    pub(super) fn ask(&mut self, question: &str, start: Duration, limits: &Limits) -> Result<Answered, Fault> {
        if let Ok(line) = self.lines.try_recv() {
            return Err(unasked(&line).into());
        }
        self.asked += 1;
        self.write(&numbered(self.asked, question))?;
        let limit = if self.asked == 1 { start } else { limits.answer };
        let line = self.line(limit, limits)?;
        if self.asked == 1 {
            // By now it has loaded its libraries. A fast program isn't waited for, so that it would not be looked at.
            self.require_memory(limits.memory)?;
        }
        let nonsense = |why| Fault {
            words: format!("wrote {:?} where an answer is expected: {why}", beginning(&line)),
            line: Some(beginning(&line)),
            is_late: false,
        };
        let reply = protocol::answer(&line, self.asked).map_err(nonsense)?;
        Ok(Answered { reply, line: beginning(&line) })
    }

    fn write(&mut self, line: &str) -> Result<(), String> {
        let written = self.stdin.as_mut().map(|stdin| writeln!(stdin, "{line}").and_then(|()| stdin.flush()));
        // What a process wrote before it stopped reading says more than that it did.
        if matches!(written, Some(Ok(()))) || self.asked == 0 { Ok(()) } else { Err(self.ended()) }
    }

    /// The next line of its standard output.
    fn line(&mut self, limit: Duration, limits: &Limits) -> Result<String, Fault> {
        let asked = Instant::now();
        loop {
            if self.looked.elapsed() > MEMORY_EVERY {
                self.require_memory(limits.memory)?;
            }
            match self.lines.recv_timeout(MEMORY_EVERY.min(limit)) {
                Ok(line) => return Ok(line),
                Err(RecvTimeoutError::Disconnected) => return Err(self.ended().into()),
                Err(RecvTimeoutError::Timeout) if asked.elapsed() >= limit => {
                    return Err(Fault { words: self.late(limit, limits), line: None, is_late: true });
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    /// Notes that its memory was looked at, and says if it is too much.
    fn require_memory(&mut self, memory: u64) -> Result<(), String> {
        self.looked = Instant::now();
        let used = resident_bytes(&family(self.child.id()));
        if used <= memory {
            return Ok(());
        }
        Err(format!("used {} MB of memory, and {} MB are its limit", used >> 20, memory >> 20))
    }

    /// What it did in the time `limit`, in which it did not answer.
    fn late(&self, limit: Duration, limits: &Limits) -> String {
        let (number, seconds) = (self.asked, (limit.as_secs_f64() * 1e3).round() / 1e3);
        if waits_for_input(&family(self.child.id())) {
            return format!(
                "read question {number}, wrote no answer within {seconds} s and waits for more input: it has to answer \
                 each line before it reads the next one, and to write out each answer, without buffering"
            );
        }
        // One that replaces another is known to start in less.
        if number == 1 && limit == STARTS * limits.answer {
            let answer = limits.answer.as_secs_f64();
            return format!(
                "gave no first answer within {seconds} s of its start (--answer-seconds {answer} times {STARTS}): if it \
                 takes so long to load its libraries, raise --answer-seconds"
            );
        }
        format!("gave no answer to question {number} within {seconds} s (--answer-seconds)")
    }

    /// Why the process no longer reads or writes. It may be about to end, so it is given a moment.
    fn ended(&mut self) -> String {
        if let Ok(line) = self.lines.try_recv() {
            return unasked(&line);
        }
        let moment = Duration::from_millis(500);
        let said = self.last_words.recv_timeout(moment).unwrap_or_default();
        let closed = Instant::now();
        loop {
            if let Ok(Some(status)) = self.child.try_wait() {
                let said = if said.is_empty() { said } else { format!(": {said}") };
                return format!("ended ({status}) without an answer{said}");
            }
            if closed.elapsed() > moment {
                return "closed its standard input or output without an answer".to_owned();
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let family = family(self.child.id());
        self.stdin = None;
        // An error means that it has ended already.
        let _ = self.child.kill();
        if let [_, children @ ..] = &family[..]
            && !children.is_empty()
        {
            let ids: Vec<String> = children.iter().map(u32::to_string).collect();
            let kill = format!("kill -KILL {} 2>/dev/null", ids.join(" "));
            let _ = Command::new("sh").args(["-c", &kill]).status();
        }
        let _ = self.child.wait();
    }
}

/// Sends the lines of a process until it closes its standard output or nobody receives them. A last line without an end
/// is not sent, because it may be part of one.
fn read_lines(mut stdout: impl BufRead, line: &SyncSender<String>) {
    loop {
        let mut bytes = Vec::new();
        let read = stdout.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut bytes);
        let whole = bytes.ends_with(b"\n") || bytes.len() as u64 == LONGEST_LINE;
        if read.is_err() || !whole || line.send(String::from_utf8_lossy(&bytes).into_owned()).is_err() {
            return;
        }
    }
}

/// Sends the last line that a process wrote to its standard error, when it closes it.
fn read_last_words(mut stderr: impl BufRead, words: &SyncSender<String>) {
    let mut last = String::new();
    loop {
        let mut bytes = Vec::new();
        match stderr.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut bytes) {
            Ok(1..) => {}
            _ => break,
        }
        let text = String::from_utf8_lossy(&bytes);
        if !text.trim().is_empty() {
            last = beginning(&text);
        }
    }
    let _ = words.send(last);
}

fn unasked(line: &str) -> String {
    format!("wrote {:?} without being asked (standard output is for answers alone)", beginning(line))
}

fn beginning(line: &str) -> String {
    const SHOWN: usize = 120;
    let line = line.trim_end();
    let shown: String = line.chars().take(SHOWN).collect();
    if shown.len() < line.len() { shown + "…" } else { shown }
}

/// The process `id` and, on Linux, its descendants.
fn family(id: u32) -> Vec<u32> {
    let processes = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let parents: Vec<(u32, u32)> = processes.filter_map(|entry| parent_of(&entry.path())).collect();
    let mut family = vec![id];
    let mut next = 0;
    while let Some(&parent) = family.get(next) {
        family.extend(parents.iter().filter(|(_, of)| *of == parent).map(|(child, _)| child));
        next += 1;
    }
    family
}

/// The id of a process and that of its parent, from its folder in `/proc`.
fn parent_of(folder: &Path) -> Option<(u32, u32)> {
    let id = folder.file_name()?.to_str()?.parse().ok()?;
    // The name of the program, which may contain anything, stands in parentheses before the state and the parent.
    let stat = std::fs::read_to_string(folder.join("stat")).ok()?;
    Some((id, stat.rsplit_once(") ")?.1.split(' ').nth(1)?.parse().ok()?))
}

/// Whether one of these processes waits for its input, and the others for their children, as far as Linux tells.
fn waits_for_input(processes: &[u32]) -> bool {
    let waits = |id: &u32| std::fs::read_to_string(format!("/proc/{id}/wchan")).unwrap_or_default();
    let places: Vec<String> = processes.iter().map(waits).collect();
    let reads = |place: &String| place.contains("pipe_read");
    places.iter().any(reads) && places.iter().all(|place| reads(place) || place == "do_wait")
}

/// Resident memory of processes (bytes); 0 where there is no `/proc`.
fn resident_bytes(processes: &[u32]) -> u64 {
    let of_one = |id: &u32| {
        let status = std::fs::read_to_string(format!("/proc/{id}/status")).ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
        Some(line.split_whitespace().next()?.parse::<u64>().ok()? << 10)
    };
    processes.iter().filter_map(of_one).sum()
}
