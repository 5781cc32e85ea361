# %% [markdown]
# # The unfair toss
#
# A tossed coin is a rigid body in free flight: mechanics decides how it lands. Its normal n turns about the angular
# momentum S and keeps the angle ψ to it. For ψ below 45° the coin never shows tails, however long it flies.

# %%
import matplotlib.pyplot as plt
import numpy as np

import unfair_toss as ut

# %% [markdown]
# ## One toss
#
# The paper's cheated toss: ω = (1, 1, 2.5) rad/s, thrown up at 3 m/s. Its ψ is 48.5°, so n tips over in the end, but not
# within this flight. The margin says how much faster the throw has to be for tails.

# %%
cheated = ut.Toss((1.0, 1.0, 2.5), speed=3.0)
landing, margins = ut.toss(cheated), ut.margins(cheated)
print(f"{landing.outcome}, proven: {landing.certified}; tails from {3.0 + margins.speed:.4f} m/s on")

# %%
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
for body, label in [("paper", "the paper's coin, k = ½"), ("us-quarter", "a US quarter, k = 1.99")]:
    flight = ut.trace(ut.Toss((1.0, 1.0, 2.5), time=6.0, body=body), 600)
    axes.plot(flight.t, flight.cos_tilt, label=label)
axes.axvline(cheated.flight_time, color="grey", linestyle=":", label="caught at 3 m/s")
axes.axhline(0.0, color="black", linewidth=0.8)
axes.set(xlabel="time / s", ylabel="cos θ", title="Heads where cos θ > 0", xlim=(0, 6), ylim=(-1.05, 1.05))
axes.legend(loc="lower left")

# %% [markdown]
# ## Many tosses
#
# A map of proven outcomes: each of 160 000 throws is one pixel. Columns broadcast, so the grid is two axes.

# %%
rates, speeds = np.linspace(0.0, 50.0, 400), np.linspace(1.0, 5.0, 400)
faces = ut.outcome(rates[None, :], 0.0, 20.0, speeds[:, None])
figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
axes.pcolormesh(rates, speeds, faces, cmap="coolwarm", shading="nearest", rasterized=True)
axes.axvline(10.0, color="black", linestyle="--")
axes.text(9.6, 3.0, "ψ < 45°: always heads", rotation=90, ha="right", va="center", color="white")
axes.set(xlabel="ωx / (rad/s)", ylabel="speed / (m/s)", title="Heads (red) and tails (blue), ωz = 20 rad/s, from horizontal")
assert (faces[:, rates < 10.0] == 1).all()

# %% [markdown]
# ## A hand that varies
#
# The paper's Fig. 4: about 66 % heads. Each estimate has an interval that says how far it is to be trusted; the last one
# integrates the speed in closed form.

# %%
fig4 = ut.Space.named("paper-fig4")
exact = ut.probability(fig4, ut.Plan.exact_speed(2**16))
print(f"P(heads) = {exact.probability:.7f} ± {exact.half_width:.0e}")

numbers = 2 ** np.arange(8, 21)
random = [ut.probability(fig4, ut.Plan.random(int(number))) for number in numbers]
low, high = np.array([found.interval for found in random]).T
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.fill_between(numbers, low, high, alpha=0.3, label="interval of 95 %")
axes.plot(numbers, [found.probability for found in random], "o-", label="random launches")
axes.axhline(exact.probability, color="black", label="all speeds in closed form")
axes.axhline(0.5, color="grey", linestyle=":")
axes.set(xscale="log", xlabel="launches", ylabel="P(heads)", title="An unbiased coin, tossed unfairly")
axes.legend()
assert sum(lo <= exact.probability <= hi for lo, hi in zip(low, high, strict=True)) >= len(numbers) - 2

# %% [markdown]
# ## How to cheat
#
# For a wanted probability in long flights, `inverse` has the ratio of tumbling to spin.

# %%
wanted = np.linspace(0.505, 1.0, 100)
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
for body in ("paper", "us-quarter"):
    axes.plot(wanted, [ut.inverse(probability, body).rate_ratio for probability in wanted], label=body)
axes.set(
    xlabel="wanted P(heads)", ylabel="tumbling / spin", yscale="log", title="Tumble less than this, and it lands heads so often"
)
axes.legend()
