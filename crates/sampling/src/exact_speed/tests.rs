use dynamics::{Coin, Outcome};

use super::*;
use crate::coordinate::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
use crate::plan::{Plan, Rest};
use crate::sampler::Sampler;

fn share_of(coin: Coin, rate: [&str; 3], tilt: &str, speed: &str) -> Share {
    let [x, y, z] = rate;
    let space = Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)]).unwrap();
    share(&space, coin, &space.fixed_values()).unwrap()
}

/// The same share, found by counting the proven outcomes at the medians of 40 000 parts of equal probability.
fn counted(coin: Coin, rate: [&str; 3], tilt: &str, speed: &str) -> f64 {
    const PARTS: u32 = 40_000;
    let [x, y, z] = rate;
    let space = Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)]).unwrap();
    let heads = (0..PARTS).filter(|part| {
        let mut values = space.fixed_values();
        values[Speed as usize] = space.axis(Speed).quantile((f64::from(*part) + 0.5) / f64::from(PARTS));
        certify(&space.toss(&values)).is_ok_and(|found| found.outcome() == Outcome::Heads)
    });
    heads.count() as f64 / f64::from(PARTS)
}

#[test]
fn the_share_matches_counted_outcomes() {
    let rates = [["1", "1", "2.5"], ["20", "-31", "7"], ["0", "9", "0"], ["-3", "40", "-60"], ["2", "2", "0.5"]];
    let mut certain = 0;
    for coin in [Coin::PAPER, Coin::DISC, Coin::from_moments(1.0, 1.0).unwrap()] {
        for rate in rates {
            for tilt in ["0", "0.4", "1.5707963", "2.9", "-0.7"] {
                for speed in ["3:5", "0:0.2", "0:300", "4:4.0001", "normal:4:0.1", "normal:4:0.4", "normal:90:9"] {
                    let share = share_of(coin, rate, tilt, speed);
                    let counted = counted(coin, rate, tilt, speed);
                    // Each edge of an interval of heads may add an error of one part; 300 m/s are at most 800
                    // turns.
                    let within = if speed.ends_with("00") || speed.ends_with(":9") { 5e-2 } else { 5e-4 };
                    let error = (share.probability - counted).abs();
                    assert!(error < within, "{rate:?} {tilt} {speed}: {share:?}, {counted}");
                    // The largest error is that of a coin that turns end over end at a tilt of nearly 90°, where
                    // cos θ stays below 1e-7.
                    assert!(share.error < 2e-6, "{rate:?} {tilt} {speed}: {share:?}");
                    certain += u32::from(share.error == 0.0);
                }
            }
        }
    }
    assert!(certain > 20, "{certain}");
}

