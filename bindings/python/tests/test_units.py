"""Values with a unit, of every package and as texts: converted to SI units or refused by the unit's name, never taken for SI."""

import copy
import inspect
import math
import pickle

import numpy as np
import pandas
import pint
import pytest
import xarray

import unfair_toss as ut
from unfair_toss import errors

pint_units = pint.UnitRegistry()
REST = {"rate_y": 0.0, "rate_z": 20.0, "speed": 3.0}
TOSS = ut.Toss((9.0, 4.0, 3.0), time=1.5)
SIZE = {"deg/s": math.radians(1), "rpm": math.tau / 60, "m/s": 1.0, "cm/s": 0.01, "ms": 1e-3, "deg": math.radians(1), "cm": 0.01, "kg": 1.0}
KIND = {"deg/s": "rad/s", "rpm": "rad/s", "cm/s": "m/s", "ms": "s", "deg": "rad", "cm": "m"}


class Stand:
    """A quantity of a package that is not installed: it knows its unit, and converts by the method ``to_value``."""

    def __init__(self, value, unit):
        self.value, self.unit = value, unit

    def to_value(self, unit):
        if KIND.get(self.unit, self.unit) != unit:
            raise RuntimeError(f"{self.unit} is no {unit}")
        return np.asarray(self.value) * SIZE[self.unit] if isinstance(self.value, list) else self.value * SIZE[self.unit]

    def __float__(self):
        return float(self.value)

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.value, dtype)


def of_pint(value, unit):
    return pint_units.Quantity(value, unit)


def of_astropy(value, unit):
    units = pytest.importorskip("astropy.units")
    return units.Quantity(value, {"rpm": math.tau / 60 * units.rad / units.s}.get(unit, unit))


def of_unyt(value, unit):
    unyt = pytest.importorskip("unyt")
    return unyt.unyt_array(value, unit) if isinstance(value, list) else unyt.unyt_quantity(value, unit)


PACKAGES = [Stand, of_pint, of_astropy, of_unyt]


@pytest.mark.parametrize("of", PACKAGES)
def test_a_column_is_converted_whatever_package_gives_its_unit(of):
    """In degrees the first lands heads and the second tails; taken as rad/s, it would be the other way round."""
    right = ut.cos_tilt(np.radians([3600.0, 720.0]), **REST)
    assert (right > 0).tolist() == [True, False] and ut.outcome([3600.0, 720.0], **REST).tolist() == [-1, 1]
    columns = [of([3600.0, 720.0], "deg/s"), [of(3600.0, "deg/s"), of(720.0, "deg/s")]]
    if of is not Stand:
        columns += [xarray.DataArray(columns[0], dims="n"), pandas.Series(columns[1])]
        if of is not of_pint:
            columns += [pandas.Series(columns[0]), np.ma.array(columns[0])]
    for column in columns:
        assert np.allclose(ut.cos_tilt(column, **REST), right, rtol=0, atol=1e-13), column
        assert ut.count(column, **REST).heads == 1 and np.array(ut.outcome(column, **REST)).tolist() == [1, -1]
        assert np.array(ut.attitude(column, **REST)).shape == (2, 4)
    assert math.isclose(ut.cos_tilt(of(600.0, "rpm"), **REST), ut.cos_tilt(20 * math.pi, **REST), abs_tol=1e-13)
    mixed = ut.cos_tilt([of(3600.0, "deg/s"), math.radians(720.0)], **REST)
    assert np.allclose(mixed, right, rtol=0, atol=1e-13)


