//! Tests of bodies: which numbers describe one, and their principal axes against nalgebra and in more digits.

use numerics::big::exactly;
use numerics::{Ball, Big};

use super::*;

/// Full tensors with axes in all directions: random ones, nearly symmetric, nearly spherical, and a plate.
fn tensors() -> Vec<[[f64; 3]; 3]> {
    let mut tensors = Vec::new();
    for index in 0..60 {
        let part = |irrational: f64| 2.0 * (f64::from(index + 1) * irrational).fract() - 1.0;
        let [w, x, y, z] = [part(2f64.sqrt()), part(3f64.sqrt()), part(5f64.sqrt()), part(7f64.sqrt())];
        let turn = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
        let axes = turn.to_rotation_matrix().into_inner();
        for moments in [[1.0, 2.0, 2.5], [1.0, 1.0 + 1e-9, 1.5], [1.0, 1.0 + 1e-6, 1.0 + 3e-6], [0.01, 1.0, 1.005]] {
            let scale = 10f64.powi(3 * (index % 7) - 9);
            let tensor = axes * nalgebra::Matrix3::from_diagonal(&Vector3::from(moments)) * axes.transpose() * scale;
            let [xy, xz, yz] = [tensor[(0, 1)], tensor[(0, 2)], tensor[(1, 2)]];
            tensors.push([[tensor[(0, 0)], xy, xz], [xy, tensor[(1, 1)], yz], [xz, yz, tensor[(2, 2)]]]);
        }
    }
    tensors
}

#[test]
fn moments_and_tensors_that_are_no_body_are_refused_with_the_field_at_fault() {
    let refused = |moments: [f64; 3]| Body::from_moments(moments).unwrap_err();
    for (moments, field) in [
        ([f64::NAN, 1.0, 1.0], "I1 [kg m²]"),
        ([1.0, -1.0, 1.0], "I2 [kg m²]"),
        ([1.0, 1.0, f64::INFINITY], "I3 [kg m²]"),
        ([1e-310, 1.0, 1.0], "I1 [kg m²]"),
        ([0.0; 3], "I1 [kg m²]"),
        ([1.0, 2.0, 3.1], "I3 [kg m²]"),
        ([1e300, 1.0, 1.0], "I1 [kg m²]"),
        ([0.0, 1.0, 1f64.next_up()], "I3 [kg m²]"),
        ([1e-20, 1.0, 1f64.next_up()], "I3 [kg m²]"),
        ([0.0, 0.0, 1.0], "I3 [kg m²]"),
    ] {
        assert_eq!(refused(moments).field(), field, "{moments:?}");
    }
    let message = refused([1.0, 3.5, 2.0]).to_string();
    assert_eq!(message, "I2 [kg m²] = 3.5 is larger than I1 + I3 by 0.5: no body has such moments");
    let tensor = |xy: f64, yx: f64| Body::from_tensor([[2.0, xy, 0.0], [yx, 2.0, 0.0], [0.0, 0.0, 3.0]]).unwrap_err();
    assert_eq!(tensor(0.1, 0.2).field(), "Jxy [kg m²]");
    assert_eq!(tensor(2.5, 2.5).field(), "inertia tensor (smallest principal moment) [kg m²]");
    assert_eq!(tensor(1.75, 1.75).field(), "inertia tensor (largest principal moment) [kg m²]");
    for bad in [f64::NAN, f64::INFINITY, 1e308] {
        assert_eq!(tensor(bad, bad).field(), "inertia tensor (largest element) [kg m²]");
    }
    let rod = Body::from_tensor([[0.5, -0.5, 0.0], [-0.5, 0.5, 0.0], [0.0, 0.0, 1.0]]).unwrap_err();
    assert_eq!(rod.field(), "inertia tensor (smallest principal moment) [kg m²]");
}

