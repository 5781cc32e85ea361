use super::*;

fn read<T: for<'de> Deserialize<'de>>(text: &str) -> Result<T, String> {
    toml::from_str(text).map_err(|error| error.message().to_owned())
}

#[test]
fn plans_are_read_back_and_have_defaults() {
    let scrambled = Scrambled { points: 96, scrambles: 3, seed: 7 };
    for plan in [
        Plan::Grid,
        Plan::Random { points: 1000, seed: 5 },
        Plan::Sobol(scrambled),
        Plan::ExactSpeed(Rest::Grid),
        Plan::ExactSpeed(Rest::Sobol(scrambled)),
        Plan::Enclosure { accuracy: 1e-9 },
    ] {
        assert_eq!(read::<Plan>(&toml::to_string(&plan).unwrap()), Ok(plan));
        assert_eq!(plan.method().to_string().parse(), Ok(plan.method()));
    }
    // 2^53 + 1 is the first whole number that no f64 holds.
    for (seed, written) in [(1_u64 << 53, "9007199254740992"), ((1 << 53) + 1, "'9007199254740993'"), (u64::MAX, "")] {
        let plan = Plan::Random { points: 64, seed };
        let (toml, json) = (toml::to_string(&plan).unwrap(), serde_json::to_string(&plan).unwrap());
        assert!(toml.replace('"', "'").contains(written), "{toml}");
        assert_eq!((read::<Plan>(&toml), serde_json::from_str(&json).ok()), (Ok(plan), Some(plan)));
    }
    let plain = "{\"method\":\"random\",\"points\":64,\"seed\":18446744073709551615}";
    assert_eq!(serde_json::from_str(plain).ok(), Some(Plan::Random { points: 64, seed: u64::MAX }));
    assert_eq!(
        read::<Plan>("method = 'random'\npoints = 64\nseed = '1e6'"),
        Ok(Plan::Random { points: 64, seed: 1_000_000 })
    );
    assert_eq!(read::<Plan>("method = 'sobol'\npoints = 64"), Ok(Plan::Sobol(Scrambled::new(64, 1))));
    assert_eq!(read::<Plan>("method = 'random'\npoints = 64"), Ok(Plan::Random { points: 64, seed: 1 }));
}

#[test]
fn plans_that_no_sampler_carries_out_are_refused_with_the_field_at_fault() {
    for (text, message) in [
        ("method = 'magic'", "method = 'magic' is unknown; known: grid, random, sobol, exact-speed, enclosure"),
        ("method = 'random'", "points is missing"),
        ("method = 'random'\npoints = 0", "points = 0.0 is outside its valid range: at least 1"),
        ("method = 'random'\npoints = 8\nscrambles = 8", "scrambles = '8' can't be used: expected none"),
        ("method = 'grid'\npoints = 8", "points = '8' can't be used: expected none"),
        ("method = 'grid'\nseed = 8", "seed = '8' can't be used"),
        ("method = 'exact-speed'\nseed = 8", "seed = '8' can't be used"),
        ("method = 'enclosure'", "accuracy"),
        ("method = 'enclosure'\naccuracy = 0", "accuracy"),
        ("method = 'enclosure'\naccuracy = 1e-9\npoints = 8", "points = '8' can't be used"),
        ("method = 'grid'\naccuracy = 1e-9", "accuracy = '0.000000001' can't be used"),
        ("method = 'random'\npoints = 8\nseed = -1", "expected a seed: a whole number from 0 to 2^64 - 1"),
        ("method = 'random'\npoints = 8\nseed = '1.5'", "seed = '1.5' can't be used: expected a whole number"),
        ("method = 'sobol'\npoints = 12", "points = '12' can't be used: expected a multiple"),
        ("method = 'sobol'\npoints = 0", "points = 0.0 is outside"),
        ("method = 'sobol'\npoints = 8\nscrambles = 0", "scrambles = 0.0 is outside"),
        ("method = 'sobol'\npoints = 8\nsead = 1", "unknown field `sead`"),
    ] {
        let found = read::<Plan>(text).unwrap_err();
        assert!(found.starts_with(message), "{found} for {text}");
    }
}
