//! Make and the compiler: whether they are installed, and new enough.

use sensedsl_diagnostics::codes::{e0516_tool_missing, e0517_compiler_too_old};
use sensedsl_diagnostics::{Diagnostic, Span};

use super::asked;

const COMPILER: &str = "arm-none-eabi-gcc";
const OBJCOPY: &str = "arm-none-eabi-objcopy";
/// The first version that never gives an instruction of a Cortex-M0 a register that it cannot use.
const VERSION_MIN: u32 = 9;

/// GNU make as it is called here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Make(pub(crate) &'static str);

/// GNU make, if it is installed.
pub(crate) fn gnu_make() -> Option<Make> {
    let is_gnu = |name: &&&str| {
        asked(name, &["--version"]).is_some_and(|reported| reported.starts_with("GNU Make"))
    };
    ["make", "gmake"].iter().find(is_gnu).map(|name| Make(name))
}

/// Make, once everything that a build calls is known to be installed.
pub(crate) fn tools(at: Span) -> Result<Make, Box<Diagnostic>> {
    let Some(make) = gnu_make() else {
        return Err(e0516_tool_missing::tool_missing(at, "make", "GNU make runs the build").into());
    };
    let Some(version) = asked(COMPILER, &["-dumpversion"]) else {
        let what = "the compiler for the microcontroller";
        return Err(e0516_tool_missing::tool_missing(at, COMPILER, what).into());
    };
    let version = version.trim();
    let major = version.split('.').next().and_then(|major| major.parse::<u32>().ok());
    if major.is_some_and(|major| major < VERSION_MIN) {
        return Err(e0517_compiler_too_old::compiler_too_old(at, version, VERSION_MIN).into());
    }
    if asked(OBJCOPY, &["--version"]).is_none() {
        let what = "it makes the image that is flashed, and comes with the compiler";
        return Err(e0516_tool_missing::tool_missing(at, OBJCOPY, what).into());
    }
    // For a library that it does not have, the compiler repeats the bare name.
    let library = asked(COMPILER, &["-print-file-name=libc.a"]).unwrap_or_default();
    if !library.contains(['/', '\\']) {
        let what = "the C library of the compiler is not installed";
        return Err(e0516_tool_missing::tool_missing(at, "newlib", what).into());
    }
    Ok(make)
}
