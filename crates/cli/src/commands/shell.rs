//! `unfair-toss completions` prints a script that completes the program's options and their values in a shell, and
//! `unfair-toss man` a manual page. Both are made from the definition of the options, so that they are never out of date.

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Arg, Command, ValueHint};
use clap_complete::Shell;
use clap_mangen::Man;
use sampling::{Coordinate, named_spaces};
use toss::catalogue::entries;
use toss::{Formulation, Registry, Scheme, SolverEntry};

use crate::failure::Failure;
use crate::help;
use crate::solver_args::each_once;

#[derive(Debug, clap::Args)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ManArgs {
    /// The command whose page is wanted [default: that of the whole program]
    command: Option<String>,
}

impl CompletionsArgs {
    pub(crate) fn run(&self, registry: &Registry, program: Command) -> String {
        let commands: Vec<String> = program.get_subcommands().map(|command| command.get_name().to_owned()).collect();
        let mut program = program.mut_subcommands(|command| {
            let name = command.get_name().to_owned();
            command.mut_args(|option| completed(option, registry, &name, &commands))
        });
        let name = program.get_name().to_owned();
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, name, &mut script);
        let script = String::from_utf8_lossy(&script).into_owned();
        match self.shell {
            // It takes the hyphen of the program's name for the mark of a command, but not everywhere. In `--coin=us`, bash
            // takes the sign between for a word.
            Shell::Bash => script
                .replace("unfair__subcmd__toss", "unfair__toss")
                .replace("prev=\"$3\"", "prev=\"$3\"; [[ $prev == = ]] && prev=\"${COMP_WORDS[COMP_CWORD - 2]}\""),
            Shell::Fish => script + &positions_in_fish(&program),
            _ => script,
        }
    }
}

/// `option` of `command` with the values that a shell offers. The program itself reads names as texts, so that its own
/// message says which are known.
fn completed(option: Arg, registry: &Registry, command: &str, commands: &[String]) -> Arg {
    if !option.get_action().takes_values() || !option.get_possible_values().is_empty() {
        return option;
    }
    let id = option.get_id().as_str().to_owned();
    let names = names(registry, (command, &id), commands);
    if !names.is_empty() {
        return option.value_parser(PossibleValuesParser::new(names));
    }
    let is_file = matches!(id.as_str(), "svg" | "out" | "scene" | "counts" | "parts" | "from");
    option.value_hint(if is_file { ValueHint::FilePath } else { ValueHint::Other })
}

/// The names that an option of a command takes; none if it takes something else.
fn names(registry: &Registry, (command, option): (&str, &str), commands: &[String]) -> Vec<String> {
    let owned = |names: Vec<&str>| names.into_iter().map(str::to_owned).collect();
    let solvers = || registry.entries().iter().filter(|entry| command != "plan" || entry.integrates());
    let formulations = || Formulation::ALL.map(Formulation::name).into_iter();
    match option {
        "coin" => owned(entries().map(|entry| entry.name).collect()),
        "space" => owned(named_spaces().map(|(name, _)| name).collect()),
        "solver" => owned(solvers().map(SolverEntry::name).collect()),
        "scheme" => owned(each_once(solvers().flat_map(SolverEntry::schemes)).into_iter().map(Scheme::name).collect()),
        "formulation" => owned(formulations().chain((command == "compare").then_some("all")).collect()),
        "across" | "up" => owned(Coordinate::ALL.map(Coordinate::name).to_vec()),
        "command" => commands.to_vec(),
        _ => Vec::new(),
    }
}

/// What completes arguments without an option in fish, which the generated script leaves out.
fn positions_in_fish(program: &Command) -> String {
    let lines = program.get_subcommands().filter_map(|command| {
        let values = command.get_positionals().next()?.get_possible_values();
        let names: Vec<&str> = values.iter().map(PossibleValue::get_name).collect();
        let using = format!("__fish_unfair_toss_using_subcommand {}", command.get_name());
        let line = format!("complete -c unfair-toss -n \"{using}\" -f -a \"{}\"\n", names.join(" "));
        (!names.is_empty()).then_some(line)
    });
    lines.collect()
}

impl ManArgs {
    pub(crate) fn run(&self, program: Command) -> Result<String, Failure> {
        // `unfair-toss help` says what `--help` says, and has no page.
        let mut program = program.disable_help_subcommand(true);
        // Gives each command its full name.
        program.build();
        let name = self.command.as_deref();
        let found = name.map_or(Some(&program), |name| program.find_subcommand(name)).ok_or_else(|| {
            let commands: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            let name = name.unwrap_or_default();
            Failure::usage("command", format!("command = '{name}' is unknown; known: {}", commands.join(", ")))
        })?;
        let mut text = Vec::new();
        page(found.clone(), &mut text).map_err(Failure::print)?;
        Ok(String::from_utf8_lossy(&text).into_owned())
    }
}

/// Writes the manual page of `command`.
fn page(command: Command, to: &mut Vec<u8>) -> std::io::Result<()> {
    let has_commands = command.has_subcommands();
    let (command, sections) = help::manual(command);
    let title = command.get_display_name().unwrap_or(command.get_name()).to_owned();
    let program = concat!("unfair-toss ", env!("CARGO_PKG_VERSION"));
    let man = Man::new(command).title(title).source(program);
    man.render_title(to)?;
    man.render_name_section(to)?;
    man.render_synopsis_section(to)?;
    man.render_description_section(to)?;
    man.render_options_section(to)?;
    if has_commands {
        man.render_subcommands_section(to)?;
    }
    for (heading, paragraphs) in sections {
        to.extend_from_slice(format!(".SH {heading}\n").as_bytes());
        for paragraph in paragraphs {
            to.extend_from_slice(format!(".PP\n{}\n", escaped(paragraph)).as_bytes());
        }
    }
    Ok(())
}

/// `text` in the language of manual pages, in which a backslash, a hyphen and an apostrophe stand for other signs.
fn escaped(text: &str) -> String {
    text.replace('\\', "\\e").replace('-', "\\-").replace('\'', "\\(aq")
}
