//! What a wrong solver most likely does, told from its answers to launches of every kind: a known mistake that explains
//! them, an error that is merely larger than allowed, or the launches on which alone it is right, or answers. If none of
//! these explains all, the smallest question that is left is shown. The reference judges which answers are right; where a
//! mistake lands is computed in f64. A cause is a conjecture from these launches, and is told with how many of them it
//! explains. Other bodies are asked for once coins are right.

mod hypotheses;

use std::cmp::Ordering;
use std::sync::Arc;
use std::time::{Duration, Instant};

use dynamics::{Phases, Toss};
use rayon::prelude::*;
use serde::Serialize;
use toss::{Attitude, SolverEntry};

use self::hypotheses::{HYPOTHESES, Hypothesis};
use super::any_launch;
use super::case;
use super::exact_landings::ExactLandings;
use super::reference::Reference;
use super::run::Allowance;
use super::subject::by_scheme;
use crate::process::Question;
use crate::shown::shown;

pub(crate) use self::hypotheses::{Numbers, turned_back};

/// The number of launches of coins that a diagnosis asks for, and as many of other bodies.
const LAUNCHES: u64 = 1000;

/// What these are called.
const KINDS: [&str; 2] = ["launches", "launches of bodies with three moments"];

/// Of the launches one in so many says whether a solver is right, before it is measured: a prime number, so that launches of
/// every kind are among them.
const ONE_IN: usize = 7;

/// So long the launches of one kind are asked for. What a slow solver has not answered by then is left out.
const ASKED_FOR: Duration = Duration::from_secs(20);

/// The tolerances at which they are asked for. Whoever is right at the first, and fails, is asked at the second.
const TOLERANCES: [f64; 2] = [any_launch::TOLERANCE, 1e-12];

/// The part of the answers that a cause has to explain.
const EXPLAINED: f64 = 0.95;

/// A few wrong answers show which hypotheses are worth trying on all.
const TRIED: usize = 24;

/// An angle (rad) that tells no answer from another, where less is allowed.
const NEAR: f64 = 1e-6;

/// The loosest tolerance that a solver may have which is right but for its accuracy (rad of error a rad of phase).
const ROUGH: f64 = 1e-2;

/// 1 + φ of the flights from whose errors a tolerance is told: those that turn, but not for long.
const MODERATE: std::ops::RangeInclusive<f64> = 1.1..=11.0;

/// How many times the error of a tolerance is still an error of it.
const NEAR_TOLERANCE: f64 = 10.0;

/// The least and the largest norm of a quaternion that is taken for one of norm 1 with the error of an integration.
pub(crate) const NORMS: std::ops::RangeInclusive<f64> = 0.9..=1.1;

/// How far the square of a norm may be from 1 by the rounding of a few products of unit quaternions.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// What stands before the reason why a program was given up.
pub(crate) const GIVEN_UP: &str = "is no longer asked: it ";

/// A launch that a solver was asked for, with its answer.
#[derive(Debug)]
pub(crate) struct Asked {
    toss: Toss,
    /// The question as the solver got it.
    question: String,
    numbers: Numbers,
    /// The answer as it was written, if it wrote any.
    line: Option<String>,
    /// The quaternion from BF to LF that was answered, or why there is none.
    answer: Result<[f64; 4], String>,
    /// Whether there is no answer because it took too long.
    is_late: bool,
    allowed: Allowance,
    exact: Arc<Reference>,
    /// The larger one of the errors of cos θ and of the attitude, as a part of what is allowed, and the latter (rad), both of
    /// the answer divided by its norm.
    errors: Option<[f64; 2]>,
    is_right: bool,
}

/// What a wrong solver most likely does.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Diagnosis {
    /// The solver, with its scheme.
    pub subject: String,
    /// The likeliest cause, in words.
    pub cause: String,
    /// Whether the cause explains every answer.
    pub explains_all: bool,
    /// The number of launches that it was asked for.
    pub launches: u64,
    /// The number of right answers.
    pub right: u64,
    /// The number of launches without an answer.
    pub without_answer: u64,
    /// The smallest question that the cause does not explain; if it explains all, the smallest that fails.
    pub example: Example,
}

/// A question with its answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Example {
    /// The question as the solver got it.
    pub question: String,
    /// The answer, or why there is none.
    pub answer: String,
    /// The attitude at landing and cos θ by the reference.
    pub expected: String,
}

