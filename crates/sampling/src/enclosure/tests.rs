use dynamics::Coin;

use super::cell::MOST_DIRECTIONS;
use super::series::Series;
use super::*;
use crate::exact_speed;
use crate::plan::{Plan, Rest, Scrambled};
use crate::sampler::Sampler;

fn fraction(index: u32, square: f64) -> f64 {
    (f64::from(index) * square.sqrt()).fract()
}

/// Spaces with one to three coordinates besides the speed: from horizontal and tilted, with ψ = 45° inside and without, narrow and wide, with
/// ties, normal axes, and gravities.
fn spaces() -> impl Iterator<Item = Space> {
    (1..=120)
        .map(|index| {
            let part = |square: f64| fraction(index, square);
            let wide = |square: f64, other: f64| {
                let lo = 60.0 * part(square) - 20.0;
                lo..=lo + [30.0, 3.0, 0.02][index as usize % 3] * (0.1 + part(other))
            };
            let space = Space::builder(Coin::from_moments(1.0, 2.0 * part(37.0)).unwrap());
            let low = if index % 7 == 0 { 0.0 } else { 1.0 + part(41.0) };
            let space = space.speed(low..=low + 0.1 + 3.0 * part(43.0));
            let space = match index % 10 {
                0 => space.rate_x(0.0).rate_y(wide(2.0, 3.0)).rate_z(30.0 * part(5.0)),
                1 => space.rate_x(3.0).rate_y(wide(2.0, 3.0)).rate_z(wide(5.0, 7.0)),
                2 => space.rate_x(wide(2.0, 3.0)).tie_rate_y_to_x().rate_z(20.0 * part(5.0)),
                3 => space.rate_x(wide(2.0, 3.0)).rate_y(wide(11.0, 13.0)).rate_z(wide(5.0, 7.0)),
                4 => space.rate_x(4.0).rate_y(wide(2.0, 3.0)).rate_z(7.0).tilt(part(5.0)..=part(5.0) + 0.5),
                5 => space.rate_x(wide(2.0, 3.0)).rate_y(11.0).rate_z(wide(5.0, 7.0)).tilt(2.0 * part(11.0)),
                6 => space.rate_x(0.0).rate_y(crate::Axis::normal(20.0 * part(2.0), 0.1 + part(3.0))).rate_z(9.0),
                7 => space.rate_x(1.0).rate_y(wide(2.0, 3.0)).rate_z(5.0).gravity(9.0..=9.0 + part(5.0)),
                8 => space.rate_x(wide(2.0, 3.0)).rate_y(wide(11.0, 13.0)).rate_z(wide(5.0, 7.0)).tilt(1.0),
                _ => space.rate_x(wide(2.0, 3.0)).rate_y(-3.0).rate_z(crate::Axis::normal(8.0, 2.0)).tilt(0.4),
            };
            space.build().unwrap()
        })
        .chain((1..=24).map(precessing))
}

/// Spaces in which the turn and ψ are given in place of the rates.
fn precessing(index: u32) -> Space {
    let part = |square: f64| fraction(index, square);
    let psi = 0.1 + 1.2 * part(3.0)..=0.2 + 1.2 * part(3.0) + 1.6 * part(5.0);
    let space = Space::builder(Coin::from_moments(1.0, 0.1 + 1.9 * part(37.0)).unwrap()).speed(1.5..=2.5 + part(43.0));
    let (turn, psi): (crate::Axis, crate::Axis) = match index % 4 {
        0 => ((40.0 * part(2.0)).into(), psi.into()),
        1 => ((40.0 * part(2.0)..=41.0).into(), (1.5 * part(7.0)).into()),
        2 => (crate::Axis::normal(20.0, 0.5), psi.into()),
        _ => ((10.0..=11.0).into(), crate::Axis::normal(1.2, 0.03)),
    };
    let space = space.axis(Coordinate::Turn, turn).axis(Coordinate::Psi, psi);
    if index % 8 < 4 { space.build().unwrap() } else { space.tilt(part(11.0)).build().unwrap() }
}

const SILENT: Reports<'static> = (&|_| {}, &|_| {}, &|| false);

