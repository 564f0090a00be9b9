//! Host applications: the programs at the other end of the link.
//!
//! In: a [`HostPlan`]. Out: for each host a [`FileSet`] below `host/<name>/`. A language is a crate with its names, its
//! view of the plan, its templates and its hand-written runtime.

mod plan;

pub use plan::{
    BoardPlan, DevicePlan, DirectionPlan, HostBoard, HostPlan, Limits, MessagePlan, Scaling,
};

use sensedsl_files::FileSet;

/// One kind of host application.
pub trait Host: Sync {
    /// Its folder below `host/` and its name on the command line.
    fn name(&self) -> &'static str;
    /// What people read of it.
    fn about(&self) -> About;
    /// How a source that it prints is held to its language.
    fn compile(&self) -> Compile;
    /// All its files, relative to its folder.
    fn render(&self, plan: &HostPlan) -> FileSet;
}

/// A row of the page on hosts, `docs/hosts.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// Its language.
    pub language: &'static str,
    /// What it needs beside a compiler.
    pub needs: &'static str,
    /// What it gives.
    pub gives: &'static str,
}

/// The call that says whether a printed source is one of its language. It runs in the host's folder, and the
/// path of the source is its last argument. Nothing is linked or run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compile {
    /// The compiler.
    pub program: &'static str,
    /// What it is called with.
    pub arguments: &'static [&'static str],
    /// How the names of sources end.
    pub extension: &'static str,
    /// The standard, in the compiler's words; empty where there is none to choose.
    pub standard: &'static str,
    /// The variable that names the tree of the middleware, where the sources include one.
    pub tree: Option<&'static str>,
}

impl Compile {
    /// A source of C++ without a warning.
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
