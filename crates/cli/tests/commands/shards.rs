//! Parts of an estimate: any partition merges to the whole, a part that is there is not computed again, and what would
//! count a launch twice or not at all is refused with the name of its file.

use std::path::Path;

use crate::common::{json, run, stderr, stdout};

/// Writes part `index` of `number` of the estimate with these options into `folder`, and returns its path.
fn part(folder: &Path, options: &str, index: usize, number: usize) -> String {
    let path = folder.join(format!("part-{index}.json")).display().to_string();
    let output = run(&format!("probability {options} --shard {index}/{number} --out {path}"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with(&format!("part         {index} of {number}: ")), "{}", stdout(&output));
    path
}

/// The refusal of `arguments`, as text and as JSON alike.
#[track_caller]
fn refusal(arguments: &str) -> String {
    let error = json(arguments, 2);
    let message = error["error"]["message"].as_str().expect("a message").to_owned();
    assert!(stderr(&run(arguments)).contains(&message), "{message}");
    message
}

#[test]
fn ninety_seven_parts_in_any_order_are_the_whole() {
    for options in [
        "--space paper-fig4 --method random --points 100003 --seed 5",
        "--space paper-fig4 --method sobol --points 16384",
        "--space paper-fig4 --method grid",
        "--rate-x 1:9 --rate-y x --rate-z 1:9 --speed 3:5 --method exact-speed --points 4096",
        "--coin us-quarter-engraved --rate-x 20:30 --rate-y 5 --rate-z 3 --speed 3:4 --method sobol --points 2048",
    ] {
        let folder = tempfile::tempdir().unwrap();
        let parts: Vec<String> = (1..=97).rev().map(|index| part(folder.path(), options, index, 97)).collect();
        let merged = json(&format!("merge {}", parts.join(" ")), 0);
        let whole = json(&format!("probability {options}"), 0);
        for field in
            ["heads", "tails", "undecided", "points", "probability", "interval", "interval_kind", "seed", "method"]
        {
            assert_eq!(merged[field], whole[field], "{field} of {options}");
        }
        // A file proves nothing.
        assert_eq!((&merged["certified"], &merged["proven_by"]), (&false.into(), &serde_json::Value::Null));
        assert_eq!(merged["input"]["parts"].as_array().unwrap().len(), 97);
    }
}

#[test]
fn a_part_reads_back_every_digit_of_its_space() {
    let folder = tempfile::tempdir().unwrap();
    for number in ["1.0472333333333335", "0.1", "7.317735896177309e-5", "123.45678901234567"] {
        let options =
            format!("--rate-x 0:50 --rate-y 9:9:9 --rate-z 30 --speed 3:5 --method random --points 99 --drop {number}");
        let folder = folder.path().join(number);
        std::fs::create_dir(&folder).unwrap();
        let path = part(&folder, &options, 1, 1);
        let again = run(&format!("probability {options} --shard 1/1 --out {path}"));
        assert!(stdout(&again).contains("which held it already"), "{number}: {}", stderr(&again));
    }
}

#[test]
fn a_part_that_is_there_is_not_computed_again_and_nothing_else_is_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let options = "--space paper-fig4 --method random --points 1000";
    let path = part(folder.path(), options, 1, 2);
    let command = format!("probability {options} --shard 1/2 --out {path}");
    let before = std::fs::metadata(&path).unwrap().modified().unwrap();
    assert!(stdout(&run(&command)).contains("which held it already"));
    assert_eq!(std::fs::metadata(&path).unwrap().modified().unwrap(), before);
    for other in [command.replace("1/2", "2/2"), command.replace("1000", "1001"), format!("{command} --seed 2")] {
        let output = run(&other);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(&path) && stderr(&output).contains("another part"), "{}", stderr(&output));
    }
    // Half a file, as another program may leave it.
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, &text[..text.len() / 2]).unwrap();
    assert!(stderr(&run(&command)).contains("holds no part"));
    assert!(refusal(&format!("merge {path}")).starts_with(&path));
    // On standard output.
    assert_eq!(stdout(&run(&command.replace(&path, "-"))), text);
}