impl Asked {
    /// What the solver of `entry` answers; `None` as for [`Ask`].
    fn of(
        entry: &SolverEntry,
        scheme: Option<toss::Scheme>,
        tolerance: f64,
        toss: &Toss,
        known: &ExactLandings,
    ) -> Option<Self> {
        let by = any_launch::subject(entry, scheme, tolerance, toss).ok()?;
        let landing = by.solver.land(toss);
        let (answer, estimate) = match &landing {
            Ok(landing) => (Ok(landing.state.attitude.components()), landing.error),
            Err(error) if toss.coin().is_none() && error.kind() == "not_symmetric" => return None,
            Err(error) => (Err(error.to_string()), None),
        };
        // Whoever states nothing is taken by a rough measure. cos θ is that of the rounded quaternion.
        let allowed = Allowance::by_estimate(estimate.unwrap_or(NEAR).max(ROUNDED));
        let line = answer.as_ref().ok().map(|parts: &[f64; 4]| parts.map(|part| format!("{part:?}")).join(","));
        let question = case::text(toss) + &case::settings(&by);
        let in_numbers = Question::new(toss, any_launch::TOLERANCE);
        Some(Self::new(toss, question, &in_numbers, line, answer, allowed, known.of(toss)?))
    }

    pub(crate) fn new(
        toss: &Toss,
        question: String,
        in_numbers: &Question,
        line: Option<String>,
        answer: Result<[f64; 4], String>,
        allowed: Allowance,
        exact: Arc<Reference>,
    ) -> Self {
        let numbers = in_numbers.numbers();
        let errors = answer.as_ref().ok().and_then(|answer| errors_of(*answer, &exact, &allowed));
        let has_norm = |answer: &[f64; 4]| {
            let off = exact.cos_tilt_error(cos_tilt_as_answered(*answer));
            NORMS.contains(&nalgebra::Vector4::from(*answer).norm()) && off <= allowed.cos_tilt
        };
        let is_right = errors.is_some_and(|[part, _]| part <= 1.0) && answer.as_ref().is_ok_and(has_norm);
        Self { toss: *toss, question, numbers, line, answer, is_late: false, allowed, exact, errors, is_right }
    }

    /// The same launch, whose answer took too long if `is_late`.
    pub(crate) fn late(self, is_late: bool) -> Self {
        Self { is_late, ..self }
    }

    /// Whether it is right once it is divided by its norm.
    fn is_right_in_direction(&self) -> bool {
        self.errors.is_some_and(|[part, _]| part <= 1.0)
    }

    /// Whether it is no fault that there is no answer.
    fn is_declined(&self) -> bool {
        self.answer.is_err() && !self.is_late && any_launch::may_be_declined(&self.toss)
    }

    /// Whether it was asked, and not only given up before.
    fn is_asked(&self) -> bool {
        !self.answer.as_ref().is_err_and(|why| why.contains(GIVEN_UP))
    }

    /// The angle (rad) by which an answer may differ from what a hypothesis says.
    fn near(&self) -> f64 {
        10.0 * self.allowed.attitude.max(NEAR)
    }

    /// Whether `hypothesis` explains the answer; `None` if it says nothing of this question.
    fn is_explained(&self, hypothesis: &Hypothesis) -> Option<bool> {
        let asked = (hypothesis.ask)(self.numbers);
        let right = || {
            let answer = Attitude::from_components(*self.answer.as_ref().ok()?).ok()?;
            let answer = (hypothesis.read)(&self.numbers, (answer * self.numbers.axes).components());
            Attitude::from_components(answer).ok()
        };
        let answer = right();
        match asked.angle_to(&answer.unwrap_or(Attitude::IDENTITY)) {
            Some(off) => Some(answer.is_some() && off <= self.near()),
            // Numbers without a landing explain why there is no answer.
            None => self.answer.is_err().then_some(true),
        }
    }

    /// The fewer digits a question has, and the shorter its flight, the easier it is to follow.
    fn size(&self) -> (usize, f64) {
        (
            self.question.split_once('\n').map_or(self.question.len(), |(_, numbers)| numbers.len()),
            self.toss.launch.flight_time(),
        )
    }

