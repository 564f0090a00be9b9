//! Host `cpp`: a header-only C++17 library and an example, without middleware.

use super::runtime;
use super::shared;
use super::view::{BoardView, DesignView};
use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};

/// The host `cpp`.
pub struct Plain;

templates! {
    board: BoardView;
    BoardHeader = "plain/board.hpp.txt";
    Monitor = "plain/monitor.cpp.txt";
}

templates! {
    design: DesignView;
    CMakeLists = "plain/CMakeLists.txt.txt";
    Readme = "plain/README.md.txt";
}

/// The header of a board, as programs include it.
pub(super) fn board_header(board: &BoardView) -> String {
    print(&BoardHeader { board })
}

impl Host for Plain {
    fn name(&self) -> &'static str {
        "cpp"
    }

    fn about(&self) -> About {
        About {
            language: "C++17",
            needs: "nothing",
            gives: "headers, and a monitor that prints values",
        }
    }

    fn compile(&self) -> Compile {
        Compile::cpp("-std=c++17", None)
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = shared(design);
        for (path, text) in runtime::BOARD {
            files.add(path, text);
        }
        for board in &design.boards {
            let ident = &board.ident;
            let header = format!("include/sense/{}/{ident}.hpp", design.ident);
            files.add(header, board_header(board));
            files.add(format!("src/monitor_{ident}.cpp"), print(&Monitor { board }));
        }
        files.add("CMakeLists.txt", print(&CMakeLists { design }));
        files.add("README.md", print(&Readme { design }));
        files
    }
}
