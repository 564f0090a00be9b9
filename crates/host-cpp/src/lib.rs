//! The C++ hosts: a common part, and one folder each.
//!
//! In: a [`HostPlan`](sensedsl_job::host::HostPlan). Out: files. `names.rs` makes C++ names, `view.rs` puts the plan in
//! C++ terms, `runtime/` is hand-written and copied beside the generated files, `shared/` is printed for several hosts.
//!
//! # Example
//!
//! ```
//! use std::collections::BTreeMap;
//!
//! use sensedsl_host_cpp::Plain;
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
//! let files = Plain.render(&HostPlan::new("garden", &[rover]));
//! let header = files.get("include/sense/garden/Rover.hpp").unwrap();
//! assert!(str::from_utf8(&header.bytes).unwrap().contains("struct Light {"));
//! ```

mod libcluon;
mod names;
mod opendavinci;
mod plain;
mod ros2;
mod runtime;
mod view;

pub use libcluon::Libcluon;
pub use opendavinci::{OpenDavinci, OpenDavinci2014};
pub use plain::Plain;
pub use ros2::Ros2;

use sensedsl_files::{FileSet, print, templates};
use view::{BoardView, DesignView};

templates! {
    board: BoardView;
    SchemaHeader = "shared/schema.hpp.txt";
}

templates! {
    design: DesignView;
    Odvd = "shared/sense.odvd.txt";
}

/// The files that each of them has: the hand-written headers, and the tables of each board.
fn shared(design: &DesignView) -> FileSet {
    let mut files = runtime::files();
    for board in &design.boards {
        let path = format!("include/sense/{}/{}_schema.hpp", design.ident, board.ident);
        files.add(path, print(&SchemaHeader { board }));
    }
    files
}

/// The messages of all boards for OpenDaVINCI's and libcluon's tools.
fn odvd(design: &DesignView) -> String {
    print(&Odvd { design })
}
