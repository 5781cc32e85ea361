"""Derives elliptic.toml. Needs Python 3, mpmath (1.3 was used) and python-flint (Arb's arithmetic); no code of ours.

Each number is computed by mpmath and, as an interval with a proven radius, by Arb. It is printed only if both agree to 60
digits. Arguments are f64 numbers and are taken exactly.
"""
from flint import acb, arb, ctx, fmpq
from mpmath import ellipf, ellipk, exp, jtheta, mp, mpc, mpf, pi, sqrt, atan2

mp.dps = 1400
ctx.prec = 4700


def to_arb(value):
    """The f64 `value` exactly."""
    return arb(fmpq(*value.as_integer_ratio()))


def show(number):
    return mp.nstr(number, 60, strip_zeros=False, min_fixed=-2, max_fixed=6)


def agreed(number, interval):
    text = interval.str(70, radius=False)
    assert abs(mpf(text) - number) <= mpf(10)**-60*max(abs(number), mpf(10)**-300), (number, interval)
    return show(number)


def arb_f(sin, cos, kc):
    """F by Carlson's R_F(cos², kc² sin² + cos², 1), all homogeneous in (sin, cos)."""
    s, c, k = to_arb(sin), to_arb(cos), to_arb(kc)
    return s*arb.elliptic_rf(c*c, c*c + k*k*s*s, c*c + s*s) if hasattr(arb, "elliptic_rf") else \
        (acb(s)*acb.elliptic_rf(acb(c*c), acb(c*c + k*k*s*s), acb(c*c + s*s))).real


COMPLEMENTS = [1e-300, 1e-150, 1e-30, 1e-15, 1e-8, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1 - 1e-8, 1 - 1e-15, 1.0]


def complete():
    for kc in COMPLEMENTS:
        k = ellipk(1 - mpf(kc)**2)
        print(f'[[complete]]\ncomplementary_modulus = {kc!r}')
        print(f'k = "{agreed(k, acb(1 - to_arb(kc)**2).elliptic_k().real)}"\n')


def incomplete():
    for kc in COMPLEMENTS[:-1]:
        for sin, cos in [(1e-12, 1.0), (0.001, 1.0), (0.3, 1.0), (1.0, 1.0), (3.0, 1.0), (40.0, 1.0), (1.0, 1e-5), (1.0, kc), (1.0, 3*kc)]:
            if sin*kc > cos:
                continue
            f = ellipf(atan2(mpf(sin), mpf(cos)), 1 - mpf(kc)**2)
            print(f'[[incomplete]]\nsin = {sin!r}\ncos = {cos!r}\ncomplementary_modulus = {kc!r}')
            print(f'f = "{agreed(f, arb_f(sin, cos, kc))}"\n')


def nomes():
    for kc in COMPLEMENTS[:-1]:
        q = exp(-pi*ellipk(mpf(kc)**2)/ellipk(1 - mpf(kc)**2))
        m = to_arb(kc)**2
        interval = (-arb.pi()*acb(m).elliptic_k().real/acb(1 - m).elliptic_k().real).exp()
        print(f'[[nome]]\ncomplementary_modulus = {kc!r}\nq = "{agreed(q, interval)}"\n')


def thetas():
    for k, k_prime in [(1.0, 30.0), (1.5625, 4.0), (1.75, 2.0), (2.0, 1.75), (2.0, 1.0625), (2.0, 1.015625), (3.0, 1.5), (6.0, 1.5625), (40.0, 1.5625), (900.0, 1.5703125)]:
        for part in [0.0078125, 0.5, 0.75, 0.9921875]:
            for rho in [-0.4375, 0.0, 0.125, 0.4921875]:
                c = part*k_prime
                z = mpc(pi*mpf(rho) - pi/2, -pi*mpf(c)/(2*mpf(k)))
                q = exp(-2*pi*mpf(k_prime)/mpf(k))
                # Of a nome next to 1, mpmath's series has too many terms.
                near_1 = k > 100
                modular = acb(0, 1)*acb(to_arb(2*k_prime)/to_arb(k))
                argument = (acb(to_arb(rho)) - acb(to_arb(0.5)) - acb(0, 1)*acb(to_arb(c)/(2*to_arb(k))))
                arbs = [f for f in acb.modular_theta(argument, modular)]
                # Arb's order is θ1, θ2, θ3, θ4.
                found = [mpc(0), mpc(0)]
                size = None
                for index, (number, ours) in enumerate([(4, arbs[3]), (1, arbs[0])]):
                    assert ours.real.rad() + ours.imag.rad() < to_arb(1e-300), ours
                    value = mpc(mpf(ours.real.str(200, radius=False)), mpf(ours.imag.str(200, radius=False)))
                    if not near_1:
                        other = jtheta(number, z, q)
                        assert abs(other - value) <= mpf(10)**-60*(1 + abs(value)), (k, k_prime, c, rho, number)
                    found[index] = value
                size = sqrt(sum(abs(value)**2 for value in found))
                print(f'[[theta]]\nk = {k!r}\nk_prime = {k_prime!r}\nc = {c!r}\nrho = {rho!r}')
                parts = [part/size for value in found for part in (value.real, value.imag)]
                print(f'size = "{show(size)}"\ntheta = [{", ".join(chr(34) + show(p) + chr(34) for p in parts)}]\n')


if __name__ == "__main__":
    complete()
    incomplete()
    nomes()
    thetas()
