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

pub use plan::{BoardPlan, DirectionPlan, HostBoard, HostPlan, MessagePlan, Presentation, Scaling};

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
    /// Tables and scalars, decoder, encoder.
    pub(super) const LINK: [(&str, &str); 3] = [
        (
            "include/sensedsl/wire.hpp",
            include_str!("../../../../runtime/host/cpp/sensedsl/wire.hpp"),
        ),
        (
            "include/sensedsl/decode.hpp",
            include_str!("../../../../runtime/host/cpp/sensedsl/decode.hpp"),
        ),
        (
            "include/sensedsl/link.hpp",
            include_str!("../../../../runtime/host/cpp/sensedsl/link.hpp"),
        ),
    ];
    /// Raw serial device.
    pub(super) const SERIAL: (&str, &str) = (
        "include/sensedsl/serial.hpp",
        include_str!("../../../../runtime/host/cpp/sensedsl/serial.hpp"),
    );
    /// Overloads for C++17.
    pub(super) const HANDLERS: (&str, &str) = (
        "include/sensedsl/handlers.hpp",
        include_str!("../../../../runtime/host/cpp/sensedsl/handlers.hpp"),
    );
    /// Scalars as text.
    pub(super) const TEXT: (&str, &str) = (
        "include/sensedsl/text.hpp",
        include_str!("../../../../runtime/host/cpp/sensedsl/text.hpp"),
    );
}
