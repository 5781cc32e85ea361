//! Reads a file with how many coins of each person landed on the side that had been up.

use std::path::Path;

use csv::StringRecord;
use dynamics::quantity::read_count;
use sampling::{NextStart, SameSide};
use toss::InputError;

use crate::failure::Failure;
use crate::output;

/// The counts of a person.
pub(crate) struct Named {
    /// The person's name, or the number of the row.
    pub(crate) name: String,
    pub(crate) counts: SameSide,
}

/// The people in a CSV file, in order of their first rows. It has the columns `same` and `tosses`, or `start` and `lands` with
/// flips as letters, and then may have `rule`. It may have `person`: the rows of one name are added up. Other columns and rows without any text are passed over.
pub(crate) fn read(path: &Path) -> Result<Vec<Named>, Failure> {
    let text = output::read("counts", path)?;
    people(&text).map_err(|(line, source)| Failure::Row { path: path.display().to_string(), line, source })
}

/// The columns that a file needs.
const COLUMNS: &str = "the columns same and tosses, or start and lands, in the heading";

/// What is wrong, and in which line of the file.
type Wrong = (u64, InputError);

fn people(text: &str) -> Result<Vec<Named>, Wrong> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).trim(csv::Trim::All).from_reader(text.as_bytes());
    let mut rows =
        reader.records().map(|record| Row::new(text, record)).filter(|row| !matches!(row, Ok(row) if row.is_blank()));
    let missing = |field, expected| InputError::Missing { field, expected };
    let heading = rows.next().ok_or((1, missing("counts", COLUMNS)))??;
    let columns = Columns::new(&heading).map_err(|source| (heading.line, source))?;
    let mut people: Vec<Named> = Vec::new();
    for (number, row) in (1_u64..).zip(rows) {
        let row = row?;
        let Named { name, counts } = columns.person(&row, number).map_err(|source| (row.line, source))?;
        match people.iter_mut().find(|person| person.name == name) {
            None => people.push(Named { name, counts }),
            Some(known) => {
                known.counts = SameSide::sum([known.counts, counts]).map_err(|source| (row.line, source))?;
            }
        }
    }
    let is_present = people.iter().any(|person| person.counts.tosses() > 0);
    let nobody = missing("counts", "a person with a toss in a row below the heading");
    if is_present { Ok(people) } else { Err((heading.line, nobody)) }
}

/// A row of the table.
struct Row {
    cells: StringRecord,
    /// The line of its first character, from 1.
    line: u64,
}

impl Row {
    fn new(text: &str, record: Result<StringRecord, csv::Error>) -> Result<Self, Wrong> {
        match record {
            Ok(cells) => Ok(Self { line: line(text, cells.position()), cells }),
            Err(error) => {
                let source =
                    InputError::Malformed { field: "counts", value: error.to_string(), expected: "a table of CSV" };
                Err((line(text, error.position()), source))
            }
        }
    }

    fn is_blank(&self) -> bool {
        self.cells.iter().all(str::is_empty)
    }
}

/// The number of the line at a position, as an editor counts. A position is where the row before ends, so that the ends of
/// empty lines may follow.
fn line(text: &str, position: Option<&csv::Position>) -> u64 {
    let byte = position.and_then(|position| usize::try_from(position.byte()).ok()).unwrap_or(0);
    let bytes = text.as_bytes();
    let blank = bytes.iter().skip(byte).take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
    let before = &bytes[..(byte + blank).min(bytes.len())];
    let ends = (0..before.len()).filter(|at| match before[*at] {
        b'\n' => true,
        b'\r' => before.get(at + 1) != Some(&b'\n'),
        _ => false,
    });
    1 + ends.count() as u64
}

/// Where the columns are, and how many there are.
struct Columns {
    person: Option<usize>,
    flips: Flips,
    number: usize,
}

/// The columns with the flips.
enum Flips {
    Counts { same: usize, tosses: usize },
    Letters { start: usize, lands: usize, rule: Option<usize> },
}

