"""What mypy and pyright say of columns: a number of numbers, labels of what has labels, an array of arrays."""

from typing import Any, assert_type

import numpy as np
import numpy.typing as npt
import xarray as xr

import unfair_toss as ut

rates: npt.NDArray[np.float64] = np.linspace(0.0, 50.0, 5)
labelled = xr.DataArray(rates, dims="launch")


class Frame:
    """As a frame of pandas, which has no types of its own."""


class Series:
    """As a series of pandas."""

    attrs: dict[str, str] = {}
    size = 2

    def to_frame(self) -> Frame:
        return Frame()


generator = np.random.default_rng(1)

assert_type(ut.cos_tilt(1.0, 1, "2rad/s", speed=3.0), np.float64)
assert_type(ut.cos_tilt(rates, 1.0, 2.0, 3.0), npt.NDArray[np.float64])
assert_type(ut.outcome([1.0, 2.0], 1.0, 2.0, 3.0, tilt=rates[:2]), npt.NDArray[np.int8])
assert_type(ut.outcome(1.0, 1.0, labelled, 3.0), xr.DataArray)
assert_type(ut.cos_tilt(1.0, 1.0, 2.0, 3.0, tilt=labelled), xr.DataArray)
assert_type(ut.cos_tilt(1.0, 1.0, 2.0, time=rates, threads=2, solver="exact"), npt.NDArray[np.float64])
assert_type(ut.attitude(1.0, 1.0, 2.0, time=3.0, drop=labelled), xr.DataArray)
assert_type(ut.attitude(1.0, 1.0, 2.0, 3.0, tilt=Series()), Frame)
ut.cos_tilt(1.0, 1.0, 2.0, 3.0, tlit=0.1)  # type: ignore[call-overload]  # pyright: ignore
ut.cos_tilt(1.0, 1.0, 2.0, 3.0, threads="2")  # type: ignore[call-overload]  # pyright: ignore
assert_type(ut.outcome(turn=rates, psi=1.2, speed=3.0, body=["paper", "disc"]), npt.NDArray[np.int8])
assert_type(ut.cos_tilt(turn=6.0, psi="80deg", speed=3.0), np.float64)
assert_type(ut.cos_tilt(1.0, 1.0, 2.0, 3.0, moments=[[1.0, 1.5], [1.0, 2.0]]), npt.NDArray[np.float64])
assert_type(ut.cos_tilt(1.0, 1.0, 2.0, labelled, body=labelled), xr.DataArray)
assert_type(ut.attitude(1.0, 1.0, 2.0, 3.0), npt.NDArray[np.float64])
assert_type(ut.attitude(rates, 1.0, 2.0, 3.0, attitude=(1.0, 0.0, 0.0, 0.0)), npt.NDArray[np.float64])
assert_type(ut.attitude(labelled, 1.0, 2.0, 3.0), xr.DataArray)
assert_type(ut.attitude(1.0, 1.0, 2.0, Series()), Frame)
assert_type(ut.count(rates, 1.0, 2.0, 3.0, body=np.array(["paper", "disc"], dtype=object)), ut.Counts)
assert_type(ut.Toss(turn=6.0, psi=1.2, speed=3.0).rate, list[float])
assert_type(ut.inverse(0.6), ut.Inverse)
assert_type(ut.inverse(counts=(55, 100)), ut.SameSideBias)
space = ut.Space.named("paper-fig4").with_spread(0.01)
assert_type(ut.probability(space, ut.Plan.random(10, seed=generator)).interval, tuple[float, float] | None)
assert_type(ut.sample(space, 10, rng=generator).outcome, npt.NDArray[np.int8])
assert_type(ut.map(space, plan=ut.Plan.sobol(64)).probability, npt.NDArray[np.float64])
assert_type(ut.limit(points=10).to_dict(), dict[str, npt.NDArray[Any]])
