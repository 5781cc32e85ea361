"""Derives coins.toml, the moments of inertia of the catalogue's coins. Needs Python 3 alone; no code of ours.

I1 = m (3 r^2 + h^2)/12 and I3 = m r^2/2 of a homogeneous cylinder, in decimal arithmetic of 40 digits.
"""
from decimal import Decimal, getcontext

getcontext().prec = 40

# Name, mass (g), diameter (mm), thickness (mm). US coins: United States Mint, Coin Specifications,
# https://www.usmint.gov/learn/coins-and-medals/circulating-coins/coin-specifications
# Euro coins: Council Regulation (EU) No 729/2014, Annex I, Official Journal L 194, 2.7.2014, p. 1.
PUBLISHED = """
us-cent     2.500  19.05  1.52
us-nickel   5.000  21.21  1.95
us-dime     2.268  17.91  1.35
us-quarter  5.670  24.26  1.75
us-half    11.340  30.61  2.15
us-dollar   8.1    26.49  2.00
euro-1c     2.30   16.25  1.67
euro-2c     3.06   18.75  1.67
euro-5c     3.92   21.25  1.67
euro-10c    4.10   19.75  1.93
euro-50c    7.80   24.25  2.38
euro-1      7.50   23.25  2.33
euro-2      8.50   25.75  2.20
"""


def show(name, i1, i3):
    print(f'[[coin]]\nname = "{name}"\ni1 = {i1:.20e}\ni3 = {i3:.20e}\n')


# The paper's moments, and those of a disc without height of the same I1.
show("paper", Decimal("5e-7"), Decimal("2.5e-7"))
show("disc", Decimal("5e-7"), Decimal("1e-6"))
for line in PUBLISHED.split("\n"):
    if line:
        name, mass, diameter, thickness = line.split()
        mass, radius, height = Decimal(mass)/1000, Decimal(diameter)/2000, Decimal(thickness)/1000
        show(name, mass*(3*radius**2 + height**2)/12, mass*radius**2/2)
