//! Host applications: the programs at the other end of the link.
//!
//! In: a [`HostPlan`]. Out: for each host a [`FileSet`] below `host/<name>/`. Each language has its own crate with its
//! names, its view of the plan, its templates and its hand-written runtime.

mod names;
mod plan;

pub use names::{Names, identifier};
pub use plan::{
    BoardPlan, DevicePlan, DirectionPlan, HostBoard, HostPlan, Limits, MessagePlan, Scaling,
};

use sensedsl_files::FileSet;

/// A kind of host application.
pub trait Host: Sync {
    /// The folder below `host/`, and the name on the command line.
    fn name(&self) -> &'static str;
    /// The host's description for people.
    fn about(&self) -> About;
    /// The compiler call that checks a generated source.
    fn compile(&self) -> Compile;
    /// All the host's files, relative to its folder.
    fn render(&self, plan: &HostPlan) -> FileSet;
}

/// A row of the page on hosts, `docs/hosts.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// The language.
    pub language: &'static str,
    /// The host's requirements besides a compiler.
    pub needs: &'static str,
    /// The features that it provides.
    pub gives: &'static str,
}

/// The compiler call that checks a generated source. It runs in the host's folder, with the path of the source as its
/// last argument. Nothing is linked or run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compile {
    /// The compiler.
    pub program: &'static str,
    /// The arguments before the path.
    pub arguments: &'static [&'static str],
    /// The file name extension of the sources.
    pub extension: &'static str,
    /// The language standard, as the compiler spells it; empty if there is no choice.
    pub standard: &'static str,
    /// The environment variable for the middleware's source tree, if the sources include it.
    pub tree: Option<&'static str>,
}

impl Compile {
    /// A C++ source that must compile without warnings.
    #[must_use]
    pub const fn cpp(standard: &'static str, tree: Option<&'static str>) -> Self {
        const ARGUMENTS: &[&str] = &[
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Wconversion",
            "-Wshadow",
            "-Werror",
            "-fsyntax-only",
            "-Iinclude",
        ];
        Self { program: "g++", arguments: ARGUMENTS, extension: "cpp", standard, tree }
    }
}
