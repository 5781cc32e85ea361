//! The theta functions at launch and at landing, cos θ of them, and the bound of its error.

use numerics::UNIT_ROUNDOFF;
use numerics::lanes::{
    Complex, MOST_TURNS, ROUGH_ERROR, Real, Simd, complex_product, rough_cos_of_half, rough_sin_of_half,
};

use super::constants::Constants;

/// What is left of a toss when its roots are to be taken.
pub(super) struct Begun<S: Simd> {
    pub(super) point: Complex<Real<S>>,
    pub(super) is_c: Real<S>,
    pub(super) side: Real<S>,
    pub(super) upright: Real<S>,
    pub(super) condition: Real<S>,
    pub(super) turns: [Real<S>; 2],
    pub(super) decay: Real<S>,
    pub(super) nome: Real<S>,
    pub(super) points: [Complex<Real<S>>; 4],
}

/// cos θ at landing.
pub(super) struct Height<S: Simd> {
    /// cos θ times `norm`.
    pub(super) height: Real<S>,
    pub(super) norm: Real<S>,
    /// The bound of the error of cos θ.
    pub(super) bound: Real<S>,
}

impl<S: Simd> Height<S> {
    /// A number with the sign of cos θ, or 0 if it is within its bound. NaN is not beyond any bound.
    #[inline(always)]
    pub(super) fn written(&self) -> Real<S> {
        let Self { height, norm, bound } = *self;
        (bound * norm).less_than(height.abs()).choose(height, norm.constant(0.0))
    }
}

impl Constants {
    /// cos θ at landing.
    #[inline(always)]
    pub(super) fn landing<S: Simd>(&self, begun: &Begun<S>) -> Height<S> {
        let number = |value: f64| begun.side.constant(value);
        let largest = number(0.0).less_than(begun.side);
        let (middle, upright) = (begun.side * begun.upright, begun.upright);
        let relabelled = |[x, y, z]: [f64; 3]| {
            let [x, y, z] = [number(x), number(y), number(z)];
            [largest.choose(x, z), y * middle, largest.choose(z, x) * upright]
        };
        let decays = begun.decays();
        let terms = Terms::new(decays);
        let [across, precession] = begun.turns;
        let launch = begun.launch();
        let up = Seen::new(terms.at(launch), relabelled(self.vertical));
        let normal = Seen::new(terms.at(complex_product(launch, circle(across))), relabelled(self.normal));
        // The real part of up · conj(normal) e^(-iΩT), and the product along the angular momentum.
        let [cos, sin] = circle(precession);
        let [re, im] = complex_product(up.across, [normal.across[0], -normal.across[1]]);
        let height = re.mul_add(cos, im.mul_add(sin, up.along * normal.along));
        Height { height, norm: up.norm * normal.norm, bound: begun.bound(decays, &terms) }
    }
}

impl<S: Simd> Begun<S> {
    /// e^(-πv/(2K)) and e^(-πc/(2K)), whose product is √q.
    #[inline(always)]
    fn decays(&self) -> [Real<S>; 2] {
        let number = |value: f64| self.nome.constant(value);
        let square = self.nome * self.nome;
        let fourth = square * square;
        // q² = ε + 2ε⁵ + 15ε⁹ + ...
        let series = fourth.mul_add(number(15.0), number(2.0)).mul_add(fourth, number(1.0));
        let root_of_nome = (self.nome * series).sqrt().sqrt();
        let smaller = self.decay.sqrt().sqrt().sqrt().sqrt().sqrt();
        let larger = root_of_nome / smaller;
        let is_c = number(0.5).less_than(self.is_c);
        [is_c.choose(larger, smaller), is_c.choose(smaller, larger)]
    }

    /// e^(ix) at launch.
    #[inline(always)]
    fn launch(&self) -> Complex<Real<S>> {
        let [first, second, third, [x, y]] = self.points;
        // The angle of the last point is so small that it is halved by doubling the first part.
        let turned = direction_of_root(complex_product(third, [x + x, y]));
        let turned = direction_of_root(complex_product(second, turned));
        let turned = direction_of_root(complex_product(first, turned));
        let [x, y] = complex_product(self.point, turned);
        let inverse = x.constant(1.0) / x.mul_add(x, y * y).sqrt();
        [x * inverse, y * inverse]
    }

    /// The bound of the error of cos θ, as docs/proofs/rigid-outcomes.md derives it.
    #[inline(always)]
    fn bound(&self, [v, c]: [Real<S>; 2], terms: &Terms<S>) -> Real<S> {
        let number = |value: f64| v.constant(value);
        let nome = (v * c) * (v * c);
        let third = nome * nome * nome;
        let sixth = third * third;
        let truncated = (sixth * sixth) * third;
        let [across, precession] = self.turns.map(Real::abs);
        let of_turn = self.condition.mul_add(number(130.0 * UNIT_ROUNDOFF), number(650.0 * UNIT_ROUNDOFF));
        let of_turn = truncated.mul_add(number(1e-4), of_turn);
        let fixed = truncated.mul_add(number(7.0), number(10.0 * ROUGH_ERROR));
        let of_terms = of_turn.mul_add(across + number(7.0), fixed);
        let bound = (number(1.0) + terms.slope()).mul_add(of_terms, (of_turn + of_turn) * precession);
        (across + precession).less_than(number(MOST_TURNS)).choose(bound, number(f64::INFINITY))
    }
}