/// The hardest of 20 000 random shares next to an edge of the heads, with ranges of 1 to 2^40 units of the last place and
/// phases up to 10^15 rad. Their values are those of the closed form in 300 bits, by mpmath.
#[test]
fn shares_of_narrow_ranges_and_of_large_phases_hold_their_value_in_300_bits() {
    #[rustfmt::skip]
    const CASES: [(&str, [&str; 3], &str, &str, &str); 18] = [
        ("0.3907040665256408", ["4.213156086741947", "30.560439946681864", "-11.471323096202948"], "0.1454161422859066", "normal:3.704256201581451:2.6752362039160395e-17", "2.2481791869152695e-06"),
        ("0.399192260708947", ["14.992024710508389", "-96.60208083390758", "17.84693385255775"], "0.41323754053714", "normal:5.419257110886765:5.350472407832079e-17", "0.9999999914847528"),
        ("1.1712945716578502", ["149.81839962991683", "-86.49718144403063", "0.9176135222877537"], "0.0", "4.676339448844535:4.676339448844536", "0.17258644091050507"),
        ("1.714641082905228", ["-12.53895396648053", "46.984528104716766", "-13.528837419917451"], "2.4227243530349303", "484.7230907988457:484.72309079884576", "0.17369019332512464"),
        ("1.0289829309219665", ["-72.69236247697447", "-138.6040081369706", "26.09169473126111"], "1.695049379045481", "normal:2.802011537862392:2.6752362039160395e-17", "0.9999999999994994"),
        ("0.9123944456162082", ["-42.6157893219516", "17.079958567776455", "-20.751229298521014"], "0.0", "59794524.071878664:59794524.07187867", "0.5856829668571226"),
        ("1.486132563450943", ["174.73412110270806", "-0.842046773414202", "2.563513513161796"], "2.165451025409088", "1452224502.320797:1452224502.3207972", "0.30415599141907573"),
        ("0.6027345187964814", ["-1.6956773740342417", "-6.569582597427785", "-1.5855889606473563"], "0.0", "normal:4068401791.8319798:2.8725130012236442e-08", "7.089021487575801e-17"),
        ("0.18930215076858625", ["-141.0254046108176", "-32.006424327647935", "18.314935069610794"], "0.0", "1989141256636.4724:1989141256636.4727", "0.5353726491981118"),
        ("0.4277546674920544", ["-33.43242801891255", "-4.5389732818146555", "-5.442808104741577"], "0.8555902516878295", "630009220.4708327:630009220.4708486", "0.0036562681531274333"),
        ("0.495555475950037", ["6.315640118530349", "-45.676983885069774", "19.988893102841537"], "2.892463735657061", "2023844438803.7498:2023844438805.156", "0.45431383051959595"),
        ("0.34946932076601245", ["-172.1280631592914", "41.350838365622884", "-3.2831828306796815"], "2.4643712445993144", "1.9401386324289622:1.9401423849450716", "0.5613869775304482"),
        ("0.8558692135606932", ["-19.451938849678037", "-27.321592437120945", "-1.8945345085011862"], "1.802530609276678", "490.1800720852574:490.1807405793004", "0.627636039084823"),
        ("0.4565335106628946", ["-17.624103409498264", "-3.680118247787939", "76.70501045173647"], "1.8496434479066606", "1326.7246648806442:1326.775622770456", "0.454009933265962"),
        ("0.8724972871920276", ["-25.243973905190575", "7.077213222920194", "1.852398775256426"], "2.1878448197843867", "55.85422332880822:55.85422332907468", "0.8080444746287141"),
        ("0.7652486088225225", ["-4.10765290779946", "-40.66866501510734", "21.696267335442347"], "0.6663747912760649", "normal:1587.9623969293416:3.808851493908238e-09", "0.5822256762894485"),
        ("0.20903628269342017", ["-13.245457051777915", "39.47205084700774", "108.31206854550636"], "2.8822189645156966", "normal:3.715947190186204:1.0200213685744166e-08", "0.24347410316225807"),
        ("1.7178717035661062", ["112.47390454778713", "-53.44442493252007", "8.09579529129786"], "0.0", "normal:2.7675586262449787:5.964008156142631e-07", "0.19896239431979265"),
    ];
    let mut unknown = 0;
    for (ratio, rate, tilt, speed, expected) in CASES {
        let coin = Coin::from_moments(1.0, ratio.parse().unwrap()).unwrap();
        let expected: f64 = expected.parse().unwrap();
        let one = share_of(coin, rate, tilt, speed);
        let [x, y, z] = rate;
        let space = Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)]).unwrap();
        // In registers, if the speed is uniform.
        let estimate = Sampler::exact().estimate(&space, Plan::ExactSpeed(Rest::Grid)).unwrap();
        for (found, error) in [(one.probability, one.error), (estimate.probability, estimate.half_width().unwrap())] {
            assert!((found - expected).abs() <= error, "{rate:?} {tilt} {speed}: {found} ± {error}, not {expected}");
            unknown += usize::from(error >= 0.5);
        }
    }
    // The others have a bound that says something.
    assert!(unknown <= CASES.len(), "{unknown}");
}

#[test]
fn the_share_of_a_single_speed_is_0_or_1() {
    for (speed, probability) in [("0", 1.0), ("3", 0.0), ("3:3", 0.0)] {
        let share = share_of(Coin::PAPER, ["2", "2", "0.5"], "0", speed);
        assert_eq!(share, Share { probability, error: 0.0 });
    }
    // A quarter of a turn end over end: cos θ = 0 to rounding, but not exactly.
    let speed = (9.81 * PI / 36.0).to_string();
    assert_eq!(share_of(Coin::PAPER, ["0", "9", "0"], "0", &speed).error, 0.0);
    assert_eq!(share_of(Coin::PAPER, ["0", "0", "0"], "0.3", "3:5").probability, 1.0);
}

#[test]
fn a_share_that_depends_on_rounding_has_an_error() {
    // Phases whose distance to the edge of the heads is about its rounding error.
    let heads = HeadsPhases { crest: 0.0, half_width: 2.0, crest_error: 1e-15, half_width_error: 1e-15 };
    for (from, to) in [(2.0 - 3e-15, 2.0 - 1e-15), (1.0, 2.0 - 1e-15), (2.0 + 1e-15, 2.0 + 3e-15)] {
        let share = uniform_share(&heads, from, to);
        assert!(share.error > 1e-15 / (to - from), "{from}, {to}: {share:?}");
    }
    assert_eq!(uniform_share(&heads, 1.0, 1.9), Share { probability: 1.0, error: 0.0 });
}

#[test]
fn a_share_is_certain_only_beyond_the_error_of_the_edge() {
    let (half_width_error, crest_error) = (f64::exp2(-40.0), f64::exp2(-41.0));
    // The error of the phase 2.
    let rounding = 36.0 * UNIT_ROUNDOFF;
    let error = half_width_error + crest_error + rounding;
    let heads = |half_width| HeadsPhases { crest: 0.0, half_width, crest_error, half_width_error };
    assert!(uniform_share(&heads(2.0 + error), 1.5, 2.0).error > 0.0);
    assert_eq!(uniform_share(&heads((2.0 + error).next_up()), 1.5, 2.0).error, 0.0);
    assert!(uniform_share(&heads(2.0 - error), 2.0, 2.0_f64.next_up()).error > 0.0);
}

