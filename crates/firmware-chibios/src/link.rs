//! The link to the host, its button, and the report rate.

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target;
use sensedsl_model::design::Transport;

use super::context::{Context, Drive, PadPlan, alternate_mode};
use super::names::Setting;
use super::plan::TaskPlan;
use sensedsl_job::kinds::can;

/// The reporter's cycle unless something requires another.
const REPORT_MS: u32 = 10;

/// The carrier of the frames.
#[derive(Clone, Debug)]
pub(super) enum LinkPlan {
    /// A USB device: its driver and the options that it needs.
    Usb { driver: String, switches: Vec<String>, settings: Vec<Setting>, is_always_connected: bool },
    /// A serial port.
    Uart { unit: String, driver: String, switches: Vec<String>, baud: u32 },
}

/// A button that turns frames on at the start.
#[derive(Clone, Debug)]
pub(super) struct ButtonPlan {
    pub(super) pin: String,
    pub(super) line: String,
    pub(super) level: &'static str,
}

impl LinkPlan {
    pub(super) fn is_usb(&self) -> bool {
        matches!(self, Self::Usb { .. })
    }

    /// Whether it is a USB device that the host sees as long as the cable is plugged in.
    pub(super) fn is_always_connected(&self) -> bool {
        matches!(self, Self::Usb { is_always_connected: true, .. })
    }

    /// The options that select its clock.
    pub(super) fn settings(&self) -> &[Setting] {
        match self {
            Self::Usb { settings, .. } => settings,
            Self::Uart { .. } => &[],
        }
    }

    /// The driver object.
    pub(super) fn driver(&self) -> &str {
        match self {
            Self::Usb { driver, .. } | Self::Uart { driver, .. } => driver,
        }
    }

    /// The options that it needs.
    pub(super) fn switches(&self) -> &[String] {
        match self {
            Self::Usb { switches, .. } | Self::Uart { switches, .. } => switches,
        }
    }

    /// The baud rate; 0 over USB.
    pub(super) fn baud(&self) -> u32 {
        match self {
            Self::Usb { .. } => 0,
            Self::Uart { baud, .. } => *baud,
        }
    }

    /// The title for people.
    pub(super) fn title(&self) -> String {
        match self {
            Self::Usb { .. } => "USB (a serial port of the host, such as /dev/ttyACM0)".to_owned(),
            Self::Uart { unit, baud, .. } => format!("{unit} at {baud} baud"),
        }
    }
}

pub(super) fn plan(
    context: &Context<'_>,
    pads: &mut Vec<PadPlan>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<LinkPlan> {
    let plan = match context.job.board.link.transport {
        Transport::Usb => usb(context, pads),
        Transport::Uart => uart(context, pads, diagnostics),
        Transport::None => None,
    };
    if plan.is_none() {
        let name = &context.job.board.name;
        let why = match context.job.board.link.transport {
            Transport::None => "it has no link to send reports over (`transport = none`)",
            Transport::Usb | Transport::Uart => "its target has no driver for the link",
        };
        diagnostics.push(e0504_no_firmware_target::no_firmware_target(name.span, &name.value, why));
    }
    plan
}

fn usb(context: &Context<'_>, pads: &mut Vec<PadPlan>) -> Option<LinkPlan> {
    let usb = context.profile.usb(None)?;
    let names = context.names.usb(&usb.name)?;
    if let Some(number) = usb.alternate {
        let mode = alternate_mode(number, Drive::Fast);
        let pad = |pin: &PinName| {
            Some(PadPlan {
                pin: pin.clone(),
                line: context.line(pin)?,
                mode: mode.clone(),
                is_high: false,
            })
        };
        pads.extend(usb.pins.iter().filter_map(pad));
    }
    let vbus = usb.vbus.as_ref().filter(|_| !context.job.board.link.vbus);
    let without = vbus.and(names.without_vbus.as_ref());
    let switches = std::iter::once(&names.switch).chain(&names.needs).chain(without).cloned();
    Some(LinkPlan::Usb {
        driver: names.driver.clone(),
        switches: switches.collect(),
        settings: names.settings.iter().map(|(name, value)| Setting::new(name, value)).collect(),
        is_always_connected: names.is_always_connected,
    })
}

fn uart(
    context: &Context<'_>,
    pads: &mut Vec<PadPlan>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<LinkPlan> {
    let link = context.job.link.as_ref()?;
    let unit = context.profile.serials.iter().find(|serial| serial.name == link.unit)?;
    for pad in &link.pads {
        pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
    }
    Some(LinkPlan::Uart {
        unit: unit.name.clone(),
        driver: context.names.driver(&unit.name)?,
        switches: context.names.switches(&unit.name),
        baud: context.job.board.link.baud,
    })
}

/// The board's own button, unless a device uses its pin. Another board with the same MCU may have anything at that pin.
pub(super) fn button(context: &Context<'_>) -> Option<ButtonPlan> {
    let button = context.job.board.facts.as_ref()?.button.as_ref();
    let button = button.filter(|_| context.job.board.built_in)?;
    let is_taken = context.job.all_pads().any(|pad| pad.pin.name == button.pin);
    let line = context.line(&button.pin).filter(|_| !is_taken)?;
    Some(ButtonPlan {
        pin: button.pin.to_string(),
        line,
        level: if button.active_high { "PAL_HIGH" } else { "PAL_LOW" },
    })
}

/// The reporter's cycle: as short as the time in which something can become due, but no shorter than the link allows.
pub(super) fn report_ms(context: &Context<'_>, tasks: &[TaskPlan]) -> u32 {
    if let Some(report_ms) = context.job.board.link.report_ms() {
        return report_ms;
    }
    let repeats = can::repeats_ms(context.job);
    tasks.iter().map(|task| task.delay_ms).chain(repeats).fold(REPORT_MS, u32::min).max(1)
}