/// The mean of the share times the density over a cell, by the midpoint rule with so many points in each direction.
fn mean_of_shares(space: &Space, cell: &Cell<'_>, points: u32) -> f64 {
    let directions: Vec<&Direction> = cell.directions.iter().flatten().copied().collect();
    let all = u64::from(points).pow(directions.len() as u32);
    let mut sum = 0.0;
    for number in 0..all {
        let (mut values, mut weight, mut rest) = (space.fixed_values(), 1.0, number);
        if directions.iter().any(|direction| direction.is_across()) {
            values[Coordinate::RateY as usize] = 0.0;
        }
        for (index, direction) in directions.iter().enumerate() {
            let [lo, hi] = cell.interval(index);
            let part = (f64::from((rest % u64::from(points)) as u32) + 0.5) / f64::from(points);
            rest /= u64::from(points);
            let s = Series::constant(Ball::new(lo + part * (hi - lo), 0.0));
            let (value, density) = direction.at(&s);
            values[direction.of as usize] = *value.value().midpoint();
            weight *= density.map_or(1.0, |density| *density.value().midpoint());
        }
        sum += weight * exact_speed::share(space, space.coin().unwrap(), &values).unwrap().probability;
    }
    sum / all as f64
}

/// Each direction of a space is divided again and again, at places of its own.
fn cells(directions: &[Vec<Direction>], index: u32) -> Vec<Cell<'_>> {
    let mut cells = Vec::new();
    for mut cell in roots(directions) {
        for depth in 0..9_u32 {
            let axis = (depth + index) as usize % directions.len();
            let half = usize::from(fraction(index + 31 * depth, 17.0) > 0.5);
            cell = cell.halves(axis).unwrap()[half].clone();
            if depth % 2 == index % 2 {
                cells.push(cell.clone());
            }
        }
    }
    cells
}

/// Asserts that the bounds of cells contain the means. Returns the number of cells, and in how many a remainder that is too small
/// by some parts would be seen. `roundings` are those of a share in f64.
fn assert_contains(space: &Space, index: u32, roundings: f64) -> [u32; 2] {
    let (directions, _) = directions_of(space);
    let problem = Problem::new(space, space.coin().unwrap(), directions.iter().flatten().any(Direction::is_across));
    let points = [16_384, 100, 20][directions.len() - 1];
    let [mut number, mut told] = [0; 2];
    for cell in cells(&directions, index) {
        let found = bounds_in(&problem, &cell, directions.len(), 0.0);
        let [rough, other, fine] =
            [points / 2, 7 * points / 10, points].map(|points| mean_of_shares(space, &cell, points));
        // Two numbers of points alone may agree by chance.
        let slack = 2.0 * (rough - fine).abs().max((other - fine).abs()) + roundings;
        assert!(
            found.lo - slack <= fine && fine <= found.hi + slack,
            "{index}: {fine} ± {slack:e} is not in {found:?} of {space:?}"
        );
        number += 1;
        told += u32::from(slack < 0.2 * found.width() && found.width() < 0.1);
    }
    [number, told]
}

/// The same of one space of each kind, and of spaces whose density is a product.
#[test]
fn the_bounds_of_a_few_cells_contain_their_means() {
    let normal = |mean, sd| crate::Axis::normal(mean, sd);
    let with = |space: crate::SpaceBuilder| space.speed(2.0..=2.5).build().unwrap();
    let coin = Space::builder(Coin::PAPER);
    let products = [
        with(coin.clone().rate_x(2.0).rate_y(normal(9.0, 0.5)).rate_z(normal(5.0, 0.25))),
        with(coin.rate_x(-1.0..=2.0).rate_y(3.0..=9.0).rate_z(normal(5.0, 0.25))),
    ];
    let mut told = 0;
    for (index, space) in (0..).zip(spaces()).skip(20).take(20).chain((0..).zip(products)) {
        told += assert_contains(&space, index, 1e-12)[1];
    }
    assert!(told > 0, "{told}");
}

#[test]
fn the_bounds_of_a_cell_contain_its_mean() {
    let (mut told, mut kinds) = (0, [0; MOST_DIRECTIONS]);
    for (index, space) in (0..).zip(spaces()) {
        let [number, seen] = assert_contains(&space, index, 1e-12);
        told += seen;
        kinds[coordinates(&space) - 1] += number;
    }
    assert!(told > 200 && kinds.iter().all(|cells| *cells > 40), "{told} {kinds:?}");
}

