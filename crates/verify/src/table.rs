//! Reads and writes tables of numbers as CSV: the baselines and the accuracy of a record. A number in such a table is
//! trusted, so a table with one that cannot have been measured is refused as a whole: compared with NaN nothing is worse,
//! and of two rows of one name only one would count.

use std::collections::BTreeMap;

use anyhow::{anyhow, bail, ensure};
use whole_file::TableError;

use crate::shown::shown;

/// The rows of a table, by the texts in its first columns.
pub(crate) type Rows<const K: usize, const N: usize> = BTreeMap<[String; K], [Option<f64>; N]>;

/// The columns of a table: those whose texts name a row, and those with numbers.
pub(crate) struct Table<const K: usize, const N: usize> {
    pub(crate) name: [&'static str; K],
    pub(crate) numbers: [(&'static str, Kind); N],
}

/// What stands in a column of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A finite number from 0.
    Number,
    /// A whole number from 0, or nothing.
    CountIfAny,
}

impl Kind {
    fn read(self, cell: &str) -> Option<Option<f64>> {
        match self {
            Self::CountIfAny if cell.is_empty() => Some(None),
            // Above 2^53 not every count is an f64, and nothing is called so often.
            Self::CountIfAny => {
                cell.parse::<u64>().ok().filter(|count| *count <= 1 << 53).map(|count| Some(count as f64))
            }
            Self::Number => cell.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0).map(Some),
        }
    }

    fn expected(self) -> &'static str {
        match self {
            Self::Number => "a finite number from 0",
            Self::CountIfAny => "a whole number from 0, or nothing",
        }
    }
}

impl<const K: usize, const N: usize> Table<K, N> {
    fn columns(&self) -> impl Iterator<Item = &'static str> {
        self.name.into_iter().chain(self.numbers.map(|(name, _)| name))
    }

    /// The rows of `text`. Spaces around a cell and blank lines do not count.
    ///
    /// # Errors
    /// If a column is missing, unknown or there twice, a row has too few or too many cells, no name, the name of another
    /// row or a number that is none of its column, or there is no row. The error begins with the line, as an editor counts.
    pub(crate) fn read(&self, text: &str) -> anyhow::Result<Rows<K, N>> {
        let mut table = whole_file::Table::new(text.as_bytes()).map_err(in_line)?;
        let (mut rows, mut lines) = (Rows::new(), BTreeMap::new());
        if !table.heading().is_blank() {
            let heading = (table.heading().line(), cells(table.heading()));
            let places = self.places(&heading.1).map_err(|error| error.context(format!("line {}", heading.0)))?;
            while let Some(row) = table.row().map_err(in_line)? {
                let line = row.line();
                let (name, numbers) =
                    self.row(&cells(row), &places).map_err(|error| error.context(format!("line {line}")))?;
                if let Some(first) = lines.insert(name.clone(), line) {
                    bail!("line {line}: {} is there twice, first in line {first}", name.join(", "));
                }
                rows.insert(name, numbers);
            }
        }
        let columns = || self.columns().collect::<Vec<_>>().join(",");
        ensure!(!rows.is_empty(), "there is no row; expected rows below the heading {}", columns());
        Ok(rows)
    }

    /// In which cell each column stands.
    fn places(&self, heading: &[String]) -> anyhow::Result<Vec<usize>> {
        let columns = || self.columns().collect::<Vec<_>>().join(", ");
        for (place, name) in heading.iter().enumerate() {
            ensure!(self.columns().any(|known| known == name), "the column '{name}' is unknown; known: {}", columns());
            ensure!(!heading[..place].contains(name), "the column {name} is there twice");
        }
        let place = |column| heading.iter().position(|name| name == column);
        let missing = |column| anyhow!("the column {column} is missing; expected {}", columns());
        self.columns().map(|column| place(column).ok_or_else(|| missing(column))).collect()
    }

    fn row(&self, cells: &[String], places: &[usize]) -> anyhow::Result<([String; K], [Option<f64>; N])> {
        let (mut name, mut numbers) = ([const { String::new() }; K], [None; N]);
        for ((column, place), part) in self.name.iter().zip(places).zip(&mut name) {
            part.clone_from(&cells[*place]);
            ensure!(!part.is_empty(), "{column} is empty");
        }
        for (((column, kind), place), number) in self.numbers.iter().zip(&places[K..]).zip(&mut numbers) {
            let Some(found) = kind.read(&cells[*place]) else {
                bail!("{column} = '{}': expected {}", cells[*place], kind.expected());
            };
            *number = found;
        }
        Ok((name, numbers))
    }

    /// The table with `rows` as text.
    ///
    /// # Errors
    /// If it could not be read back: a run must not leave a baseline that every later run refuses.
    pub(crate) fn text(&self, rows: &Rows<K, N>) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(self.columns())?;
        for (name, numbers) in rows {
            let shown = |(number, (_, kind)): (&Option<f64>, &(_, Kind))| match (number, kind) {
                (None, _) => String::new(),
                (Some(number), Kind::CountIfAny) => format!("{number}"),
                (Some(number), Kind::Number) => format!("{number:?}"),
            };
            writer.write_record(name.iter().cloned().chain(numbers.iter().zip(&self.numbers).map(shown)))?;
        }
        let text = String::from_utf8(writer.into_inner()?)?;
        self.read(&text)?;
        Ok(text)
    }
}