#[test]
fn plates_and_rods_are_bodies_and_so_are_decimal_plates() {
    for moments in [
        [0.1, 0.7, 0.8],
        [0.3, 0.1, 0.2],
        [0.0, 1.0, 1.0],
        [1.0, 0.0, 1.0],
        [1e-15, 1.0, 1.0],
        [1e300, 2e300, 3e300],
        [3e-308, 4e-308, 5e-308],
    ] {
        let body = Body::from_moments(moments).unwrap();
        assert_eq!(body.moments(), Some(moments));
        assert_eq!(body.coin(), None);
    }
    // A flat disc by any of the constructors, with moments that were rounded.
    let i3 = 2.000_000_000_000_000_4;
    let disc = Body::from(Coin::from_moments(1.0, 2.0).unwrap());
    for found in [
        Body::from_moments([1.0, 1.0, i3]),
        Body::from_listed_moments(&[1.0, i3]),
        Body::from_inertia([1.0, 1.0, i3, 0.0, 0.0, 0.0]),
    ] {
        assert_eq!(found, Ok(disc));
    }
    for found in [Body::from_moments([1.0, i3, 1.0]), Body::from_inertia([1.0, i3, 1.0, 1e-20, 0.0, 0.0])] {
        assert!(found.is_ok_and(|body| body.coin().is_none()));
    }
    // All plates whose moments are decimal numbers of two digits, in all orders.
    for first in 1..100 {
        for second in (1..100).filter(|second| *second != first) {
            let [a, b, c] = [first, second, first + second].map(|part| f64::from(part) / 100.0);
            assert!(Body::from_moments([a, b, c]).is_ok() && Body::from_moments([c, a, b]).is_ok(), "{a} {b} {c}");
        }
    }
}

#[test]
fn a_body_with_two_equal_moments_is_a_coin_with_all_its_bits() {
    let coin = Coin::from_cylinder(0.003, 0.01874, 0.00114).unwrap();
    assert_eq!(Body::from(coin).coin(), Some(coin));
    let from_moments = Body::from_moments([coin.i1(), coin.i1(), coin.i3()]).unwrap();
    assert_eq!(from_moments.coin(), Some(Coin::from_moments(coin.i1(), coin.i3()).unwrap()));
    assert_eq!(Body::from_moments([1.0, 2.0, 2.0]).unwrap().coin(), None, "symmetric about x, not about n");
    let diagonal = Body::from_tensor([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]]).unwrap();
    assert_eq!(diagonal.coin(), Some(Coin::from_moments(1.0, 1.5).unwrap()));
}

#[test]
fn given_moments_are_sorted_into_right_handed_axes() {
    for moments in
        [[1.0, 2.0, 2.5], [2.0, 1.0, 2.5], [2.5, 2.0, 1.0], [1.0, 2.5, 2.0], [2.0, 2.5, 1.0], [2.5, 1.0, 2.0]]
    {
        let body = Body::from_moments(moments).unwrap();
        assert_eq!(body.principal_moments(), [1.0, 2.0, 2.5]);
        let axes = body.rigid().principal().axes.map(|axis| Vector3::from(axis.map(DoubleDouble::hi)));
        assert_eq!(axes[0].cross(&axes[1]), axes[2], "{moments:?}");
        for (axis, moment) in axes.iter().zip(body.principal_moments()) {
            assert_eq!(body.angular_momentum(axis), axis * moment);
        }
    }
}

