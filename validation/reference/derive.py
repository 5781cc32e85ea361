"""Derives the reference numbers of this folder in 50 digits. Needs Python 3 and mpmath (1.3 was used); no code of ours.

Everything is computed twice: from the closed form of the motion, and by integrating the equations of motion with
mpmath's Taylor-series solver. The numbers are printed only if both agree to 30 digits.
"""
from mpmath import mp, mpf, matrix, sin, cos, sqrt, atan2, acos, asin, pi, odefun, cot

mp.dps = 50


def multiply(a, b):
    w, x, y, z = a
    s, i, j, k = b
    return [w*s - x*i - y*j - z*k, w*i + x*s + y*k - z*j, w*j - x*k + y*s + z*i, w*k + x*j - y*i + z*s]


def closed_form(i1, i3, rate, launch, t):
    x, y, z = rate
    k = i3 / i1
    s = [x, y, k*z]
    precession = sqrt(sum(c*c for c in s))
    half, spin = precession*t/2, (k - 1)*z*t
    turn = [cos(half)] + [c/precession*sin(half) for c in s]
    return multiply(multiply(launch, turn), [cos(spin/2), 0, 0, -sin(spin/2)])


def integrated(i1, i3, rate, launch, t):
    """Euler's equations for three moments, and Q' = Q (0, omega) / 2."""
    def derivative(_, y):
        q, (a, b, c) = y[:4], y[4:]
        turn = multiply(q, [0, a, b, c])
        return [part/2 for part in turn] + [(i1 - i3)*b*c/i1, (i3 - i1)*c*a/i1, mpf(0)]
    return odefun(derivative, 0, list(launch) + list(rate))(t)[:4]


def attitude(i1, i3, rate, tilt, t):
    i1, i3, rate, tilt, t = mpf(i1), mpf(i3), [mpf(c) for c in rate], mpf(tilt), mpf(t)
    launch = [cos(tilt/2), sin(tilt/2), mpf(0), mpf(0)]
    one, two = (solve(i1, i3, rate, launch, t) for solve in (closed_form, integrated))
    sign = 1 if sum(a*b for a, b in zip(one, two)) > 0 else -1
    assert max(abs(a - sign*b) for a, b in zip(one, two)) < mpf(10)**-30, (one, two)
    return one


def tilt_of(q):
    w, x, y, z = q
    return w*w + z*z - x*x - y*y


def show(number):
    return mp.nstr(number, 32, strip_zeros=False)


def toss(i1, i3, rate, rest):
    launch = f'rate = [{", ".join(str(c) for c in rate)}], {rest}'
    return f"toss = {{ coin = {{ moments = [{i1}, {i3}] }}, launch = {{ {launch} }} }}"


def flight(name, i1, i3, rate, t, tilt="0.0", time=None):
    q = attitude(i1, i3, rate, tilt, t)
    # The time as an expression where it is no decimal number.
    clock = time or f"time = {t}"
    print(f'[[flight]]\nname = "{name}"\n{toss(i1, i3, rate, f"{clock}, tilt = {tilt}")}')
    print(f'cos_tilt = "{show(tilt_of(q))}"')
    print(f'attitude = [{", ".join(show(c) for c in q)}]\n')


def thrown(name, i1, i3, rate, speed, gravity, drop=None, tilt="0.0"):
    """A flight of which the speed, gravity and the drop (m) to the height of the catch are given."""
    v, g, h = mpf(speed), mpf(gravity), mpf(drop or 0)
    t = (v + sqrt(v*v + 2*g*h))/g
    # The height at that time, by the parabola and not by the formula: the catch is on the way down.
    assert abs(v*t - g*t*t/2 + h) < mpf(10)**-45 and g*t >= v
    clock = f"speed = {speed}, gravity = {gravity}" + (f", drop = {drop}" if drop else "")
    flight(name, i1, i3, rate, t, tilt=tilt, time=clock)


def flights():
    for name, i3, rate in [("cheated", "2.5e-7", "1 1 2.5"), ("tails", "2.5e-7", "2 2 0.5"), ("cheated disc", "1e-6", "1 1 2.5")]:
        for speed in "345":
            t = 2*mpf(speed)/mpf("9.81")
            rate_list = [c if "." in c else c + ".0" for c in rate.split()]
            flight(f"{name}, v0 = {speed} m/s", "5e-7", i3, rate_list, t, time=f"speed = {speed}.0, gravity = 9.81")
    flight("Kane's body at 1 s", "0.04", "0.02", ["2.0", "4.0", "6.0"], "1.0")
    flight("Kane's body at 10 s", "0.04", "0.02", ["2.0", "4.0", "6.0"], "10.0")
    flight("tilted, alpha' changes sign", "1.0", "0.5", ["0.25", "0.25", "5.0"], "5.0", tilt="1.0")
    flight("end over end, without spin", "1.0", "1.96875", ["3.0", "-4.0", "0.0"], "2.0")
    flight("pure spin, tilted", "1.0", "1.96875", ["0.0", "0.0", "7.0"], "1.5", tilt="0.5")
    flight("sphere", "1.0", "1.0", ["1.0", "-2.0", "3.0"], "3.0", tilt="2.0")
    flight("rod", "1.0", "0.0", ["1.0", "-2.0", "3.0"], "3.0", tilt="0.25")
    flight("fast coin, upside down", "1.0", "1.96875", ["-35.0", "40.0", "-52.5"], "0.75", tilt="3.0")
    thrown("weak gravity, caught below", "5e-10", "2.5e-10", ["1.0", "1.0", "2.5"], "1.0", "1.625", "1.0")
    thrown("weak gravity, caught above", "64.0", "126.0", ["-3.0", "2.0", "5.0"], "2.0", "1.625", "-1.0")
    thrown("strong gravity, same height", "1e-12", "1.5e-12", ["6.0", "-2.5", "4.0"], "12.0", "24.75", tilt="1.5")
    thrown("strong gravity, caught below", "1000.0", "250.0", ["8.0", "15.0", "-12.0"], "6.0", "24.75", "7.5", tilt="2.5")
    thrown("let go, caught below", "1e-12", "2e-12", ["4.0", "-7.0", "20.0"], "0.0", "9.81", "1.25", tilt="0.5")


def flips():
    for name, i3, rate in [("cheated", "0.5", (1, 1, 2.5)), ("tails", "0.5", (2, 2, 0.5))]:
        x, y, z = [mpf(c) for c in rate]
        spin = mpf(i3)*z
        precession = sqrt(x*x + y*y + spin*spin)
        cot_squared = spin*spin/(x*x + y*y)
        time = f"time = {show(acos(-cot_squared)/precession)}"
        print(f'[[first_flip]]\nname = "{name}"\n{toss("5e-7", "2.5e-7", [x, y, z], time)}\n')


def long_flights():
    for degrees in range(45, 91, 5):
        angle = degrees*pi/180
        # The integral of the indicator over the phase, not the closed form's arc sine: the edge by root finding.
        edge = mp.findroot(lambda phase: cos(angle)**2 + sin(angle)**2*cos(phase), pi*mpf(3)/4) if degrees > 45 else pi
        assert abs(edge/pi - (mpf(1)/2 + asin(cot(angle)**2)/pi)) < mpf(10)**-20
        print(f'[[long_flight]]\ncone_deg = {degrees}.0\nprobability = {show(mpf(1)/2 + asin(cot(angle)**2)/pi)}\n')


if __name__ == "__main__":
    flights()
    flips()
    long_flights()
