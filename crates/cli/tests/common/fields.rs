//! The fields of JSON: those that `docs/json.md` lists, and those that an answer has. A field that is not listed, or has
//! another type there, breaks what the document promises.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

const DOCUMENT: &str = include_str!("../../../../docs/json.md");

/// Paths of fields, each with the types of its values.
pub(crate) type Fields = BTreeMap<String, BTreeSet<String>>;

/// The rows of a section of the document.
pub(crate) fn documented(section: &str) -> Fields {
    let (_, text) = DOCUMENT.split_once(&format!("\n## {section}\n")).unwrap_or_else(|| panic!("no section {section}"));
    let text = text.split("\n## ").next().unwrap_or(text);
    let row = |line: &str| {
        let mut cells = line.split('|').map(str::trim).skip(1);
        let (path, types) = (cells.next()?.strip_prefix('`')?.strip_suffix('`')?, cells.next()?);
        Some((path.to_owned(), types.split(" or ").map(str::to_owned).collect()))
    };
    text.lines().filter_map(row).collect()
}

/// Adds the fields of `value`, which stands at `path`.
pub(crate) fn collect(value: &Value, path: &str, fields: &mut Fields) {
    let kind = match value {
        Value::Object(object) => {
            for (key, value) in object {
                collect(value, &if path.is_empty() { key.clone() } else { format!("{path}.{key}") }, fields);
            }
            return;
        }
        Value::Array(items) if items.first().is_some_and(Value::is_object) => {
            return items.iter().for_each(|item| collect(item, &format!("{path}[]"), fields));
        }
        Value::Array(_) => "array",
        Value::Number(number) if number.is_u64() => "integer",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Bool(_) => "boolean",
        Value::Null => "null",
    };
    fields.entry(path.to_owned()).or_default().insert(kind.to_owned());
}
