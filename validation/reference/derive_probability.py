"""Derives the probabilities of this folder. Needs Python 3, mpmath (1.3 was used) and numpy (2 was used); no code of ours.

Shares over a range of speeds: every sign change of cos theta, which is taken from the quaternion of the motion, is found
by sampling and polished to 30 digits. Averages over one more coordinate: mpmath's adaptive quadrature between the kinks of
the share, in 30 digits. The box over all four coordinates: composite Gauss-Legendre rules in double precision over
(Omega, omega_z), printed with the digits on which two resolutions agree.
"""
import numpy as np
from mpmath import mp, mpf, sin, cos, sqrt, acos, asin, pi, quad, floor, findroot, atan, tan, cot

from derive import closed_form, tilt_of

mp.dps = 40
GRAVITY = mpf("9.81")


def show(number, digits=25):
    return mp.nstr(number, digits, strip_zeros=False)


def share_by_roots(i1, i3, rate, tilt, lo, hi):
    """Share of the speeds from lo to hi with cos theta > 0."""
    launch = [cos(tilt/2), sin(tilt/2), mpf(0), mpf(0)]

    def height(speed):
        return tilt_of(closed_form(i1, i3, rate, launch, 2*speed/GRAVITY))

    samples = 2000
    speeds = [lo + (hi - lo)*i/samples for i in range(samples + 1)]
    heights = [height(speed) for speed in speeds]
    edges = [lo]
    for a, b, at_a, at_b in zip(speeds, speeds[1:], heights, heights[1:]):
        if at_a*at_b < 0:
            edges.append(findroot(height, (a, b), solver="anderson", tol=mpf(10)**-60))
    edges.append(hi)
    return sum((b - a for a, b in zip(edges, edges[1:]) if height((a + b)/2) > 0), mpf(0))/(hi - lo)


def shares():
    launches = [
        ("cheated", "0.5", "1 1 2.5", "0", "3 5"),
        ("cheated, long", "0.5", "1 1 2.5", "0", "3 50"),
        ("tails", "0.5", "2 2 0.5", "0", "0 5"),
        ("fast", "1.96875", "-31.5 44.25 13.0", "0", "3 5"),
        ("near 45 degrees", "0.5", "20 0 39.9", "0", "3 5"),
        ("just above 45 degrees", "0.5", "20 0 39.9999", "0", "3 5"),
        ("end over end", "1.96875", "3 -4 0", "0", "3 5"),
        ("tilted", "0.5", "9 -7 12", "0.7", "3 5"),
        ("tilted beyond 90 degrees", "1.96875", "-17 8 21", "2.5", "3 5"),
        ("tilted, seldom heads", "1.96875", "-17 8 6", "2.5", "3 5"),
        ("tilted backwards", "1", "14 3 -6", "-1.2", "2 4"),
        ("rod", "0", "12 5 40", "0.3", "3 5"),
        ("on edge", "2", "11 0 3", "1.5", "3 5"),
    ]
    for name, i3, rate, tilt, speed in launches:
        rate, (lo, hi) = [mpf(c) for c in rate.split()], [mpf(c) for c in speed.split()]
        share = share_by_roots(mpf(1), mpf(i3), rate, mpf(tilt), lo, hi)
        rates = ", ".join(f"rate_{axis} = {c}" for axis, c in zip("xyz", rate))
        space = f'coin = {{ moments = [1.0, {mpf(i3)}] }}, {rates}, speed = "{lo}:{hi}", tilt = {mpf(tilt)}'
        print(f'[[share]]\nname = "{name}"\nspace = {{ {space} }}\nprobability = {show(share)}\n')


def figure(name, probability, digits=25):
    print(f'[[figure]]\nname = "{name}"\nprobability = {show(probability, digits)}\n')


def long_flight(cone):
    return mpf(1)/2 + asin(cot(cone)**2)/pi if cone > pi/4 else mpf(1)