    /// The question with its answer and what was expected.
    pub(crate) fn example(&self) -> Example {
        let [w, x, y, z] = self.exact.components();
        let cos_tilt = self.exact.rounded_cos_tilt();
        let why = self.answer.as_ref().err().cloned().unwrap_or_default();
        Example {
            question: self.question.clone(),
            answer: shown(&self.line.clone().unwrap_or_else(|| format!("none: {why}"))),
            expected: format!("{w:?},{x:?},{y:?},{z:?} (or its negative), cos θ = {cos_tilt:?}"),
        }
    }
}

/// The [`Asked::errors`] of an answer.
fn errors_of(answer: [f64; 4], exact: &Reference, allowed: &Allowance) -> Option<[f64; 2]> {
    let attitude = Attitude::from_components(answer).ok()?;
    let angle = exact.attitude_error(&attitude);
    let cos_tilt = exact.cos_tilt_error(attitude.cos_tilt());
    Some([(cos_tilt / allowed.cos_tilt).max(angle / allowed.attitude), angle])
}

/// What the solver of `entry` most likely does wrong with each of its schemes, by those whose rows `fails` says to fail.
pub(crate) fn of_entry(
    entry: &SolverEntry,
    fails: &dyn Fn(&str) -> bool,
    known: &ExactLandings,
) -> anyhow::Result<Vec<Diagnosis>> {
    let mut found = Vec::new();
    for (entry, scheme) in by_scheme(entry) {
        let Some(toss) = any_launch::tosses(1)?.pop() else { continue };
        let name = any_launch::subject(entry, scheme, TOLERANCES[0], &toss)?.name;
        if fails(&name) {
            found.extend(of_solver(&name, &|toss, by| Asked::of(entry, scheme, by, toss, known))?);
        }
    }
    Ok(found)
}

/// What a solver answers to a toss at a tolerance; `None` if it takes no such body, or there is no reference of it.
type Ask<'a> = dyn Fn(&Toss, f64) -> Option<Asked> + Sync + 'a;

/// What `subject` most likely does wrong, by what `ask` answers.
pub(crate) fn of_solver(subject: &str, ask: &Ask<'_>) -> anyhow::Result<Option<Diagnosis>> {
    let launches = launches()?;
    let of = |kind: usize| TOLERANCES.iter().find_map(|by| of_kind(kind, &launches, 1, *by, subject, ask));
    Ok(of(0).or_else(|| of(1)))
}

/// The same by some of these launches.
pub(crate) fn of_some(subject: &str, ask: &Ask<'_>) -> anyhow::Result<Option<Diagnosis>> {
    let launches = launches()?;
    Ok((0..2).find_map(|kind| of_kind(kind, &launches, ONE_IN, TOLERANCES[0], subject, ask)))
}

/// By its answers to one in so many launches of a kind.
fn of_kind(
    kind: usize,
    launches: &[Vec<Toss>; 2],
    one_in: usize,
    tolerance: f64,
    subject: &str,
    ask: &Ask<'_>,
) -> Option<Diagnosis> {
    let asked = some_of(&launches[kind], one_in, tolerance, ask);
    // What is wrong for coins may be told apart by bodies.
    let also = kind == 0 && !asked.iter().all(|one| one.is_right);
    let also = if also { some_of(&launches[1], ONE_IN, tolerance, ask) } else { Vec::new() };
    diagnosis(subject, KINDS[kind], asked, &also)
}

/// The launches of which a diagnosis is made: of coins, and of other bodies.
fn launches() -> anyhow::Result<[Vec<Toss>; 2]> {
    Ok([any_launch::tosses(LAUNCHES)?, any_launch::bodies(LAUNCHES)?])
}

fn some_of(launches: &[Toss], one_in: usize, tolerance: f64, ask: &Ask<'_>) -> Vec<Asked> {
    let began = Instant::now();
    let asked = |toss| if began.elapsed() < ASKED_FOR { ask(toss, tolerance) } else { None };
    launches.par_iter().step_by(one_in).filter_map(asked).collect()
}

