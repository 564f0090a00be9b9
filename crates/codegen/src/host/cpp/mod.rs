//! The C++ hosts: what they share, and one folder each.
//!
//! In: a [`HostPlan`](super::HostPlan). Out: files. `names.rs` makes names of C++, `view.rs` says the plan
//! in C++ words, `runtime/` is hand-written and copied beside what is generated, `shared/` is
//! printed for several hosts.

/// Declares templates, each of which prints a design or one of its boards.
macro_rules! templates {
    ($($name:ident($field:ident: $view:ident) = $path:literal;)*) => {
        $(
            #[derive(askama::Template)]
            #[template(path = $path, escape = "none")]
            struct $name<'a> {
                $field: &'a $view,
            }
        )*
    };
}

mod libcluon;
mod names;
mod opendavinci;
mod plain;
mod runtime;
mod view;

pub(super) use libcluon::Libcluon;
pub(super) use opendavinci::{OpenDavinci, OpenDavinci2014};
pub(super) use plain::Plain;

use crate::fileset::FileSet;
use crate::print::print;
use view::{BoardView, DesignView};

templates! {
    SchemaHeader(board: BoardView) = "host/cpp/shared/schema.hpp.txt";
    Odvd(design: DesignView) = "host/cpp/shared/sense.odvd.txt";
}

/// What each of them has: the hand-written headers, and for each board its tables.
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
