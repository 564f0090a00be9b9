//! The host in C: for a second microcontroller, without memory to allocate and without an operating system.
//!
//! In: a [`HostPlan`]. Out: files. `names.rs` makes C names, `view.rs` puts the plan in C's words, `runtime/` is
//! hand-written and copied.
//!
//! # Example
//!
//! ```
//! use std::collections::BTreeMap;
//!
//! use sensedsl_host_c::C;
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
//! let files = C.render(&HostPlan::new("garden", &[rover]));
//! let header = files.get("garden_Rover.h").unwrap();
//! assert!(str::from_utf8(&header.bytes).unwrap().contains("(*on_Light)(void *context, uint16_t raw);"));
//! ```

mod names;
mod view;

use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};
use view::{BoardView, DesignView};

/// The host `c`.
pub struct C;

templates! {
    board: BoardView;
    Header = "board.h.txt";
    Source = "board.c.txt";
    Monitor = "monitor.c.txt";
}

templates! {
    design: DesignView;
    Readme = "README.md.txt";
}

/// The hand-written part.
const HEADER: &str = include_str!("../runtime/sensedsl.h");
const SOURCE: &str = concat!(
    include_str!("../runtime/decode.c"),
    "\n",
    include_str!("../runtime/values.c"),
    "\n",
    include_str!("../runtime/link.c"),
);

impl Host for C {
    fn name(&self) -> &'static str {
        "c"
    }

    fn about(&self) -> About {
        About {
            language: "C99",
            needs: "nothing",
            gives: "a handler for each message, for a second microcontroller: no allocation, no operating system",
        }
    }

    fn compile(&self) -> Compile {
        const ARGUMENTS: &[&str] = &[
            "-Wall",
            "-Wextra",
            "-Wconversion",
            "-Wshadow",
            "-Werror",
            "-pedantic",
            "-fsyntax-only",
        ];
        Compile {
            program: "gcc",
            arguments: ARGUMENTS,
            extension: "c",
            standard: "-std=c99",
            tree: None,
        }
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = FileSet::default();
        files.add("README.md", print(&Readme { design }));
        files.add("sensedsl.h", HEADER);
        files.add("sensedsl.c", SOURCE);
        for board in &design.boards {
            files.add(format!("{}.h", board.own), print(&Header { board }));
            files.add(format!("{}.c", board.own), print(&Source { board }));
            files.add(format!("monitor_{}.c", board.own), print(&Monitor { board }));
        }
        files
    }
}
