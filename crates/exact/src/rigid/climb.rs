//! The ladder of numbers: balls of f64, of double-double, and of 192, 384, 768, … binary digits. A question about a toss climbs it
//! until the numbers have digits enough for an answer.

use dynamics::time_of_flight::ExactTime;
use dynamics::{Stage, Toss};
use numerics::{Elementary, WideBall};

use super::given::Given;
use super::quaternion::Quaternion;
use super::special::Special;
use crate::given::rounded;

/// Digits of the first stage after double-double, and of the last. A flight of 10^6 rad of a tensor next to a spin about the middle
/// axis, 1e-60 of the rate off it, takes the last.
const DIGITS: [usize; 2] = [192, 12_288];

/// Digits of the last stage of a special motion, which loses none with the length of a flight: what they do not decide is a tie.
const MOST_OF_SPECIAL: usize = 1536;

/// What can be asked of the landing, with an answer if the numbers have digits enough.
pub(super) trait Question {
    type Answer;
    fn answer<N: Elementary>(&self, landed: &Landed<N>) -> Option<Self::Answer>;
}

/// Both questions at once.
impl<A: Question, B: Question> Question for (A, B) {
    type Answer = (A::Answer, B::Answer);

    fn answer<N: Elementary>(&self, landed: &Landed<N>) -> Option<Self::Answer> {
        Some((self.0.answer(landed)?, self.1.answer(landed)?))
    }
}

/// A body that has turned since its launch.
pub(super) struct Landed<N> {
    pub(super) given: Given<N>,
    /// Of any norm.
    pub(super) turn: Quaternion<N>,
    special: Option<Special>,
}

impl<N: Elementary> Landed<N> {
    /// `None` if the numbers have too few digits.
    fn new(given: Given<N>, special: Option<Special>) -> Option<Self> {
        let turn = given.turn(special)?;
        Some(Self { given, turn, special })
    }

    /// The body rate (BF) in the unit of the given one.
    pub(super) fn rate(&self) -> [N; 3] {
        self.given.rate_after(&self.turn, self.special)
    }
}

/// The answer to a question about a toss at its landing, or else after `time`, and the stage that has it; `None` if the last
/// one has too few digits. The `first` stage is f64 or double-double.
pub(super) fn climb<Q: Question>(
    toss: &Toss,
    time: Option<ExactTime>,
    first: Stage,
    question: &Q,
) -> Option<(Q::Answer, Stage)> {
    let seen = Special::at_sight(toss);
    let fine = Given::in_double_double(toss, time);
    if first == Stage::F64 {
        let rough = Landed::new(fine.map(rounded), seen);
        if let Some(answer) = rough.and_then(|landed| question.answer(&landed)) {
            return Some((answer, Stage::F64));
        }
    }
    if let Some(answer) = Landed::new(fine, seen).and_then(|landed| question.answer(&landed)) {
        return Some((answer, Stage::DoubleDouble));
    }
    let special = seen.or_else(|| Special::of(toss));
    let in_digits = |digits| -> Option<Landed<WideBall>> { Landed::new(Given::in_digits(toss, time, digits), special) };
    let most = if special.is_some() { MOST_OF_SPECIAL } else { DIGITS[1] };
    let digits = std::iter::successors(Some(DIGITS[0]), |digits| Some(2 * digits));
    let mut digits = digits.take_while(|digits| *digits <= most);
    let found = digits.find_map(|digits| question.answer(&in_digits(digits)?));
    found.map(|answer| (answer, Stage::MoreDigits))
}
