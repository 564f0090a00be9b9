//! Host `opendavinci2014`: the same for the OpenDaVINCI of the paper's time, in C++98.

use askama::Template;

use super::cpp_view::{BoardView, DATA_TYPE_BASE_2014, DesignView, MessageView, SchemaHeader};
use super::plan::HostPlan;
use super::{Host, runtime};
use crate::fileset::FileSet;
use crate::print::print;

/// See the module.
pub(super) struct OpenDavinci2014;

#[derive(Template)]
#[template(path = "host/opendavinci2014/messages.h.txt", escape = "none")]
struct Messages<'a> {
    design: &'a str,
    data_type_base: u32,
    messages: &'a [&'a MessageView],
}

#[derive(Template)]
#[template(path = "host/opendavinci2014/board.cpp.txt", escape = "none")]
struct Application<'a> {
    board: &'a BoardView,
}

#[derive(Template)]
#[template(path = "host/opendavinci2014/print.cpp.txt", escape = "none")]
struct Printer<'a> {
    design: &'a str,
    messages: &'a [&'a MessageView],
}

#[derive(Template)]
#[template(path = "host/opendavinci2014/CMakeLists.txt.txt", escape = "none")]
struct CMakeLists<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

#[derive(Template)]
#[template(path = "host/opendavinci2014/README.md.txt", escape = "none")]
struct Readme<'a> {
    design: &'a str,
    boards: &'a [BoardView],
}

impl Host for OpenDavinci2014 {
    fn name(&self) -> &'static str {
        "opendavinci2014"
    }

    fn summary(&self) -> &'static str {
        "OpenDaVINCI application in the API of 2014 (C++98)"
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
            print(&Messages {
                design: &design.ident,
                data_type_base: DATA_TYPE_BASE_2014,
                messages: &messages,
            }),
        );
        files.add("src/print.cpp", print(&Printer { design: &design.ident, messages: &messages }));
        files.add(
            "CMakeLists.txt",
            print(&CMakeLists { design: &design.ident, boards: &design.boards }),
        );
        files.add("README.md", print(&Readme { design: &design.ident, boards: &design.boards }));
        files
    }
}
