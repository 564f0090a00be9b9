//! Host `libcluon`: one OD4 microservice a board, and the messages of all boards in one file.

use askama::Template;

use super::cpp_view::{BoardView, DesignView, OdvdFile, SchemaHeader};
use super::plan::HostPlan;
use super::{Host, runtime};
use crate::fileset::FileSet;
use crate::print::print;

/// See the module.
pub(super) struct Libcluon;

#[derive(Template)]
#[template(path = "host/libcluon/service.cpp.txt", escape = "none")]
struct Service<'a> {
    board: &'a BoardView,
}

#[derive(Template)]
#[template(path = "host/libcluon/CMakeLists.txt.txt", escape = "none")]
struct CMakeLists<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

#[derive(Template)]
#[template(path = "host/libcluon/README.md.txt", escape = "none")]
struct Readme<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

impl Host for Libcluon {
    fn name(&self) -> &'static str {
        "libcluon"
    }

    fn summary(&self) -> &'static str {
        "OD4 microservice for libcluon (C++14) and its .odvd messages"
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = DesignView::new(plan);
        let mut files = runtime::files();
        for board in &design.boards {
            let (name, ident) = (&design.ident, &board.ident);
            files.add(
                format!("include/sense/{name}/{ident}_schema.hpp"),
                print(&SchemaHeader { board }),
            );
            files.add(format!("src/{ident}.cpp"), print(&Service { board }));
        }
        files.add("sense.odvd", print(&OdvdFile::new(&design)));
        files.add(
            "CMakeLists.txt",
            print(&CMakeLists { design: &design.ident, boards: &design.boards }),
        );
        files.add("README.md", print(&Readme { design: &design.ident, boards: &design.boards }));
        files
    }
}
