//! This file lists the launches of a plan one by one, with the values of their coordinates. Programs print or solve them
//! without counting; blocks keep the memory small however many launches there are.

use dynamics::{InputError, Toss};

use crate::block::{BLOCK, Block};
use crate::coordinate::Coordinate;
use crate::plan::Plan;
use crate::sequences::Sequences;
use crate::space::Space;

/// A launch of a space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawn {
    /// The values of [`Coordinate::OF_LAUNCH`]. A tied coordinate has the value of its partner.
    pub values: [f64; 6],
    /// The toss with these values.
    pub toss: Toss,
}

impl Space {
    /// The launches that `plan` tries, in their order, in blocks of a few hundred.
    ///
    /// # Errors
    /// [`InputError`] if the plan does not fit the space, and for [`Plan::ExactSpeed`], whose points have no speed.
    pub fn drawn(&self, plan: Plan) -> Result<impl Iterator<Item = Vec<Drawn>> + use<>, InputError> {
        if let Plan::ExactSpeed(_) = plan {
            let (field, value) = ("method", "exact-speed".to_owned());
            return Err(InputError::Malformed { field, value, expected: "a method that draws launches" });
        }
        let sequences = Sequences::new(self, plan)?.into_launches();
        let space = *self;
        Ok(sequences.flat_map(move |(launches, number)| {
            let mut block = Block::new(&space);
            (0..number).step_by(BLOCK).map(move |start| {
                launches.write(start..number.min(start + BLOCK as u64), &mut block);
                (0..block.len()).map(|index| space.drawn_from(&block, index)).collect()
            })
        }))
    }

    fn drawn_from(&self, block: &Block, index: usize) -> Drawn {
        let values = block.values(index);
        Drawn { values: Coordinate::OF_LAUNCH.map(|of| values[self.place(of) as usize]), toss: self.toss(&values) }
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Outcome};
    use exact::certify;

    use super::*;
    use crate::coordinate::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
    use crate::plan::{Rest, Scrambled};
    use crate::random::random_tosses;
    use crate::sampler::Sampler;

    fn space() -> Space {
        let texts = [
            (RateX, "1:60:40"),
            (RateY, "x"),
            (RateZ, "1:60:10"),
            (Speed, "3:5:4"),
            (Gravity, "9:10:2"),
            (Tilt, "0.1"),
        ];
        Space::parse(Coin::PAPER, &texts).unwrap()
    }

    fn all(space: &Space, plan: Plan) -> Vec<Drawn> {
        space.drawn(plan).unwrap().flatten().collect()
    }

    #[test]
    fn the_launches_of_a_plan_have_the_outcomes_that_an_estimate_counts() {
        for plan in [
            Plan::Grid,
            Plan::Random { points: 1500, seed: 7 },
            Plan::Sobol(Scrambled::new(1600, 3)),
            Plan::Sobol(Scrambled { points: 777, scrambles: 1, seed: 3 }),
        ] {
            for drop in [None, Some(0.7)] {
                let space = space().with_drop(drop).unwrap();
                let drawn = all(&space, plan);
                let heads =
                    drawn.iter().filter(|drawn| certify(&drawn.toss).unwrap().outcome() == Outcome::Heads).count();
                let found = Sampler::exact().estimate(&space, plan).unwrap();
                assert_eq!(drawn.len() as u64, found.points);
                assert_eq!(heads as f64 / drawn.len() as f64, found.probability, "{plan:?}");
            }
        }
        let random: Vec<_> =
            all(&space(), Plan::Random { points: 600, seed: 7 }).iter().map(|drawn| drawn.toss).collect();
        assert_eq!(random, random_tosses(&space(), 7, 0..600));
    }

    #[test]
    fn the_values_are_those_of_the_toss() {
        for Drawn { values: [x, y, z, speed, gravity, tilt], toss } in
            all(&space(), Plan::Random { points: 9, seed: 1 })
        {
            assert_eq!([x, y, z], <[f64; 3]>::from(toss.launch.rate()));
            assert_eq!((x, tilt), (y, 0.1));
            assert_eq!(toss.launch.flight_time(), 2.0 * speed / gravity);
        }
    }

    #[test]
    fn plans_that_draw_no_launches_are_refused() {
        let refused = space().drawn(Plan::ExactSpeed(Rest::Grid)).err().unwrap();
        assert_eq!(refused.field(), "method");
        assert!(space().drawn(Plan::Random { points: 0, seed: 1 }).is_err());
    }
}