fn in_line(TableError { line, message, .. }: TableError) -> anyhow::Error {
    anyhow!("line {line}: {message}")
}

fn cells(row: &whole_file::Row) -> Vec<String> {
    row.cells().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: Table<2, 2> =
        Table { name: ["check", "subject"], numbers: [("error", Kind::Number), ("calls", Kind::CountIfAny)] };

    #[test]
    fn a_table_that_cannot_be_trusted_is_refused_with_the_line_that_an_editor_shows() {
        let heading = "check,subject,error,calls|";
        let number = "expected a finite number from 0";
        for (rows, error) in [
            ("|a,b,1,|a,c,NaN,|", format!("line 4: error = 'NaN': {number}")),
            ("a,b,inf,", format!("line 2: error = 'inf': {number}")),
            ("a,b,1e999,", format!("line 2: error = '1e999': {number}")),
            ("a,b,-1e-9,", format!("line 2: error = '-1e-9': {number}")),
            ("a,b,,", format!("line 2: error = '': {number}")),
            ("a,b,many,", format!("line 2: error = 'many': {number}")),
            ("a,b,1\u{1b},", format!("line 2: error = '1\\u{{1b}}': {number}")),
            ("a,b,1,-7|", "line 2: calls = '-7': expected a whole number from 0, or nothing".to_owned()),
            ("a,b,1,1.5|", "line 2: calls = '1.5': expected a whole number".to_owned()),
            ("a,b,1,|||\"a\", b ,2,7|", "line 5: a, b is there twice, first in line 2".to_owned()),
            ("a,b,1,|   |a,c,1|", "line 4: 3 cells, but the heading has 4".to_owned()),
            ("a,\"b|c\",1,|a,,1,|", "line 4: subject is empty".to_owned()),
            ("||", "there is no row; expected rows below the heading check,subject,error,calls".to_owned()),
        ] {
            for end in ["\n", "\r\n", "\r"] {
                let text = format!("{heading}{rows}").replace('|', end);
                let found = format!("{:#}", TABLE.read(&text).unwrap_err());
                assert!(found.starts_with(&error), "{text}: {found}");
            }
        }
        for (text, error) in [
            ("", "there is no row"),
            (
                "check,subject,error\na,b,1",
                "line 1: the column calls is missing; expected check, subject, error, calls",
            ),
            ("\ncheck,subject,errors,calls\na,b,1,", "line 2: the column 'errors' is unknown; known: check"),
            ("check,subject,error,calls,error\na,b,1,,NaN", "line 1: the column error is there twice"),
        ] {
            let found = format!("{:#}", TABLE.read(text).unwrap_err());
            assert!(found.starts_with(error), "{text}: {found}");
        }
    }

    #[test]
    fn a_table_is_read_with_its_columns_in_any_order_and_written_as_it_is_read() {
        let name = |subject: &str| ["a".to_owned(), subject.to_owned()];
        let rows = Rows::from([(name("b, c"), [Some(0.1 + 0.2), None]), (name("d"), [Some(0.0), Some(77.0)])]);
        let text = "check,subject,error,calls\na,\"b, c\",0.30000000000000004,\na,d,0.0,77\n";
        assert_eq!(TABLE.text(&rows).unwrap(), text);
        assert_eq!(TABLE.read(text).unwrap(), rows);
        let other = " calls , error,subject,check\r\n\r\n, 0.30000000000000004 ,\"b, c\", a\r\n77,-0,d,a";
        assert_eq!(TABLE.read(other).unwrap(), rows);
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            assert!(TABLE.text(&Rows::from([(name("b"), [Some(bad), None])])).is_err(), "{bad}");
        }
    }
}
