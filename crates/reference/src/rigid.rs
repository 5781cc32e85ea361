//! The toss of a body that is given by three different moments, in closed form and in 256 bits, for speed and for long
//! flights. It takes other ways than the solver that it judges, where there are others: elliptic integrals by Carlson's
//! duplication instead of means, theta functions in one form for all nomes, and rotation matrices instead of
//! quaternions. [`landed`] says for which motions it is vouched for; tests and a check compare it with the [ground
//! truth](super::taylor).
//!
//! E, which decides the regime, is exact.

use dashu_float::FBig;
use dynamics::Toss;

use super::{Big, PRECISION, big, exactly, sin_cos, to_f64};

type Matrix = [[Big; 3]; 3];

/// Bound of the error of each component: 2^-256, and a factor of at most 2^60 for each of the phase, the distance to the
/// separatrix and that to a turn about an axis, of which no two are near their limits at once.
pub(super) const ERROR: f64 = 1e-40;

/// The slowest rate beside the fastest one, about the axes of the middle and of the least rate, relative to it.
const NEAREST_TO_AN_AXIS: f64 = 1e-13;

/// The least |E|, relative to its two terms.
const NEAREST_TO_THE_SEPARATRIX: f64 = 1e-18;

/// The smallest moment, relative to the largest.
const THINNEST: f64 = 1e-10;

/// The longest flight (rad).
const LONGEST: f64 = 1e12;

/// The turn since launch and the rate (rad/s) at landing, of a body with three different moments (f64 differ by 2^-53 of
/// their size at least) which is neither too thin nor too near to a turn about an axis or to the separatrix.
pub(super) fn landed(toss: &Toss) -> Option<([Big; 4], [Big; 3])> {
    let (moments, rate) = (toss.body.moments()?, super::rates(&toss.launch));
    let time = super::time(toss.launch.time_of_flight());
    let sorted = Sorted::new(moments, &rate)?;
    if !sorted.is_inside(&rate, &time) {
        return None;
    }
    let turn = turned(&sorted, &time);
    let momentum = [0, 1, 2].map(|axis: usize| big(moments[axis]) * &rate[axis]);
    let [w, x, y, z] = turn.clone();
    let momentum = super::rotated(&[w, -x, -y, -z], &momentum);
    Some((turn, [0, 1, 2].map(|axis: usize| &momentum[axis] / big(moments[axis]))))
}

/// Whether a body given by its moments needs elliptic functions.
pub(super) fn is_elliptic(toss: &Toss) -> bool {
    toss.body.moments().is_some_and(|moments| Sorted::new(moments, &super::rates(&toss.launch)).is_some())
}

/// A launch in the axes in which its momentum circles the third.
struct Sorted {
    /// Which axis is the first, the second and the third.
    order: [usize; 3],
    moments: [f64; 3],
    rates: [Big; 3],
    /// |E|.
    excess: Big,
    /// |E| relative to its two terms.
    distance: f64,
}

impl Sorted {
    /// `None` if no elliptic function is needed.
    fn new(moments: [f64; 3], rate: &[Big; 3]) -> Option<Self> {
        let mut order = [0, 1, 2];
        order.sort_by(|a: &usize, b: &usize| moments[*a].total_cmp(&moments[*b]));
        let sorted = |order: [usize; 3]| (order.map(|index| moments[index]), order.map(|index| rate[index].clone()));
        let (ascending, rates) = sorted(order);
        let [i1, i2, i3] = ascending.map(exactly);
        let [w1, _, w3] = rates.map(|part| part.with_precision(0).value());
        let terms = [&i3 * (&i3 - &i2) * &w3 * &w3, &i1 * (&i2 - &i1) * &w1 * &w1];
        let excess = &terms[0] - &terms[1];
        let about_one_axis = rate.iter().filter(|part| **part == Big::ZERO).count() > 1;
        let equal = ascending[0] == ascending[1] || ascending[1] == ascending[2];
        if equal || about_one_axis || excess == Big::ZERO {
            return None;
        }
        if excess < Big::ZERO {
            order.reverse();
        }
        let (moments, rates) = sorted(order);
        let excess = size(&excess).with_precision(PRECISION).value();
        let [one, other] = terms;
        let distance = to_f64(&(&excess / (one + other).with_precision(PRECISION).value()));
        Some(Self { order, moments, rates, excess, distance })
    }

