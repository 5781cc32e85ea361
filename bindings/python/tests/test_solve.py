"""Solvers in SciPy's words, and SciPy's own beside them."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import unfair_toss as ut
from unfair_toss import errors

TOSS = ut.Toss((9.0, 4.0, 3.0), time=1.5, tilt=0.4)


def rotation(_, y, k):
    """The slope of many attitudes and rates in one vector: Q' = ½ Q ⊗ (0, ω), and Euler's equations for a coin."""
    w, x, y, z, a, b, c = y.reshape(7, -1)
    half = [-(x * a + y * b + z * c), w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a]
    return np.concatenate([*(0.5 * part for part in half), (1 - k) * b * c, (k - 1) * a * c, 0.0 * c])


@pytest.mark.parametrize("solver", ["exact", "gamma", "euler", "quaternion"])
def test_every_solver_follows_the_flight_in_scipys_words(solver):
    times = np.linspace(0.0, 1.5, 31)
    solution = ut.solve(TOSS, solver, t_eval=times)
    assert (solution.t == times).all() and solution.y.shape == (7, 31) and solution.success
    assert (solution.nfev == 0) == (solver == "exact") and solution.nfev == solution.work.rhs_calls
    trace = ut.trace(TOSS, 31)
    assert np.abs(solution.cos_tilt - trace.cos_tilt).max() < 1e-8
    assert np.abs((solution.rotation.inv() * Rotation.from_quat(trace.attitude, scalar_first=True)).magnitude()).max() < 1e-8
    assert np.abs(np.linalg.norm(solution.attitude, axis=1) - 1).max() < 1e-14
    assert np.abs(solution.rate[:, 2] - 3.0).max() < 1e-8 and abs(solution.error_estimate) < 1e-5


def test_the_launch_and_the_landing_are_those_of_the_toss():
    for solver in ("exact", "quaternion"):
        solution, landing = ut.solve(TOSS, solver), ut.toss(TOSS, solver)
        assert solution.t.tolist() == [0.0, 1.5] and np.allclose(solution.y[:4, 0], TOSS.attitude, atol=1e-15)
        assert np.abs(solution.y[:4, -1] - landing.attitude).max() == 0.0
        assert (solution.nfev, solution.error_estimate) == (landing.work.rhs_calls, landing.error_estimate)


def test_settings_have_an_effect_or_are_refused():
    rough, fine = (ut.solve(TOSS, "quaternion", rtol=rtol) for rtol in (1e-4, 1e-12))
    assert rough.nfev < fine.nfev and rough.error_estimate > fine.error_estimate
    assert ut.solve(TOSS, "quaternion", scheme="taylor").nfev != fine.nfev
    assert ut.solve(TOSS, ut.Solver("gamma", scheme="rk4", step=0.01)).work.accepted_steps == 150
    for solver, settings, field in [
        ("exact", {"rtol": 1e-9}, "rtol"),
        ("quaternion", {"rtol": 2.0}, "rtol"),
        ("quaternion", {"rtol": 1e-9, "step": 0.1}, "step"),
        ("quaternion", {"scheme": "heun"}, "scheme"),
        ("euler", {"formulation": "sideways"}, "formulation"),
        (ut.Solver("euler"), {"rtol": 1e-9}, "rtol"),
        ("magic", {}, "solver"),
    ]:
        with pytest.raises(errors.InputError) as caught:
            ut.solve(TOSS, solver, **settings)
        assert caught.value.field == field
    solver = ut.Solver("quaternion", rtol=1e-9)
    assert (solver.scheme, solver.rtol, solver.step, solver.formulation) == ("dop853", 1e-9, None, None)
    assert repr(solver) == "Solver('quaternion', rtol=1e-9)" and solver == ut.Solver("quaternion", rtol=1e-9)


@pytest.mark.parametrize("times", [[1.0, 0.5], [-0.1, 1.0], [0.0, 1.6], [np.nan], [[0.0, 1.0]], 1.0, ["a"]])
def test_impossible_times_are_refused(times):
    with pytest.raises(errors.InputError) as caught:
        ut.solve(TOSS, t_eval=times)
    assert caught.value.field == "t_eval [s]"


def test_a_solver_that_cannot_go_on_says_so():
    standing = ut.Toss((0.0, 30.0, 1e-3), time=1.0)
    with pytest.raises(errors.SolveError) as caught:
        ut.solve(standing, "gamma", formulation="vertical")
    assert isinstance(caught.value, RuntimeError)


def test_any_body_is_followed_to_its_landing():
    book = ut.Toss((0.01, 5.0, 0.02), time=12.0, body=ut.Body.from_moments((1.0, 2.0, 2.8)))
    solution = ut.solve(book, t_eval=np.linspace(0, 12, 200))
    reference = solve_ivp(
        lambda _, w: [(2.0 - 2.8) * w[1] * w[2], (2.8 - 1.0) / 2 * w[2] * w[0], (1.0 - 2.0) / 2.8 * w[0] * w[1]],
        (0, 12), book.rate, "DOP853", t_eval=solution.t, rtol=1e-12, atol=1e-14,
    )  # fmt: skip
    assert np.abs(solution.rate.T - reference.y).max() < 1e-8
    # It turns over, again and again: the racket's flip.
    assert (np.diff(np.sign(solution.rate[:, 1])) != 0).sum() >= 2


def landings_by_scipy(x, y, z, time, k, tolerance):
    """cos θ by SciPy's DOP853, all flights scaled to the same time and solved as one system."""
    start = np.concatenate([np.ones_like(x), *np.zeros((3, x.size)), x * time, y * time, z * time])
    ends = solve_ivp(rotation, (0.0, 1.0), start, "DOP853", args=(k,), rtol=tolerance, atol=tolerance)
    assert ends.success
    w, x, y, z = ends.y[:, -1].reshape(7, -1)[:4]
    return (w * w + z * z - x * x - y * y) / (w * w + x * x + y * y + z * z)


