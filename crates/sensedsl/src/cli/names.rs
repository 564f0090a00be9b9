//! Names in arguments: any text is taken, and shells complete the known ones.
//!
//! What is typed so far comes in; what goes out is the names that begin so. The code that looks a name up reports one
//! that does not exist, with the nearest one.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap_complete::engine::{
    ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter,
};
use sensedsl_board::{catalog, profile};
use sensedsl_diagnostics::codes;
use sensedsl_model::facts;

/// A name, with those that a script of completions lists.
#[derive(Clone)]
pub(super) struct Name(fn() -> Vec<&'static str>);

pub(super) const BOARD: Name = Name(boards);
pub(super) const TEMPLATE: Name = Name(crate::commands::template::names);
pub(super) const DRIVER: Name = Name(|| facts::names().collect());

fn boards() -> Vec<&'static str> {
    catalog::all().iter().map(|one| one.name).collect()
}

impl TypedValueParser for Name {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.0)().into_iter().map(PossibleValue::new)))
    }
}

/// MCU parts, once enough is typed that a person can read the list.
pub(super) fn parts() -> ArgValueCompleter {
    ArgValueCompleter::new(|typed: &OsStr| {
        let typed = typed.to_string_lossy().to_ascii_uppercase();
        begins(&typed, sensedsl_parts::all().map(|one| one.name()))
    })
}

/// Built-in boards and MCU parts.
pub(super) fn boards_and_parts() -> ArgValueCompleter {
    ArgValueCompleter::new(|typed: &OsStr| {
        let mut found = of_boards(typed);
        found.extend(parts().complete(typed));
        found
    })
}

/// Built-in boards, and files with tables.
pub(super) fn boards_and_tables() -> ArgValueCompleter {
    ArgValueCompleter::new(|typed: &OsStr| {
        let mut found = of_boards(typed);
        found.extend(PathCompleter::file().complete(typed));
        found
    })
}

/// The systems that a wiring can be for.
pub(super) fn targets() -> ArgValueCompleter {
    ArgValueCompleter::new(|typed: &OsStr| {
        begins(&typed.to_string_lossy(), profile::names().into_iter())
    })
}

/// What `explain` explains.
pub(super) fn subjects() -> ArgValueCompleter {
    ArgValueCompleter::new(|typed: &OsStr| {
        let words = ["wiring", "timing"].map(str::to_owned).into_iter();
        let mut found = begins(&typed.to_string_lossy(), words);
        let typed = typed.to_string_lossy().to_ascii_uppercase();
        found.extend(begins(&typed, codes::ALL.iter().map(|code| code.name().to_owned())));
        found
    })
}

fn of_boards(typed: &OsStr) -> Vec<CompletionCandidate> {
    begins(&typed.to_string_lossy(), boards().into_iter().map(str::to_owned))
}

fn begins(typed: &str, names: impl Iterator<Item = String>) -> Vec<CompletionCandidate> {
    names.filter(|name| name.starts_with(typed)).map(CompletionCandidate::new).collect()
}