/// The likeliest cause of the wrong answers of `subject` to launches of this kind; `None` if all are right. Of two causes
/// that explain the same answers, that which explains more of what it answered `also` is likelier.
fn diagnosis(subject: &str, kind: &str, mut asked: Vec<Asked>, also: &[Asked]) -> Option<Diagnosis> {
    // Of what came after a program was given up nothing is known.
    if asked.iter().any(Asked::is_asked) {
        asked.retain(Asked::is_asked);
    }
    let is_mostly_silent = asked.iter().filter(|one| one.answer.is_err()).count() * 2 > asked.len();
    asked.retain(|one| is_mostly_silent || !one.is_declined());
    let wrong: Vec<&Asked> = asked.iter().filter(|one| !one.is_right).collect();
    let silent = wrong.iter().filter(|one| one.answer.is_err()).count();
    if wrong.is_empty() {
        return None;
    }
    let is_silent = is_mostly_silent || silent == wrong.len();
    // A few wrong answers are rather those of some launches than of a rough solver.
    let is_rare = wrong.len() * 10 < asked.len();
    let cause = (if is_rare || is_silent { split(&asked) } else { None })
        .or_else(|| is_silent.then(|| no_answer(kind, &asked)))
        .or_else(|| without_norm(&asked))
        .or_else(|| rough(&asked))
        .or_else(|| mistake(&asked, also))
        .or_else(|| split(&asked));
    let unknown = || {
        let (wrong, all, known) = (wrong.len(), asked.len(), HYPOTHESES.len());
        let words =
            format!("wrong in {wrong} of {all} {kind}, for a reason that none of the {known} known mistakes explains");
        Cause::unexplained(words, &asked)
    };
    let Cause { words, explains } = cause.unwrap_or_else(unknown);
    let unexplained = asked.iter().zip(&explains).filter(|(_, explained)| **explained == Some(false));
    let unexplained: Vec<&Asked> = unexplained.map(|(one, _)| one).collect();
    let explains_all = unexplained.is_empty();
    let is_wrong_beside = unexplained.iter().any(|one| !one.is_right);
    let shown_of = if explains_all { &wrong } else { &unexplained };
    let shown_of = shown_of.iter().filter(|one| !is_wrong_beside || !one.is_right);
    let example = shown_of.min_by(|a, b| a.size().partial_cmp(&b.size()).unwrap_or(Ordering::Equal))?.example();
    Some(Diagnosis {
        subject: subject.to_owned(),
        cause: shown(&words),
        explains_all,
        launches: asked.len() as u64,
        right: (asked.len() - wrong.len()) as u64,
        without_answer: silent as u64,
        example,
    })
}

/// A cause.
struct Cause {
    words: String,
    /// Whether it explains each of the answers; `None` where it says nothing.
    explains: Vec<Option<bool>>,
}

impl Cause {
    /// One that explains no wrong answer.
    fn unexplained(words: String, asked: &[Asked]) -> Self {
        Self { words, explains: asked.iter().map(|one| Some(one.is_right)).collect() }
    }

    /// One that explains what it does, in `words` with the number.
    fn explaining(words: &str, explains: Vec<Option<bool>>) -> Self {
        let said = explains.iter().flatten().count();
        let rest = explains.len() - said;
        let rest = if rest == 0 { String::new() } else { format!(", and {rest} have no landing then") };
        Self { words: format!("{words}: {} of {said}{rest}", count(&explains)), explains }
    }
}

fn count(explains: &[Option<bool>]) -> usize {
    explains.iter().filter(|explained| **explained == Some(true)).count()
}

/// Answers that are missing: the cause of nothing but all of them.
fn no_answer(kind: &str, asked: &[Asked]) -> Cause {
    let (reason, silent) = most_frequent_reason(asked);
    if silent == asked.len() {
        let words = format!("no answer to any of the {kind}: {reason}");
        return Cause { words, explains: vec![Some(true); silent] };
    }
    Cause::unexplained(format!("no answer to {silent} of {} {kind}: {reason}", asked.len()), asked)
}

/// The most frequent reason why there is no answer, and to how many launches there is none.
fn most_frequent_reason(asked: &[Asked]) -> (&str, usize) {
    let reasons = asked.iter().filter_map(|one| one.answer.as_ref().err());
    // A program that is given up says of all launches that follow what it did.
    let mut reasons: Vec<&str> = reasons.map(|why| why.strip_prefix(GIVEN_UP).unwrap_or(why)).collect();
    reasons.sort_unstable();
    let most = reasons.chunk_by(|a, b| a == b).max_by_key(|same| same.len());
    (most.map_or("", |same| same[0]), reasons.len())
}

