//! Chooses how solvers are drawn, alike in all charts: the colour comes from the registry or, for a solver without one,
//! from a list of colours that none of the others has; the form of points and lines comes from the scheme.

use chart::{Marker, Series};
use plotters::style::RGBColor;
use toss::SolverEntry;

/// Colours for solvers without one, in this order: dark and light by turns. Each was chosen to differ from those before
/// it, from the colours of the library's solvers and from the purple of remarks also in the simulations of protanopia,
/// deuteranopia and tritanopia by Machado, Oliveira and Fernandes (2009): by at least 16 units of CIELAB.
const FREE: [[u8; 3]; 8] = [
    [230, 159, 0],
    [64, 0, 160],
    [86, 180, 233],
    [96, 32, 0],
    [224, 192, 128],
    [64, 0, 96],
    [128, 64, 224],
    [0, 64, 64],
];

const UNKNOWN: [u8; 3] = [110; 3];

pub(crate) struct Palette<'a> {
    registry: &'a [SolverEntry],
    colours: Vec<[u8; 3]>,
}

impl<'a> Palette<'a> {
    pub(crate) fn new(registry: &'a [SolverEntry]) -> Self {
        let set: Vec<[u8; 3]> = registry.iter().filter_map(SolverEntry::color).collect();
        let mut free = FREE.iter().copied().filter(|colour| !set.contains(colour)).cycle();
        let colours = registry.iter().map(|entry| entry.color().or_else(|| free.next()).unwrap_or(UNKNOWN)).collect();
        Self { registry, colours }
    }

    /// The colour of a subject's solver; grey if it is not in the registry. A subject is named `solver`,
    /// `solver/scheme` or `solver/scheme/formulation`.
    pub(super) fn colour(&self, subject: &str) -> RGBColor {
        let at = self.registry.iter().position(|entry| subject.split('/').next() == Some(entry.name()));
        let [red, green, blue] = at.map_or(UNKNOWN, |at| self.colours[at]);
        RGBColor(red, green, blue)
    }

    /// The line of a subject, in the colour of its solver and with the form of its scheme.
    pub(super) fn line(&self, subject: &str, label: &str, points: Vec<(f64, f64)>, failures: Vec<f64>) -> Series {
        let (marker, dashed) = match subject.split('/').nth(1) {
            Some("dopri5") => (Marker::Triangle, false),
            Some("rk4") => (Marker::Ring, true),
            Some("taylor") => (Marker::Square, false),
            _ => (Marker::Disc, false),
        };
        Series { dashed, failures, ..Series::new(label, self.colour(subject), marker, points) }
    }
}

#[cfg(test)]
mod tests {
    use toss::{ExactSolver, Registry};

    use super::*;

    fn foreign(name: &'static str) -> SolverEntry {
        SolverEntry::new(name, "", |_| Box::new(ExactSolver))
    }

    #[test]
    fn solvers_without_a_colour_get_one_that_no_other_has() {
        let mut registry = Registry::standard().entries().to_vec();
        // The first free colour is taken by somebody who chose it.
        registry.extend([foreign("a"), foreign("b").with_color(FREE[0]), foreign("c"), foreign("d"), foreign("e")]);
        let palette = Palette::new(&registry);
        let mut colours: Vec<RGBColor> = registry.iter().map(|entry| palette.colour(entry.name())).collect();
        colours.push(palette.colour("nobody/rk4"));
        for (index, colour) in colours.iter().enumerate() {
            assert!(!colours[..index].contains(colour), "{colour:?} twice");
        }
        assert_eq!(palette.colour("b/dop853"), RGBColor(230, 159, 0));
        assert_eq!(palette.colour("a"), RGBColor(64, 0, 160));
    }
}
