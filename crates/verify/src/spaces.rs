//! A space that both the benchmarks and the planner's measurements take.

use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::Space;
use toss::{Coin, InputError};

pub(crate) fn box_of_launches() -> Result<Space, InputError> {
    Space::parse(Coin::PAPER, &[(RateX, "1:60"), (RateY, "1:60"), (RateZ, "1:60"), (Speed, "3:5")])
}
