//! Renders one set of rows as text, HTML, JSON, JUnit and charts. Nothing is measured or judged here.

pub mod charts;
pub mod history;
pub mod html;
pub mod junit;
pub mod moves;
pub mod report;
pub mod runs;
pub mod table;

pub use report::Report;
