//! Reads a table of how many coins of each person landed on the side that had been up, for every interface.

use std::fmt;

use dynamics::InputError;
use dynamics::quantity::read_count;
use whole_file::{Row, Table, TableError};

use crate::same_side::SameSide;
use crate::sequence::{NextStart, landings};

/// What a table says of a person.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// The person's name, or the number of the row.
    pub name: String,
    /// The flips.
    pub counts: SameSide,
    /// Whether each flip landed on the side that had been up, in order; `None` unless all were given as letters.
    pub landings: Option<Vec<bool>>,
}

/// The columns that a file needs.
const COLUMNS: &str = "the columns same and tosses, or start and lands, in the heading";

/// What is wrong with a table of counts.
#[derive(Debug, Clone, PartialEq)]
pub enum CountsError {
    /// It is no table.
    Table(TableError),
    /// A cell can't be used.
    Cell {
        /// The line, from 1.
        line: u64,
        /// The cell in it, from 1.
        column: usize,
        /// What is wrong with it.
        source: InputError,
    },
}

impl From<TableError> for CountsError {
    fn from(error: TableError) -> Self {
        Self::Table(error)
    }
}

impl fmt::Display for CountsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Table(error) => error.fmt(f),
            Self::Cell { line, column, source } => write!(f, "line {line}, column {column}: {source}"),
        }
    }
}

impl std::error::Error for CountsError {}

/// The people in a table, in order of their first rows. It has the columns `same` and `tosses`, or `start` and `lands` with
/// flips as letters, and then may have `rule`. It may have `person`: the rows of one name are added up. Other columns and rows
/// without any text are passed over. A table whose first row ends in two counts has no heading: its columns are `person`, which
/// may be left out, `same` and `tosses`.
///
/// # Errors
/// [`CountsError`], with its place.
pub fn people(text: &[u8]) -> Result<Vec<Named>, CountsError> {
    let mut table = Table::new(text)?;
    let missing = |field, expected| InputError::Missing { field, expected };
    let heading = table.heading().clone();
    let in_heading = |source: InputError| CountsError::Cell { line: heading.line(), column: 1, source };
    if heading.is_blank() {
        return Err(in_heading(missing("counts", COLUMNS)));
    }
    let (columns, mut first) = match Columns::without_heading(&heading) {
        Some(columns) => (columns, Some(heading.clone())),
        None => (Columns::new(&heading).map_err(in_heading)?, None),
    };
    let mut people: Vec<Named> = Vec::new();
    let mut number = 0;
    while let Some(row) =
        first.take().map_or_else(|| Ok(table.row()?.cloned()), |row| Ok::<_, TableError>(Some(row)))?
    {
        number += 1;
        let at =
            |source: InputError| CountsError::Cell { line: row.line(), column: columns.of(source.field()), source };
        let person = columns.person(&row, number).map_err(at)?;
        match people.iter_mut().find(|known| known.name == person.name) {
            None => people.push(person),
            Some(known) => known.add(person).map_err(at)?,
        }
    }
    let is_present = people.iter().any(|person| person.counts.tosses() > 0);
    let nobody = missing("counts", "a person with a toss in a row below the heading");
    if is_present { Ok(people) } else { Err(in_heading(nobody)) }
}

impl Named {
    /// Adds the flips of another row of the same person.
    fn add(&mut self, other: Self) -> Result<(), InputError> {
        self.counts = SameSide::sum([self.counts, other.counts])?;
        self.landings = self.landings.take().zip(other.landings).map(|(earlier, later)| [earlier, later].concat());
        Ok(())
    }
}

/// Where the columns are.
struct Columns {
    person: Option<usize>,
    flips: Flips,
}

/// The columns with the flips.
enum Flips {
    Counts { same: usize, tosses: usize },
    Letters { start: usize, lands: usize, rule: Option<usize> },
}

impl Columns {
    fn new(heading: &Row) -> Result<Self, InputError> {
        let place = |field: &'static str| {
            let mut found = (0..).zip(heading.cells()).filter(|(_, name)| name.eq_ignore_ascii_case(field));
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
        Ok(Self { flips, person: place("person")? })
    }

    /// The columns of a table whose first row ends in two counts, with a name before them or nothing.
    fn without_heading(first: &Row) -> Option<Self> {
        let same = first.columns().checked_sub(2).filter(|before| *before <= 1)?;
        let is_data = first.cells().skip(same).all(|cell| read_count(cell).is_some());
        let (person, flips) = ((same > 0).then_some(0), Flips::Counts { same, tosses: same + 1 });
        is_data.then_some(Self { person, flips })
    }

    /// The column, from 1, of the cell with this field; 1 for what is in no single column.
    fn of(&self, field: &str) -> usize {
        let place = match (field, &self.flips) {
            ("person", _) => self.person,
            ("same", Flips::Counts { same: place, .. })
            | ("tosses", Flips::Counts { tosses: place, .. })
            | ("start", Flips::Letters { start: place, .. })
            | ("lands", Flips::Letters { lands: place, .. }) => Some(*place),
            ("rule", Flips::Letters { rule, .. }) => *rule,
            _ => None,
        };
        place.map_or(1, |place| place + 1)
    }

