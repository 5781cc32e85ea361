//! How far the computed rates of a body are from those of its ideal flight, step by step. An error is split: what leads
//! along the polhode is a shift in time, which is added up, and what leads across it is measured at the end of each step.
//! Next to the middle axis, where the curve is slow and its invariants tell little, the errors are followed as they grow
//! instead.

use super::{INVERSE_ROOT_3, Polhode, ROOT_2, SLOWEST, TINY, exp_above};

/// One step of a flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    /// Its length.
    pub(crate) h: f64,
    /// The bounds of [`Defect`](crate::prove::rigid_step::Defect).
    pub(crate) turn: f64,
    pub(crate) rates: f64,
    pub(crate) rounding: f64,
    /// The computed rates at its end.
    pub(crate) after: [f64; 3],
}

/// What the steps so far add to the error of the turn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    pub(super) polhode: Polhode,
    /// Σ Dₖ.
    pub(super) turn: f64,
    pub(super) along: Along,
    pub(super) growing: Growing,
}

/// Errors of the rates from an ideal flight that is shifted in time, and that shift.
#[derive(Debug, Clone, Copy)]
pub(super) struct Along {
    pub(super) across: f64,
    /// ∫ |e| dt.
    pub(super) integral: f64,
    /// A bound of |s - t| and of ∫ |s' - 1| dt.
    pub(super) shift: f64,
    /// A lower bound of |f|/b at the ideal rates.
    pub(super) speed: f64,
}

/// Errors of the rates from the ideal flight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Growing {
    pub(super) error: f64,
    /// Σ |d| and the roundings, which is all that the rate about the axis of a symmetric body is off.
    pub(super) added: f64,
    /// ∫ |e| dt.
    pub(super) integral: f64,
}

impl Errors {
    /// At the launch of a flight with these computed `rates`.
    pub(crate) fn at_launch(polhode: Polhode, rates: [f64; 3]) -> Self {
        let launched = polhode.launched;
        let along = Along { across: 0.0, integral: 0.0, shift: 0.0, speed: polhode.speed_near(rates, launched) };
        let growing = Growing { error: launched, added: launched, integral: 0.0 };
        let mut errors = Self { polhode, turn: 0.0, along, growing };
        errors.along.step(&polhode, &Step { h: 0.0, turn: 0.0, rates: 0.0, rounding: launched, after: rates });
        errors
    }

    /// Adds those of one step.
    pub(crate) fn add(&mut self, step: &Step) {
        self.turn += step.turn;
        // About an axis, all products of rates are 0, so that none underflows.
        let tiny = if self.polhode.about_axis { 0.0 } else { TINY };
        let step = Step { rates: step.rates + tiny, ..*step };
        self.along.step(&self.polhode, &step);
        self.growing.step(&self.polhode, &step);
    }

    /// The bound (20) of the error of the turn, for a time of flight that is right; infinite or NaN where there is none.
    pub(crate) fn bound(&self) -> f64 {
        let along = 0.5 * self.along.integral + self.polhode.across * self.along.shift;
        self.turn + along.min(0.5 * self.growing.integral) + self.polhode.axes
    }

    /// W.
    pub(crate) fn fastest(&self) -> f64 {
        self.polhode.fastest
    }
}

impl Growing {
    fn step(&mut self, polhode: &Polhode, step: &Step) {
        let error = self.error + step.rates;
        let mut reach = polhode.grown(error, step.h);
        self.added += step.rates;
        if polhode.is_symmetric {
            reach = reach.min(error + polhode.coupling * polhode.fastest * step.h * self.added); // (22)
        }
        self.integral += step.h * reach;
        self.added += step.rounding;
        self.error = reach + step.rounding;
    }
}

impl Along {
    fn step(&mut self, polhode: &Polhode, step: &Step) {
        if self.stepped(polhode, step).is_none() {
            *self = Self { across: f64::INFINITY, integral: f64::INFINITY, shift: f64::INFINITY, speed: 0.0 };
        }
    }

    /// `None` if the conditions (18) do not hold.
    fn stepped(&mut self, polhode: &Polhode, step: &Step) -> Option<()> {
        let Step { h, after, .. } = *step;
        let growth = polhode.growth;
        let reach = polhode.grown(self.across + step.rates, h);
        let error = reach + step.rounding;
        let end = polhode.speed_near(after, error);
        let least = self.speed / exp_above(growth * h);
        // The times by which the shift grows, at no less than this speed (17).
        let time = |speed: f64| -> Option<f64> {
            let tilt = ROOT_2 * polhode.widest * polhode.fastest * error / speed;
            let square = INVERSE_ROOT_3 * polhode.widest * polhode.coupling * reach;
            let arc = (2.0 * growth + square) * h * reach + step.rates + step.rounding;
            (tilt <= 0.25 && speed > SLOWEST).then(|| arc / (1.0 - tilt) / (polhode.coupling * (1.0 - 1e-11) * speed))
        };
        let slowed = growth * time(0.875 * least)?;
        if !(slowed <= 0.125 && end > SLOWEST) {
            return None;
        }
        let speed = least.max((self.speed * end).sqrt() / exp_above(0.5 * growth * h)) * (1.0 - slowed);
        self.shift += time(speed)?;
        self.integral += h * reach;
        self.across = polhode.across(after, error, end);
        self.speed = end;
        Some(())
    }
}
