//! Tables as texts: CSV with a heading, as spreadsheets and programs write it.
//!
//! Cells are separated by commas, or by semicolons or tabs if the heading has no comma. Spaces around a cell are passed over, and
//! so are rows without any text. A cell may stand in quotation marks; two in it stand for one. A line ends by a line feed, a
//! carriage return or both, and is counted as an editor does.

use std::fmt;
use std::io::{self, BufRead, BufReader, Read};

use crate::text::{MARK, NotText, looks_like_utf_16};

/// Bytes that are read at a time.
const CAPACITY: usize = 1 << 20;

/// A table that is read row by row.
pub struct Table<R> {
    lines: Lines<R>,
    separator: u8,
    heading: Row,
    row: Row,
}

/// What is wrong with a table, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableError {
    /// The line, from 1.
    pub line: u64,
    /// The cell in it, from 1.
    pub column: usize,
    /// What is wrong there.
    pub message: String,
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}", self.line, self.column, self.message)
    }
}

impl std::error::Error for TableError {}

/// A row of a table.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Row {
    /// The line of its first character, from 1.
    line: u64,
    text: String,
    /// Where each cell ends in the text.
    ends: Vec<usize>,
}

impl Row {
    /// The line in which it begins, from 1.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// Number of cells.
    pub fn columns(&self) -> usize {
        self.ends.len()
    }

    /// Whether it has no text.
    pub fn is_blank(&self) -> bool {
        self.text.is_empty()
    }

    /// The cells, without the spaces around them.
    pub fn cells(&self) -> impl Iterator<Item = &str> + Clone {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.text[start..*end])
    }

    /// The cell in a column, counted from 0; empty where there is none.
    pub fn cell(&self, column: usize) -> &str {
        self.cells().nth(column).unwrap_or_default()
    }

    fn clear(&mut self, line: u64) {
        self.line = line;
        self.text.clear();
        self.ends.clear();
    }

    fn push(&mut self, cell: &str) {
        self.text.push_str(cell.trim());
        self.ends.push(self.text.len());
    }

    fn wrong(&self, message: String) -> TableError {
        TableError { line: self.line, column: 1, message }
    }
}

impl<R: Read> Table<R> {
    /// The table in a text, whose heading is read. That of a text without any row is empty.
    ///
    /// # Errors
    /// [`TableError`] if the heading can't be read.
    pub fn new(from: R) -> Result<Self, TableError> {
        let lines = Lines {
            from: BufReader::with_capacity(CAPACITY, from),
            line: Vec::new(),
            number: 0,
            ends_in_return: false,
        };
        let mut table = Self { lines, separator: b',', heading: Row::default(), row: Row::default() };
        if table.read()? {
            table.heading = std::mem::take(&mut table.row);
        } else {
            table.heading.line = 1;
        }
        Ok(table)
    }

    /// The row with the names of the columns.
    pub fn heading(&self) -> &Row {
        &self.heading
    }

    /// The next row with text; `None` at the end.
    ///
    /// # Errors
    /// [`TableError`] for a row with another number of cells than the heading, a quotation mark that is not closed, and bytes
    /// that are not UTF-8 or can't be read.
    pub fn row(&mut self) -> Result<Option<&Row>, TableError> {
        if !self.read()? {
            return Ok(None);
        }
        let (cells, columns) = (self.row.columns(), self.heading.columns());
        if cells != columns {
            let s = if cells == 1 { "" } else { "s" };
            return Err(self.row.wrong(format!("{cells} cell{s}, but the heading has {columns}")));
        }
        Ok(Some(&self.row))
    }

    /// Whether a line with text has arrived, so that the next row can be read without waiting for whoever writes it.
    pub fn has_row(&self) -> bool {
        let is_blank = |byte: &&u8| byte.is_ascii_whitespace() || **byte == self.separator;
        self.lines.from.buffer().iter().skip_while(is_blank).any(is_end)
    }

    /// Reads the next row with text; false at the end.
    fn read(&mut self) -> Result<bool, TableError> {
        loop {
            let number = self.lines.number + 1;
            self.row.clear(number);
            if !self.lines.read().map_err(|error| self.row.wrong(format!("cannot be read: {error}")))? {
                return Ok(false);
            }
            self.split()?;
            if !self.row.is_blank() {
                return Ok(true);
            }
        }
    }