@pytest.mark.parametrize("of", PACKAGES)
def test_every_argument_that_measures_something_is_converted(of):
    close = lambda one, two: np.allclose(one, two, rtol=1e-13, atol=0)
    one = lambda number, unit: of(number, unit)
    toss = ut.Toss(of([360.0, 90.0, 30.0], "deg/s"), speed=one(250.0, "cm/s"), drop=one(10.0, "cm"), tilt=one(30.0, "deg"))
    plain = ut.Toss(np.radians([360.0, 90.0, 30.0]), speed=2.5, drop=0.1, tilt=math.radians(30.0))
    assert close(toss.rate, plain.rate) and close(toss.flight_time, plain.flight_time) and close(toss.attitude, plain.attitude)
    assert close(ut.Toss([one(360.0, "deg/s"), 1.0, 2.0], time=one(500.0, "ms")).rate, [math.tau, 1.0, 2.0])
    disc = ut.Body.cylinder(one(0.005, "kg"), one(1.2, "cm"), one(0.2, "cm"))
    assert close(disc.moments, ut.Body.cylinder(0.005, 0.012, 0.002).moments)
    assert close(ut.solve(TOSS, t_eval=of([0.0, 100.0, 200.0], "ms")).t, [0.0, 0.1, 0.2])
    flight = ut.solve(TOSS, "euler", scheme="rk4", step=one(10.0, "ms"), dense_output=True)
    assert close(flight.sol(one(100.0, "ms")), flight.sol(0.1)) and flight.work.accepted_steps == 150
    assert len(ut.trace(TOSS, dt=one(500.0, "ms")).t) == 4
    thrown = ut.Toss((1, 1, 2.5), speed=3)
    assert close(ut.intervals(thrown, one(50.0, "cm/s")).heads, ut.intervals(thrown, 0.5).heads) and len(ut.intervals(thrown, 0.5).heads)
    assert close(ut.rate_of_precession(one(2280.0, "rpm"), one(81.0, "deg")), ut.rate_of_precession(76 * math.pi, math.radians(81)))
    by_axes = ut.Space(rate_x=of([360.0, 720.0], "deg/s"), rate_y=(one(0.0, "rpm"), one(60.0, "rpm"), 5), rate_z=1, speed=one(250.0, "cm/s"), tilt=one(30.0, "deg"), drop=one(5.0, "cm"))
    space = ut.Space(rate_x=(math.tau, 2 * math.tau), rate_y=(0.0, math.tau, 5), rate_z=1, speed=2.5, tilt=math.radians(30), drop=0.05)
    found = [ut.probability(of_it, ut.Plan.random(1000)).probability for of_it in (by_axes, space)]
    assert close(*found)
    column = dict(drop=of([10.0, 20.0], "cm"), tilt=of([10.0, 20.0], "deg"))
    assert close(ut.cos_tilt(1, 2, 3, of([250.0, 500.0], "cm/s"), **column), ut.cos_tilt(1, 2, 3, [2.5, 5.0], drop=[0.1, 0.2], tilt=np.radians([10.0, 20.0])))
    assert close(ut.cos_tilt(1, 2, 3, time=of([500.0], "ms")), ut.cos_tilt(1, 2, 3, time=[0.5]))


WRONG = {
    "rate_x": lambda value: ut.count(value(), **REST),
    "speed": lambda value: ut.count(1.0, 2.0, 3.0, value("deg/s")),
    "time": lambda value: ut.count(1.0, 2.0, 3.0, time=value()),
    "gravity": lambda value: ut.count(1.0, 2.0, 3.0, 3.0, gravity=value()),
    "drop": lambda value: ut.count(1.0, 2.0, 3.0, 3.0, drop=value()),
    "tilt": lambda value: ut.count(1.0, 2.0, 3.0, 3.0, tilt=value()),
    "attitude": lambda value: ut.count(1.0, 2.0, 3.0, 3.0, attitude=value("m/s", 4)),
    "rate": lambda value: ut.Toss(value("m/s", 3), speed=3.0),
    "t_eval [s]": lambda value: ut.solve(TOSS, t_eval=value()),
    "t [s]": lambda value: ut.solve(TOSS, dense_output=True).sol(value()),
    "tensor": lambda value: ut.Body.from_tensor([value("m/s", 3)] * 3),
    "moments": lambda value: ut.Body.from_moments(value("m/s", 3)),
    "same_side": lambda value: ut.same_side_bias(value(), [10]),
}
WRONG_NUMBERS = {
    "mass": lambda value: ut.Body.cylinder(value(), 1.0, 1.0),
    "thickness": lambda value: ut.Body.cylinder(1.0, 1.0, value()),
    "dt": lambda value: ut.trace(TOSS, dt=value()),
    "step": lambda value: ut.Solver("euler", scheme="rk4", step=value()),
    "rtol": lambda value: ut.Solver("euler", rtol=value()),
    "turn": lambda value: ut.rate_of_precession(value(), 1.0),
    "psi": lambda value: ut.rate_of_precession(1.0, value()),
    "slowest": lambda value: ut.intervals(ut.Toss((1, 2, 3), speed=3.0), value("deg/s")),
    "probability": lambda value: ut.inverse(value()),
    "accuracy": lambda value: ut.plan("tilt", TOSS, value()),
    "points": lambda value: ut.Plan.random(value()),
    "rate_z": lambda value: ut.Space(rate_x=1, rate_y=1, rate_z=value(), speed=1),
    "speed": lambda value: ut.Space(rate_x=1, rate_y=1, rate_z=1, speed=(1, value("deg/s"))),
}


