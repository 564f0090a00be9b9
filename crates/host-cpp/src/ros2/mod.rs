//! Host `ros2`: a package of ROS 2 with a node for each board, which publishes what its sensors say and takes what its
//! actuators are to be set to.
//!
//! `kinds.rs` decides which message carries which device, `view.rs` puts that beside the view of all C++ hosts.

mod kinds;
mod view;

use super::runtime;
use super::shared;
use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};
use view::{NodeView, PackageView};

use super::plain::board_header;

/// The host `ros2`.
pub struct Ros2;

templates! {
    node: NodeView;
    Node = "ros2/node.cpp.txt";
}

templates! {
    package: PackageView;
    CMakeLists = "ros2/CMakeLists.txt.txt";
    Manifest = "ros2/package.xml.txt";
    Launch = "ros2/launch.py.txt";
    Readme = "ros2/README.md.txt";
}

impl Host for Ros2 {
    fn name(&self) -> &'static str {
        "ros2"
    }

    fn about(&self) -> About {
        About {
            language: "C++17",
            needs: "ROS 2, from Humble on",
            gives: "a package: a node that publishes `sensor_msgs`, takes commands, tells diagnostics",
        }
    }

    fn compile(&self) -> Compile {
        Compile::cpp("-std=c++17", Some("ROS2"))
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let package = &PackageView::new(plan);
        let mut files = shared(&package.design);
        for (path, text) in runtime::BOARD {
            files.add(path, text);
        }
        let (path, text) = runtime::ROS2;
        files.add(path, text);
        for (board, node) in package.design.boards.iter().zip(&package.nodes) {
            let header = format!("include/sense/{}/{}.hpp", package.design.ident, board.ident);
            files.add(header, board_header(board));
            files.add(format!("src/{}.cpp", board.ident), print(&Node { node }));
        }
        files.add("CMakeLists.txt", print(&CMakeLists { package }));
        files.add("package.xml", print(&Manifest { package }));
        files.add(format!("launch/{}.launch.py", package.name), print(&Launch { package }));
        files.add("README.md", print(&Readme { package }));
        files
    }
}