    /// Whether the motion is one for which the closed form is vouched for.
    fn is_inside(&self, rate: &[Big; 3], time: &Big) -> bool {
        let [least, _, largest] = {
            let mut moments = self.moments;
            moments.sort_by(f64::total_cmp);
            moments
        };
        let speed = rate.iter().fold(big(0.0), |sum, part| sum + part * part).sqrt();
        let mut parts = rate.each_ref().map(|part| to_f64(&(part / &speed)).abs());
        parts.sort_by(f64::total_cmp);
        least >= THINNEST * largest
            && parts[1] >= NEAREST_TO_AN_AXIS
            && self.distance >= NEAREST_TO_THE_SEPARATRIX
            && to_f64(&(speed * time)) <= LONGEST
    }
}

/// The quaternion of the turn since launch.
fn turned(Sorted { order, moments, rates, excess, .. }: &Sorted, time: &Big) -> [Big; 4] {
    // The new axes as rows: any signs that make them right-handed and the third rate positive.
    let third = if rates[2] < Big::ZERO { -1.0 } else { 1.0 };
    let even = (order[0] + 1) % 3 == order[1];
    let signs = [1.0, if even { third } else { -third }, third];
    let rates = [0, 1, 2].map(|axis: usize| big(signs[axis]) * &rates[axis]);
    let motion = Motion::new(&moments.map(big), &rates, excess);
    let (start, end) = (motion.matrix(&big(0.0)), motion.matrix(time));
    // D = P^T R(0)^T R(t) P, where the rows of P are the new axes.
    let relative = |row: usize, column: usize| (0..3).fold(big(0.0), |sum, k| sum + &start[k][row] * &end[k][column]);
    let mut matrix: Matrix = [0, 1, 2].map(|_| [0, 1, 2].map(|_| big(0.0)));
    for (row, &to_row) in order.iter().enumerate() {
        for (column, &to_column) in order.iter().enumerate() {
            matrix[to_row][to_column] = big(signs[row] * signs[column]) * relative(row, column);
        }
    }
    quaternion_of(&matrix)
}

/// The constants of a motion in sorted axes.
struct Motion {
    lambda: Big,
    k: Big,
    falls: Falls,
    launch: Big,
    omega: Big,
}

/// The factors by which terms of the theta functions fall: exp(-πK'/K), exp(-πv/(2K)) and exp(-π(K' + c)/(2K)).
struct Falls {
    both: Big,
    less: Big,
    more: Big,
}

