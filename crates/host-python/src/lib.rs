//! The host in Python: a typed package with a class for each message and each board.
//!
//! In: a [`HostPlan`]. Out: files. `names.rs` makes Python names, `view.rs` puts the plan
//! in Python's words, `runtime/` is hand-written and copied into the package.
//!
//! # Example
//!
//! ```
//! use std::collections::BTreeMap;
//!
//! use sensedsl_host_python::Python;
//! use sensedsl_job::host::{Host as _, HostBoard, HostPlan};
//! use sensedsl_wire::{Direction, Item, ScalarType, Schema, ValueType};
//!
//! let light = Item {
//!     id: 17,
//!     name: "Light".to_owned(),
//!     direction: Direction::Sensor,
//!     value: ValueType::scalar(ScalarType::Uint16),
//! };
//! let rover = HostBoard {
//!     name: "Rover".to_owned(),
//!     schema: Schema { items: vec![light], ..Schema::default() },
//!     baud: 115_200,
//!     silence_ms: None,
//!     presentations: BTreeMap::new(),
//!     cycles_ms: BTreeMap::new(),
//! };
//! let files = Python.render(&HostPlan::new("garden", &[rover]));
//! let package = files.get("sense_garden/__init__.py").unwrap();
//! assert!(str::from_utf8(&package.bytes).unwrap().contains("class Light(Message):"));
//! ```

mod names;
mod view;

use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};
use view::DesignView;

/// The host `python`.
pub struct Python;

templates! {
    design: DesignView;
    Package = "package.py.txt";
    Main = "main.py.txt";
    Project = "pyproject.toml.txt";
    Readme = "README.md.txt";
}

/// A file of `runtime/`.
macro_rules! runtime {
    ($($name:literal,)+) => {
        [$(($name, include_str!(concat!("../runtime/sensedsl/", $name))),)+]
    };
}

/// The hand-written modules.
const RUNTIME: [(&str, &str); 6] =
    runtime!["__init__.py", "board.py", "link.py", "session.py", "values.py", "wire.py",];

impl Host for Python {
    fn name(&self) -> &'static str {
        "python"
    }

    fn about(&self) -> About {
        About {
            language: "Python 3.9",
            needs: "pyserial",
            gives: "a typed package: messages as dataclasses, blocking, with callbacks or with asyncio",
        }
    }

    fn compile(&self) -> Compile {
        Compile {
            program: "python3",
            arguments: &["-c", "import ast, sys; ast.parse(open(sys.argv[1]).read(), sys.argv[1])"],
            extension: "py",
            standard: "",
            tree: None,
        }
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = FileSet::default();
        let package = &design.package;
        for (name, text) in RUNTIME {
            files.add(format!("{package}/_sensedsl/{name}"), text);
        }
        files.add(format!("{package}/__init__.py"), print(&Package { design }));
        files.add(format!("{package}/__main__.py"), print(&Main { design }));
        files.add(format!("{package}/py.typed"), "");
        files.add("pyproject.toml", print(&Project { design }));
        files.add("README.md", print(&Readme { design }));
        files
    }
}
