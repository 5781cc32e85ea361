//! The motion of a rigid body as a curve of quaternions, in any kind of number: its two frequencies, and the functions
//! that are periodic in them. The frequencies need more digits than the functions, because they are multiplied by the
//! time: the two may be numbers of different kinds.

use dynamics::Body;
use numerics::{DoubleDouble, Elementary};

use super::constants::{Combinations, norm, periodic, separatrix};
use super::form::Form;
use super::phases::Phases;
use super::quaternion::{Quaternion, conjugate, norm_squared, of_axes, product, turned};
use super::regime::{Regime, Start};

/// Steepness of Gaussians up to which they change by less than a few ulp with an ulp of their phase.
const STEEPEST: f64 = 4.0;

/// The turn of a body since its launch as a function of time, by frequencies of the type `N` and functions of the type
/// `M`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve<N, M = N> {
    /// |L|, the angular momentum, in the units of [`Start`].
    momentum: M,
    moments: [M; 3],
    axes: [[M; 3]; 3],
    /// p, from BF to the relabelled axes, of any norm.
    labels: Quaternion<M>,
    /// p⁻¹ R(0)⁻¹, of any norm.
    from_launch: Quaternion<M>,
    /// Ω/2, the rate of the phase about the angular momentum.
    half_rate: N,
    pub(super) form: Form<N, M>,
}

impl<N: Phases<M>, M: Elementary> Curve<N, M> {
    /// The motion of `body` from the `rate` (BF) in a unit near its largest component. `None` if the numbers have too
    /// few digits.
    pub(super) fn new(body: &Body, rate: &[N; 3]) -> Option<Self> {
        let start = Start::new(body, rate)?;
        let m: [N; 3] = [0, 1, 2].map(|axis: usize| start.moments[axis].clone() * start.rate[axis].clone());
        let momentum = norm(&m);
        if start.regime == Regime::Uniform {
            return Some(Self::uniform(&start, &m, &momentum));
        }
        let combinations = Combinations::new(&start, &m);
        let (half_rate, form) = if start.regime == Regime::Separatrix {
            separatrix(&start, &m, &momentum, &combinations)
        } else {
            periodic(&start, &m, &momentum, &combinations)
        };
        let mut curve = Self::of_parts(&start, &momentum, half_rate, form);
        let at_launch = curve.relative(&curve.half_rate.like(0.0));
        curve.from_launch = product(&curve.from_launch, &conjugate(&at_launch));
        Some(curve)
    }

    /// A motion whose R(0) is 1.
    fn of_parts(start: &Start<N>, momentum: &N, half_rate: N, form: Form<N, M>) -> Self {
        let three = |numbers: &[N; 3]| numbers.each_ref().map(N::part);
        let axes = start.axes.each_ref().map(three);
        let labels = of_axes(&axes);
        let from_launch = conjugate(&labels);
        Self { momentum: momentum.part(), moments: three(&start.moments), axes, labels, from_launch, half_rate, form }
    }

    /// Precession about the angular momentum and spin about the axis of symmetry, or about none.
    fn uniform(start: &Start<N>, m: &[N; 3], momentum: &N) -> Self {
        let [first, second, third] = &start.moments;
        let is_0 = |part: N| part.sign() == 0.0;
        let [x, y, _] = &start.rate;
        // The axis that has its moment alone; of a sphere, any one. A body that turns about a principal axis does not
        // spin about another.
        let symmetric = [is_0(third.clone() - second.clone()), is_0(second.clone() - first.clone())];
        let about = if symmetric[0] { 0 } else { 2 };
        let across = if symmetric[0] || symmetric[1] {
            second.clone()
        } else if !is_0(x.clone()) {
            first.clone()
        } else if !is_0(y.clone()) {
            second.clone()
        } else {
            third.clone()
        };
        let spin = if symmetric[0] || symmetric[1] {
            start.rate[about].clone() * (start.moments[about].clone() - across.clone()) / across.clone()
        } else {
            across.like(0.0)
        };
        let is_still = momentum.sign() == 0.0;
        let along = |part: &N| if is_still { part.part() } else { (part.clone() / momentum.clone()).part() };
        let form = Form::Uniform {
            direction: m.each_ref().map(along),
            half_spin: spin.halved(),
            about,
            rate: start.rate.each_ref().map(N::part),
        };
        Self::of_parts(start, momentum, (momentum.clone() / across).halved(), form)
    }

