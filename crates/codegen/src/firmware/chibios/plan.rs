//! All decisions about the firmware of all boards, ready to be printed.

use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0501_no_generator, e0504_no_firmware_target};
use sensedsl_model::design::{Board, Design};
use sensedsl_model::kind::KindName;
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};

use super::analog::{self, AnalogPlan};
use super::board::{self, TreePlan};
use super::context::{Context, PadPlan};
use super::guards::{self, GuardPlan};
use super::i2c::{self, I2cPlan};
use super::icu::{self, IcuPlan, PulsePlan};
use super::link::{self, ButtonPlan, LinkPlan};
use super::schema::SchemaPlan;
use super::settings::{self, SettingsPlan};
use super::tasks::{self, TaskPlan};

/// The kinds that code is made for.
const KINDS: [KindName; 3] = [KindName::Analog, KindName::I2c, KindName::Icu];

/// The versions of the drivers that the templates are written for.
const DRIVERS: [(&str, &str); 4] =
    [("ADC", "ADCv2"), ("I2C", "I2Cv1"), ("GPIO", "GPIOv2"), ("timer", "TIMv1")];

/// The firmware of a design.
#[derive(Clone, Debug)]
pub struct FirmwarePlan {
    pub(super) boards: Vec<BoardPlan>,
}

/// The firmware of one board.
#[derive(Clone, Debug)]
pub(super) struct BoardPlan {
    pub(super) name: String,
    pub(super) tree: TreePlan,
    pub(super) settings: SettingsPlan,
    pub(super) schema: SchemaPlan,
    pub(super) pads: Vec<PadPlan>,
    pub(super) analog: AnalogPlan,
    pub(super) i2c: I2cPlan,
    pub(super) icus: Vec<IcuPlan>,
    pub(super) pulses: Vec<PulsePlan>,
    pub(super) tasks: Vec<TaskPlan>,
    pub(super) link: LinkPlan,
    pub(super) button: Option<ButtonPlan>,
    pub(super) report_ms: u32,
    pub(super) finish_ms: u32,
    pub(super) guards: Vec<GuardPlan>,
}

/// Decides the firmware of every board that carries a device.
///
/// # Errors
///
/// What the hardware, the operating system or this generator cannot do.
pub fn plan(design: &Design, wiring: &Assignment) -> Result<FirmwarePlan, Vec<Diagnostic>> {
    let mut diagnostics = unsupported_kinds(design);
    let mut boards = Vec::new();
    for (board_wiring, board) in wiring.used(design) {
        boards.extend(plan_board(design, board, board_wiring, &mut diagnostics));
    }
    if diagnostics.is_empty() { Ok(FirmwarePlan { boards }) } else { Err(diagnostics) }
}

fn unsupported_kinds(design: &Design) -> Vec<Diagnostic> {
    let can = KINDS.map(KindName::name).join(", ");
    let devices = design.devices.iter().filter(|device| !KINDS.contains(&device.kind.name()));
    let refuse =
        |kind: KindName, span| e0501_no_generator::no_generator(span, &kind.with_article(), &can);
    devices.map(|device| refuse(device.kind.name(), device.kind_span)).collect()
}

fn plan_board(
    design: &Design,
    board: &Board,
    wiring: &BoardAssignment,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<BoardPlan> {
    let context = match Context::new(design, board, wiring) {
        Ok(context) => context,
        Err(why) => {
            let name = &board.name.value;
            diagnostics.push(e0504_no_firmware_target::no_firmware_target(
                board.name.span,
                name,
                why,
            ));
            return None;
        }
    };
    if let Some((what, found, wanted)) = unsupported_driver(context.profile) {
        let why = format!("its {what} driver is {found}, code is made for {wanted} only");
        let name = &board.name;
        let report = e0504_no_firmware_target::no_firmware_target(name.span, &name.value, &why);
        diagnostics.push(report);
        return None;
    }
    diagnostics.extend(sensedsl_timing::refusals_of(design, board, wiring));
    let mut pads = Vec::new();
    let link = link::plan(&context, &mut pads, diagnostics)?;
    let analog = analog::plan(&context, &mut pads);
    let i2c = i2c::plan(&context, &mut pads, diagnostics);
    let icus = icu::plan(&context, &mut pads, diagnostics);
    let pulses = icu::plan_pulses(&context, &mut pads);
    let tasks = tasks::plan(&analog, &i2c, &pulses);
    let settings = settings::plan(&context, &i2c, &link);
    pads.sort();
    pads.dedup();
    Some(BoardPlan {
        name: board.name.value.clone(),
        tree: board::plan(&context),
        schema: SchemaPlan::new(&context),
        report_ms: link::report_ms(&context, &tasks),
        finish_ms: link::finish_ms(&context, &link),
        button: link::button(&context),
        guards: guards::plan(&context, &settings, &i2c, &icus),
        settings,
        pads,
        analog,
        i2c,
        icus,
        pulses,
        tasks,
        link,
    })
}

/// Whether the templates are written for the drivers of the MCU.
#[must_use]
pub fn has_templates(profile: &TargetProfile) -> bool {
    unsupported_driver(profile).is_none()
}

/// A driver that the templates do not know: what it is for, its version, the version they know.
fn unsupported_driver(profile: &TargetProfile) -> Option<(&'static str, &str, &'static str)> {
    let drivers = &profile.drivers;
    let found = [&drivers.adc, &drivers.i2c, &drivers.gpio, &drivers.timer];
    let mut pairs = DRIVERS.iter().zip(found);
    let ((what, wanted), found) = pairs.find(|((_, wanted), found)| wanted != &found.as_str())?;
    Some((what, found, wanted))
}