def isotropic():
    """Directions uniform on the sphere: the cosine of the polar angle is uniform; both halves are alike."""
    momentum = quad(lambda c: long_flight(acos(c)), [0, sqrt(mpf(1)/2), 1])
    assert abs(momentum - 1/sqrt(mpf(2))) < mpf(10)**-9
    figure("isotropic angular momentum", 1/sqrt(mpf(2)))
    for k in ("0.5", "1", "1.98", "2"):
        k = mpf(k)
        # tan(psi) = tan(polar angle of the rate)/k; the kink is at tan(polar) = k. Near it p falls like a square root.
        kink = cos(atan(k))
        smooth = quad(lambda s: 2*s*long_flight(atan(tan(acos(kink - s*s))/k)), [0, sqrt(kink)])
        figure(f"isotropic rate, k = {mp.nstr(k, 3)}", smooth + 1 - kink)


def share_of_phases(width, lo, hi):
    def heads_below(phase):
        turn = floor((phase + pi)/(2*pi))
        return 2*width*turn + max(-width, min(width, phase - 2*pi*turn))
    return (heads_below(hi) - heads_below(lo))/(hi - lo)


def mean_share(width, factors, lo, hi):
    """Mean over rates from lo to hi of the share of the phases rate*factors, between the kinks."""
    kinks = {lo, hi}
    for factor in factors:
        for turn in range(int(hi*factor/(2*pi)) + 2):
            kinks |= {edge/factor for edge in (2*pi*turn - width, 2*pi*turn + width) if lo < edge/factor < hi}
    kinks = sorted(kinks)
    parts = (quad(lambda rate: share_of_phases(width, rate*factors[0], rate*factors[1]), [a, b])
             for a, b in zip(kinks, kinks[1:]))
    return sum(parts, mpf(0))/(hi - lo)


def averages():
    speeds = [mpf("2.1"), mpf("2.7")]
    keller = mean_share(pi/2, [2*u/GRAVITY for u in speeds], 2*pi*36, 2*pi*40)
    figure("Keller's box", keller)
    for degrees in (60, 75, 90):
        width = acos(-cot(degrees*pi/180)**2)
        figure(f"finite flights, {degrees} degrees", mean_share(width, [2*v/GRAVITY for v in (3, 5)], mpf(2), mpf(20)))


def box(panels):
    """Rates uniform in [1, 60] on each axis, speeds in [3, 5], k = 1/2; Omega^2 = x^2 + y^2 has a closed density."""
    k, g, lo, hi = 0.5, 9.81, 1.0, 60.0
    nodes, weights = np.polynomial.legendre.leggauss(6)

    def rule(breaks, count):
        edges = np.concatenate([np.linspace(a, b, max(1, round(count*(b - a)/(breaks[-1] - breaks[0]))) + 1)[:-1]
                                for a, b in zip(breaks, breaks[1:])] + [[breaks[-1]]])
        half, middle = np.diff(edges)/2, (edges[1:] + edges[:-1])/2
        return (middle[:, None] + half[:, None]*nodes).ravel(), (half[:, None]*weights).ravel()

    def density(radius):
        """Length of the arc of this radius inside the square, over the square's area."""
        first = np.arccos(np.minimum(1.0, hi/radius))
        begin = np.maximum(first, np.arcsin(np.minimum(1.0, lo/radius)))
        end = np.minimum(np.arccos(np.minimum(1.0, lo/radius)), np.arcsin(np.minimum(1.0, hi/radius)))
        return radius*np.maximum(0.0, end - begin)/(hi - lo)**2

    def share(radius, spin):
        rate = np.hypot(radius, spin)
        width = np.arccos(-np.minimum(1.0, (spin/radius)**2))

        def heads_below(phase):
            turn = np.floor((phase + np.pi)/(2*np.pi))
            return 2*width*turn + np.clip(phase - 2*np.pi*turn, -width, width)
        begin, end = rate*2*3/g, rate*2*5/g
        return (heads_below(end) - heads_below(begin))/(end - begin)

    total = 0.0
    corners = [np.sqrt(2.0), np.sqrt(1 + 3600.0), 60*np.sqrt(2.0)]
    # The arc's length has kinks at the corners, the share one at Omega = k omega_z: split there in both directions.
    spins, spin_weights = rule([lo, 2*corners[0], hi], panels)
    for spin, weight in zip(spins, spin_weights):
        kink = k*spin
        breaks = sorted({*corners, *([kink] if corners[0] < kink < corners[2] else [])})
        # Omega = kink + s^2 above the kink takes the square root out of the share.
        start = max(kink, corners[0])
        below = 0.0
        if kink > corners[0]:
            radius, radius_weights = rule([b for b in breaks if b <= kink], panels)
            below = np.sum(radius_weights*density(radius))
        roots, root_weights = rule([np.sqrt(b - start) for b in breaks if b >= start], 4*panels)
        radius = start + roots**2
        above = np.sum(root_weights*2*roots*density(radius)*share(radius, k*spin))
        total += weight*(below + above)/(hi - lo)
    return total


