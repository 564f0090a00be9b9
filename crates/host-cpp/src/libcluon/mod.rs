//! Host `libcluon`: one OD4 microservice per board, and the messages of all boards in one file.

use super::view::{BoardView, DesignView};
use super::{odvd, shared};
use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};

/// The host `libcluon`.
pub struct Libcluon;

templates! {
    board: BoardView;
    Service = "libcluon/service.cpp.txt";
}

templates! {
    design: DesignView;
    CMakeLists = "libcluon/CMakeLists.txt.txt";
    Readme = "libcluon/README.md.txt";
}

impl Host for Libcluon {
    fn name(&self) -> &'static str {
        "libcluon"
    }

    fn about(&self) -> About {
        About {
            language: "C++14",
            needs: "`cluon-complete.hpp`",
            gives: "a microservice of an OD4 session, and the messages as `sense.odvd`",
        }
    }

    fn compile(&self) -> Compile {
        Compile::cpp("-std=c++14", Some("LIBCLUON"))
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = shared(design);
        for board in &design.boards {
            files.add(format!("src/{}.cpp", board.ident), print(&Service { board }));
        }
        files.add("sense.odvd", odvd(design));
        files.add("CMakeLists.txt", print(&CMakeLists { design }));
        files.add("README.md", print(&Readme { design }));
        files
    }
}