impl Motion {
    /// From moments that rise or fall, rates with a positive third one, and |E|.
    fn new(i: &[Big; 3], w: &[Big; 3], e: &Big) -> Self {
        let m = [0, 1, 2].map(|axis: usize| &i[axis] * &w[axis]);
        let g = (&m[0] * &m[0] + &m[1] * &m[1] + &m[2] * &m[2]).sqrt();
        let alpha = |a: usize, b: usize| (&i[b] - &i[a]) / (&i[a] * &i[b]);
        let (a12, a13, a23) = (alpha(0, 1), alpha(0, 2), alpha(1, 2));
        let p1 = &a12 * &m[1] * &m[1] + &a13 * &m[2] * &m[2];
        let p3 = &a13 * &m[0] * &m[0] + &a23 * &m[1] * &m[1];
        let below = &a23 * &p1;
        let complement = size(&(&a13 * e)) / (&i[1] * &below);
        let parameter = &a12 * &p3 / &below;
        let lambda = if a13 > Big::ZERO { below.sqrt() } else { -below.sqrt() };
        // F(φ | 1 - s) with tan²φ = a/b, homogeneous in a and b.
        let first = |a: &Big, b: &Big, s: &Big| a.sqrt() * carlson(b.clone(), b + s * a, a + b);
        let k = carlson(big(0.0), complement.clone(), big(1.0));
        let k_prime = carlson(big(0.0), parameter.clone(), big(1.0));
        let c = first(&size(&a23), &size(&a12), &parameter);
        let v = first(&size(&p1), &size(&p3), &parameter);
        let (sin, cos) = (&m[1] * &m[1] * size(&a23), &m[0] * &m[0] * size(&a13));
        // F of u0 or of K - u0, whichever amplitude is the smaller one.
        let folded = if &complement * &sin <= cos {
            first(&sin, &cos, &complement)
        } else {
            &k - first(&cos, &(&complement * &sin), &complement)
        };
        let folded = if w[0] < Big::ZERO { big(2.0) * &k - folded } else { folded };
        let launch = if w[1] < Big::ZERO { -folded } else { folded };
        let rate = pi() / &k;
        let fall = |exponent: &Big| (-(&rate * exponent)).exp();
        let half = |exponent: Big| fall(&(exponent / big(2.0)));
        let falls = Falls { both: fall(&k_prime), less: half(v), more: half(k_prime + c) };
        let slope = slope(&falls);
        let steady = &g / &i[2] + &p3 / (big(2.0) * &g);
        // The slope of ln θ1 at iπv/(2K) is that of ln θ4 at iπc/(2K), but for 1.
        let omega = steady + pi() * &lambda / (big(2.0) * &k) * slope;
        Self { lambda, k, falls, launch, omega }
    }

    /// The matrix that takes components in the body to those along axes of which the third is along the momentum.
    fn matrix(&self, time: &Big) -> Matrix {
        let x = pi() * (&self.lambda * time + &self.launch) / (big(2.0) * &self.k);
        let [a, b] = self.thetas(&x);
        let norm = &a[0] * &a[0] + &a[1] * &a[1] + &b[0] * &b[0] + &b[1] * &b[1];
        let (sin, cos) = sin_cos(&(&self.omega * time / big(2.0)));
        let turned = |part: &[Big; 2]| [&part[0] * &cos - &part[1] * &sin, &part[0] * &sin + &part[1] * &cos];
        let ([w, z], [x, y]) = (turned(&a), turned(&b));
        let two = |p: &Big, q: &Big| big(2.0) * p * q;
        let rows = [
            [&w * &w + &x * &x - &y * &y - &z * &z, two(&x, &y) - two(&w, &z), two(&x, &z) + two(&w, &y)],
            [two(&x, &y) + two(&w, &z), &w * &w - &x * &x + &y * &y - &z * &z, two(&y, &z) - two(&w, &x)],
            [two(&x, &z) - two(&w, &y), two(&y, &z) + two(&w, &x), &w * &w - &x * &x - &y * &y + &z * &z],
        ];
        rows.map(|row| row.map(|part| part / &norm))
    }

    /// θ4 and θ1 of x - iπc/(2K), by as many terms of the Fourier series as it takes, also for nomes next to 1.
    fn thetas(&self, x: &Big) -> [[Big; 2]; 2] {
        let Falls { both, less, more } = &self.falls;
        let (sin, cos) = sin_cos(x);
        let once = [cos, sin];
        let mut angle = [big(1.0), big(0.0)];
        let mut sums = [[big(0.0), big(0.0)], [big(0.0), big(0.0)]];
        // exp(-πs/K), where s is n ((2n - 1) K' + v) = 2n² K' - nc, n (2nK' + c) and 2nK'.
        let (mut grown, mut shrunk, mut fall) = (big(1.0), big(1.0), big(1.0));
        for index in 0_u32.. {
            // n = index/2: whole numbers belong to θ4, the others to θ1.
            let weight = if index == 0 { big(0.5) } else { big(1.0) };
            let sign = if (index / 2) % 2 == 0 { weight } else { -weight };
            let (sum, difference) = ((&grown + &shrunk) * &sign, (&grown - &shrunk) * &sign);
            let [re, im] = if index % 2 == 0 {
                [&angle[0] * sum, &angle[1] * difference]
            } else {
                [&angle[1] * sum, -(&angle[0] * difference)]
            };
            let half = (index % 2) as usize;
            sums[half] = [&sums[half][0] + re, &sums[half][1] + im];
            angle = [&angle[0] * &once[0] - &angle[1] * &once[1], &angle[0] * &once[1] + &angle[1] * &once[0]];
            if index > 2 && to_f64(&grown) < 1e-75 {
                break;
            }
            (grown, shrunk) = (grown * &fall * less, shrunk * &fall * more);
            fall *= both;
        }
        sums
    }
}

