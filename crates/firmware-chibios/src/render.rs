//! Printing: each file of a board is one template over its plan.

use super::peripherals::PERIPHERALS;
use super::plan::BoardPlan;
use super::runtime;
use sensedsl_files::{FileSet, print, templates};
use sensedsl_firmware_c as c;

/// The user's file, as it is first written.
const USER: &str = include_str!("templates/user.c.txt");

templates! {
    b: BoardPlan;
    Makefile = "templates/Makefile.txt";
    Readme = "templates/README.md.txt";
    Chconf = "templates/chconf.h.txt";
    Halconf = "templates/halconf.h.txt";
    Mcuconf = "templates/mcuconf.h.txt";
    UpConf = "templates/up_conf.h.txt";
    Hardware = "templates/sense_hw.c.txt";
}

/// Prints everything.
pub(super) fn render(b: &BoardPlan) -> FileSet {
    let mut files = FileSet::default();
    files.add("Makefile", print(&Makefile { b }));
    files.add("README.md", print(&Readme { b }));
    files.add("cfg/chconf.h", print(&Chconf { b }));
    files.add("cfg/halconf.h", print(&Halconf { b }));
    files.add("cfg/mcuconf.h", print(&Mcuconf { b }));
    files.add("cfg/up_conf.h", print(&UpConf { b }));
    files.merge_under("generated", c::render(&b.name, &b.schema));
    files.add("generated/sense_hw.c", print(&Hardware { b }));
    files.add_once("user/user.c", USER);
    let plans = b.controllers.plans();
    files.merge_under(
        "generated",
        sensedsl_code::headers(&b.name, &plans, &sensedsl_code::GENERATED),
    );
    files.merge_under("user", sensedsl_code::first_c(&b.name, &plans, &sensedsl_code::GENERATED));
    let core = PERIPHERALS.iter().flat_map(|peripheral| peripheral.core.iter().copied().flatten());
    let drivers = PERIPHERALS.iter().flat_map(|peripheral| peripheral.runtime);
    let always = c::runtime::BASE.iter().chain(runtime::FILES);
    for (path, text) in always.chain(core).chain(drivers) {
        files.add(format!("uproxy/{path}"), *text);
    }
    files
}