/// Where all speeds are nearly the same.
fn with_narrow_speeds(space: &Space, width: f64) -> Space {
    let [low, _] = space.axis(Coordinate::Speed).bounds();
    space.with_axis(Coordinate::Speed, crate::Axis::from(low..=low + width)).unwrap()
}

#[test]
fn the_bounds_of_a_cell_contain_its_mean_over_narrow_speeds() {
    let mut told = 0;
    for (index, space) in (0..).zip(spaces()).filter(|(index, _)| index % 7 != 6) {
        let width = [0.1, 1e-2, 1e-4][index as usize % 3];
        told += assert_contains(&with_narrow_speeds(&space, width), index, 1e-13 / width)[1];
    }
    assert!(told > 80, "{told}");
}

/// The share divides by the difference of phases, whose last digits cancel over a narrow range: bounds for each speed do not.
#[test]
fn a_narrow_range_of_speeds_takes_few_more_cells_than_one_speed() {
    for space in spaces().filter(|space| coordinates(space) == 2).take(4) {
        let cells = |space: &Space| estimate(SILENT, space, 1e-2, MOST_CELLS).unwrap().points;
        let [low, _] = space.axis(Coordinate::Speed).bounds();
        let one = cells(&space.with_axis(Coordinate::Speed, crate::Axis::from(low)).unwrap());
        for width in [1e-6, 1e-9, 4.0 * f64::EPSILON] {
            let narrow = cells(&with_narrow_speeds(&space, width * low));
            assert!(narrow <= 4 * one + 16, "{width}: {narrow} cells, not {one}");
        }
    }
}

/// The halves of a cell, whose bounds are narrower, allow a number that the cell allows, too.
#[test]
fn the_bounds_of_a_cell_meet_those_of_its_halves() {
    for (index, space) in (0..).zip(spaces()) {
        let (directions, _) = directions_of(&space);
        let problem =
            Problem::new(&space, space.coin().unwrap(), directions.iter().flatten().any(Direction::is_across));
        for cell in cells(&directions, index) {
            let of = |cell: &Cell<'_>| bounds_in(&problem, cell, directions.len(), 0.0);
            let (whole, [one, other]) = (of(&cell), cell.halves(0).unwrap().map(|half| of(&half)));
            let (lo, hi) = (0.5 * (one.lo + other.lo), 0.5 * (one.hi + other.hi));
            assert!(lo <= whole.hi + 1e-15 && whole.lo <= hi + 1e-15, "{index}: {whole:?} {one:?} {other:?}");
        }
    }
}

/// Whether the interval at 95 % of so many Sobol points misses the proven one, which it may. Asserts that it does not miss by
/// more than twice its width.
fn is_outside(space: &Space, accuracies: [f64; MOST_DIRECTIONS], points: u64) -> bool {
    let accuracy = accuracies[coordinates(space) - 1];
    let found = estimate(SILENT, space, accuracy, MOST_CELLS).unwrap();
    let proven = found.interval.unwrap();
    assert!(proven.hi - proven.lo <= 2.0 * accuracy && found.interval_kind == crate::IntervalKind::Proven);
    let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, 1)));
    let sampled = Sampler::exact().estimate(space, plan).unwrap();
    let interval = sampled.interval.unwrap();
    let width = interval.hi - interval.lo;
    assert!(
        interval.lo - 2.0 * width <= proven.hi && proven.lo <= interval.hi + 2.0 * width,
        "{space:?} {proven:?} {sampled:?}"
    );
    interval.lo > proven.hi || interval.hi < proven.lo
}

#[test]
fn sampled_probabilities_meet_the_proven_ones() {
    let outside = spaces().filter(|space| is_outside(space, [1e-6, 1e-3, 3e-2], 1 << 10)).count();
    assert!(spaces().count() == 144 && outside < 12, "{outside}");
}

