//! `docs/report.schema.json` describes report.json for programs that read it. These tests compare it with reports in
//! both directions: a key that was added or renamed in the code is not in the schema, and one that was removed is
//! required by it.
//!
//! The validator knows the keywords of JSON Schema that the file uses, and refuses others.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use serde_json::{Map, Value, json};
use toss::{Coin, ExactSolver, Landing, QuaternionSolver, Scheme, SolveError, Solver, SolverEntry, Toss};
use verify::judge::baseline::Baseline;
use verify::judge::limits::Limits;
use verify::judge::time::Timing;
use verify::judge::unused_limits;
use verify::measure::diagnosis::{Diagnosis, Example};
use verify::process::Tally;
use verify::render::report::Compared;
use verify::{CHECKS, Check, Context, Effort, LeftOut, Report, Row, judge};

fn schema() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/report.schema.json");
    serde_json::from_str(&std::fs::read_to_string(path).expect("the schema")).expect("JSON")
}

/// Where `value` differs from `schema`, which is a part of `root`; the definitions that it is compared with are `used`.
fn differences(root: &Value, schema: &Value, value: &Value, at: &str, used: &mut BTreeSet<String>) -> Vec<String> {
    let mut found = Vec::new();
    for (keyword, wanted) in schema.as_object().expect("a schema is an object") {
        let holds = match keyword.as_str() {
            "$schema" | "title" | "description" | "$defs" | "required" | "additionalProperties" => true,
            "$ref" => {
                let name = wanted.as_str().and_then(|text| text.strip_prefix("#/$defs/")).expect("a definition's name");
                used.insert(name.to_owned());
                found.extend(differences(root, &root["$defs"][name], value, at, used));
                true
            }
            "type" => is_of_type(wanted, value),
            "const" => wanted == value,
            "enum" => wanted.as_array().is_some_and(|all| all.contains(value)),
            "minimum" => value.as_f64() >= wanted.as_f64() || value.is_null(),
            "minItems" => value.as_array().is_some_and(|all| Some(all.len() as u64) >= wanted.as_u64()),
            "maxItems" => value.as_array().is_some_and(|all| Some(all.len() as u64) <= wanted.as_u64()),
            "properties" => {
                for (key, value) in value.as_object().into_iter().flatten() {
                    found.extend(match wanted.get(key) {
                        Some(schema) => differences(root, schema, value, &format!("{at}/{key}"), used),
                        None => vec![format!("{at}: {key} is not in the schema")],
                    });
                }
                let required = schema["required"].as_array().expect("a list of required keys");
                required.iter().all(|key| key.as_str().is_some_and(|key| value.get(key).is_some()))
            }
            "items" | "prefixItems" => {
                for (index, item) in value.as_array().into_iter().flatten().enumerate() {
                    let schema = if keyword == "items" { wanted } else { &wanted[index] };
                    found.extend(differences(root, schema, item, &format!("{at}[]"), used));
                }
                value.is_array() || value.is_null()
            }
            // Exactly one of the schemas. If none fits, the differences are those from the last, which is not `null`.
            "oneOf" => {
                let compared = wanted.as_array().into_iter().flatten().map(|schema| {
                    let mut used = BTreeSet::new();
                    (differences(root, schema, value, at, &mut used), used)
                });
                let (mut fitting, mut others): (Vec<_>, Vec<_>) = compared.partition(|(found, _)| found.is_empty());
                let is_at_most_one = fitting.len() <= 1;
                let (more, of_it) = fitting.pop().or_else(|| others.pop()).expect("a schema");
                found.extend(more);
                used.extend(of_it);
                is_at_most_one
            }
            unknown => panic!("the keyword {unknown} is not known to this validator"),
        };
        if !holds {
            let shown: String = value.to_string().chars().take(80).collect();
            found.push(format!("{at}: {shown} does not satisfy {keyword}"));
        }
    }
    found
}

fn is_of_type(wanted: &Value, value: &Value) -> bool {
    let is = |name: &str| match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_u64() || value.is_i64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        unknown => panic!("no type is called {unknown}"),
    };
    match wanted {
        Value::Array(names) => names.iter().filter_map(Value::as_str).any(is),
        name => name.as_str().is_some_and(is),
    }
}

/// A solver that fails on every toss, so that a report has failures.
struct Refuses;

impl Solver for Refuses {
    fn name(&self) -> &str {
        "refuses"
    }
    fn land(&self, _: &Toss) -> Result<Landing, SolveError> {
        let reason = Coin::from_moments(-1.0, 1.0).expect_err("a negative moment");
        Err(SolveError::failed(self.name(), reason))
    }
}