/// nalgebra's eigenvalues are right to f64. The axes are judged by J axis = moment axis, in more digits.
#[test]
fn principal_axes_are_those_of_nalgebra_and_eigenvectors_in_double_double() {
    let big = |value: DoubleDouble| (exactly(value.hi()) + exactly(value.lo())).with_precision(300).value();
    for tensor in tensors() {
        let body = Body::from_tensor(tensor).unwrap();
        let mut eigenvalues: [f64; 3] = nalgebra::Matrix3::from(tensor).symmetric_eigenvalues().into();
        eigenvalues.sort_by(f64::total_cmp);
        let PrincipalAxes { moments, axes } = *body.rigid().principal();
        let largest = moments[2].hi();
        for (moment, eigenvalue) in moments.iter().zip(eigenvalues) {
            assert!((moment.hi() - eigenvalue).abs() < 1e-14 * largest, "{tensor:?}: {eigenvalue}");
        }
        for (index, axis) in axes.iter().enumerate() {
            let axis = axis.map(big);
            for (row, part) in tensor.iter().zip(&axis) {
                let along =
                    row.iter().zip(&axis).fold(Big::ZERO, |sum, (element, part)| sum + exactly(*element) * part);
                let off = (along - big(moments[index]) * part).to_f64().value().abs() / largest;
                assert!(off < 2f64.powi(-98), "{tensor:?}: 2^{}", off.log2());
            }
            for (other, expected) in axes.iter().zip([0, 1, 2].map(|other| f64::from(u8::from(other == index)))) {
                let cos = axis.iter().zip(other).fold(Big::ZERO, |sum, (a, b)| sum + a * big(*b));
                assert!((cos - exactly(expected)).to_f64().value().abs() < 2f64.powi(-98), "{tensor:?}");
            }
        }
        let balls = body.rigid().scaled_principal(&Ball::new(DoubleDouble::ZERO, 0.0));
        assert!(balls.moments.iter().all(|ball| ball.radius() < 1e-26 * ball.midpoint().hi()), "{balls:?}");
    }
}

#[test]
fn euler_s_equations_conserve_momentum_and_energy_and_those_of_a_coin_are_its_own() {
    let rate = Vector3::new(0.5, -1.5, 4.0);
    let mut bodies: Vec<Body> = tensors().into_iter().map(|tensor| Body::from_tensor(tensor).unwrap()).collect();
    bodies.extend(
        [[1.0, 2.0, 2.5], [2.5, 2.0, 1.0], [0.1, 0.7, 0.8], [0.0, 1.0, 1.0]].map(|m| Body::from_moments(m).unwrap()),
    );
    for body in bodies {
        let acceleration = body.rigid().acceleration(&rate);
        let torque = body.angular_momentum(&rate).cross(&rate);
        let size = body.principal_moments()[2];
        assert!((body.angular_momentum(&acceleration) - torque).norm() < 1e-13 * size, "{body:?}");
        assert!(body.angular_momentum(&rate).dot(&acceleration).abs() < 1e-12 * size, "{body:?}");
        assert_eq!(body.kinetic_energy(&rate), 0.5 * body.angular_momentum(&rate).dot(&rate));
    }
    let coin = Coin::from_moments(2.0, 3.0).unwrap();
    assert_eq!(Body::from(coin).rigid().acceleration(&rate), Vector3::new(3.0, 1.0, 0.0));
}

#[test]
fn moments_of_any_size_give_the_same_scaled_axes() {
    let one = Body::from_moments([1.0, 2.0, 2.5]).unwrap().rigid().scaled_principal(&DoubleDouble::ZERO);
    for exponent in [-1021, -300, 0, 300, 1021] {
        let moments = [1.0, 2.0, 2.5].map(|moment| moment * 2f64.powi(exponent));
        assert_eq!(
            Body::from_moments(moments).unwrap().rigid().scaled_principal(&DoubleDouble::ZERO),
            one,
            "{exponent}"
        );
    }
}

/// Tensors with moments that are nearly or exactly equal, or that differ by small elements alone.
fn close_tensors() -> Vec<[[f64; 3]; 3]> {
    let symmetric = |[xx, yy, zz, xy, xz, yz]: [f64; 6]| [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let mut inertia = Vec::new();
    for exponent in [-16, -17, -18, -19, -25, -40, -48, -49, -50, -100, -145, -200, -290, -310, -323] {
        let tiny = 10f64.powi(exponent);
        for [xy, xz, yz] in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [1.0, 0.5, -0.7], [tiny.sqrt(), 0.0, 1.0]] {
            let [xy, xz, yz] = [xy, xz, yz].map(|part| part * tiny);
            inertia.extend([
                [1.0, 1.0, 1.0, xy, xz, yz],
                [1.0, 1.0, 0.5, xy, xz, yz],
                [0.6, 1.0, 1.0, xy, xz, yz],
                [0.783_175_569_369_716_7, 0.783_175_569_369_716_7, 0.595_072_136_183_691_7, xy * tiny, 0.0, 1e-19],
                [1.0, 1.1, 1.0, xy, 0.1 + xz, yz],
                [5.0, 5.0, 5.0, 1.0 + xy, 1.0 + xz, 1.0 + yz],
            ]);
        }
    }
    inertia.into_iter().filter(|[.., xy, xz, yz]| [*xy, *xz, *yz] != [0.0; 3]).map(symmetric).collect()
}

