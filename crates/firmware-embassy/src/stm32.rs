//! What a project on `embassy-stm32` begins with: clocks, watchdog, the cause of the last reset.

use super::context::Context;
use super::plan::{Begin, Watchdog};

/// How a project begins.
pub(super) fn begin(context: &Context<'_>, is_usb: bool) -> Begin {
    let unit = if context.profile.family == "STM32H7" { "IWDG1" } else { "IWDG" };
    Begin {
        clocks: clock(context, is_usb),
        config: "hal::Config",
        start: start(context),
        watchdog: Watchdog {
            type_: format!("hal::wdg::IndependentWatchdog<'static, {unit}>"),
            make: format!("hal::wdg::IndependentWatchdog::new(p.{unit}, WATCHDOG_US)"),
        },
        scripts: "",
        memory: None,
    }
}

/// What is set of the HAL's clocks.
fn clock(context: &Context<'_>, is_usb: bool) -> Vec<String> {
    let clock = context.names.line.clock.as_ref();
    clock.and_then(|clock| clock.lines(&context.crystal(), is_usb)).unwrap_or_default()
}

/// The first statements of `main`, up to the wiring.
fn start(context: &Context<'_>) -> Vec<String> {
    let mut lines = match &context.names.reset {
        Some(reset) => vec![
            format!("STATUS.begin(hal::pac::RCC.{reset}().read().0);"),
            format!("hal::pac::RCC.{reset}().modify(|flags| flags.set_rmvf(true));"),
        ],
        None => vec!["STATUS.begin(0);".to_owned()],
    };
    // The MCU may have a second core, which is left alone.
    if context.chip.feature.contains("-cm") {
        lines.extend(
            [
                "// What a program of the other core would wait for.",
                "static SHARED: core::mem::MaybeUninit<hal::SharedData> = core::mem::MaybeUninit::uninit();",
                "let wiring = wiring::wire(hal::init_primary(config(), &SHARED));",
            ]
            .map(str::to_owned),
        );
    } else {
        lines.push("let wiring = wiring::wire(hal::init(config()));".to_owned());
    }
    lines
}
