//! The rows that `sample` prints: a launch and its landing, in CSV or as a JSON object in a line.

use std::io::Write;

use serde::Serialize;
use toss::{Toss, Verdict};

use crate::failure::Failure;
use crate::output::{DataFormat, plain_json, without_sign_of_zero};

/// A launch as it was given.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Given {
    pub(crate) rate: [f64; 3],
    pub(crate) speed: Option<f64>,
    pub(crate) time: Option<f64>,
    pub(crate) gravity: Option<f64>,
    pub(crate) drop: Option<f64>,
    pub(crate) tilt: f64,
    pub(crate) toss: Toss,
}

/// A row: body rate (rad/s), speed (m/s) or time of flight (s), gravity (m/s²), drop (m) and tilt (rad), all as they were
/// given; time of flight (s), cos θ at landing, outcome, and whether it is proven.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Row {
    wx: f64,
    wy: f64,
    wz: f64,
    speed: Option<f64>,
    time: Option<f64>,
    gravity: Option<f64>,
    drop: Option<f64>,
    tilt: f64,
    flight_time: f64,
    cos_tilt: f64,
    outcome: &'static str,
    certified: bool,
}

impl Row {
    pub(crate) fn new(given: &Given, cos_tilt: f64, verdict: Verdict) -> Self {
        let Given { rate, speed, time, gravity, drop, tilt, toss } = *given;
        let [wx, wy, wz] = rate.map(without_sign_of_zero);
        let plain = |value: Option<f64>| value.map(without_sign_of_zero);
        Self {
            wx,
            wy,
            wz,
            speed: plain(speed),
            time: plain(time),
            gravity,
            drop: plain(drop),
            tilt: without_sign_of_zero(tilt),
            flight_time: without_sign_of_zero(toss.launch.flight_time()),
            cos_tilt: without_sign_of_zero(cos_tilt),
            outcome: verdict.outcome().name(),
            certified: verdict.is_proven(),
        }
    }
}

/// Writes rows to standard output as they come.
pub(crate) struct Writer<'a> {
    out: &'a mut (dyn Write + Send),
    format: DataFormat,
    rows: u64,
    is_closed: bool,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(out: &'a mut (dyn Write + Send), format: DataFormat) -> Self {
        Self { out, format, rows: 0, is_closed: false }
    }

    /// Number of rows that were written.
    pub(crate) fn rows(&self) -> u64 {
        self.rows
    }

    /// Whether the reader of standard output has gone, so that no more rows are wanted.
    pub(crate) fn is_closed(&self) -> bool {
        self.is_closed
    }

    pub(crate) fn write(&mut self, rows: &[Row]) -> Result<(), Failure> {
        let text = match self.format {
            DataFormat::Csv => self.csv(rows),
            DataFormat::Json => rows.iter().map(|row| plain_json(row) + "\n").collect::<String>().into_bytes(),
        };
        self.rows += rows.len() as u64;
        self.print(&text)
    }

    /// Prints the heading of a table without rows.
    pub(crate) fn head(&mut self) -> Result<(), Failure> {
        if self.rows > 0 || self.format != DataFormat::Csv {
            return Ok(());
        }
        let table = self.csv(&[Row::default()]);
        let heading = table.split_inclusive(|byte| *byte == b'\n').next().unwrap_or_default();
        self.print(heading)
    }

    /// Ends the output.
    pub(crate) fn finish(&mut self) -> Result<(), Failure> {
        whole_file::unless_closed(self.out.flush()).map_err(Failure::Print)
    }

    fn csv(&self, rows: &[Row]) -> Vec<u8> {
        let mut writer = csv::WriterBuilder::new().has_headers(self.rows == 0).from_writer(Vec::new());
        for row in rows {
            writer.serialize(row).expect("a row of plain data always fits into memory");
        }
        writer.into_inner().expect("memory takes every byte")
    }

    fn print(&mut self, text: &[u8]) -> Result<(), Failure> {
        match self.out.write_all(text) {
            Err(closed) if closed.kind() == std::io::ErrorKind::BrokenPipe => self.is_closed = true,
            written => written.map_err(Failure::Print)?,
        }
        Ok(())
    }
}
