//! Chooses how solvers are drawn, alike in all charts: the colour comes from the registry, the form of points and lines from
//! the scheme or the formulation.

use chart::{LINE_WIDTH, Marker, Series};
use plotters::style::RGBColor;
use toss::{Formulation, SolverEntry};

/// The colours of a registry.
pub(super) struct Palette<'a>(&'a [SolverEntry]);

impl<'a> Palette<'a> {
    pub(super) fn new(registry: &'a [SolverEntry]) -> Self {
        Self(registry)
    }

    /// The entry of a subject, which is named `solver`, `solver/scheme` or `solver/scheme/formulation`.
    fn entry(&self, subject: &str) -> Option<&SolverEntry> {
        self.0.iter().find(|entry| subject.split('/').next() == Some(entry.name()))
    }

    /// The colour of a subject's solver; grey if it is not in the registry.
    pub(super) fn colour(&self, subject: &str) -> RGBColor {
        let [red, green, blue] = self.entry(subject).map_or([110; 3], SolverEntry::color);
        RGBColor(red, green, blue)
    }

    /// The line of a subject, in the colour of its solver and with the form of its scheme.
    pub(super) fn line(&self, subject: &str, label: String, points: Vec<(f64, f64)>, failures: Vec<f64>) -> Series {
        let (marker, dashed) = match subject.split('/').nth(1) {
            Some("dopri5") => (Marker::Triangle, false),
            Some("rk4") => (Marker::Ring, true),
            Some("taylor") => (Marker::Square, false),
            _ => (Marker::Disc, false),
        };
        Series { label, colour: self.colour(subject), width: LINE_WIDTH, dashed, marker, points, failures }
    }

    /// The contestants of the atlas, each by the first scheme of its solver and with the form of its formulation.
    pub(super) fn contestants(&self) -> Vec<(String, RGBColor, bool, Marker)> {
        let forms = [
            (Formulation::RAW, true, Marker::Ring),
            (Formulation::VERTICAL, true, Marker::Triangle),
            (Formulation::MOMENTUM, false, Marker::Disc),
        ];
        let mut contestants = Vec::new();
        for (formulation, dashed, marker) in forms {
            for entry in self.0 {
                let is_default = formulation == Formulation::default();
                if is_default || entry.formulations().contains(&formulation) {
                    let scheme = entry.schemes().first().map(|scheme| format!("/{}", scheme.name()));
                    let suffix = if is_default { String::new() } else { format!("/{}", formulation.name()) };
                    let name = format!("{}{}{suffix}", entry.name(), scheme.unwrap_or_default());
                    contestants.push((name, self.colour(entry.name()), dashed, marker));
                }
            }
        }
        contestants
    }
}
