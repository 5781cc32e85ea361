//! Tests of the measured table: lookups, interpolation, and tables that are refused.

use super::*;
use crate::model::MODELS;

#[test]
fn the_table_has_an_entry_for_every_model_and_for_our_integrators() {
    let fitted = &*FITTED;
    for model in &MODELS {
        match model.name {
            // Integrators are tabulated by scheme (below). A grid has no error estimate and an enclosure is never planned, so they
            // have no entry.
            "integrator" | "grid" | "share-enclosure" => {}
            name if model.is_closed_form() || name == "share" => {
                assert!(fitted.closed(name).unwrap().cost_ns > 0.0);
            }
            name => assert!(fitted.sampling(name).unwrap().launch_ns > 0.0),
        }
    }
    assert_eq!(fitted.complaint(), None);
    for (solver, scheme) in [("gamma", "dop853"), ("euler", "dopri5"), ("quaternion", "taylor")] {
        assert!(fitted.integrator(solver, scheme).is_some());
    }
}

#[test]
fn errors_and_costs_are_interpolated_in_phase_and_tolerance() {
    // The calls are no geometric sequence, so that extrapolating from a neighbour's entry gives another cost.
    let calls = vec![vec![8.0, 16.0, 50.0], vec![9.0, 25.0, 36.0]];
    let fit = IntegratorFit {
        solver: "gamma".to_owned(),
        scheme: "dop853".to_owned(),
        cost_ns: 100.0,
        call_ns: 10.0,
        tilt_errors: vec![vec![vec![1e-3, 1e-5, 1e-7]; 2]; 2],
        errors: vec![vec![vec![1e-2, 1e-4, 1e-6], vec![4e-2, 4e-4, 4e-6]], vec![vec![1.0; 3], vec![1.0; 3]]],
        calls: vec![calls, vec![vec![7.0, 11.0, 13.0], vec![17.0, 19.0, 23.0]]],
    };
    let fitted = Fitted {
        measured: String::new(),
        closed: Vec::new(),
        spins: vec![0.5, 1.0],
        phases: vec![1.0, 9.0],
        tolerances: vec![1e-3, 1e-5, 1e-7],
        integrators: Vec::new(),
        sampling: Vec::new(),
    };
    let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected}");
    let setting = |phase, spin, accuracy| fitted.setting(&fit, false, &Turn { phase, spin }, accuracy);
    let rough = setting(1.0, 0.1, 0.5).unwrap();
    assert_eq!((rough.tolerance, rough.error, rough.cost_ns), (1e-3, 1e-2, 260.0));
    // Half-way from 1 to 9 rad and from 1e-5 to 1e-7, on logarithmic scales.
    let middle = setting(3.0, 0.5, 2e-5).unwrap();
    near(middle.tolerance, 1e-6);
    near(middle.error, 2e-5);
    near(middle.cost_ns, 100.0 + (25.0_f64 * 36.0).sqrt() * 4.0 * 10.0);
    for (phase, spin, tolerance, calls) in
        [(1.0, 0.5, 1e-5, 16.0), (1.0, 0.5, 1e-7, 50.0), (3.0, 0.6, 1e-3, 17.0), (900.0, 9.0, 1e-5, 19.0)]
    {
        let cost = fitted.cost_ns(&fit, &Turn { phase, spin }, tolerance);
        near(cost, 100.0 + calls * (1.0 + phase) * 10.0);
    }
    let beyond = setting(900.0, 0.0, 4e-4).unwrap();
    near(beyond.tolerance, 1e-7);
    near(fitted.setting(&fit, true, &Turn { phase: 3.0, spin: 0.5 }, 1e-4).unwrap().tolerance, 1e-4);
    near(setting(0.5, 0.0, 1e-7).unwrap_err(), 1e-6);
    near(setting(0.5, f64::INFINITY, 1e-3).unwrap_err(), 1.0);
}