    /// The turn (of any norm) from the body at launch to the body after `time`, in the unit of the inverse rates.
    pub(super) fn turn(&self, time: &N) -> Quaternion<M> {
        self.since_launch(&self.relative(time))
    }

    /// The turn, and the body rate (BF) after `time` in the unit of the rates.
    pub(super) fn turn_and_rate(&self, time: &N) -> (Quaternion<M>, [M; 3]) {
        let relative = self.relative(time);
        (self.since_launch(&relative), self.rate(&relative, time))
    }

    /// The turn since launch to R(t).
    fn since_launch(&self, relative: &Quaternion<M>) -> Quaternion<M> {
        product(&product(&self.from_launch, relative), &self.labels)
    }

    /// R(t), from the relabelled axes to axes whose third is along the angular momentum; of a uniform motion, to
    /// those at launch. Of any norm.
    fn relative(&self, time: &N) -> Quaternion<M> {
        let phase = self.half_rate.clone() * time.clone();
        let ([a, b], phase) = match &self.form {
            Form::Uniform { direction, half_spin, about, .. } => {
                let [sin, cos] = phase.circle();
                let [x, y, z] = direction.clone().map(|part| part * sin.clone());
                let [spin_sin, spin_cos] = (half_spin.clone() * time.clone()).circle();
                let mut spin = [spin_cos, sin.like(0.0), sin.like(0.0), sin.like(0.0)];
                spin[about + 1] = -spin_sin;
                return product(&[cos, x, y, z], &spin);
            }
            Form::Series { pair, frequency, launch } => {
                let (rest, whole) = rounded_off(&(frequency.clone() * time.clone() + launch.clone()));
                let rest = rest.part();
                let [even, odd] = pair.at(&(rest.pi() * rest).sine_and_cosine());
                ([even, signed(odd, whole)], phase)
            }
            Form::Gaussian { pair, turn, frequency, launch } => {
                let quarter = launch.like(0.5);
                let (rest, whole) = rounded_off(&(frequency.clone() * time.clone() + launch.clone() + quarter.clone()));
                let [even, odd] = pair.at(&rest.part());
                // The half-periods since launch less the whole ones of them: a few at most.
                let left = (rest - launch.clone() - quarter).part();
                ([even, signed(odd, whole)], phase + N::of_part(turn.clone() * left))
            }
            Form::Separatrix { rate, launch, angle: [angle_cos, angle_sin] } => {
                let shift = (rate.clone() * time.clone()).part();
                // e^u with u = λt + u0; the larger one of e^(u/2) and e^(-u/2) is divided out.
                let one = shift.like(1.0);
                let falling = (-shift.clone()).exp() / launch.clone();
                let (even, odd) =
                    if falling.to_f64() <= 1.0 { (falling, one) } else { (one, shift.exp() * launch.clone()) };
                let (along, across) = (odd.clone() * angle_cos.clone(), -(odd * angle_sin.clone()));
                ([[along.clone() + even.clone(), across.clone()], [along - even, across]], phase)
            }
        };
        along_momentum(a, b, &phase)
    }

    /// The body rate (BF) at R(t) = `relative`.
    fn rate(&self, relative: &Quaternion<M>, time: &N) -> [M; 3] {
        let size = norm_squared(relative);
        let along_axes = if let Form::Uniform { half_spin, about, rate, .. } = &self.form {
            // ω is fixed but for the spin, which turns it about the axis of symmetry.
            let [sin, cos] = (half_spin.clone() * time.clone()).circle();
            let mut spin = [cos, sin.like(0.0), sin.like(0.0), sin.like(0.0)];
            spin[about + 1] = sin;
            turned(&spin, rate)
        } else {
            let zero = size.like(0.0);
            let m = turned(&conjugate(relative), &[zero.clone(), zero, self.momentum.clone()]);
            let [x, y, z] = m.map(|part| part / size.clone());
            let [first, second, third] = self.moments.clone();
            [x / first, y / second, z / third]
        };
        [0, 1, 2].map(|column: usize| {
            let [first, second, third] = self.axes.each_ref().map(|axis| axis[column].clone());
            let [x, y, z] = along_axes.clone();
            first * x + second * y + third * z
        })
    }

