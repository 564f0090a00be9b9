//! Host applications: the programs at the other end of the link.
//!
//! In: a [`HostPlan`]. Out: for each host a [`FileSet`] below `host/<name>/`. A new host is one file
//! here, its templates, and one line in [`HOSTS`]; what it needs that is the same in each run
//! (decoders, serial devices) is hand-written in `runtime/host` and copied beside what is generated.

mod cpp;
mod cpp_names;
mod cpp_view;
mod libcluon;
mod opendavinci;
mod opendavinci2014;
mod plan;

pub use plan::{BoardPlan, DirectionPlan, HostBoard, HostPlan, Limits, MessagePlan, Scaling};

use crate::fileset::FileSet;

/// One kind of host application.
pub trait Host: Sync {
    /// Its folder below `host/` and its name on the command line.
    fn name(&self) -> &'static str;
    /// One line for people.
    fn summary(&self) -> &'static str;
    /// All its files, relative to its folder.
    fn render(&self, plan: &HostPlan) -> FileSet;
}

/// Every host there is, in the order in which people read of them.
pub const HOSTS: [&dyn Host; 4] =
    [&opendavinci::OpenDavinci, &opendavinci2014::OpenDavinci2014, &libcluon::Libcluon, &cpp::Cpp];

/// The host of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static dyn Host> {
    HOSTS.into_iter().find(|host| host.name() == name)
}

/// The hand-written files that C++ hosts share.
mod runtime {
    use crate::fileset::FileSet;

    /// A file of `runtime/host/cpp` and where a host has it.
    macro_rules! shared {
        ($name:literal) => {
            (
                concat!("include/sensedsl/", $name),
                include_str!(concat!("../../../../runtime/host/cpp/sensedsl/", $name)),
            )
        };
    }

    /// From C++98 on: what every host is made of.
    const EVERY_HOST: [(&str, &str); 13] = [
        shared!("cause.hpp"),
        shared!("connection.hpp"),
        shared!("decode.hpp"),
        shared!("difference.hpp"),
        shared!("link.hpp"),
        shared!("memo.hpp"),
        shared!("options.hpp"),
        shared!("serial.hpp"),
        shared!("session.hpp"),
        shared!("text.hpp"),
        shared!("thread.hpp"),
        shared!("usb.hpp"),
        shared!("wire.hpp"),
    ];
    /// For C++17.
    pub(super) const BOARD: [(&str, &str); 2] = [shared!("board.hpp"), shared!("handlers.hpp")];

    /// All that a host of any C++ includes.
    pub(super) fn files() -> FileSet {
        let mut files = FileSet::default();
        for (path, text) in EVERY_HOST {
            files.add(path, text);
        }
        files
    }
}
