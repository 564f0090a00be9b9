//! Everything `generate` writes for a wired design, as one set of files.

use sensedsl_diagnostics::codes::e0504_no_firmware_target;
use sensedsl_diagnostics::{Diagnostic, render};
use sensedsl_model::design::{Design, DeviceIndex};
use sensedsl_model::kind::Kind;
use sensedsl_report::{json, markdown, schema, svg};
use sensedsl_wiring::assignment::Assignment;

use crate::fileset::FileSet;
use crate::firmware::chibios;
use crate::host::{Host, HostBoard, HostPlan};

/// All files: the answer, the schema, the wiring sheet, the picture, firmware for each board and
/// the host applications `hosts`. `name` is what people call the design: what its file is called.
///
/// # Errors
/// Diagnostics for what no firmware can be generated for; then there are no files at all.
pub fn project(
    name: &str,
    design: &Design,
    assignment: &Assignment,
    hosts: &[&dyn Host],
) -> Result<FileSet, Vec<Diagnostic>> {
    if let Some(board) = design.boards.first()
        && assignment.used(design).next().is_none()
    {
        let name = &board.name.value;
        let report = e0504_no_firmware_target::no_firmware_target(
            board.name.span,
            name,
            "nothing is connected to it",
        );
        return Err(vec![report.help("declare a sensor or an actuator, then generate")]);
    }
    let firmware = chibios::plan(design, assignment)?;
    let mut files = FileSet::default();
    files.merge_under("firmware", chibios::render(&firmware));
    files.add("assignment.json", render::json_text(&json::wired(design, assignment)));
    files.add("schema.json", render::json_text(&schema::schema(design, assignment)));
    files.add("wiring.md", markdown::markdown(design, assignment));
    files.add("pinout.svg", svg::svg(design, assignment));
    let plan = host_plan(name, design, assignment);
    for host in hosts {
        files.merge_under(&format!("host/{}", host.name()), host.render(&plan));
    }
    Ok(files)
}

fn host_plan(name: &str, design: &Design, assignment: &Assignment) -> HostPlan {
    let boards: Vec<HostBoard> = assignment
        .used(design)
        .map(|(on, board)| {
            let devices: Vec<DeviceIndex> = on.devices.iter().map(|wiring| wiring.device).collect();
            let shown = devices.iter().filter_map(|index| design.device(*index));
            let paced = shown.clone().filter(|device| !matches!(device.kind, Kind::Icu(_)));
            HostBoard {
                name: board.name.value.clone(),
                schema: design.schema(on.board, &devices),
                baud: board.link.baud,
                presentations: shown.map(|one| (one.id.value, one.shown.clone())).collect(),
                cycles_ms: paced.map(|one| (one.id.value, one.delay_ms)).collect(),
            }
        })
        .collect();
    HostPlan::new(name, &boards)
}
