//! The input of a command as its JSON answer repeats it: every option that was given or has a default, by its name.

use clap::{ArgMatches, Command};
use dynamics::quantity::Given;
use serde_json::{Map, Value};

use crate::output::whole;
use crate::quantity;

/// What does not change the answer, only where it goes, in which form, and how fast it is there.
const NO_INPUT: [&str; 5] = ["format", "svg", "threads", "help", "version"];

/// The options of `command` that were `given` or have a default, and the command's name.
pub(crate) fn input(command: &Command, given: &ArgMatches) -> Map<String, Value> {
    let names = command.get_arguments().map(|argument| argument.get_id().as_str());
    let options = names.filter(|name| !NO_INPUT.contains(name));
    let mut input: Map<String, Value> =
        options.filter_map(|name| Some((name.to_owned(), value(name, given)?))).collect();
    input.insert("command".to_owned(), command.get_name().into());
    input
}

/// A number where the option is one, else the text as it was given.
fn value(name: &str, given: &ArgMatches) -> Option<Value> {
    let whole = || count(name, given).or_else(|| number::<u32>(name, given));
    if let Ok(Some(flag)) = given.try_get_one::<bool>(name) {
        return flag.then(|| true.into());
    }
    let number = number::<f64>(name, given).or_else(whole).or_else(|| number::<usize>(name, given));
    let quantity = || Some(given.try_get_one::<Given>(name).ok()??.si().into());
    if name == "parts" {
        let paths = given.try_get_raw(name).ok()??.map(|path| Value::from(path.to_string_lossy().into_owned()));
        return Some(paths.collect());
    }
    if let Ok(Some(flag)) = given.try_get_one::<bool>(name) {
        // A flag that was not given is no input.
        return flag.then_some(Value::Bool(true));
    }
    number.or_else(quantity).or_else(|| {
        let text = given.try_get_raw(name).ok()??.next()?.to_string_lossy();
        let list = quantity::list(name, &text).map(|numbers| numbers.map_or(Value::Null, Value::from));
        Some(list.unwrap_or_else(|| text.into_owned().into()))
    })
}

/// The value of an option that holds a `T`.
fn number<T: Into<Value> + Copy + Clone + Send + Sync + 'static>(name: &str, given: &ArgMatches) -> Option<Value> {
    given.try_get_one::<T>(name).ok()?.map(|number| (*number).into())
}

/// The value of an option that is a count or a seed.
fn count(name: &str, given: &ArgMatches) -> Option<Value> {
    given.try_get_one::<u64>(name).ok()?.map(|number| whole(*number))
}