    /// Splits the line, and those that follow while a quotation mark is open, into the cells of the row.
    fn split(&mut self) -> Result<(), TableError> {
        let Self { lines, separator, row, heading } = self;
        let text = lines.text(*separator)?;
        let text = if row.line == 1 { text.strip_prefix(MARK).unwrap_or(text) } else { text };
        // The first row with text is the heading.
        if heading.columns() == 0 {
            *separator = [b',', b';', b'\t'].into_iter().find(|mark| text.contains(char::from(*mark))).unwrap_or(b',');
        }
        if !text.contains('"') {
            text.split(char::from(*separator)).for_each(|cell| row.push(cell));
            return Ok(());
        }
        let mut record = text.to_owned();
        loop {
            if let Some(cells) = quoted_cells(&record, char::from(*separator)) {
                cells.iter().for_each(|cell| row.push(cell));
                return Ok(());
            }
            loop {
                if !lines.read().map_err(|error| row.wrong(format!("cannot be read: {error}")))? {
                    return Err(row.wrong("a quotation mark is not closed".to_owned()));
                }
                let more = lines.text(*separator)?;
                record.extend(["\n", more]);
                if more.contains('"') {
                    break;
                }
            }
        }
    }
}

/// The cells of a record, of which some may stand in quotation marks; `None` if one of them goes on in the next line.
fn quoted_cells(record: &str, separator: char) -> Option<Vec<String>> {
    let mut cells = Vec::new();
    let mut rest = record;
    loop {
        let mut cell = String::new();
        if let Some(mut quoted) = rest.trim_start_matches(' ').strip_prefix('"') {
            loop {
                let (within, after) = quoted.split_once('"')?;
                cell.push_str(within);
                let Some(more) = after.strip_prefix('"') else {
                    rest = after;
                    break;
                };
                cell.push('"');
                quoted = more;
            }
        }
        let (last, next) = rest.split_once(separator).map_or((rest, None), |(last, next)| (last, Some(next)));
        cells.push(cell + last);
        match next {
            Some(next) => rest = next,
            None => return Some(cells),
        }
    }
}

/// The lines of a text.
struct Lines<R> {
    from: BufReader<R>,
    /// The last line that was read, without its end.
    line: Vec<u8>,
    /// Its number, from 1.
    number: u64,
    /// Whether it ended in a carriage return, to which a line feed may belong that has not arrived yet.
    ends_in_return: bool,
}

impl<R: Read> Lines<R> {
    /// Reads a line; false at the end.
    fn read(&mut self) -> io::Result<bool> {
        self.line.clear();
        let mut is_there = false;
        loop {
            let bytes = match self.from.fill_buf() {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                bytes => bytes?,
            };
            if bytes.is_empty() {
                self.number += u64::from(is_there);
                return Ok(is_there);
            }
            if std::mem::take(&mut self.ends_in_return) && bytes[0] == b'\n' {
                self.from.consume(1);
                continue;
            }
            is_there = true;
            match bytes.iter().position(is_end) {
                None => {
                    let all = bytes.len();
                    self.line.extend_from_slice(bytes);
                    self.from.consume(all);
                }
                Some(end) => {
                    self.line.extend_from_slice(&bytes[..end]);
                    self.ends_in_return = bytes[end] == b'\r';
                    self.from.consume(end + 1);
                    self.number += 1;
                    return Ok(true);
                }
            }
        }
    }

    /// The line as a text.
    fn text(&self, separator: u8) -> Result<&str, TableError> {
        let wrong = |valid: usize| {
            let what = NotText::new(&self.line, valid);
            let column = 1 + what.before.matches(char::from(separator)).count();
            TableError { line: self.number, column, message: what.to_string() }
        };
        if self.number == 1 && looks_like_utf_16(&self.line) {
            return Err(wrong(0));
        }
        std::str::from_utf8(&self.line).map_err(|error| wrong(error.valid_up_to()))
    }
}

