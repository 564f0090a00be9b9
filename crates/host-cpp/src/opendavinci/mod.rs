//! The OpenDaVINCI hosts: one application per board, and one that prints its Containers.
//!
//! `opendavinci` is for OpenDaVINCI 4, `opendavinci2014` for the version at the time of the paper, in C++98. What they
//! have in common word for word is printed once and included by both.

use super::view::{BoardView, DesignView};
use super::{odvd, shared};
use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};

/// The host for OpenDaVINCI 4.
pub struct OpenDavinci;

/// The host for the OpenDaVINCI of 2014.
pub struct OpenDavinci2014;

templates! {
    design: DesignView;
    Messages = "opendavinci/v4/messages.h.txt";
    Printer = "opendavinci/v4/print.cpp.txt";
    CMakeLists = "opendavinci/v4/CMakeLists.txt.txt";
    Readme = "opendavinci/v4/README.md.txt";
    Messages2014 = "opendavinci/v2014/messages.h.txt";
    Printer2014 = "opendavinci/v2014/print.cpp.txt";
    CMakeLists2014 = "opendavinci/v2014/CMakeLists.txt.txt";
    Readme2014 = "opendavinci/v2014/README.md.txt";
}

templates! {
    board: BoardView;
    Application = "opendavinci/v4/board.cpp.txt";
    Application2014 = "opendavinci/v2014/board.cpp.txt";
}

impl Host for OpenDavinci {
    fn name(&self) -> &'static str {
        "opendavinci"
    }

    fn about(&self) -> About {
        About {
            language: "C++11",
            needs: "OpenDaVINCI 4 (namespace `odcore`)",
            gives: "a time-triggered module that sends each value as a Container, and a printer",
        }
    }

    fn compile(&self) -> Compile {
        Compile::cpp("-std=c++11", Some("OPENDAVINCI"))
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = shared(design);
        for board in &design.boards {
            files.add(format!("src/{}.cpp", board.ident), print(&Application { board }));
        }
        files.add("include/messages.h", print(&Messages { design }));
        files.add("src/print.cpp", print(&Printer { design }));
        files.add("sense.odvd", odvd(design));
        files.add("CMakeLists.txt", print(&CMakeLists { design }));
        files.add("README.md", print(&Readme { design }));
        files
    }
}

impl Host for OpenDavinci2014 {
    fn name(&self) -> &'static str {
        "opendavinci2014"
    }

    fn about(&self) -> About {
        About {
            language: "C++98",
            needs: "OpenDaVINCI of 2014 (namespace `core`), the paper's",
            gives: "the same",
        }
    }

    fn compile(&self) -> Compile {
        Compile::cpp("-std=c++98", Some("OPENDAVINCI2014"))
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = shared(design);
        for board in &design.boards {
            files.add(format!("src/{}.cpp", board.ident), print(&Application2014 { board }));
        }
        files.add("include/messages.h", print(&Messages2014 { design }));
        files.add("src/print.cpp", print(&Printer2014 { design }));
        files.add("CMakeLists.txt", print(&CMakeLists2014 { design }));
        files.add("README.md", print(&Readme2014 { design }));
        files
    }
}
