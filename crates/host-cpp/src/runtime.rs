//! The hand-written files that C++ hosts share, copied beside the generated files.

use sensedsl_files::FileSet;

/// A file of `runtime/` and its path in a host.
macro_rules! shared {
    ($name:literal) => {
        (concat!("include/sensedsl/", $name), include_str!(concat!("../runtime/sensedsl/", $name)))
    };
}

/// The files of every host, in C++98.
const EVERY_HOST: [(&str, &str); 17] = [
    shared!("cause.hpp"),
    shared!("clock.hpp"),
    shared!("command.hpp"),
    shared!("connection.hpp"),
    shared!("decode.hpp"),
    shared!("difference.hpp"),
    shared!("health.hpp"),
    shared!("link.hpp"),
    shared!("memo.hpp"),
    shared!("options.hpp"),
    shared!("scaling.hpp"),
    shared!("serial.hpp"),
    shared!("session.hpp"),
    shared!("text.hpp"),
    shared!("thread.hpp"),
    shared!("usb.hpp"),
    shared!("wire.hpp"),
];

/// The additional files for C++17.
pub(super) const BOARD: [(&str, &str); 3] =
    [shared!("board.hpp"), shared!("handlers.hpp"), shared!("typed.hpp")];

/// The additional file for nodes of ROS 2.
pub(super) const ROS2: (&str, &str) = shared!("ros2.hpp");

/// The files of every host.
pub(super) fn files() -> FileSet {
    let mut files = FileSet::default();
    for (path, text) in EVERY_HOST {
        files.add(path, text);
    }
    files
}
