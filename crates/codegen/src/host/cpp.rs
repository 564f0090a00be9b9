//! Host `cpp`: a header-only C++17 library and an example, no middleware.

use askama::Template;

use super::cpp_view::{BoardView, DesignView, SchemaHeader};
use super::plan::HostPlan;
use super::{Host, runtime};
use crate::fileset::FileSet;
use crate::print::print;

/// See the module.
pub(super) struct Cpp;

#[derive(Template)]
#[template(path = "host/cpp/board.hpp.txt", escape = "none")]
struct BoardHeader<'a> {
    board: &'a BoardView,
}

#[derive(Template)]
#[template(path = "host/cpp/monitor.cpp.txt", escape = "none")]
struct Monitor<'a> {
    board: &'a BoardView,
}

#[derive(Template)]
#[template(path = "host/cpp/CMakeLists.txt.txt", escape = "none")]
struct CMakeLists<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

#[derive(Template)]
#[template(path = "host/cpp/README.md.txt", escape = "none")]
struct Readme<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

impl Host for Cpp {
    fn name(&self) -> &'static str {
        "cpp"
    }

    fn summary(&self) -> &'static str {
        "C++17 headers and an example, no middleware"
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = DesignView::new(plan);
        let mut files = runtime::files();
        for (path, text) in runtime::BOARD {
            files.add(path, text);
        }
        for board in &design.boards {
            let (name, ident) = (&design.ident, &board.ident);
            files.add(
                format!("include/sense/{name}/{ident}_schema.hpp"),
                print(&SchemaHeader { board }),
            );
            files.add(format!("include/sense/{name}/{ident}.hpp"), print(&BoardHeader { board }));
            files.add(format!("src/monitor_{ident}.cpp"), print(&Monitor { board }));
        }
        files.add(
            "CMakeLists.txt",
            print(&CMakeLists { design: &design.ident, boards: &design.boards }),
        );
        files.add("README.md", print(&Readme { design: &design.ident, boards: &design.boards }));
        files
    }
}