@pytest.mark.parametrize("of", PACKAGES)
def test_a_unit_of_another_kind_is_refused_and_both_are_named(of):
    for field, call in [*WRONG.items(), *WRONG_NUMBERS.items()]:
        several = (field, call) in WRONG.items()
        value = lambda unit="m/s", count=1: of([1.0] * count, unit) if several else of(1, unit)
        with pytest.raises(errors.MalformedError, match=r"has the unit .*: expected ") as caught:
            call(value)
        assert caught.value.field == field and caught.value.valid in str(caught.value), (field, caught.value)
    with pytest.raises(errors.MalformedError, match=r"rate_x\[1\] has the unit m.*: expected a rate in rad/s, deg/s"):
        ut.count([of(1.0, "deg/s"), of(1.0, "m/s")], **REST)


def test_a_frequency_is_no_rate_of_turning():
    """Pint takes 1 Hz for 1 rad/s, though who says 38 Hz means 38 rev/s."""
    for unit in ("hertz", "1/s", "dimensionless"):
        with pytest.raises(errors.MalformedError, match="rate_x has the unit"):
            ut.cos_tilt(of_pint([38.0], unit), **REST)
    for of in (of_astropy, of_unyt):
        with pytest.raises(errors.MalformedError, match="rate_x has the unit Hz"):
            ut.cos_tilt(of([38.0], "Hz"), **REST)


@pytest.mark.parametrize("unit", ["deg/s", "degrees/s", "degree s-1", "deg s**-1", "degree / second"])
def test_arrays_with_labels_name_their_unit(unit):
    x = xarray.DataArray([3600.0, 720.0], {"n": [7, 8]}, attrs={"units": unit})
    right = ut.cos_tilt(np.radians([3600.0, 720.0]), **REST)
    found = ut.cos_tilt(x, **REST)
    assert np.allclose(found, right, rtol=0, atol=1e-13) and found.sel(n=8) == found[1] and x.attrs == {"units": unit}
    series = pandas.Series([3600.0, 720.0], index=["a", "b"])
    series.attrs["units"] = unit
    assert np.allclose(ut.cos_tilt(series, **REST), right, rtol=0, atol=1e-13)
    assert ut.cos_tilt(series, **REST).index.tolist() == ["a", "b"]
    for wrong in ("m s-1", "furlong", "rad", "K"):
        with pytest.raises(errors.MalformedError, match=f"rate_x has the unit {wrong}: expected a rate in rad/s"):
            ut.count(x.assign_attrs(units=wrong), **REST)


def test_counts_that_say_they_have_no_unit_are_counts():
    people = xarray.DataArray([56, 61, 20], dims="person", attrs={"units": "1"})
    assert ut.same_side_bias(people, [100, 100, 100]) == ut.same_side_bias(people.values, [100, 100, 100])
    with pytest.raises(errors.InputError):
        ut.cos_tilt(xarray.Dataset({"x": people}), **REST)


def test_the_times_of_a_flight_are_read_back_from_xarray():
    flight = ut.trace(TOSS, 5).to_xarray()
    assert (ut.solve(TOSS, t_eval=flight["t"]).t == flight["t"].values).all()
    late = flight["t"].assign_attrs(units="ms")
    assert np.allclose(ut.solve(TOSS, t_eval=late).t, 1e-3 * flight["t"].values, rtol=1e-15)


def test_a_result_has_no_place_for_a_unit():
    units = pytest.importorskip("astropy.units")
    with pytest.raises(errors.MalformedError, match="out"):
        ut.cos_tilt([1.0], **REST, out=units.Quantity([0.0], "deg"))


