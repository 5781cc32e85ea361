//! Renders one set of rows as text, HTML, JSON, JUnit, annotations of GitHub and charts. Nothing is measured
//! or judged here.

pub mod charts;
pub(crate) mod diagnosis;
mod folder;
pub(crate) mod github;
pub(crate) mod html;
pub(crate) mod junit;
pub(crate) mod pattern;
pub mod report;
pub(crate) mod standing;
pub(crate) mod text;
pub(crate) mod words;

pub use report::Report;

#[cfg(test)]
mod tests {
    use crate::judge::Row;
    pub(super) use crate::judge::tests::row;
    use crate::measure::check::Judges;

    pub(super) fn library(check: &str, subject: &str, measured: f64, limit: f64) -> Row {
        Row { judges: Some(Judges::Library), ..row(check, subject, measured, limit) }
    }
}
