//! Everything that `generate` writes for a wired design, as one set of files.

use sensedsl_diagnostics::codes::e0504_no_firmware_target;
use sensedsl_diagnostics::{Diagnostic, render};
use sensedsl_model::design::{Design, DeviceIndex};
use sensedsl_report::{json, schema, sheet, svg};
use sensedsl_wiring::assignment::Assignment;

use sensedsl_files::FileSet;
use sensedsl_job::host::{Host, HostBoard, HostPlan};

use crate::host::HOSTS;
use crate::target;

/// The things to generate besides the answer, the schema, the wiring sheet and the picture.
#[derive(Clone, Copy)]
pub struct Selection<'a> {
    /// Firmware for each board.
    pub firmware: bool,
    /// The host applications.
    pub hosts: &'a [&'a dyn Host],
}

impl Selection<'static> {
    /// Everything.
    pub const ALL: Self = Self { firmware: true, hosts: HOSTS };
}

/// The generated files, and the reasons why the rest was not generated.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    /// All files that could be generated. Firmware is included for all boards or for none.
    pub files: FileSet,
    /// Why there is no firmware although it was wanted, or why there are no files because nothing is connected.
    pub gaps: Vec<Diagnostic>,
}

/// All files of a design. `name` is the design's name for people, taken from the name of its file.
#[must_use]
pub fn project(
    name: &str,
    design: &Design,
    assignment: &Assignment,
    wanted: &Selection<'_>,
) -> Project {
    let mut files = FileSet::default();
    if let Some(gap) = nothing_connected(design, assignment) {
        return Project { files, gaps: vec![gap] };
    }
    let mut gaps = Vec::new();
    if wanted.firmware {
        match target::firmware(design, assignment) {
            Ok(firmware) => files.merge_under("firmware", firmware),
            Err(why) => gaps = why,
        }
    }
    files.add("assignment.json", render::json_text(&json::wired(design, assignment)));
    files.add("schema.json", render::json_text(&schema::schema(design, assignment)));
    files.add("wiring.md", sheet::markdown::markdown(design, assignment));
    files.add("wiring.html", sheet::html::html(design, assignment));
    files.add("pinout.svg", svg::svg(design, assignment));
    let plan = host_plan(name, design, assignment);
    for host in wanted.hosts {
        files.merge_under(&format!("host/{}", host.name()), host.render(&plan));
    }
    Project { files, gaps }
}

/// Hosts and firmware need at least one device.
fn nothing_connected(design: &Design, assignment: &Assignment) -> Option<Diagnostic> {
    let board = design.boards.first()?;
    if assignment.used(design).next().is_some() {
        return None;
    }
    let name = &board.name;
    let why = "nothing is connected to it";
    let report = e0504_no_firmware_target::no_firmware_target(name.span, &name.value, why);
    Some(report.help("declare a sensor or an actuator, then generate"))
}

fn host_plan(name: &str, design: &Design, assignment: &Assignment) -> HostPlan {
    let boards: Vec<HostBoard> = assignment
        .used(design)
        .map(|(on, board)| {
            let devices: Vec<DeviceIndex> = on.devices.iter().map(|wiring| wiring.device).collect();
            let shown = devices.iter().filter_map(|index| design.device(*index));
            let paced =
                shown.clone().filter_map(|one| Some((one.id.value, design.told_every_ms(one)?)));
            HostBoard {
                name: board.name.value.clone(),
                schema: design.schema(on.board, &devices),
                baud: board.link.baud,
                silence_ms: board.link.silence_ms,
                presentations: shown.map(|one| (one.id.value, one.shown.clone())).collect(),
                cycles_ms: paced.collect(),
            }
        })
        .collect();
    HostPlan::new(name, &boards)
}
