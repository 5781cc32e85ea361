//! Files of scenes and spaces: valid ones, whose fields and numbers are changed, and whose text is then damaged. Also rows of
//! launches, as standard input has them.

use serde_json::{Map, Value, json};

use crate::lists::EXTREME;
use crate::source::Source;
use crate::values::{axis, number};

/// The file `name` with some content, a scene if that is wanted. The end of the name tells its format.
pub(crate) fn file(source: &mut Source, name: &str, scene_wanted: bool) -> (String, Vec<u8>) {
    if name == "part.json" {
        return (name.to_owned(), part(source));
    }
    let is_space = if source.careful { !scene_wanted } else { source.chance(50) };
    let mut content = if is_space { space(source) } else { scene(source) };
    while !source.careful && source.chance(40) {
        change(source, &mut content);
    }
    let text = if name.ends_with(".json") {
        content.to_string()
    } else {
        // A table can't hold everything that JSON can.
        toml::to_string(&content).unwrap_or_else(|_| format!("x = {content}"))
    };
    // Numbers stand as texts up to here, because neither format has all of them.
    let text = text.replace("\"@", "").replace("@\"", "");
    let mut bytes = text.into_bytes();
    if !source.careful && source.chance(30) {
        damage(source, &mut bytes);
    }
    (name.to_owned(), bytes)
}

/// The only part of ten launches, whose fields may be changed and whose text may be damaged.
fn part(source: &mut Source) -> Vec<u8> {
    let mut content = json!({
        "schema": 2,
        "streams": 1,
        "version": env!("CARGO_PKG_VERSION"),
        "space": { "coin": "paper", "rate_x": "0:50", "rate_y": "x", "rate_z": 30, "speed": "3:5" },
        "plan": { "method": "random", "points": 10, "seed": source.below(9) },
        "range": [0, 10],
        "counts": [{ "heads": 7, "tails": 2, "undecided": 1 }],
        "digest": "",
    });
    while !source.careful && source.chance(40) {
        change(source, &mut content);
    }
    let mut text = content.to_string().replace("\"@", "").replace("@\"", "");
    if source.careful || source.chance(80) {
        text = with_digest(&text);
    }
    let mut bytes = text.into_bytes();
    if !source.careful && source.chance(30) {
        damage(source, &mut bytes);
    }
    bytes
}

/// The part with its digest, which the refusal of another one states.
fn with_digest(text: &str) -> String {
    let refusal =
        serde_json::from_str::<sampling::Tally>(text).map_or_else(|error| error.to_string(), |_| String::new());
    let digest = refusal.split_once(", and ").and_then(|(_, rest)| rest.split_once(" of the contents"));
    digest
        .map_or(text.to_owned(), |(digest, _)| text.replacen("\"digest\":\"\"", &format!("\"digest\":\"{digest}\""), 1))
}

fn space(source: &mut Source) -> Value {
    let mut space = Map::new();
    for coordinate in ["rate_x", "rate_y", "rate_z", "speed", "gravity", "tilt", "drop"] {
        let wanted = matches!(coordinate, "rate_x" | "rate_y" | "rate_z" | "speed");
        if source.chance(if wanted { 97 } else { 10 }) {
            let value = if source.chance(30) { numeral(source) } else { axis(source).into() };
            space.insert(coordinate.to_owned(), value);
        }
    }
    if source.chance(50) {
        space.insert("coin".to_owned(), coin(source));
    }
    if source.chance(20) {
        space.insert("description".to_owned(), "a space".into());
    }
    space.into()
}

fn scene(source: &mut Source) -> Value {
    let mut scene = json!({ "accuracy": numeral(source) });
    let toss = toss(source);
    scene["want"] = match source.below(5) {
        0 => json!({ "outcome": toss }),
        1 => json!({ "tilt": toss }),
        2 => json!({ "attitude": toss }),
        3 => json!({ "trace": { "toss": toss, "points": source.below(9) } }),
        _ => json!({ "probability": space(source) }),
    };
    if source.chance(30) {
        scene["by"] = json!({ "solver": source.pick(&["gamma", "euler", "quaternion", "exact", "x"]) });
        if source.chance(50) {
            scene["by"]["scheme"] = (*source.pick(&["dop853", "rk4", "taylor", ""])).into();
        }
    }
    scene
}