fn assert_share(found: Share, probability: f64, error: f64) {
    assert!((found.probability - probability).abs() < 1e-15, "{found:?}, not {probability}");
    assert!((found.error - error).abs() < 1e-10 * error, "{found:?}, not {error}");
}

#[test]
fn shares_and_errors_match_the_formulas() {
    let heads =
        |crest_error, half_width_error| HeadsPhases { crest: 0.5, half_width: 1.0, crest_error, half_width_error };
    let rounding = 9.0 * UNIT_ROUNDOFF;
    // The range ends 0.25 rad after the fourth edge from the crest; it shows heads for 1, 2 and 0.25 rad.
    let to = 0.5 + 4.0 * PI - 0.75;
    assert_share(
        uniform_share(&heads(0.0, 0.0), 0.5, to),
        3.25 / (to - 0.5),
        rounding * (3.0 * (2.0 + to) / (to - 0.5) + 1.0),
    );
    assert_share(uniform_share(&heads(1e-2, 1e-1), 0.5, to), 3.25 / (to - 0.5), (0.6 + 0.02) / (to - 0.5));
    assert_share(uniform_share(&heads(4.0, 1e-1), 0.5, to), 3.25 / (to - 0.5), (0.6 + TAU) / (to - 0.5));
    // Φ((1.5 - 1)/0.5) - Φ((-0.5 - 1)/0.5); the crests of three turns lie within the reach of the distribution.
    let probability = 0.839_994_848_036_912_8;
    assert_share(
        normal_share(&heads(0.0, 0.0), 1.0, 0.5),
        probability,
        6.0 * rounding * (13.0 / 9.0 * 7.15 * 0.8 + 1.0),
    );
    assert_share(normal_share(&heads(1e-4, 1e-3), 1.0, 0.5), probability, 6.0 * 1.1e-3 * 0.8);
    assert_share(normal_share(&heads(1e-4, 1e-3), 1.0, 2.0), 0.381_985_954_673_481_5, 14.0 * 1.1e-3 * 0.2);
    // The crest of a single turn lies within reach.
    assert_share(normal_share(&heads(1e-4, 1e-3), 0.5, 0.1), 1.0, 2.0 * 1.1e-3 * 4.0);
}

#[test]
fn a_motion_that_is_always_heads_or_never_has_a_share_without_error() {
    for speed in ["3:5", "normal:4:0.1"] {
        for (tilt, probability) in [("0", 1.0), ("3.1", 0.0)] {
            let share = share_of(Coin::PAPER, ["1", "1", "60"], tilt, speed);
            assert_eq!(share, Share { probability, error: 0.0 });
        }
        // At ψ = 45° the motion only touches cos θ = 0, but within its rounding error it may cross it.
        let share = share_of(Coin::PAPER, ["30", "0", "60"], "0", speed);
        assert!(share.probability > 1.0 - 1e-7 && share.error > 0.0, "{share:?}");
    }
}

#[test]
fn a_wide_normal_speed_gives_the_long_flight_limit() {
    let wide = share_of(Coin::PAPER, ["20", "0", "3"], "0", "normal:1000:20");
    let cone = 20_f64.atan2(1.5);
    let limit = crate::long_flight_probability(cone, cone);
    assert!((wide.probability - limit).abs() < 1e-15);
    // Both formulas agree at σ = 9 rad, where the code changes from one to the other.
    let heads = TiltTerms::new(
        &Space::parse(Coin::PAPER, &[(RateX, "20"), (RateY, "0"), (RateZ, "3"), (Speed, "3")])
            .unwrap()
            .toss(&[20.0, 0.0, 3.0, 3.0, 9.81, 0.0, 0.0, 0.0, 0.0])
            .coin()
            .unwrap(),
    )
    .heads();
    let [below, above] = [9.0_f64.next_down(), 9.0].map(|sd| normal_share(&heads, 100.0, sd));
    assert!((below.probability - above.probability).abs() < 1e-14, "{below:?} {above:?}");
    assert_eq!(above.error, heads.half_width_error / PI);
}

#[test]
fn refuses_a_phase_above_two_to_the_53() {
    let texts = [(RateX, "1e9"), (RateY, "0"), (RateZ, "0"), (Speed, "0:1e9")];
    let space = Space::parse(Coin::PAPER, &texts).unwrap();
    let (_, error) = share(&space, Coin::PAPER, &space.fixed_values()).unwrap_err();
    assert!(matches!(error, SolveError::PhaseTooLarge { .. }));
    // A phase of exactly 2^53 rad is accepted.
    let texts = [(RateX, "9007199254740992"), (RateY, "0"), (RateZ, "0"), (Speed, "0:1"), (Gravity, "2")];
    let space = Space::parse(Coin::PAPER, &texts).unwrap();
    assert!(share(&space, Coin::PAPER, &space.fixed_values()).is_ok());
}
