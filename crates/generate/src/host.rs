//! The host applications that can be generated: each is a line of [`HOSTS`].

use sensedsl_host_c::C;
use sensedsl_host_cpp as cpp;
use sensedsl_host_matlab::Matlab;
use sensedsl_host_python::Python;
use sensedsl_host_rust::Rust;
use sensedsl_job::host::Host;

/// All hosts, in the order in which they are documented.
pub const HOSTS: &[&dyn Host] = &[
    &cpp::OpenDavinci, //
    &cpp::OpenDavinci2014,
    &cpp::Libcluon,
    &cpp::Plain,
    &cpp::Ros2,
    &Python,
    &Rust,
    &C,
    &Matlab,
];

/// The host with this name.
#[must_use]
pub fn find(name: &str) -> Option<&'static dyn Host> {
    HOSTS.iter().copied().find(|host| host.name() == name)
}