    /// The person of a row, who is called by its `number` if there are no names.
    fn person(&self, row: &Row, number: u64) -> Result<Named, InputError> {
        let count = |field: &'static str, place: usize| {
            let cell = row.cell(place);
            read_count(cell).ok_or_else(|| InputError::unreadable(field, cell, "a whole number, such as 1000"))
        };
        let (counts, landings) = match self.flips {
            Flips::Counts { same, tosses } => (SameSide::new(count("same", same)?, count("tosses", tosses)?)?, None),
            Flips::Letters { start, lands, rule } => {
                let rule = rule.map(|place| row.cell(place)).filter(|text| !text.is_empty());
                let rule = rule.map(NextStart::read).transpose()?;
                let landings = landings(row.cell(start), row.cell(lands), rule)?;
                (SameSide::of_landings(&landings), Some(landings))
            }
        };
        let name = self.person.map_or_else(|| number.to_string(), |place| row.cell(place).to_owned());
        if name.is_empty() {
            return Err(InputError::Missing { field: "person", expected: "a name in each row" });
        }
        Ok(Named { name, counts, landings })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(text: &str) -> Vec<(String, u64, u64)> {
        let of = |Named { name, counts, .. }| (name, counts.same(), counts.tosses());
        people(text.as_bytes()).unwrap_or_else(|wrong| panic!("{wrong:?}")).into_iter().map(of).collect()
    }

    #[test]
    fn rows_of_a_name_are_added_up_and_rows_without_text_are_passed_over() {
        let named =
            counts("Person, same ,tosses,day\r\n\r\nAda,31,60,1\r\n,,,\r\nBen,0,0,1\r\n  \r\n\"Ada\",22,4e1,2\r\n");
        assert_eq!(named, [("Ada".to_owned(), 53, 100), ("Ben".to_owned(), 0, 0)]);
        let numbered = counts("\u{feff}tosses,same\n4,3\n\n4,1\n");
        assert_eq!(numbered, [("1".to_owned(), 3, 4), ("2".to_owned(), 1, 4)]);
        for text in ["Ada, 11, 20\nBen, 9, 20\nAda, 1, 2", "Ada\t11\t20\r\nBen\t9\t20\r\nAda\t1\t2\r\n"] {
            assert_eq!(counts(text), [("Ada".to_owned(), 12, 22), ("Ben".to_owned(), 9, 20)]);
        }
        assert_eq!(counts("11;20\n9;20\n"), [("1".to_owned(), 11, 20), ("2".to_owned(), 9, 20)]);
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
            for (text, line, column, field) in [
                ("same,tosses|3,4|||5,4|", 5, 1, "same"),
                ("||same,tosses|  |3,4|,|5,4", 7, 1, "same"),
                ("\u{feff}tosses,same|4,5|", 2, 2, "same"),
                ("person;same;tosses|A;1;2|\"B|b\";1;2|C;x;4|", 5, 2, "same"),
                ("same,tosses||1,2,3|", 3, 1, "3 cells, but the heading has 2"),
                ("same,tosses|1|", 2, 1, "1 cell, but the heading has 2"),
                ("person,same,tosses|A,1,2||,1,2|", 4, 1, "person"),
                ("person,same,tosses|A,1,18446744073709551615|A,1,1|", 3, 3, "tosses"),
                ("|same,flips|1,2|", 2, 1, "tosses"),
                ("same,tosses,Same|1,2,1|", 1, 1, "same"),
                ("person,same,tosses,person|A,1,2,B|", 1, 1, "person"),
                ("start,lands,rule|H,HTH,last||H,HTX,last|", 4, 2, "lands"),
                ("start,lands|H,H||H,HT|", 4, 1, "rule"),
                ("start,lands,rule|H,HT,always|", 2, 3, "rule"),
                ("start,lands|HT,H|", 2, 1, "start"),
                ("lands,rule|HT,last|", 1, 1, "start"),
                ("same,tosses|0,0||0,0|", 1, 1, "counts"),
                ("same,tosses|", 1, 1, "counts"),
                ("", 1, 1, "counts"),
                ("Ada,1,2|Ben,3,2|", 2, 2, "same"),
                ("Ada,x,2|", 1, 1, "same"),
                ("A,1,2,3|", 1, 1, "same"),
            ] {
                let (of, in_it, what) = match people(text.replace('|', end).as_bytes()).expect_err(text) {
                    CountsError::Table(TableError { line, column, message }) => (line, column, message),
                    CountsError::Cell { line, column, source } => (line, column, source.field().to_owned()),
                };
                assert_eq!((of, in_it, what.as_str()), (line, column, field), "{text}");
            }
        }
    }
}
