//! Printing. In: a plan. Out: the files of a project, each one template over the plan.

use super::cargo::Manifests;
use super::item::{Constant, Entry, Item};
use super::plan::Plan;
use sensedsl_files::{FileSet, print, templates};

/// The user's file as it is first made.
const USER: &str = include_str!("templates/user.rs.txt");

templates! {
    b: Plan;
    Readme = "templates/README.md.txt";
    CargoConfig = "templates/config.toml.txt";
    Main = "templates/main.rs.txt";
    Wiring = "templates/wiring.rs.txt";
    Tables = "templates/tables.rs.txt";
}

templates! {
    m: Manifests;
    Firmware = "templates/Cargo.toml.txt";
    Adapters = "templates/sense-embassy.toml.txt";
    Runtime = "templates/sense-rt.toml.txt";
}

/// Prints all files.
pub(super) fn render(b: &Plan) -> FileSet {
    let mut files = FileSet::default();
    files.add("README.md", print(&Readme { b }));
    let m = &b.manifests;
    files.add("Cargo.toml", print(&Firmware { m }));
    files.add("Cargo.lock", b.lock.clone());
    files.add(".cargo/config.toml", print(&CargoConfig { b }));
    files.add("src/main.rs", print(&Main { b }));
    files.add("src/wiring.rs", print(&Wiring { b }));
    files.add("src/tables.rs", print(&Tables { b }));
    files.add_once("src/user/mod.rs", USER);
    files.merge_under("src/controls", sensedsl_code::modules(&b.board, &b.controllers));
    files.merge_under("src/user", sensedsl_code::first_rust(&b.board, &b.controllers));
    if let Some(memory) = &b.begin.memory {
        files.add("memory.x", memory.clone());
    }
    files.add("sense-embassy/Cargo.toml", print(&Adapters { m }));
    for (name, text) in sense_embassy::sources::SOURCES {
        files.add(format!("sense-embassy/src/{name}"), *text);
    }
    files.add("sense-rt/Cargo.toml", print(&Runtime { m }));
    for (name, text) in sense_rt::sources::SOURCES {
        files.add(format!("sense-rt/src/{name}"), *text);
    }
    files
}