/// The terms j = 1 to 5 of the theta functions: r^(j(j-1)) e^(-πjv/(2K)) ± r^(jj) e^(-πjc/(2K)), r = √q.
struct Terms<S: Simd>([[Real<S>; 2]; 5]);

impl<S: Simd> Terms<S> {
    #[inline(always)]
    fn new([v, c]: [Real<S>; 2]) -> Self {
        let (product, c2) = (v * c, c * c);
        let nome = product * product;
        let (c4, nome_2, step) = (c2 * c2, nome * nome, v * nome);
        let second = v * step;
        let third = second * (step * nome);
        let fourth = third * (step * nome_2);
        let fifth = fourth * (step * (nome_2 * nome));
        let pair = |size: Real<S>, power: Real<S>| [power.mul_add(size, size), (-power).mul_add(size, size)];
        let c8 = c4 * c4;
        Self([pair(v, c2), pair(second, c4), pair(third, c4 * c2), pair(fourth, c8), pair(fifth, c8 * c2)])
    }

    /// A bound of |dθ4/dx| + |dθ1/dx|.
    #[inline(always)]
    fn slope(&self) -> Real<S> {
        let [[first, _], [second, _], [third, _], [fourth, _], [fifth, _]] = self.0;
        let number = |value: f64| first.constant(value);
        let ends = fifth.mul_add(number(5.0), first);
        second.mul_add(number(2.0), third.mul_add(number(3.0), fourth.mul_add(number(4.0), ends)))
    }

    /// θ4 and θ1 at x - iy, from e^(ix).
    #[inline(always)]
    fn at(&self, once: Complex<Real<S>>) -> [Complex<Real<S>>; 2] {
        let one = once[0].constant(1.0);
        let twice = complex_product(once, once);
        let (thrice, four) = (complex_product(once, twice), complex_product(twice, twice));
        let five = complex_product(thrice, twice);
        let [first, second, third, fourth, fifth] = self.0;
        let even = [
            fourth[0].mul_add(four[0], (-second[0]).mul_add(twice[0], one)),
            fourth[1].mul_add(four[1], -(second[1] * twice[1])),
        ];
        let odd = [
            fifth[0].mul_add(five[1], first[0].mul_add(once[1], -(third[0] * thrice[1]))),
            (-fifth[1]).mul_add(five[0], third[1].mul_add(thrice[0], -(first[1] * once[0]))),
        ];
        [even, odd]
    }
}

/// A vector seen from axes whose third is along the angular momentum.
struct Seen<S: Simd> {
    across: Complex<Real<S>>,
    along: Real<S>,
    /// |θ4|² + |θ1|², which both are multiplied by.
    norm: Real<S>,
}

impl<S: Simd> Seen<S> {
    /// θ4² V + θ1² V* - 2i θ4 θ1 z with V = x + iy, and the product with (|θ4|² - |θ1|², 2i θ4* θ1).
    #[inline(always)]
    fn new([even, odd]: [Complex<Real<S>>; 2], [x, y, z]: [Real<S>; 3]) -> Self {
        let (p, q) = (complex_product(even, even), complex_product(odd, odd));
        let twice = z + z;
        let [mixed_re, mixed_im] = complex_product(even, odd);
        let across = [
            mixed_im.mul_add(twice, (p[0] + q[0]).mul_add(x, (q[1] - p[1]) * y)),
            (-mixed_re).mul_add(twice, (p[1] + q[1]).mul_add(x, (p[0] - q[0]) * y)),
        ];
        let sizes = [even[0].mul_add(even[0], even[1] * even[1]), odd[0].mul_add(odd[0], odd[1] * odd[1])];
        let [re, im] = complex_product([even[0], -even[1]], odd);
        let tilted = re.mul_add(y, -(im * x));
        Self { across, along: (sizes[0] - sizes[1]).mul_add(z, tilted + tilted), norm: sizes[0] + sizes[1] }
    }
}

/// A point whose angle is half of that of `point`.
#[inline(always)]
fn direction_of_root<S: Simd>([x, y]: Complex<Real<S>>) -> Complex<Real<S>> {
    [x.mul_add(x, y * y).sqrt() + x, y]
}

/// e^(2πi `turns`), to 3 [`ROUGH_ERROR`].
#[inline(always)]
fn circle<S: Simd>(turns: Real<S>) -> Complex<Real<S>> {
    let part = turns - turns.round();
    let (sin, cos) = (rough_sin_of_half(part), rough_cos_of_half(part));
    [cos.mul_add(cos, -(sin * sin)), (sin + sin) * cos]
}
