//! Reads and writes the baselines as CSV. A number in such a table is trusted, so a table with one that cannot have been
//! measured is refused as a whole: compared with NaN nothing is worse, and of two rows of one name only one would count.

use std::collections::BTreeMap;

use anyhow::{anyhow, bail, ensure};
use whole_file::TableError;

use crate::shown::shown;

/// A row of a table with these columns.
pub(crate) struct Row<const N: usize> {
    columns: [&'static str; N],
    /// Its line, from 1, as an editor counts.
    line: u64,
    pub(crate) cells: [String; N],
}

/// The rows of `text`, whose heading is `columns`. The first `named` cells of a row are its name.
///
/// # Errors
/// If the heading is another one, a row has too few or too many cells, no name or that of another row, or there is no row.
/// The error begins with the line.
pub(crate) fn rows<const N: usize>(
    text: &str,
    columns: [&'static str; N],
    named: usize,
) -> anyhow::Result<Vec<Row<N>>> {
    let wrong = |TableError { line, message, .. }: TableError| anyhow!("line {line}: {message}");
    let mut table = whole_file::Table::new(text.as_bytes()).map_err(wrong)?;
    let (heading, expected) = (table.heading(), columns.join(","));
    if !heading.cells().eq(columns) && !heading.is_blank() {
        let found = heading.cells().map(shown).collect::<Vec<_>>().join(",");
        bail!("line {}: the heading is {found}; expected {expected}", heading.line());
    }
    let (mut rows, mut lines) = (Vec::new(), BTreeMap::new());
    while let Some(row) = table.row().map_err(wrong)? {
        let (line, mut cells) = (row.line(), row.cells().map(shown));
        let cells = [(); N].map(|()| cells.next().unwrap_or_default());
        if let Some(empty) = (0..named).find(|column| cells[*column].is_empty()) {
            bail!("line {line}: {} is empty", columns[empty]);
        }
        let name = cells[..named].join(", ");
        if let Some(first) = lines.insert(name.clone(), line) {
            bail!("line {line}: {name} is there twice, first in line {first}");
        }
        rows.push(Row { columns, line, cells });
    }
    ensure!(!rows.is_empty(), "there is no row; expected rows below the heading {expected}");
    Ok(rows)
}

impl<const N: usize> Row<N> {
    /// The finite number from 0 in a column.
    pub(crate) fn number(&self, column: usize) -> anyhow::Result<f64> {
        let number = self.cells[column].parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
        number.ok_or_else(|| self.wrong(column, "a finite number from 0"))
    }

    /// The whole number from 0 in a column, if there is one.
    pub(crate) fn count(&self, column: usize) -> anyhow::Result<Option<u64>> {
        if self.cells[column].is_empty() {
            return Ok(None);
        }
        // Above 2^53 not every count is an f64, and nothing is called so often.
        let count = self.cells[column].parse().ok().filter(|count| *count <= 1 << 53);
        count.map(Some).ok_or_else(|| self.wrong(column, "a whole number from 0, or nothing"))
    }

    fn wrong(&self, column: usize, expected: &str) -> anyhow::Error {
        anyhow!("line {}: {} = '{}': expected {expected}", self.line, self.columns[column], self.cells[column])
    }
}

/// A table with these columns as text.
pub(crate) fn text<const N: usize>(
    columns: [&str; N],
    rows: impl IntoIterator<Item = [String; N]>,
) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns)?;
    rows.into_iter().try_for_each(|row| writer.write_record(row))?;
    Ok(String::from_utf8(writer.into_inner()?)?)
}

#[cfg(test)]
mod tests {
    use crate::judge::baseline::Baseline;

    #[test]
    fn a_table_that_cannot_be_trusted_is_refused_with_the_line_that_an_editor_shows() {
        let number = "expected a finite number from 0";
        for (rows, error) in [
            ("|a,b,1,|a,c,NaN,|", format!("line 4: error = 'NaN': {number}")),
            ("a,b,1e999,", format!("line 2: error = '1e999': {number}")),
            ("a,b,-1e-9,", format!("line 2: error = '-1e-9': {number}")),
            ("a,b,,", format!("line 2: error = '': {number}")),
            ("a,b,1\u{1b},", format!("line 2: error = '1\\u{{1b}}': {number}")),
            ("a,b,1,-7|", "line 2: calls = '-7': expected a whole number from 0, or nothing".to_owned()),
            ("a,b,1,1.5|", "line 2: calls = '1.5': expected a whole number".to_owned()),
            ("a,b,1,|||\"a\", b ,2,7|", "line 5: a, b is there twice, first in line 2".to_owned()),
            ("a,b,1,|   |a,c,1|", "line 4: 3 cells, but the heading has 4".to_owned()),
            ("a,\"b|c\",1,|a,,1,|", "line 4: subject is empty".to_owned()),
            ("||", "there is no row; expected rows below the heading check,subject,error,calls".to_owned()),
        ] {
            for end in ["\n", "\r\n", "\r"] {
                let text = format!("check,subject,error,calls|{rows}").replace('|', end);
                let found = format!("{:#}", Baseline::parse(&text).unwrap_err());
                assert!(found.starts_with(&error), "{text}: {found}");
            }
        }
        for (text, error) in [
            ("", "there is no row"),
            (
                "\ncheck,subject,error\na,b,1",
                "line 2: the heading is check,subject,error; expected check,subject,error,",
            ),
        ] {
            let found = format!("{:#}", Baseline::parse(text).unwrap_err());
            assert!(found.starts_with(error), "{text}: {found}");
        }
    }
}
