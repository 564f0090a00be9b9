//! Printing: each file of a sketch is one template over its plan.

use sensedsl_code::Headers;
use sensedsl_files::{FileSet, print, templates};
use sensedsl_firmware_c as c;

use crate::plan::SketchPlan;
use crate::runtime;

/// The framework compiles the user's folder without the one above it in its path.
const HEADERS: Headers = Headers { path: "../", folder: "src", user: "src/user" };

/// The user's file, as it is first written.
const USER: &str = include_str!("templates/user.c.txt");

templates! {
    b: SketchPlan;
    Sketch = "templates/sketch.ino.txt";
    Readme = "templates/README.md.txt";
    Makefile = "templates/Makefile.txt";
    PlatformIo = "templates/platformio.ini.txt";
    Library = "templates/library.properties.txt";
    Conf = "templates/sense_conf.h.txt";
    Hardware = "templates/sense_hw.c.txt";
    Ports = "templates/sense_ports.cpp.txt";
}

/// Prints everything.
pub(crate) fn render(b: &SketchPlan) -> FileSet {
    let mut files = FileSet::default();
    files.add(format!("{}.ino", b.name), print(&Sketch { b }));
    files.add("Makefile", print(&Makefile { b }));
    files.add("README.md", print(&Readme { b }));
    files.add("platformio.ini", print(&PlatformIo { b }));
    files.add("library.properties", print(&Library { b }));
    files.merge_under("src", c::render(&b.name, &b.schema));
    files.add("src/sense_conf.h", print(&Conf { b }));
    files.add("src/sense_hw.c", print(&Hardware { b }));
    files.add("src/sense_ports.cpp", print(&Ports { b }));
    files.add_once("src/user/user.c", USER);
    let plans = b.controllers.plans();
    files.merge_under("src", sensedsl_code::headers(&b.name, &plans, &HEADERS));
    files.merge_under("src/user", sensedsl_code::first_c(&b.name, &plans, &HEADERS));
    let core = c::runtime::BASE.iter().chain(&b.files);
    for (path, text) in runtime::FILES.iter().chain(core) {
        let name = path.strip_prefix("core/").unwrap_or(path);
        files.add(format!("src/{name}"), *text);
    }
    files
}