/// A report in which every kind of record, row, move and failure occurs.
fn report() -> Value {
    let stepper = SolverEntry::new("stepper", "", |settings| {
        Box::new(QuaternionSolver::new(settings.stepping, settings.formulation))
    });
    let stepper = stepper.with_schemes(&[Scheme::DOPRI5, Scheme::RK4]);
    let registry = [ExactSolver::entry(), stepper, SolverEntry::new("refuses", "", |_| Box::new(Refuses))];
    let context = Context::new(&registry, Effort::Quick).expect("the reference numbers");
    assert!(
        context.atlas.get(&context).is_ok()
            && context.convergence.get(&context).is_ok()
            && context.sweep.get(&context).is_ok()
    );
    let limits = Limits::parse("[gone]\nreason = 'r'\nallowed = { s = 1.0 }").expect("limits");
    let of = |id: &str| -> Vec<Row> {
        let check: &Check = CHECKS.iter().find(|check| check.id == id).expect("a check");
        judge(check, check.measure(&context).expect("measurements"), &limits)
    };
    let mut rows = [of("reference-cos-tilt"), of("convergence-order"), of("certified-outcomes")].concat();
    rows.extend(unused_limits(&rows, &limits, |_, _| true));
    let timing = |t_processor_s| Timing { check: "slow".to_owned(), t_wall_s: 1.5, t_processor_s, limit_s: 50.0 };
    rows.push(timing(Some(51.0)).row().expect("a slow check"));
    let before = "check,subject,error,calls\nreference-cos-tilt,exact,0,\ngone,all,1.5,7\n";
    let moves = Baseline::parse(before).expect("a baseline").moves(&Baseline::of(&rows, None), true);
    let compared = Compared { file: "quick.csv".to_owned(), found: true, written: false };
    let (timings, left_out) =
        (vec![timing(Some(51.0)), timing(None)], vec![LeftOut { check: CHECKS[0].id, why: "a test" }]);
    let example = Example { question: "1".to_owned(), answer: "none".to_owned(), expected: "2".to_owned() };
    let found = Diagnosis {
        subject: "refuses".to_owned(),
        cause: "no answer".to_owned(),
        explains_all: true,
        launches: 3,
        right: 0,
        without_answer: 3,
        example,
    };
    let report = Report::new(Arc::new(context), rows, timings, compared, moves, left_out);
    let report = report.with_diagnoses(vec![found], Some(Tally::default()));
    serde_json::from_str(&report.json().expect("JSON")).expect("JSON")
}

/// Every object within `value`, which is changed by `change`.
fn each_object(value: &mut Value, change: &mut impl FnMut(&mut Map<String, Value>)) {
    match value {
        Value::Object(map) => {
            map.values_mut().for_each(|value| each_object(value, change));
            change(map);
        }
        Value::Array(all) => all.iter_mut().take(1).for_each(|value| each_object(value, change)),
        _ => {}
    }
}

#[test]
fn a_report_and_its_schema_have_the_same_keys_in_both_directions() {
    let (root, report) = (schema(), report());
    let mut used = BTreeSet::new();
    let errors = differences(&root, &root, &report, "", &mut used);
    assert!(errors.is_empty(), "{:#?}", &errors[..errors.len().min(10)]);
    let defined: BTreeSet<String> = root["$defs"].as_object().expect("definitions").keys().cloned().collect();
    assert_eq!(used, defined, "every definition describes something");
    // The validator sees each renamed, added and removed key, wherever it is.
    let mut objects = 0;
    each_object(&mut report.clone(), &mut |_| objects += 1);
    assert!(objects >= 15, "{objects}");
    for broken in 0..objects {
        for fault in ["renamed", "added", "removed"] {
            let (mut report, mut index) = (report.clone(), 0);
            each_object(&mut report, &mut |map| {
                if index == broken {
                    let first = map.keys().next().cloned().unwrap_or_default();
                    let value = if fault == "added" { None } else { map.remove(&first) };
                    if fault != "removed" {
                        map.insert("another_name".to_owned(), value.unwrap_or(Value::Null));
                    }
                }
                index += 1;
            });
            let found = differences(&root, &root, &report, "", &mut BTreeSet::new());
            assert!(!found.is_empty(), "object {broken}, {fault}");
        }
    }
}

#[test]
fn every_object_of_the_schema_is_strict_and_every_key_is_described() {
    let mut root = schema();
    each_object(&mut root, &mut |map| {
        if let Some(properties) = map.get("properties").and_then(Value::as_object)
            && map.get("type") == Some(&json!("object"))
        {
            let keys: Vec<&String> = properties.keys().collect();
            let required: Vec<&str> =
                map["required"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
            assert_eq!(required.len(), keys.len(), "{keys:?}");
            assert_eq!(map["additionalProperties"], false, "{keys:?}");
            for (key, property) in properties {
                let described = property["description"].is_string() || property["$ref"].is_string();
                assert!(described, "{key} is not described");
            }
        }
    });
}
