//! `unfair-toss completions` prints a script that completes the program's options in a shell, and `unfair-toss man` a
//! manual page. Both are made from the definition of the options, so that they are never out of date.

use clap::Command;
use clap_complete::Shell;

use crate::failure::Failure;

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
    pub(crate) fn run(&self, mut program: Command) -> String {
        let name = program.get_name().to_owned();
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, name, &mut script);
        String::from_utf8_lossy(&script).into_owned()
    }
}

impl ManArgs {
    pub(crate) fn run(&self, mut program: Command) -> Result<String, Failure> {
        // Gives each command its full name.
        program.build();
        let name = self.command.as_deref();
        let found = name.map_or(Some(&program), |name| program.find_subcommand(name)).ok_or_else(|| {
            let commands: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            let name = name.unwrap_or_default();
            Failure::usage("command", format!("command = '{name}' is unknown; known: {}", commands.join(", ")))
        })?;
        let mut page = Vec::new();
        let written = clap_mangen::Man::new(found.clone()).render(&mut page);
        written.map_err(Failure::Print)?;
        Ok(String::from_utf8_lossy(&page).into_owned())
    }
}
