# %% [markdown]
# # Dzhanibekov's racket
#
# A body with three different moments of inertia turns steadily about the axis of the largest and of the smallest one.
# About the middle axis it does not: a wing nut in orbit, a tennis racket or a book turns over, stays so, and turns back.
# The exact motion is by elliptic functions, and outcomes by it are proven, for any inertia tensor.

# %%
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import solve_ivp

import unfair_toss as ut

# A racket: the handle along x, the face's normal along z (kg m²).
racket = ut.Body.from_moments((0.0012, 0.0164, 0.0175))
seconds = np.linspace(0.0, 8.0, 2000)

# %% [markdown]
# ## Two axes are stable, one is not
#
# The same small push of 0.02 rad/s, with a spin of 8 rad/s about each of the axes.

# %%
figure, panels = plt.subplots(3, 1, figsize=(7, 7), sharex=True, layout="constrained")
for axis, (panel, name) in enumerate(zip(panels, ("smallest", "middle", "largest"), strict=True)):
    rate = np.full(3, 0.02)
    rate[axis] = 8.0
    flight = ut.solve(ut.Toss(rate, time=8.0, body=racket), t_eval=seconds)
    for row, label in zip(flight.rate.T, ("ωx", "ωy", "ωz"), strict=True):
        panel.plot(flight.t, row, label=label)
    panel.set(ylabel="ω / (rad/s)", title=f"about the axis of the {name} moment")
    turns_over = bool(flight.rate[:, axis].min() < 0.0)
    assert turns_over == (name == "middle")
panels[0].legend(ncols=3)
panels[2].set(xlabel="time / s")

# %% [markdown]
# ## Where ω can go
#
# Angular momentum and energy are conserved, so that the tip of the angular momentum moves along the curve where a sphere
# meets an ellipsoid. Curves go round the axes of the largest and smallest moment; the middle axis is a saddle.

# %%
moments = np.array(racket.moments)
figure = plt.figure(figsize=(6, 6), layout="constrained")
axes = figure.add_subplot(projection="3d")
for tip in np.linspace(0.05, np.pi / 2 - 0.05, 7):
    for sign in (1, -1):
        for side, color in ((0, "C0"), (2, "C1")):
            direction = np.zeros(3)
            direction[1], direction[side] = np.cos(tip), sign * np.sin(tip)
            start = direction / moments * moments[1] * 8.0
            flight = ut.solve(ut.Toss(start, time=8.0, body=racket), t_eval=seconds)
            momentum = flight.rate * moments
            momentum /= np.linalg.norm(momentum[0])
            axes.plot(*momentum.T, color=color, linewidth=0.8)
            assert np.abs(np.linalg.norm(momentum, axis=1) - 1.0).max() < 1e-13
axes.set(xlabel="Lx", ylabel="Ly (middle)", zlabel="Lz", title="The angular momentum, as the body sees it")
axes.set_box_aspect((1, 1, 1))

# %% [markdown]
# ## How long it waits
#
# The time between two turns grows with the logarithm of the push: each tenth of it adds 0.65 s. An integrator has to
# resolve the push; the exact motion does down to 1e-12 rad/s and below.

# %%
pushes = 10.0 ** -np.arange(1, 13)
waits = []
for push in pushes:
    times = np.linspace(0.0, 14.0, 5_601)
    turning = ut.solve(ut.Toss((push, 8.0, 0.0), time=14.0, body=racket), t_eval=times).rate[:, 1]
    first, second = times[1:][np.diff(np.sign(turning)) != 0][:2]
    waits.append(second - first)
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.semilogx(pushes, waits, "o", label="exact motion")
rate = 8.0 * np.sqrt((moments[2] - moments[1]) * (moments[1] - moments[0]) / (moments[0] * moments[2]))
line = waits[0] - 2.0 / rate * np.log(pushes / pushes[0])
axes.semilogx(pushes, line, color="grey", label="slope 2/λ of the linearised equations")
axes.set(xlabel="push ωx / (rad/s)", ylabel="time between two turns / s")
axes.set_title("Spin of 8 rad/s about the middle axis")
axes.legend()
assert np.abs(waits[3:] - line[3:]).max() < 0.01

# %% [markdown]
# ## Which face is up?
#
# Each outcome is proven, next to the separatrix too. An integrator adds its errors to the push. SciPy's DOP853 with a
# tolerance of 1e-3 turns over a second too early the second time; with 1e-6 it is late the third time. Both report success.

# %%
toss = ut.Toss((1e-6, 8.0, 0.0), time=12.0, body=racket)
caught = np.linspace(0.05, 12.0, 240)
faces = [ut.toss(ut.Toss((1e-6, 8.0, 0.0), time=time, body=racket)) for time in caught]
assert all(face.certified for face in faces)


def euler(_, rate):
    a, b, c = moments
    x, y, z = rate
    return [(b - c) / a * y * z, (c - a) / b * z * x, (a - b) / c * x * y]


figure, (above, below) = plt.subplots(2, 1, figsize=(7, 5.5), sharex=True, layout="constrained")
above.plot(caught, [face.cos_tilt for face in faces], color="C2")
above.axhline(0.0, color="black", linewidth=0.8)
above.set(ylabel="cos θ", title="Proven outcomes: heads where cos θ > 0")
exact = ut.solve(toss, t_eval=np.linspace(0.0, 12.0, 2000))
below.plot(exact.t, exact.rate[:, 1], label="exact")
for tolerance in (1e-3, 1e-6):
    ends = solve_ivp(euler, (0.0, 12.0), toss.rate, "DOP853", t_eval=exact.t, rtol=tolerance, atol=tolerance)
    assert ends.success and np.abs(ends.y[1] - exact.rate[:, 1]).max() > 1.0
    below.plot(ends.t, ends.y[1], "--", label=f"SciPy DOP853, {tolerance:.0e}")
below.set(xlabel="time / s", ylabel="ωy / (rad/s)", ylim=(-9.5, 13.5))
below.legend(loc="upper center", ncols=3)