fn toss(source: &mut Source) -> Value {
    let rate: Vec<Value> = (0..3).map(|_| numeral(source)).collect();
    let mut launch = json!({ "rate": rate });
    launch[*source.pick(&["speed", "speed", "time"])] = numeral(source);
    for field in ["gravity", "drop", "tilt", "attitude", "drag"] {
        if source.chance(10) && !(source.careful && matches!(field, "attitude" | "drag")) {
            launch[field] = numeral(source);
        }
    }
    json!({ "coin": coin(source), "launch": launch })
}

fn coin(source: &mut Source) -> Value {
    match source.below(6) {
        0 => json!({ "moments": [numeral(source), numeral(source)] }),
        1 => json!({ "cylinder": [numeral(source), numeral(source), numeral(source)] }),
        2 => json!({ "moments": (0..3).map(|_| numeral(source)).collect::<Vec<_>>() }),
        3 => json!({ "inertia": (0..6).map(|_| numeral(source)).collect::<Vec<_>>() }),
        _ => (*source.pick(&["paper", "us-quarter", "disc", "racket", "us-quarter-engraved"])).into(),
    }
}

/// A number as a text, from which the quotation marks are taken later.
fn numeral(source: &mut Source) -> Value {
    let text = number(source);
    if text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"+-._".contains(&byte)) {
        format!("@{text}@").into()
    } else {
        text.into()
    }
}

/// Drops, renames, adds or replaces a value somewhere inside.
fn change(source: &mut Source, value: &mut Value) {
    match value {
        Value::Object(fields) if !fields.is_empty() => {
            let keys: Vec<String> = fields.keys().cloned().collect();
            let key = source.pick(&keys);
            match source.below(8) {
                0 => _ = fields.remove(key),
                1 => _ = fields.insert("unknown".to_owned(), 1.into()),
                2 => _ = fields.remove(key).and_then(|value| fields.insert(format!("{key}x"), value)),
                _ => change(source, &mut fields[key]),
            }
        }
        Value::Array(items) if !items.is_empty() && source.chance(70) => {
            let at = source.below(items.len());
            match source.below(4) {
                0 => _ = items.remove(at),
                1 => items.push(1.into()),
                _ => change(source, &mut items[at]),
            }
        }
        _ => {
            let extreme = Value::from(format!("@{}@", source.pick(&EXTREME)));
            *value =
                source.pick(&[json!({}), json!([]), json!([[1]]), json!(true), json!(""), json!("x"), extreme]).clone();
        }
    }
}

/// Cuts the text, or puts something into it that does not belong there.
fn damage(source: &mut Source, bytes: &mut Vec<u8>) {
    let at = source.below(bytes.len() + 1);
    let lines = |bytes: &[u8]| bytes.split(|byte| *byte == b'\n').next().unwrap_or_default().to_vec();
    let long = if source.chance(10) { 20 } else { 10 };
    let more: Vec<u8> = match source.below(12) {
        0 => return bytes.truncate(at),
        1 => return bytes.clear(),
        2 => [lines(bytes), b"\n".to_vec()].concat(),
        3 => vec![0],
        4 => vec![0xff, 0xfe],
        5 => "\u{feff}".into(),
        6 => "[".repeat(1 + source.below(20_000)).into(),
        7 => "{\"a\":".repeat(1 + source.below(2_000)).into(),
        8 => "a.".repeat(1 + source.below(2_000)).into(),
        9 => "9".repeat(1 << source.below(1 + long)).into(),
        10 => "\r\n".into(),
        _ => "\u{1b}\"'=\u{202e}".into(),
    };
    let at = if source.chance(30) { 0 } else { at };
    bytes.splice(at..at, more);
}

/// Rows of launches under a heading.
pub(crate) fn rows(source: &mut Source) -> Vec<u8> {
    let heading =
        source.pick(&["wx,wy,wz,speed", "wx,wy,wz,time", "wx,wy,wz,speed,tilt,gravity,drop", "wx,wy,wz", "wx,wx", ""]);
    let columns = heading.split(',').count();
    let mut text = format!("{heading}\n");
    for _ in 0..source.below(6) {
        let columns = if source.chance(95) { columns } else { source.below(9) };
        text.extend([(0..columns).map(|_| number(source)).collect::<Vec<_>>().join(","), "\n".to_owned()]);
    }
    let mut bytes = text.into_bytes();
    if source.chance(15) {
        damage(source, &mut bytes);
    }
    bytes
}