/// A digit of a sum, changed on the way from one machine to another, moved the merged probability from 0.66 to 0.60.
#[test]
fn a_part_with_a_changed_digit_is_refused_with_the_name_of_the_file_and_not_held_to_be_there() {
    let shares = "--rate-x 1:9 --rate-y x --rate-z 1:9 --speed 3:5 --method exact-speed --points 64";
    for (options, field) in
        [(shares, "\"probability\":\""), ("--space paper-fig4 --method random --points 1000", "heads\":")]
    {
        let folder = tempfile::tempdir().unwrap();
        let paths = [1, 2].map(|index| part(folder.path(), options, index, 2));
        let text = std::fs::read_to_string(&paths[1]).unwrap();
        let at = text.rfind(field).unwrap() + field.len();
        let digit = if &text[at..=at] == "2" { "3" } else { "2" };
        std::fs::write(&paths[1], format!("{}{digit}{}", &text[..at], &text[at + 1..])).unwrap();
        let message = refusal(&format!("merge {}", paths.join(" ")));
        assert!(message.starts_with(&paths[1]) && message.contains("digest"), "{message}");
        assert!(message.contains("changed since the file was written"), "{message}");
        let again = run(&format!("probability {options} --shard 2/2 --out {}", paths[1]));
        assert_eq!(again.status.code(), Some(2));
        let said = stderr(&again);
        assert!(said.contains(&paths[1]) && said.contains("digest") && said.contains("remove it"), "{said}");
        std::fs::write(&paths[1], text).unwrap();
        assert_eq!(run(&format!("merge {}", paths.join(" "))).status.code(), Some(0));
    }
}

#[test]
fn gaps_overlaps_and_parts_of_other_plans_are_refused_with_the_name_of_the_file() {
    let [folder, others] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let options = "--space paper-fig4 --method random --points 1000";
    let thirds: Vec<String> = (1..=3).map(|index| part(folder.path(), options, index, 3)).collect();
    let [one, two, three] = [0, 1, 2].map(|index| thirds[index].as_str());
    let other = part(others.path(), &format!("{options} --seed 2"), 2, 3);
    let half = part(others.path(), options, 1, 2);
    for (parts, [file, words]) in [
        (vec![one, three], [three, "launches 334 to 666 are missing"]),
        (vec![two, three], [two, "launches 1 to 333 are missing"]),
        (vec![two, one], [two, "launches 667 to 1000 are missing"]),
        (vec![one, one, two, three], [one, "launches 1 to 333 are in"]),
        (vec![&half, two, three], [two, "launches 334 to 500 are in"]),
        (vec![one, &other, three], [&other, "another plan"]),
    ] {
        let message = refusal(&format!("merge {}", parts.join(" ")));
        assert!(message.starts_with(file) && message.contains(words), "{message}");
    }
    assert!(refusal("merge /no/such/part.json").contains("/no/such/part.json"));
    assert!(json("merge", 2)["error"]["message"].as_str().unwrap().contains("PART"));
}

/// The hundredth part of 10^10 launches is within reach, and its launches are those of the whole.
#[test]
fn a_small_part_of_very_many_launches_is_quick() {
    let options = "--space paper-fig4 --method random --points 10000000000 --shard 99999/100000 --out -";
    let part: serde_json::Value = serde_json::from_str(&stdout(&run(&format!("probability {options}")))).unwrap();
    assert_eq!(part["range"], serde_json::json!([9_999_800_000_u64, 9_999_900_000_u64]));
    let heads = part["counts"][0]["heads"].as_f64().unwrap();
    assert!((heads / 1e5 - 0.6615).abs() < 0.01, "{heads}");
}