def four_coordinates():
    coarse, fine = box(1000), box(2200)
    digits = int(-np.log10(abs(coarse - fine)))
    figure("box of four coordinates", mpf(fine), digits)


def mean_over(density, share, edges, lo, hi):
    """Mean of a share with kinks at the edges, by Gauss-Legendre between them."""
    cuts = [lo, *sorted(edge for edge in edges if lo < edge < hi), hi]
    pieces = [a + (b - a)*i/16 for a, b in zip(cuts, cuts[1:]) for i in range(16)] + [hi]
    return quad(lambda x: density(x)*share(x), pieces)


def normal_density(mean, deviation):
    return lambda x: mp.npdf(x, mean, deviation)


def rare_kinks():
    """Smooth shares with a kink or a jump that few launches meet. With omega_x = omega_z = 0, cos theta is
    cos(tilt) cos(phase), so that heads and tails change places where the tilt passes 90 degrees."""
    first, last = 2*mpf(2)/GRAVITY, 2*mpf(3)/GRAVITY
    edges = [(2*n + 1)*pi/2/time for n in range(12) for time in (first, last)]

    def share(rate):
        return share_of_phases(pi/2, rate*first, rate*last)

    def beyond(tilt, deviation):
        return mp.erfc(tilt/deviation/sqrt(mpf(2)))

    even = mean_over(lambda rate: 100, share, edges, mpf("2.7"), mpf("2.71"))
    jump = beyond(pi/2, mpf("0.34"))
    figure("rare, tails of a tilt", even*(1 - jump) + (1 - even)*jump, 15)

    def normal_speeds(rate):
        mean, deviation = 2*rate*mpf("2.4")/GRAVITY, 2*rate*mpf("0.12")/GRAVITY
        return sum(mp.ncdf(2*pi*n + pi/2, mean, deviation) - mp.ncdf(2*pi*n - pi/2, mean, deviation) for n in range(-1, 6))
    even = mean_over(normal_density(10, mpf("0.5")), normal_speeds, [], mpf(5), mpf(15))
    jump = beyond(pi/2, pi/9)
    figure("rare, tails of a tilt and of speeds", even*(1 - jump) + (1 - even)*jump, 15)

    one = mean_over(normal_density(10, mpf("0.35")), share, edges, mpf(6), mpf(14))
    figure("rare, tails of a rate", one, 15)
    # The distance from the origin of two normal numbers whose means are 8 and 6.
    variance = mpf("0.37")**2
    two = mean_over(lambda r: r/variance*mp.exp(-(r*r + 100)/(2*variance))*mp.besseli(0, 10*r/variance), share, edges,
                    mpf(6), mpf(14))
    figure("rare, tails of two rates", two, 15)

    def grazing(across, spin, lo=2*mpf(3)/GRAVITY, hi=2*mpf(5)/GRAVITY):
        rate, width = mp.hypot(across, spin/2), acos(-min(mpf(1), (spin/2/across)**2))
        return share_of_phases(width, rate*lo, rate*hi)

    def over_spins(across, hi):
        """Spin = 2 across - s^2 takes the square root out of the share; beyond the cone of 45 degrees it is 1."""
        kink = min(2*across, hi)
        roots = [sqrt(2*across - kink), sqrt(2*across - 39)]
        inside = mean_over(lambda s: 2*s, lambda s: grazing(across, 2*across - s*s), [], *roots)
        return (inside + hi - kink)/(hi - 39)

    figure("rare, a range beyond 45 degrees", over_spins(mpf(20), mpf("40.001")), 12)


if __name__ == "__main__":
    shares()
    isotropic()
    averages()
    rare_kinks()
    four_coordinates()