/// A known mistake that explains nearly all answers, the wrong and the right ones.
fn mistake(asked: &[Asked], also: &[Asked]) -> Option<Cause> {
    let answered: Vec<&Asked> = asked.iter().filter(|one| one.answer.is_ok()).collect();
    // An answer that is nearly right is explained by every hypothesis that changes nothing there.
    let is_far = |one: &&Asked| one.errors.is_none_or(|[_, angle]| angle > one.near());
    let wrong: Vec<&Asked> = answered.iter().copied().filter(is_far).collect();
    let few: Vec<&Asked> = wrong.iter().copied().step_by((wrong.len() / TRIED).max(1)).collect();
    let also: Vec<&Asked> = also.iter().collect();
    let share = |hypothesis: &Hypothesis, on: &[&Asked]| {
        let explains: Vec<_> = on.par_iter().map(|one| one.is_explained(hypothesis)).collect();
        count(&explains) as f64 / explains.iter().flatten().count().max(on.len().div_ceil(2)) as f64
    };
    let explains = |hypothesis: &&Hypothesis| share(hypothesis, &few) > 0.75 && share(hypothesis, &wrong) >= EXPLAINED;
    let scored = HYPOTHESES.iter().filter(explains).map(|hypothesis| (share(hypothesis, &answered), hypothesis));
    let scored = scored.filter(|(of_answered, _)| *of_answered >= EXPLAINED);
    let scored = scored.map(|(of_answered, hypothesis)| ([of_answered, share(hypothesis, &also)], hypothesis));
    let (_, best) = scored.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
    let explains = asked.par_iter().map(|one| one.is_explained(best)).collect();
    Some(Cause::explaining(&format!("right if {}", best.words), explains))
}

/// Quaternions that are wrong by their norm alone.
fn without_norm(asked: &[Asked]) -> Option<Cause> {
    let explains: Vec<_> = asked.iter().map(|one| Some(one.is_right_in_direction())).collect();
    let answered = asked.iter().filter(|one| one.answer.is_ok()).count();
    let wrong = asked.iter().filter(|one| one.answer.is_ok() && !one.is_right).count();
    let is_so = ((answered - count(&explains)) as f64) <= (1.0 - EXPLAINED) * wrong as f64;
    is_so.then(|| Cause::explaining("right if its quaternion is divided by its norm", explains))
}

/// An error that is merely larger than allowed, as of an integrator with too loose a tolerance or too long a step: in flights
/// of moderate phase φ it is in proportion to 1 + φ, and in longer ones it grows at most by φ².
fn rough(asked: &[Asked]) -> Option<Cause> {
    let growth = |one: &Asked| Some((1.0 + Phases::new(&one.toss).ok()?.largest, one.errors?));
    let errors: Vec<Option<(f64, [f64; 2])>> = asked.iter().map(growth).collect();
    let moderate = errors.iter().flatten().filter(|(growth, _)| MODERATE.contains(growth));
    let mut of_moderate: Vec<(f64, f64)> = moderate.map(|(growth, [part, angle])| (angle / growth, *part)).collect();
    of_moderate.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Whoever keeps the tolerance in these flights does something else wrong.
    let (tolerance, _) =
        *of_moderate.get((of_moderate.len() as f64 * EXPLAINED) as usize).filter(|(_, part)| *part > 1.0)?;
    let is_explained = |(growth, [part, angle]): &(f64, [f64; 2])| {
        *part <= 1.0 || *angle <= NEAR_TOLERANCE * tolerance * growth.powi(2)
    };
    let explains: Vec<_> = errors.iter().map(|error| Some(error.as_ref().is_some_and(is_explained))).collect();
    let is_rough = tolerance <= ROUGH && count(&explains) as f64 >= EXPLAINED * errors.iter().flatten().count() as f64;
    let words = format!("right up to a tolerance of about {tolerance:.0e}, looser than asked or claimed");
    is_rough.then(|| Cause::explaining(&words, explains))
}

/// cos θ = w² + z² - x² - y² of a quaternion as it was answered. That its norm is off by rounding is not its fault.
pub(crate) fn cos_tilt_as_answered([w, x, y, z]: [f64; 4]) -> f64 {
    let square = w * w + x * x + y * y + z * z;
    let cos_tilt = w * w + z * z - x * x - y * y;
    if (square - 1.0).abs() <= ROUNDED { cos_tilt / square } else { cos_tilt }
}