/// |J' axis - moment axis| of a model is at most its `off`, but for rounding, and its couplings are in the order of moments.
#[test]
fn models_of_close_moments_have_axes_to_the_digits_of_double_double() {
    let big = |value: DoubleDouble| (exactly(value.hi()) + exactly(value.lo())).with_precision(400).value();
    let mut models = [0; 2];
    for tensor in close_tensors() {
        let body = Body::from_tensor(tensor).unwrap().rigid();
        let ModelBody { principal: PrincipalAxes { moments, axes }, couplings, off } = body.model();
        models[usize::from(off > 0.0)] += 1;
        let (scaled, _) = in_own_unit(&tensor);
        for (index, axis) in axes.iter().enumerate() {
            assert!(axis.iter().all(|part| part.radius() < 2f64.powi(-90)), "{tensor:?}: {axis:?}");
            let axis = axis.map(|part| big(*part.midpoint()));
            for (row, part) in scaled.iter().zip(&axis) {
                let along =
                    row.iter().zip(&axis).fold(Big::ZERO, |sum, (element, part)| sum + exactly(*element) * part);
                let left = (along - big(*moments[index].midpoint()) * part).to_f64().value().abs();
                assert!(left < 2f64.powi(-98) + off, "{tensor:?}: 2^{}", left.log2());
            }
        }
        let [a, b, c] = couplings;
        for coupling in couplings {
            assert!(
                coupling.to_f64() >= 0.0 && coupling.radius() <= 2f64.powi(-85) * coupling.to_f64(),
                "{couplings:?}"
            );
        }
        let rounding = 1e-15 * b.to_f64();
        assert!((a.to_f64() - b.to_f64() + c.to_f64() - a.to_f64() * b.to_f64() * c.to_f64()).abs() <= rounding);
        assert_eq!(body.couplings().map(f64::abs), couplings.map(|coupling| coupling.to_f64()));
        // The largest gap that is closed is 2^-160 of the largest moment.
        assert!(off < 2f64.powi(-157), "{tensor:?}: {off:e}");
    }
    assert!(models.into_iter().all(|count| count > 50), "{models:?}");
}

/// Moments in the order of their size, whatever the kind of number, and nothing that is not a number.
#[test]
fn nearly_equal_moments_are_in_order_in_every_kind_of_number() {
    fn assert_in_order<N: Elementary>(tensor: &[[f64; 3]; 3], like: &N) {
        let body = Body::from_tensor(*tensor).unwrap().rigid();
        let PrincipalAxes { moments: [a, b, c], axes } = body.scaled_principal(like);
        for (below, above) in [(&a, &b), (&b, &c)] {
            assert!((above.clone() - below.clone()).sign() >= 0.0, "{tensor:?}");
        }
        assert!(axes.iter().flatten().all(|part| part.is_in_range() && part.to_f64().abs() < 1.001), "{tensor:?}");
    }
    for tensor in close_tensors() {
        assert_in_order(&tensor, &0.0);
        assert_in_order(&tensor, &DoubleDouble::ZERO);
        assert_in_order(&tensor, &Ball::new(0.0, 0.0));
        assert_in_order(&tensor, &Ball::new(DoubleDouble::ZERO, 0.0));
        assert_in_order(&tensor, &Big::ZERO.with_precision(192).value());
        assert_in_order(&tensor, &Ball::new(Big::ZERO.with_precision(192).value(), 0.0));
    }
}