    /// The kind of motion.
    pub(super) fn regime(&self) -> Regime {
        match &self.form {
            Form::Uniform { .. } => Regime::Uniform,
            Form::Separatrix { .. } => Regime::Separatrix,
            Form::Series { frequency, .. } | Form::Gaussian { frequency, .. } if frequency.to_f64() < 0.0 => {
                Regime::AroundSmallest
            }
            Form::Series { .. } | Form::Gaussian { .. } => Regime::AroundLargest,
        }
    }

    /// Whether the motion is on the separatrix or so close to it that rounding a phase to f64 costs digits.
    pub(super) fn is_close_to_separatrix(&self) -> bool {
        match &self.form {
            Form::Uniform { .. } | Form::Series { .. } => false,
            Form::Gaussian { pair, .. } => pair.steepness().to_f64() > STEEPEST,
            Form::Separatrix { .. } => true,
        }
    }

    /// The rates of the two phases: Ω about the angular momentum, and that of the angular momentum in the body.
    pub(super) fn rates(&self) -> [N; 2] {
        let periodic = match &self.form {
            Form::Uniform { half_spin, .. } => half_spin.clone() + half_spin.clone(),
            Form::Series { frequency, .. } | Form::Gaussian { frequency, .. } => frequency.clone() * frequency.pi(),
            Form::Separatrix { rate, .. } => rate.clone(),
        };
        [self.half_rate.clone() + self.half_rate.clone(), periodic]
    }
}

impl<N: Elementary> Curve<N> {
    /// The same motion, rounded to double-double.
    pub(super) fn to_double_double(&self) -> Curve<DoubleDouble> {
        let one = |number: &N| number.to_double_double();
        let three = |numbers: &[N; 3]| numbers.each_ref().map(one);
        let form = match &self.form {
            Form::Uniform { direction, half_spin, about, rate } => Form::Uniform {
                direction: three(direction),
                half_spin: one(half_spin),
                about: *about,
                rate: three(rate),
            },
            Form::Series { pair, frequency, launch } => {
                Form::Series { pair: pair.map(one), frequency: one(frequency), launch: one(launch) }
            }
            Form::Gaussian { pair, turn, frequency, launch } => {
                Form::Gaussian { pair: pair.map(one), turn: one(turn), frequency: one(frequency), launch: one(launch) }
            }
            Form::Separatrix { rate, launch, angle } => {
                Form::Separatrix { rate: one(rate), launch: one(launch), angle: angle.each_ref().map(one) }
            }
        };
        Curve {
            momentum: one(&self.momentum),
            moments: three(&self.moments),
            axes: self.axes.each_ref().map(three),
            labels: self.labels.each_ref().map(one),
            from_launch: self.from_launch.each_ref().map(one),
            half_rate: one(&self.half_rate),
            form,
        }
    }
}

/// A number less its nearest whole number, and that number.
fn rounded_off<N: Elementary>(number: &N) -> (N, f64) {
    let whole = number.to_f64().round_ties_even();
    // A phase that is not finite ends as a number without digits.
    let whole = if whole.is_finite() { whole } else { 0.0 };
    (number.clone() - number.like(whole), whole)
}

/// Both parts reversed for an odd number of half-periods.
fn signed<N: Elementary>(value: [N; 2], half_periods: f64) -> [N; 2] {
    if half_periods.rem_euclid(2.0) == 0.0 { value } else { value.map(|part| -part) }
}

/// The quaternion whose pairs of components are `a` and `b`, each turned by `phase` about the angular momentum.
fn along_momentum<N: Phases<M>, M: Elementary>(a: [M; 2], b: [M; 2], phase: &N) -> Quaternion<M> {
    let [sin, cos] = phase.circle();
    let turned =
        |[re, im]: [M; 2]| [re.clone() * cos.clone() - im.clone() * sin.clone(), re * sin.clone() + im * cos.clone()];
    let ([a_re, a_im], [b_re, b_im]) = (turned(a), turned(b));
    [a_re, b_re, b_im, a_im]
}