/// A number of a question by which right and wrong answers may be told apart.
struct Feature(&'static str, fn(&Toss, &Numbers) -> f64);

const FEATURES: [Feature; 18] = [
    Feature("k = i3/i1", |_, of| of.k()),
    Feature("i2/i1", |_, of| of.moments[1] / of.moments[0]),
    Feature("i3/i2", |_, of| of.moments[2] / of.moments[1]),
    Feature("the smallest moment divided by the largest", |_, of| of.thinness()),
    Feature("2 T I/S² (energy T, angular momentum S, middle moment I)", |_, of| of.side_of_the_separatrix()),
    Feature("the time", |_, of| of.time),
    Feature("the phase (rad)", |toss, _| Phases::new(toss).map_or(f64::INFINITY, |phases| phases.largest)),
    Feature("the tilt at launch (rad)", |_, of| {
        let [w, x, y, z] = of.attitude;
        2.0 * x.hypot(y).atan2(w.hypot(z))
    }),
    Feature("the largest component of the rate", |_, of| nalgebra::Vector3::from(of.rate).amax()),
    Feature("i1", |_, of| of.moments[0]),
    Feature("w", |_, of| of.attitude[0]),
    Feature("x", |_, of| of.attitude[1]),
    Feature("y", |_, of| of.attitude[2]),
    Feature("z", |_, of| of.attitude[3]),
    Feature("y² + z²", |_, of| of.attitude[2].powi(2) + of.attitude[3].powi(2)),
    Feature("rate_x", |_, of| of.rate[0]),
    Feature("rate_y", |_, of| of.rate[1]),
    Feature("rate_z", |_, of| of.rate[2]),
];

/// The fewest answers on the side of a bound on which all are right, and on the other one. More than the former have no time
/// of flight, in which every solver is right. The latter would by chance be the last of a thousand in one of 10^7 cases.
const SIDES: [usize; 2] = [50, 3];

/// The part of the answers on the other side of a bound that has to be wrong.
const RULED_OUT: f64 = 0.75;

/// A bound of one number of the question on whose one side all answers are right, and on the other nearly all are wrong.
fn split(asked: &[Asked]) -> Option<Cause> {
    let mut best: Option<(f64, String)> = None;
    for Feature(name, number) in &FEATURES {
        for sign in [1.0, -1.0] {
            let of = |one: &Asked| (sign * number(&one.toss, &one.numbers), one.is_right);
            // 0/0 is none.
            let mut sorted: Vec<(f64, bool)> = asked.iter().map(of).filter(|(number, _)| !number.is_nan()).collect();
            sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
            let Some(first) = sorted.iter().find(|(_, right)| !right).map(|(value, _)| *value) else { continue };
            let below = sorted.partition_point(|(value, _)| *value < first);
            let (inside, outside) = (below, sorted.len() - below);
            let right = sorted[below..].iter().filter(|(_, right)| *right).count();
            let ruled_out = 1.0 - right as f64 / outside as f64;
            // Where only a part of the right answers is on the one side, the bound is no cause.
            if inside < SIDES[0].max(4 * right) || outside < SIDES[1] || ruled_out < RULED_OUT {
                continue;
            }
            let last = sorted[below - 1].0;
            let bound = roundest(last, first);
            let relation = match (sign > 0.0, bound == last) {
                _ if sorted[0].0 == last => "=",
                (true, true) => "≤",
                (true, false) => "<",
                (false, true) => "≥",
                (false, false) => ">",
            };
            let words = format!(
                "right only where {name} {relation} {}: {inside} of {inside}, elsewhere {right} of {outside}",
                short(sign * bound)
            );
            if best.as_ref().is_none_or(|(known, _)| ruled_out > *known) {
                best = Some((ruled_out, words));
            }
        }
    }
    let (_, mut words) = best?;
    let (reason, silent) = most_frequent_reason(asked);
    if silent > 0 && silent == asked.iter().filter(|one| !one.is_right).count() {
        words += &format!("; no answer there: {reason}");
    }
    Some(Cause::unexplained(words, asked))
}

/// The number from `low` to `high` with the fewest digits.
fn roundest(low: f64, high: f64) -> f64 {
    let between = |value: &f64| (low..=high).contains(value);
    let rounded =
        |digits: usize| [low, high].into_iter().filter_map(move |value| format!("{value:.digits$e}").parse().ok());
    std::iter::once(0.0).chain((0..17).flat_map(rounded)).find(between).unwrap_or(high)
}

/// A number in few characters, without a sign of zero.
fn short(value: f64) -> String {
    let value = value + 0.0;
    if value == 0.0 || (1e-3..1e4).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests;