def test_columns_of_tables_of_astropy_are_converted():
    table = pytest.importorskip("astropy.table")
    right = ut.cos_tilt(np.radians([3600.0, 720.0]), **REST)
    for made in (table.Table({"x": [3600.0, 720.0]}), table.Table({"x": [3600.0, 720.0]}, masked=True), table.QTable({"x": [3600.0, 720.0]})):
        made["x"].unit = "deg/s"
        assert np.allclose(ut.cos_tilt(made["x"], **REST), right, rtol=0, atol=1e-13)
    masked = pytest.importorskip("astropy.utils.masked").Masked(of_astropy([1.0, 2.0], "deg/s"), mask=[False, True])
    for column in (masked, table.MaskedColumn([1.0, 2.0], mask=[False, True], unit="deg/s")):
        with pytest.raises(errors.MalformedError, match="rate_x has masked elements") as caught:
            ut.cos_tilt(column, **REST)
        assert caught.value.index == 1


def test_a_quantity_may_be_a_text_with_its_unit(ask):
    """Its number is not rounded where the command line does not round it."""
    toss = ut.Toss(("38rev/s", 0, "5rev/s"), speed="2.4m/s", tilt="15deg", body=ut.Body.cylinder("5.67g", "12.13mm", "1.75mm"))
    asked = ask("toss", "--rate", "38rev/s,0,5rev/s", "--speed", "2.4m/s", "--tilt", "15deg", "--cylinder", "5.67g,12.13mm,1.75mm")
    landing = ut.toss(toss)
    assert (landing.cos_tilt, landing.attitude.tolist(), landing.certified) == (asked["cos_tilt"], asked["attitude"], True)
    for again in (pickle.loads(pickle.dumps(toss)), copy.copy(toss), eval(repr(toss), {"Toss": ut.Toss, "Body": ut.Body})):
        assert again == toss and ut.toss(again) == landing and repr(again) == repr(toss)
    assert math.isclose(ut.cos_tilt("38rev/s", 0, 0, "2.4m/s", tilt="15deg"), ut.cos_tilt(76 * math.pi, 0, 0, 2.4, tilt=math.radians(15)), rel_tol=1e-12)
    assert np.allclose(ut.rate_of_precession("38rev/s", "90deg"), ut.rate_of_precession(76 * math.pi, math.pi / 2), rtol=1e-15)
    assert len(ut.trace(TOSS, dt="500ms").t) == 4 and ut.Solver("euler", scheme="rk4", step="10ms").step == 0.01
    assert ut.Space(rate_x=1, rate_y=1, rate_z=1, speed=1, drop="50cm") == ut.Space(rate_x=1, rate_y=1, rate_z=1, speed=1, drop=0.5)
    assert ut.Body.from_moments(["1g·cm²", "2g·cm²"]).moments == [1e-7, 1e-7, 2e-7]
    for call in (
        lambda: ut.Toss((1, 2, 3), speed="3"),
        lambda: ut.Toss((1, 2, 3), speed="3rad/s"),
        lambda: ut.Toss(("1m/s", 2, 3), speed=3.0),
        lambda: ut.inverse("70%"),
        lambda: ut.cos_tilt(["38rev/s"], 0, 0, 3),
    ):
        with pytest.raises(errors.MalformedError, match="can't be used: expected a"):
            call()


def test_what_a_unit_rounded_is_not_proven(ask):
    """As on the command line: next to a tie, a speed in km/h may land either way."""
    options = ["--rate", "1,0,0", "--time", "1570.7963267948966ms"]
    asked, found = ask("toss", *options), ut.toss(ut.Toss((1, 0, 0), time="1570.7963267948966ms"))
    assert (found.outcome, found.certified, found.proven_by) == (asked["outcome"], asked["certified"], None) and not found.certified
    assert ut.toss(ut.Toss((1, 0, 0), time=1.5707963267948966)).certified


def test_what_is_said_of_a_wrong_angle_is_python():
    with pytest.raises(errors.OutOfRangeError, match=r"^psi \[rad\] = 81.*; 81 degrees are np.radians\(81\) or '81deg'$"):
        ut.rate_of_precession(1.0, 81.0)
    assert ut.rate_of_precession(1.0, "81deg") == ut.rate_of_precession(1.0, np.radians(81))


def test_the_readme_of_each_argument_names_its_unit():
    for function in (ut.cos_tilt, ut.Toss, ut.Space, ut.rate_of_precession):
        assert "rad/s" in (inspect.getdoc(function) or "")
