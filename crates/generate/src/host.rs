//! The host applications that are generated: a host is a line of [`HOSTS`].

use sensedsl_host_cpp as cpp;
use sensedsl_job::host::Host;

/// Every host there is, in the order in which people read of them.
pub const HOSTS: &[&dyn Host] = &[
    &cpp::OpenDavinci, //
    &cpp::OpenDavinci2014,
    &cpp::Libcluon,
    &cpp::Plain,
];

/// The host of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static dyn Host> {
    HOSTS.iter().copied().find(|host| host.name() == name)
}
