//! What a page keeps between its questions: the flight that is shown, and the numbers that are read from memory.

use crate::flight::{FRAME, Flight};

/// The state of a page.
#[derive(Debug, Default)]
pub struct Page {
    pub(crate) flight: Option<Flight>,
    pub(crate) numbers: Vec<f64>,
    pub(crate) cells: Vec<u8>,
    frame: [f64; FRAME],
}

impl Page {
    /// The frame of the flight at `time` (s): attitude w, x, y, z (BF to LF); n, the body's x axis and the angular velocity
    /// (LF), of three each; cos θ; height (m). All numbers are 0 if there is no flight, or no state at this time.
    pub fn frame(&mut self, time: f64) -> &[f64] {
        let found = self.flight.as_ref().and_then(|flight| flight.frame(time).ok());
        self.frame = found.unwrap_or_default();
        &self.frame
    }

    /// The trace of the flight, twelve numbers a point: time, cos θ, height, n and the body's x axis (LF), body rate (BF).
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// The cells of the map: 254 times P(heads), or 255 for a launch without an outcome.
    pub fn cells(&self) -> &[u8] {
        &self.cells
    }
}