/// With a single speed, the share of heads is counted launch by launch.
#[test]
fn single_speeds_are_enclosed() {
    for index in 1..20 {
        let part = |square: f64| fraction(index, square);
        let rate = 10.0 * part(2.0)..=30.0 + 10.0 * part(3.0);
        let space =
            Space::builder(Coin::PAPER).rate_x(1.0).rate_y(rate).rate_z(20.0 * part(5.0)).speed(2.0 + part(7.0));
        let space = space.tilt(if index % 2 == 0 { 0.0 } else { 0.5 }).build().unwrap();
        let proven = estimate(SILENT, &space, 1e-7, MOST_CELLS).unwrap().interval.unwrap();
        let grid = space.with_axis(Coordinate::RateY, space.axis(Coordinate::RateY).with_points(200_001)).unwrap();
        let counted = Sampler::exact().estimate(&grid, Plan::Grid).unwrap().probability;
        // Each of some twenty edges lies between two points.
        assert!(proven.lo - 1e-4 < counted && counted < proven.hi + 1e-4, "{space:?}: {counted} {proven:?}");
        assert!(proven.hi - proven.lo <= 2e-7);
    }
}

/// Any thresholds give a right enclosure; better ones give it in fewer cells. Checks the enclosures of many cells, or the
/// others.
fn assert_as_many_cells_as_there_were(are_many: bool) {
    let cells = |(space, accuracies): (Space, [f64; 3])| {
        let coin = space.coin().unwrap();
        accuracies.map(|accuracy| enclosed(SILENT, (&space, coin), accuracy, 1 << 20).cells)
    };
    let accuracies = [[1e-3, 1e-5, 1e-6], [1e-2, 1e-3, 1e-4], [1e-4, 1e-6, 1e-7], [3e-2, 1e-2, 4e-3]];
    let expected = [
        [7, 13, 17],
        [1, 1, 1],
        [297, 1605, 3695],
        [139, 145, 153],
        [1, 1, 1],
        [43, 43, 67],
        [3, 5, 15],
        [1, 1, 1],
        [775, 3361, 6215],
    ];
    // Sines that are rounded otherwise may halve a cell more.
    let cases = expected.into_iter().zip(spaces().zip(accuracies.into_iter().cycle()));
    let is_near = |(found, expected): (u64, u64)| found.abs_diff(expected) <= 2 + expected / 50;
    let found: Vec<([u64; 3], [u64; 3])> = cases
        .filter(|(expected, _)| (expected[2] > 300) == are_many)
        .map(|(expected, case)| (cells(case), expected))
        .collect();
    let is_as_before = found.iter().all(|(found, expected)| found.iter().copied().zip(*expected).all(is_near));
    assert!(is_as_before, "found and expected: {found:?}");
}

#[test]
fn a_wide_enclosure_takes_as_many_cells_as_it_did() {
    assert_as_many_cells_as_there_were(false);
}

#[test]
fn a_narrow_enclosure_takes_as_many_cells_as_it_did() {
    assert_as_many_cells_as_there_were(true);
}

/// A usual accuracy is worth some cells, and not many.
#[test]
fn the_usual_accuracy_is_reached_soon() {
    let space = || Space::builder(Coin::PAPER).rate_x(1.0).rate_y(9.0..=12.0).rate_z(5.0).speed(2.0..=2.5);
    for (space, most_cells) in [
        // Over one coordinate by series of order 4.
        (space(), 1_000),
        (space().rate_z(5.0..=6.0), 40_000),
        (space().rate_z(5.0..=6.0).tilt(0.0..=0.25), 40_000),
    ] {
        let space = space.build().unwrap();
        let found = estimate(SILENT, &space, usual_accuracy(&space), most_cells).unwrap();
        assert!(found.points > 20, "{space:?}: {}", found.points);
    }
}

/// Launched next to its edge, and with a spin that passes 0, a coin has intervals of heads whose width has no finite slope. There
/// the cells are halved along the range that changes the motion, not along each of three: that took 278 311 cells.
#[test]
fn narrow_ranges_are_not_halved_where_no_slope_is_known() {
    let coin = Coin::from_moments(1.0, 1.8).unwrap();
    let space = Space::builder(coin).rate_x(0.0006..=0.0646).rate_y(-39.96..=-39.83).rate_z(-22.4..=3.2);
    for tilt in [1.5775, std::f64::consts::FRAC_PI_2] {
        let space = space.clone().speed(2.0..=2.19).tilt(tilt).build().unwrap();
        let found = enclosed(SILENT, (&space, coin), 0.02, 1 << 20);
        assert!(found.interval.width() <= 0.04 && found.cells < 200, "{tilt}: {found:?}");
    }
}

