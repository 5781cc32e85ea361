//! Errors of serde in words of those who write files.

/// What serde says is wrong with a file, in one line: with tables, lists and numbers in place of the types of Rust.
///
/// ```
/// let message = "invalid type: sequence, expected struct SpaceData";
/// assert_eq!(dynamics::data::in_words(message), "invalid type: list, expected a table");
/// ```
pub fn in_words(message: &str) -> String {
    let line = message.lines().map(str::trim).collect::<Vec<_>>().join(", ");
    let line = line.replace("EOF while parsing", "the text ends within").replace("` as i128,", "`,");
    match line.rsplit_once(", expected ") {
        Some((found, expected)) => format!("{}, expected {}", found_in_words(found), expected_in_words(expected)),
        None => line,
    }
}

fn found_in_words(found: &str) -> String {
    let kinds = [("sequence", "list"), ("map", "table"), ("floating point", "number"), ("integer", "number")];
    let Some(kind) = found.strip_prefix("invalid type: ").or(found.strip_prefix("invalid value: ")) else {
        return found.to_owned();
    };
    let said = kinds.iter().find_map(|(of_serde, said)| Some(format!("{said}{}", kind.strip_prefix(of_serde)?)));
    said.map_or_else(|| found.to_owned(), |said| found.replacen(kind, &said, 1))
}

fn expected_in_words(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "u32" => "a whole number from 0 to 4294967295".to_owned(),
        "u64" | "usize" => "a whole number from 0".to_owned(),
        "a sequence" => "a list".to_owned(),
        "map" => "a table".to_owned(),
        // Of a whole number of more than 64 bits.
        "any value" => "a number with a point".to_owned(),
        _ if expected.starts_with("struct ") => "a table".to_owned(),
        _ => expected.replacen("an array of length", "a list of", 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_type_of_rust_is_named() {
        for (message, words) in [
            ("invalid type: string \"x\", expected f64", "invalid type: string \"x\", expected a number"),
            ("invalid value: integer `-1`, expected u64", "invalid value: number `-1`, expected a whole number from 0"),
            ("invalid length 0, expected struct Scene with 3 elements", "invalid length 0, expected a table"),
            ("invalid length 1, expected an array of length 2", "invalid length 1, expected a list of 2"),
            (
                "invalid type: integer `9` as i128, expected any value",
                "invalid type: number `9`, expected a number with a point",
            ),
            ("EOF while parsing an object", "the text ends within an object"),
            ("invalid basic string\nexpected `\"`", "invalid basic string, expected `\"`"),
            ("unknown field `a`, expected `b` or `c`", "unknown field `a`, expected `b` or `c`"),
        ] {
            assert_eq!(in_words(message), words);
        }
    }
}