fn is_end(byte: &u8) -> bool {
    matches!(*byte, b'\n' | b'\r')
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows with their lines, the heading first.
    fn rows(text: &str) -> Result<Vec<(u64, Vec<String>)>, TableError> {
        // Byte by byte, as a slow pipe gives them.
        struct Slow<'a>(&'a [u8]);
        impl Read for Slow<'_> {
            fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
                let number = self.0.len().min(1);
                self.0.read(&mut to[..number])
            }
        }
        let owned = |row: &Row| (row.line(), row.cells().map(str::to_owned).collect());
        let mut table = Table::new(Slow(text.as_bytes()))?;
        let mut rows = vec![owned(table.heading())];
        while let Some(row) = table.row()? {
            rows.push(owned(row));
        }
        let mut at_once = Table::new(text.as_bytes())?;
        while at_once.row()?.is_some() {}
        Ok(rows)
    }

    fn found(text: &str) -> Vec<(u64, Vec<String>)> {
        rows(text).unwrap_or_else(|error| panic!("{text:?}: {error}"))
    }

    #[test]
    fn lines_are_counted_as_an_editor_counts_them() {
        for end in ["\n", "\r\n", "\r"] {
            let text = "\u{feff}|a,b||1,2|  |,|\"3|4\",5|6,7".replace('|', end);
            let expected = [(2, ["a", "b"]), (4, ["1", "2"]), (7, ["3\n4", "5"]), (9, ["6", "7"])];
            assert_eq!(found(&text), expected.map(|(line, cells)| (line, cells.map(str::to_owned).to_vec())));
        }
    }

    #[test]
    fn cells_are_trimmed_may_be_quoted_and_are_separated_as_the_heading_is() {
        for (text, expected) in [
            (" a , b\n\"1\" , \"x \"\"y\"\", z\" \n", [["a", "b"], ["1", "x \"y\", z"]]),
            ("a;b\n1,5; 2\n", [["a", "b"], ["1,5", "2"]]),
            ("a\tb\n\t2\n", [["a", "b"], ["", "2"]]),
            ("a,b;c\n1,\"\"\n", [["a", "b;c"], ["1", ""]]),
            ("a,b\n5\" disc,\"\"\"\"\n", [["a", "b"], ["5\" disc", "\""]]),
        ] {
            let cells: Vec<Vec<String>> = found(text).into_iter().map(|(_, cells)| cells).collect();
            assert_eq!(cells, expected, "{text:?}");
        }
        assert_eq!(found(""), [(1, vec![])]);
    }

    #[test]
    fn what_is_no_table_is_refused_by_its_place() {
        for (text, line, column, message) in [
            (&b"a,b\r\n1\r\n"[..], 2, 1, "1 cell, but the heading has 2"),
            (b"a;b\n\n1;2;3\n", 3, 1, "3 cells, but the heading has 2"),
            (b"a,b\n1,\"2\n3,4\n", 2, 1, "a quotation mark is not closed"),
            (b"a,b\n1,2\n3,\xe9\n", 3, 2, "the text is not UTF-8"),
            (b"\xff\xfea\0,\0", 1, 1, "the text is not UTF-8 but looks like UTF-16; save it as UTF-8"),
            (b"a\0,\0b\0", 1, 1, "the text is not UTF-8 but looks like UTF-16; save it as UTF-8"),
        ] {
            let wrong = Table::new(text).and_then(|mut table| {
                while table.row()?.is_some() {}
                Ok(())
            });
            let expected = TableError { line, column, message: message.to_owned() };
            assert_eq!(wrong, Err(expected), "{}", String::from_utf8_lossy(text));
        }
    }

    #[test]
    fn a_row_has_arrived_when_its_line_has() {
        /// Gives one text a read.
        struct Parts(std::vec::IntoIter<&'static str>);
        impl Read for Parts {
            fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
                self.0.next().map_or(Ok(0), |part| part.as_bytes().read(to))
            }
        }
        let parts = vec!["a,b\r\n1,2\r", "\n\n3,4\n5,", "6\n,\n  \n"];
        let mut table = Table::new(Parts(parts.into_iter())).unwrap();
        let mut waiting = vec![table.has_row()];
        while table.row().unwrap().is_some() {
            waiting.push(table.has_row());
        }
        // Behind the heading, 1,2, 3,4 (half of a line has arrived) and 5,6 (only rows without text have).
        assert_eq!(waiting, [true, false, false, false]);
    }
}