#[test]
fn a_cell_is_halved_until_its_middle_is_no_f64() {
    let space = spaces().next().unwrap();
    let (directions, _) = directions_of(&space);
    let mut cell = roots(&directions).remove(0);
    for _ in 0..51 {
        cell = cell.halves(0).expect("a middle")[1].clone();
        let [lo, hi] = cell.interval(0);
        assert!(lo < f64::midpoint(lo, hi) && f64::midpoint(lo, hi) < hi);
    }
    assert_eq!((cell.halvings(), cell.halves(0).is_none()), (51, true));
}

/// The same for any number of threads, and with fewer cells than are needed the best that they gave.
#[test]
fn a_computation_stops_at_its_number_of_cells() {
    let space =
        Space::builder(Coin::PAPER).rate_x(0.0).rate_y(1.0..=60.0).rate_z(1.0..=60.0).speed(3.0..=5.0).build().unwrap();
    let coin = space.coin().unwrap();
    let all = enclosed(SILENT, (&space, coin), 1e-4, MOST_CELLS);
    let few = enclosed(SILENT, (&space, coin), 1e-4, all.cells - 1);
    assert!(few.cells < all.cells && few.interval.lo <= all.interval.hi && all.interval.lo <= few.interval.hi);
    assert_eq!([all.is_spent, few.is_spent], [false, true]);
    // What was proven is the answer, and says that it is not what was asked for.
    let found = estimate(SILENT, &space, 1e-4, all.cells - 1).unwrap();
    assert_eq!((found.interval, found.points), (Some(few.interval), few.cells));
    assert!(found.half_width().unwrap() > 1e-4 && found.is_wider_than_asked());
    assert!(!estimate(SILENT, &space, 1e-4, MOST_CELLS).unwrap().is_wider_than_asked());
    #[cfg(feature = "rayon")]
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| enclosed(SILENT, (&space, coin), 1e-4, MOST_CELLS)), all);
    }
}

/// |L| is at most |(3, 4, 2 · 12)|, as k ≤ 2, and T at most 2 · 9/3.
#[test]
fn the_largest_phase_is_that_of_the_fastest_and_longest_flight() {
    let with = |z: f64| {
        let space = Space::builder(Coin::DISC).rate_x(-1.0..=3.0).rate_y(-4.0..=2.0).rate_z(z).speed(2.0..=9.0);
        largest_phase(&space.gravity(3.0..=9.0).build().unwrap())
    };
    assert!((with(-12.0) - 6.0 * 5f64.hypot(24.0)).abs() < 1e-12 && (with(0.0) - 30.0).abs() < 1e-12);
    let still = Space::builder(Coin::DISC).rate_x(0.0).rate_y(0.0).rate_z(0.0).speed(1.0..=2.0).build().unwrap();
    assert_eq!(largest_phase(&still), 0.0);
}

#[test]
fn a_sum_of_which_nothing_is_known_has_all_probabilities() {
    let ends = |middle: f64, radius: f64| ends(&Ball::new(DoubleDouble::from(middle), radius));
    let all = Interval { lo: 0.0, hi: 1.0 };
    for (middle, radius) in
        [(f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::INFINITY), (0.5, f64::NAN), (0.5, 9.0)]
    {
        assert_eq!(ends(middle, radius), all, "{middle} ± {radius}");
    }
    assert_eq!(ends(0.5, 0.25), Interval { lo: 0.25_f64.next_down(), hi: 0.75_f64.next_up() });
}

/// In units in the last place of ¾: the parts of the middle add to the radius.
#[test]
fn the_ends_of_a_sum_have_room_for_its_low_part() {
    let unit = 0.5 * f64::EPSILON;
    for low in [0.45, -0.45] {
        let sum = Ball::new(DoubleDouble::from(0.75) + DoubleDouble::from(low * unit), 10.9 * unit);
        let [lo, hi] = [ends(&sum).lo, ends(&sum).hi].map(|end| (end - 0.75) / unit);
        assert!((-13.0..=low - 10.9).contains(&lo) && (low + 10.9..=13.0).contains(&hi), "{low}: {lo} {hi}");
    }
}