/// Σ (-1)^n (2n + 1) q^(2n(n + 1)) cosh (2n + 1)w over the same with sinh and without the factor, less 1; w = πv/K.
fn slope(Falls { both, less, .. }: &Falls) -> Big {
    let (mut above, mut below) = (big(0.0), big(0.0));
    let squared = less * less;
    let mut wave = big(1.0) / &squared;
    let wider = &wave * &wave;
    let quarter = &(both * both) * &(both * both);
    let (mut fall, mut by) = (big(1.0), quarter.clone());
    for n in 0_u32.. {
        let odd = big(2.0 * f64::from(n) + 1.0);
        let size = &fall * &wave;
        let [cosh, sinh] = [&wave + big(1.0) / &wave, &wave - big(1.0) / &wave].map(|sum| sum * &fall);
        (above, below) =
            if n % 2 == 0 { (above + &odd * cosh, below + sinh) } else { (above - &odd * cosh, below - sinh) };
        if n > 1 && to_f64(&(size * odd / &below)).abs() < 1e-75 {
            break;
        }
        (fall, wave) = (fall * &by, wave * &wider);
        by *= &quarter;
    }
    above / below - big(1.0)
}

/// Carlson's R_F by duplication (B. C. Carlson, Numer. Algorithms 10 (1995), 13; DLMF 19.36.1).
fn carlson(mut x: Big, mut y: Big, mut z: Big) -> Big {
    loop {
        let mean = (&x + &y + &z) / big(3.0);
        let off = [&x, &y, &z].map(|part| (&mean - part) / &mean);
        if off.iter().all(|part| to_f64(part).abs() < 2f64.powi(-36)) {
            let [x, y, z] = off;
            let (e2, e3) = (&x * &y - &z * &z, &x * &y * &z);
            let fraction = |numerator: f64, denominator: f64| big(numerator) / big(denominator);
            let series =
                big(1.0) - &e2 * fraction(1.0, 10.0) + &e3 * fraction(1.0, 14.0) + &e2 * &e2 * fraction(1.0, 24.0)
                    - &e2 * &e3 * fraction(3.0, 44.0)
                    - &e2 * &e2 * &e2 * fraction(5.0, 208.0)
                    + &e3 * &e3 * fraction(3.0, 104.0)
                    + &e2 * &e2 * &e3 * fraction(1.0, 16.0);
            return series / mean.sqrt();
        }
        let roots = [&x, &y, &z].map(FBig::sqrt);
        let shift = &roots[0] * &roots[1] + &roots[0] * &roots[2] + &roots[1] * &roots[2];
        [x, y, z] = [x, y, z].map(|part| (part + &shift) / big(4.0));
    }
}

fn quaternion_of(matrix: &Matrix) -> [Big; 4] {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = matrix;
    let one = big(1.0);
    let squares = [&one + xx + yy + zz, &one + xx - yy - zz, &one - xx + yy - zz, &one - xx - yy + zz];
    let largest = (0..4).fold(0, |most, index| if squares[index] > squares[most] { index } else { most });
    let [w, x, y, z] = squares;
    super::normalised(match largest {
        0 => [w, zy - yz, xz - zx, yx - xy],
        1 => [zy - yz, x, xy + yx, xz + zx],
        2 => [xz - zx, xy + yx, y, yz + zy],
        _ => [yx - xy, xz + zx, yz + zy, z],
    })
}

fn size(value: &Big) -> Big {
    if *value < Big::ZERO { -value.clone() } else { value.clone() }
}

fn pi() -> Big {
    Big::pi(PRECISION)
}

#[cfg(test)]
mod tests;
