//! Printing: each file of a project is one template over its plan.

use askama::Template;

use super::plan::Plan;
use super::runtime;
use sensedsl_files::FileSet;
use sensedsl_files::print;

/// The user's file as it is made once.
const USER: &str = include_str!("templates/user.rs.txt");

/// Declares a template that prints a [`Plan`] under the name `b`.
macro_rules! templates {
    ($($name:ident = $path:literal;)*) => {
        $(
            #[derive(Template)]
            #[template(path = $path, escape = "none")]
            struct $name<'a> {
                b: &'a Plan,
            }
        )*
    };
}

templates! {
    Readme = "templates/README.md.txt";
    CargoConfig = "templates/config.toml.txt";
    Main = "templates/main.rs.txt";
    Wiring = "templates/wiring.rs.txt";
    Tables = "templates/tables.rs.txt";
}

/// Prints everything.
pub(super) fn render(b: &Plan) -> FileSet {
    let mut files = FileSet::default();
    files.add("README.md", print(&Readme { b }));
    files.add("Cargo.toml", b.manifest.clone());
    files.add("Cargo.lock", b.lock.clone());
    files.add(".cargo/config.toml", print(&CargoConfig { b }));
    files.add("src/main.rs", print(&Main { b }));
    files.add("src/wiring.rs", print(&Wiring { b }));
    files.add("src/tables.rs", print(&Tables { b }));
    files.add_once("src/user/mod.rs", USER);
    if let Some(memory) = b.begin.memory {
        files.add("memory.x", memory);
    }
    let always = runtime::always(b.hal);
    let own = runtime::adapters(b.hal);
    for (name, text) in own.filter(|(name, _)| always.contains(name) || b.runtime.contains(name)) {
        files.add(format!("src/rt/{name}"), *text);
    }
    files.add("src/rt/mod.rs", runtime::module(&b.runtime, always));
    files.add("sense-rt/Cargo.toml", b.runtime_manifest.clone());
    for (name, text) in runtime::RUNTIME {
        files.add(format!("sense-rt/src/{name}"), *text);
    }
    files
}