/// A coin that turns by less than it is tilted shows one face. One that turns by more may show both.
#[test]
fn a_coin_that_hardly_turns_shows_one_face() {
    let with = |tilt: f64| {
        let space = Space::builder(Coin::PAPER).rate_x(1.25..=1.5).rate_y(0.0).rate_z(1.0).speed(2.0..=3.0);
        space.tilt(tilt).build().unwrap()
    };
    for (tilt, share) in [(0.25, 1.0), (3.0, 0.0)] {
        let space = with(tilt);
        let (directions, _) = directions_of(&space);
        let problem = Problem::new(&space, space.coin().unwrap(), false);
        let found = bounds_in(&problem, &roots(&directions)[0], 1, 0.0);
        assert_eq!((found.lo, found.hi), (share, share), "{tilt}");
        let work = Work { problem, roots: roots(&directions), progress: SILENT.0, stop: SILENT.2 };
        let (sum, cells) = work.pass(&mut work.nothing(), 1.0, (0, 1)).unwrap();
        let room = sum.radius() / f64::EPSILON;
        assert!(
            cells == 1 && sum.midpoint().to_f64() == share && (share..=3.0 * share + 1e-9).contains(&room),
            "{room}"
        );
    }
    let shares = [0.8, 0.9, 1.4].map(|tilt| {
        assert_contains(&with(tilt), 1, 1e-12);
        mean_of_shares(&with(tilt), &roots(&directions_of(&with(tilt)).0)[0], 64)
    });
    assert!(shares.iter().any(|share| (0.1..0.9).contains(share)), "{shares:?}");
}

#[test]
fn what_cannot_be_enclosed_is_refused_with_a_reason() {
    let space = || Space::builder(Coin::PAPER).rate_x(1.0).rate_y(1.0..=2.0).rate_z(3.0).speed(3.0..=5.0);
    let refused = |space: Space, why: &str| {
        let refused = require_enclosable(&space).unwrap_err();
        assert!(refused.to_string().contains(why), "{refused}");
        assert_eq!(estimate(SILENT, &space, 1e-6, MOST_CELLS), Err(refused.into()));
    };
    refused(space().rate_y(1.0).speed(3.0).build().unwrap(), "nothing varies");
    refused(space().speed(crate::Axis::normal(4.0, 0.1)).build().unwrap(), "range of speeds");
    refused(space().build().unwrap().with_drop(Some(0.1)).unwrap(), "height of the launch");
    refused(space().rate_y(1e17..=2e17).build().unwrap(), "2^53");
    let five = space().rate_x(1.0..=2.0).rate_z(1.0..=2.0).gravity(9.0..=10.0).tilt(0.0..=1.0).build().unwrap();
    refused(five, "at most three coordinates");
    let body = dynamics::Body::from_moments([1.0, 2.0, 2.5]).unwrap();
    refused(space().build().unwrap().with_body(body).unwrap(), "I1 ≠ I2");
    for accuracy in [0.0, -1.0, 1e-17, f64::NAN] {
        let error = estimate(SILENT, &space().build().unwrap(), accuracy, MOST_CELLS).unwrap_err().to_string();
        assert!(error.contains("accuracy"), "{error}");
    }
}

/// The coin makes so many turns that the first sum already takes more cells than are allowed.
#[test]
fn a_far_flight_takes_too_many_cells() {
    let space = Space::builder(Coin::PAPER).rate_x(1.0).rate_y(1e10..=2e10).rate_z(3.0).speed(3.0..=5.0);
    let far = space.build().unwrap();
    let found = estimate(SILENT, &far, 2e-14, 1 << 13).unwrap();
    assert_eq!((found.interval, found.points), (Some(Interval { lo: 0.0, hi: 1.0 }), 8192));
    // Any probability is 0.5 ± 0.5.
    let blind = far.with_axis(Coordinate::Speed, crate::Axis::from(3.0)).unwrap();
    let found = estimate(SILENT, &blind, 0.5, 1 << 13).unwrap();
    assert_eq!((found.interval, found.points), (Some(Interval { lo: 0.0, hi: 1.0 }), 127));
}

