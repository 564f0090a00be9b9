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
    boards: &'a [BoardView],
}

#[derive(Template)]
#[template(path = "host/cpp/README.md.txt", escape = "none")]
struct Readme<'a> {
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
        let mut files = FileSet::default();
        for (path, text) in
            runtime::LINK.into_iter().chain([runtime::SERIAL, runtime::TEXT, runtime::HANDLERS])
        {
            files.add(path, text);
        }
        for board in &design.boards {
            let ident = &board.ident;
            files.add(format!("include/sense/{ident}_schema.hpp"), print(&SchemaHeader { board }));
            files.add(format!("include/sense/{ident}.hpp"), print(&BoardHeader { board }));
            files.add(format!("src/monitor_{ident}.cpp"), print(&Monitor { board }));
        }
        files.add("CMakeLists.txt", print(&CMakeLists { boards: &design.boards }));
        files.add("README.md", print(&Readme { boards: &design.boards }));
        files
    }
}
