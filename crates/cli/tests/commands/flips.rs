//! Runs the commands about how a launch changes its outcome as a user does: `intervals` and `inverse`.

use crate::common::{assert_near, json, run, stderr, stdout};

#[test]
fn an_angle_explains_counts_of_one_hand_and_of_people() {
    // The flips of F. Bartoš et al., arXiv 2310.04153.
    let all = json("inverse --counts 178078/350757", 0);
    assert_near(&all["probability"], 178_078.0 / 350_757.0, 1e-16);
    let again = json(&format!("inverse --probability {}", all["probability"]), 0);
    assert_eq!((&all["cone_angle"], &all["rate_ratio"]), (&again["cone_angle"], &again["rate_ratio"]));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("people.csv");
    let counted = |text: &str| {
        std::fs::write(&path, text).unwrap();
        format!("inverse --counts {}", path.display())
    };
    let people = counted("person,same,tosses\nA,56,100\nB, 61 ,100\nC,2e1,100\n");
    let found = json(&people, 0);
    assert_eq!(
        (&found["same"], &found["tosses"], found["people"].as_array().unwrap().len()),
        (&137.into(), &300.into(), 3)
    );
    assert!(found["practice"].is_null() && found["people"][2]["interval"][0].as_f64().is_some_and(|lo| lo < 0.2));
    assert!(found["people"][2]["cone_angle"].is_null() && found["interval_kind"] == "beta-binomial 95 % of 3 people");
    assert_eq!((&found["people"][1]["person"], &found["absent"]), (&"B".into(), &0.into()));
    assert!(stdout(&run(&people)).contains("assumed      independent flips; long flights from horizontal"));
    // Student's interval of three people with as many flips, cut at -1.
    let order = counted(
        "person,start,lands,rule\nA,H,HHTHTTTHHT,last\nB,H,HHHTTHTHTT,fixed\nC,H,HTHTH,fixed\nC,H,TTTTT,fixed\n",
    );
    let practice = json(&order, 0)["practice"].clone();
    assert_near(&practice["change"], -0.2, 1e-12);
    assert_near(&practice["p_value"], 0.477_767_032_132_906_5, 1e-9);
    assert_near(&practice["interval"][1], 0.793_655_084_700_132_4, 1e-9);
    let said =
        "practice     -0.2000 from the earlier half of each one's flips to the later, from -1.0000 to 0.7937 (95 %)";
    assert!(stdout(&run(&order)).contains(said), "{}", stdout(&run(&order)));
    for (text, line, column, field, words) in [
        ("same,tosses\n3,4\n5,4\n", 3, 1, "same", "same = 5.0 is outside its valid range: 0 to the number of tosses"),
        ("same,tosses\n0,0\n", 1, 1, "counts", "a person with a toss in a row"),
        ("tosses;same\r\n\r\n0;1\r\n", 3, 2, "same", "same = 1.0 is outside its valid range: 0 to the number of"),
        ("same,tosses,same\n1,4,1\n", 1, 1, "same", "same = 'columns 1 and 3' can't be used: expected one column"),
        ("same,tosses\n-1,4\n", 2, 1, "same", "same = '-1' can't be used: expected a whole number"),
        ("same,flips\n1,4\n", 1, 1, "tosses", "tosses is missing: expected the columns same and tosses"),
        ("same,tosses\n", 1, 1, "counts", "a person with a toss in a row"),
    ] {
        let command = counted(text);
        let error = json(&command, 2)["error"].clone();
        let found = (&error["line"], &error["column"], &error["field"]);
        assert_eq!(found, (&line.into(), &column.into(), &field.into()), "{error}");
        let said = stderr(&run(&command));
        assert!(
            said.contains(&format!("people.csv, line {line}, column {column}: ")) && said.contains(words),
            "{said}"
        );
    }
}

#[test]
fn an_interval_below_a_half_has_no_angle_and_an_absent_person_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("people.csv");
    let counts = format!("inverse --counts {}", path.display());
    std::fs::write(&path, "person,same,tosses\nA,430,1000\nB,441,1000\nC,0,0\nD,425,1000\nA,7,10\n").unwrap();
    let few = json(&counts, 0);
    assert!(few["cone_angle"].is_null() && few["cone_angle_interval"].is_null() && few["rate_ratio"].is_null());
    assert_eq!((&few["absent"], few["people"][0]["tosses"].as_u64()), (&1.into(), Some(1010)));
    let text = stdout(&run(&counts));
    for line in [
        "ψ            none: no ψ explains this",
        "note         1 person is passed over, without a toss",
        "note         3 people say little about others",
    ] {
        assert!(text.contains(line), "{text}");
    }
    assert!(json("inverse --counts 10/100", 0)["cone_angle"].is_null());
    assert!(stdout(&run("inverse --counts 50/100")).contains("ψ            90.00°, from 60.73° to 90.00°"));
    std::fs::write(&path, "same,tosses\n20,20\n20,20\n").unwrap();
    let all = json(&counts, 0);
    assert!(all["spread"].is_null() && all["next_person"].is_null() && all["interval"][1] == 1.0, "{all}");
}