/// Nothing is known of any cell: those of a volume of 2^-10 and all before are 2^11 - 1.
#[test]
fn cells_are_counted_and_limited() {
    let space = Space::builder(Coin::PAPER).rate_x(1.0).rate_y(1e10..=2e10).rate_z(3.0).speed(3.0).build().unwrap();
    let (directions, _) = directions_of(&space);
    let reported = std::sync::Mutex::new(Vec::new());
    let report = |cells| reported.lock().unwrap().push(cells);
    let problem = Problem::new(&space, Coin::PAPER, false);
    let work = Work { problem, roots: roots(&directions), progress: &report, stop: SILENT.2 };
    let (sum, cells) = work.pass(&mut work.nothing(), 0.5_f64.powi(10), (0, 2047)).unwrap();
    assert_eq!((sum.midpoint().to_f64(), cells), (0.5, 2047));
    assert_eq!(*reported.lock().unwrap(), [256, 256, 256, 256, 256, 256, 256, 255]);
    assert!(work.pass(&mut work.nothing(), 0.5_f64.powi(10), (0, 2046)).is_none());
}

#[test]
fn a_pass_follows_if_it_helps_and_has_enough_cells() {
    let passes = Passes { goal: 1.0, power: 1.0, most_cells: 1000, threshold: 1.0, narrowest: None };
    let thousands = Passes { most_cells: 1_000_000_000, ..passes };
    let square = Passes { power: 2.0, ..thousands };
    let second = |threshold: f64| Passes { threshold, narrowest: Some([4.0, 1.0]), ..thousands };
    for (passes, now, cells, expected) in [
        // Narrow enough.
        (passes, 0.5, 1, None),
        (passes, 1.0, 1, None),
        // 0.8 of the width that is wanted, from a twentieth to 0.7 of the last threshold.
        (thousands, 4.0, 1, Some(0.2)),
        (square, 4.0, 1, Some(0.05)),
        (thousands, 1.25, 1, Some(0.64)),
        (thousands, 1.01, 1, Some(0.7)),
        (thousands, 1e9, 1, Some(0.05)),
        // No more than half of the cells, and a threshold that leaves it.
        (passes, 2.0, 501, None),
        (passes, 2.0, 500, Some(0.7)),
        (passes, 10.0, 200, Some(0.4)),
        (Passes { power: 2.0, ..passes }, 100.0, 200, Some(0.16)),
        // A width that is not clearly narrower asks for far smaller cells, but not again and again.
        (second(0.5), 3.5, 1, Some(0.5 * 0.8 / 3.5)),
        (second(0.5), 3.6, 1, Some(0.025)),
        (second(0.001), 3.6, 1, Some(0.001 * 0.05)),
        (second(0.0009), 3.6, 1, None),
        (second(0.0009), 3.5, 1, Some(0.0009 * 0.8 / 3.5)),
    ] {
        let mut next = passes;
        let is_next = next.is_next(now, cells);
        assert_eq!(is_next, expected.is_some(), "{passes:?} {now} {cells}");
        let expected = expected.unwrap_or(passes.threshold);
        assert!((next.threshold / expected - 1.0).abs() < 1e-12, "{passes:?} {now} {cells}: {next:?}, not {expected}");
    }
}

#[test]
fn roundings_and_the_ends_of_normal_distributions_are_left_out() {
    let normal = || crate::Axis::normal(9.0, 0.5);
    let space = Space::builder(Coin::PAPER).rate_x(2.0..=3.0).rate_y(1.0).rate_z(4.0).speed(2.0..=3.0);
    let found = |space: crate::SpaceBuilder| left_out(&space.build().unwrap(), 1e-15);
    assert_eq!(found(space.clone()), 1e-15);
    assert_eq!(found(space.clone().rate_y(normal())), 1e-15 + BEYOND_REACH);
    assert_eq!(found(space.rate_y(normal()).rate_z(normal())), 1e-15 + 2.0 * BEYOND_REACH);
}

/// Where the sign of P - s² is not known, cells are halved in the direction that decides it. The other directions alone took
/// millions of cells.
#[test]
fn tilts_about_90_degrees_converge() {
    let degrees = |degrees: f64| degrees.to_radians();
    let space = Space::builder(Coin::PAPER).rate_x(0.001).rate_y(0.0).rate_z(0.0..=20.0).speed(3.0..=5.0);
    let space = space.tilt(degrees(89.0)..=degrees(91.0)).build().unwrap();
    let found = estimate(SILENT, &space, 1e-4, 1 << 18).unwrap();
    assert!(found.half_width().unwrap() <= 1e-4 && found.points < 1 << 16, "{found:?}");
}
