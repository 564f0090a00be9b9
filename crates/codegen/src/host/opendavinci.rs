//! Host `opendavinci`: one application a board for OpenDaVINCI 4, and one that prints its Containers.

use askama::Template;

use super::cpp_view::{BoardView, DesignView, MessageView, OdvdFile, SchemaHeader};
use super::plan::HostPlan;
use super::{Host, runtime};
use crate::fileset::FileSet;
use crate::print::print;

/// See the module.
pub(super) struct OpenDavinci;

#[derive(Template)]
#[template(path = "host/opendavinci/messages.h.txt", escape = "none")]
struct Messages<'a> {
    design: &'a str,
    messages: &'a [&'a MessageView],
}

#[derive(Template)]
#[template(path = "host/opendavinci/board.cpp.txt", escape = "none")]
struct Application<'a> {
    board: &'a BoardView,
}

#[derive(Template)]
#[template(path = "host/opendavinci/print.cpp.txt", escape = "none")]
struct Printer<'a> {
    design: &'a str,
    messages: &'a [&'a MessageView],
}

#[derive(Template)]
#[template(path = "host/opendavinci/CMakeLists.txt.txt", escape = "none")]
struct CMakeLists<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

#[derive(Template)]
#[template(path = "host/opendavinci/README.md.txt", escape = "none")]
struct Readme<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

impl Host for OpenDavinci {
    fn name(&self) -> &'static str {
        "opendavinci"
    }

    fn summary(&self) -> &'static str {
        "OpenDaVINCI 4 application (C++11)"
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = DesignView::new(plan);
        let messages: Vec<_> = design.messages().collect();
        let mut files = runtime::files();
        for board in &design.boards {
            let (name, ident) = (&design.ident, &board.ident);
            files.add(
                format!("include/sense/{name}/{ident}_schema.hpp"),
                print(&SchemaHeader { board }),
            );
            files.add(format!("src/{ident}.cpp"), print(&Application { board }));
        }
        files.add(
            "include/messages.h",
            print(&Messages { design: &design.ident, messages: &messages }),
        );
        files.add("src/print.cpp", print(&Printer { design: &design.ident, messages: &messages }));
        files.add("sense.odvd", print(&OdvdFile::new(&design)));
        files.add(
            "CMakeLists.txt",
            print(&CMakeLists { design: &design.ident, boards: &design.boards }),
        );
        files.add("README.md", print(&Readme { design: &design.ident, boards: &design.boards }));
        files
    }
}