impl Columns {
    fn new(heading: &Row) -> Result<Self, InputError> {
        let place = |field: &'static str| {
            let mut found = (0..).zip(&heading.cells).filter(|(_, name)| name.eq_ignore_ascii_case(field));
            match (found.next(), found.next()) {
                (Some((first, _)), Some((second, _))) => Err(InputError::Malformed {
                    field,
                    value: format!("columns {} and {}", first + 1, second + 1),
                    expected: "one column of this name",
                }),
                (first, _) => Ok(first.map(|(place, _)| place)),
            }
        };
        let needed = |field| place(field)?.ok_or(InputError::Missing { field, expected: COLUMNS });
        let flips = if place("lands")?.is_some() && place("same")?.is_none() {
            Flips::Letters { start: needed("start")?, lands: needed("lands")?, rule: place("rule")? }
        } else {
            Flips::Counts { same: needed("same")?, tosses: needed("tosses")? }
        };
        Ok(Self { flips, person: place("person")?, number: heading.cells.len() })
    }

    /// The person of a row, who is called by its `number` if there are no names.
    fn person(&self, row: &Row, number: u64) -> Result<Named, InputError> {
        if row.cells.len() != self.number {
            let value = format!("{} cells below {} headings", row.cells.len(), self.number);
            return Err(InputError::Malformed { field: "counts", value, expected: "a table of CSV" });
        }
        let count = |field: &'static str, place: usize| {
            let cell = &row.cells[place];
            read_count(cell).ok_or_else(|| InputError::unreadable(field, cell, "a whole number, such as 1000"))
        };
        let counts = match self.flips {
            Flips::Counts { same, tosses } => SameSide::new(count("same", same)?, count("tosses", tosses)?)?,
            Flips::Letters { start, lands, rule } => {
                let rule = rule.map(|place| &row.cells[place]).filter(|text| !text.is_empty());
                SameSide::of_sequence(&row.cells[start], &row.cells[lands], rule.map(NextStart::read).transpose()?)?
            }
        };
        let name = self.person.map_or_else(|| number.to_string(), |place| row.cells[place].to_owned());
        if name.is_empty() {
            return Err(InputError::Missing { field: "person", expected: "a name in each row" });
        }
        Ok(Named { name, counts })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(text: &str) -> Vec<(String, u64, u64)> {
        let of = |Named { name, counts }| (name, counts.same(), counts.tosses());
        people(text).unwrap_or_else(|wrong| panic!("{wrong:?}")).into_iter().map(of).collect()
    }

    #[test]
    fn rows_of_a_name_are_added_up_and_rows_without_text_are_passed_over() {
        let named =
            counts("Person, same ,tosses,day\r\n\r\nAda,31,60,1\r\n,,,\r\nBen,0,0,1\r\n  \r\n\"Ada\",22,4e1,2\r\n");
        assert_eq!(named, [("Ada".to_owned(), 53, 100), ("Ben".to_owned(), 0, 0)]);
        let numbered = counts("\u{feff}tosses,same\n4,3\n\n4,1\n");
        assert_eq!(numbered, [("1".to_owned(), 3, 4), ("2".to_owned(), 1, 4)]);
    }

    /// One row a person or a session, and one row a flip.
    #[test]
    fn flips_may_be_letters() {
        let sessions =
            "person,start,lands,rule\nAda,H,HHTHT TTHHT,last\nBen,H,\"H,T,H\",fixed\nAda,T,TTHH,last\nEve,HTT,HTH,\n";
        let expected = [("Ada".to_owned(), 8, 14), ("Ben".to_owned(), 2, 3), ("Eve".to_owned(), 2, 3)];
        assert_eq!(counts(sessions), expected);
        let flips = "lands,start,person\nH,H,Ada\nT,H,Ada\nT,T,Ben\n";
        assert_eq!(counts(flips), [("Ada".to_owned(), 1, 2), ("Ben".to_owned(), 1, 1)]);
    }

    #[test]
    fn mistakes_are_found_in_the_line_that_an_editor_shows() {
        for end in ["\n", "\r\n", "\r"] {
            for (text, line, field) in [
                ("same,tosses|3,4|||5,4|", 5, "same"),
                ("||same,tosses|  |3,4|,|5,4", 7, "same"),
                ("\u{feff}same,tosses|5,4|", 2, "same"),
                ("person,same,tosses|A,1,2|\"B|b\",1,2|C,x,4|", 5, "same"),
                ("same,tosses||1,2,3|", 3, "counts"),
                ("same,tosses|1|", 2, "counts"),
                ("person,same,tosses|A,1,2||,1,2|", 4, "person"),
                ("person,same,tosses|A,1,18446744073709551615|A,1,1|", 3, "tosses"),
                ("|same,flips|1,2|", 2, "tosses"),
                ("same,tosses,Same|1,2,1|", 1, "same"),
                ("person,same,tosses,person|A,1,2,B|", 1, "person"),
                ("start,lands,rule|H,HTH,last||H,HTX,last|", 4, "lands"),
                ("start,lands|H,H||H,HT|", 4, "rule"),
                ("start,lands,rule|H,HT,always|", 2, "rule"),
                ("start,lands|HT,H|", 2, "start"),
                ("lands,rule|HT,last|", 1, "start"),
                ("same,tosses|0,0||0,0|", 1, "counts"),
                ("same,tosses|", 1, "counts"),
                ("", 1, "counts"),
            ] {
                let wrong = people(&text.replace('|', end)).err().map(|(line, source)| (line, source.field()));
                assert_eq!(wrong, Some((line, field)), "{text}");
            }
        }
    }
}