def compared_with_scipy(number):
    """The largest differences of ours and of SciPy's own, by a tenth of its tolerance, from SciPy's to 1e-12."""
    random = np.random.default_rng(7)
    ours, its_own = [], []
    for _ in range(number // 500):
        x, y, z = random.uniform(-40, 40, (3, 500))
        time = random.uniform(0.2, 1.0, 500)
        judged, finer = (landings_by_scipy(x, y, z, time, 2.0, tolerance) for tolerance in (1e-12, 1e-13))
        found = ut.cos_tilt(x, y, z, time=time, body=ut.Body.from_moments((1.0, 2.0)))
        ours.append(np.abs(found - judged).max())
        its_own.append(np.abs(finer - judged).max())
    return max(ours), max(its_own)


def assert_within_scipys_error(number):
    # SciPy's finer solution has a tenth of the error, which its difference from the other lacks. An integrator is allowed
    # 100 × tolerance × (1 + phase) here; the phase is below 110 rad.
    ours, its_own = compared_with_scipy(number)
    print(f"largest difference of cos θ from SciPy's: ours {ours:.1e}, its own {its_own:.1e}")
    assert ours < 1.3 * its_own < 100 * 1e-12 * 111


def test_landings_are_those_of_scipys_dop853_within_its_error():
    assert_within_scipys_error(2_000)


@pytest.mark.slow
def test_a_hundred_thousand_landings_are_those_of_scipys_dop853():
    assert_within_scipys_error(100_000)


def test_scipys_names_of_settings_are_taken():
    fine = ut.solve(TOSS, "quaternion", scheme="dop853", rtol=1e-9)
    for solution in (
        ut.solve(TOSS, method="DOP853", rtol=1e-9),
        ut.solve(TOSS, "quaternion", method="dop853", rtol=1e-9, atol=1e-9),
        ut.solve(TOSS, atol=1e-9),
    ):
        assert solution == fine
    assert ut.solve(TOSS, method="RK45") == ut.solve(TOSS, "quaternion", scheme="dopri5")
    assert ut.solve(TOSS) == ut.solve(TOSS, "exact")
    for settings, field, words in [
        ({"rtol": 1e-9, "atol": 1e-12}, "atol", "one tolerance"),
        ({"atol": [1e-9] * 7}, "atol", "one tolerance"),
        ({"method": "Radau"}, "method", "known"),
        ({"method": 853}, "method", "the name of a scheme"),
        ({"method": "DOP853", "scheme": "dop853"}, "method", "the same setting"),
        ({"atol": 2.0}, "atol", "outside"),
    ]:
        with pytest.raises(errors.InputError, match=words) as caught:
            ut.solve(TOSS, **settings)
        assert caught.value.field == field


def test_dense_output_is_the_flight_at_any_time():
    times = np.array([1.5, 0.2, 0.2, 0.0, 0.9])
    for solver in ("exact", "quaternion"):
        solution = ut.solve(TOSS, solver, dense_output=True)
        states = solution.sol(times)
        ordered = ut.solve(TOSS, solver, t_eval=np.sort(times)).y
        assert states.shape == (7, 5) and (states[:, np.argsort(times, kind="stable")] == ordered).all()
        assert solution.sol(0.7).shape == (7,) and ut.solve(TOSS, solver).sol is None
        for wrong in ([0.1, 1.6], [-0.1], [np.nan], [[0.1]]):
            with pytest.raises(errors.OutOfRangeError):
                solution.sol(wrong)
    assert np.abs(ut.solve(TOSS, dense_output=True).sol(times) - ut.solve(TOSS, "quaternion", dense_output=True).sol(times)).max() < 1e-7


@pytest.mark.parametrize("flight", [ut.trace(TOSS, 31), ut.solve(TOSS, "quaternion", t_eval=np.linspace(0.0, 1.5, 31))])
def test_flights_become_tables_and_pictures(flight):
    import matplotlib

    matplotlib.use("Agg")
    frame, dataset = flight.to_pandas(), flight.to_xarray()
    assert (frame.index == flight.t).all() and frame.index.name == "t" and len(frame) == 31
    assert (frame["cos_tilt"] == flight.cos_tilt).all() and (frame["attitude_y"] == flight.attitude[:, 2]).all()
    assert (dataset["attitude"].sel(component="y").values == flight.attitude[:, 2]).all()
    assert dataset["t"].attrs["units"] == "s" and (dataset["t"].values == flight.t).all()
    axes = flight.plot()
    assert (axes.lines[0].get_ydata() == flight.cos_tilt).all() and "(s)" in axes.get_xlabel()
    assert axes.lines[0].get_linestyle() == "-"
    matplotlib.pyplot.close()


def test_no_line_joins_times_between_which_the_body_turns_by_more_than_a_quarter():
    import matplotlib

    matplotlib.use("Agg")
    # A thousand turns, of which each tenth is seen at the same cos θ.
    spinning = ut.Toss(ut.rate_of_precession(1000 * 2 * np.pi, np.radians(80)), time=1.0)
    racket = ut.Toss((0.1, 90.0, 0.1), time=1.0, body="racket")
    assert 90.0 < ut.trace(racket).fastest_turn < 130.0  # When it turns over, it is faster than at launch.
    assert ut.solve(racket, t_eval=np.linspace(0.0, 1.0, 9999)).rate.max() < ut.trace(racket).fastest_turn
    for flight, style in [
        (ut.trace(spinning, 101), "None"),
        (ut.trace(spinning, 3999), "None"),
        (ut.trace(spinning, 4003), "-"),
        (ut.solve(spinning, t_eval=np.linspace(0.0, 1.0, 101)), "None"),
        (ut.solve(spinning, t_eval=[*np.linspace(0.0, 0.01, 100), 1.0]), "None"),
        (ut.solve(spinning, t_eval=np.linspace(0.0, 0.01, 101)), "-"),
        (ut.trace(racket, 50), "None"),
        (ut.trace(racket, 100), "-"),
        (ut.trace(ut.Toss((0, 0, 0), time=1.0), 30), "-"),
    ]:
        line = flight.plot().lines[0]
        matplotlib.pyplot.close()
        assert line.get_linestyle() == style


def test_the_angles_are_those_of_scipys_upper_case_sequence():
    from scipy.spatial.transform import Rotation

    flight = ut.trace(TOSS, 7)
    turned = Rotation.from_euler("ZXZ", flight.angles).as_quat(scalar_first=True)
    assert np.allclose(np.abs((turned * flight.attitude).sum(axis=1)), 1.0, rtol=0, atol=1e-15)
    assert "ZXZ" in ut.Trace.__doc__


def test_few_times_are_points_and_no_line():
    import matplotlib

    matplotlib.use("Agg")
    line = ut.solve(TOSS, "quaternion").plot().lines[0]
    assert (line.get_linestyle(), line.get_marker(), len(line.get_xdata())) == ("None", "o", 2)
    matplotlib.pyplot.close()


def test_a_wrong_setting_is_called_as_it_was_given():
    with pytest.raises(ut.errors.UnknownNameError, match="^method = 'radau' is unknown") as caught:
        ut.solve(TOSS, method="Radau")
    assert caught.value.field == "method"


def test_notebooks_show_answers_as_tables():
    shown = ut.toss(TOSS)._repr_html_()
    assert "<th>outcome</th><td>tails</td>" in shown or "<th>outcome</th><td>heads</td>" in shown
    assert "array of shape (7, 31)" in ut.solve(TOSS, t_eval=np.linspace(0.0, 1.5, 31))._repr_html_()
    space = ut.Space(rate_x=[20, 60], rate_y=np.array([0.0, 1.0]), rate_z=(5, 15, 3), speed=4)
    assert space == ut.Space(rate_x=(20, 60), rate_y=(0, 1), rate_z=(5, 15, 3), speed=4)
    assert "<th>interval_kind</th>" in ut.probability(space, ut.Plan.random(100))._repr_html_()
