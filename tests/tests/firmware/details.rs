//! The other half of the second reader (see `facts`): numbers of samples, times and buffers of
//! buses, which drivers are started and polled, the pads of the link, filters, the button, and the
//! settings that all of these need.

use std::collections::BTreeSet;

use sensedsl_board::pin::PinName;
use sensedsl_model::design::Design;
use sensedsl_model::kind::{Kind, Role};
use sensedsl_wiring::assignment::BoardAssignment;

use super::facts::{Differences, Folder, after, numbers};

/// The time that every transfer is given in addition to its bits, for interrupts and other threads.
const PATIENCE_MS: i64 = 10;

pub(super) fn details(
    design: &Design,
    on: &BoardAssignment,
    folder: &Folder,
    differences: &mut Differences,
) {
    let hardware = &folder["generated/sense_hw.c"];
    usb_pads(design, on, hardware, differences);
    samples(design, on, hardware, differences);
    ports(design, on, hardware, differences);
    buffers(hardware, differences);
    started(hardware, differences);
    works(design, on, hardware, differences);
    filters(design, on, hardware, differences);
    button(design, on, hardware, differences);
    settings(on, folder, differences);
}

/// The tables of a type, each from its name to its end: `static const TYPE name = { … };`, or with
/// `UP_ROM` for those of the core.
fn tables<'a>(hardware: &'a str, kind: &str) -> Vec<(&'a str, &'a str)> {
    let mut tables = Vec::new();
    let mut rest = hardware;
    while let Some((_, behind)) = rest.split_once("static ") {
        rest = behind;
        let constant = ["const ", "UP_ROM "].iter().find_map(|word| behind.strip_prefix(word));
        let table = constant.and_then(|rest| rest.strip_prefix(kind));
        let Some(table) = table.and_then(|rest| rest.strip_prefix(' ')) else {
            continue;
        };
        let name = table.split([' ', '[']).next().unwrap();
        tables.push((name, table.split("\n};").next().unwrap()));
    }
    tables
}

/// The statements of a function, without comments.
fn statements<'a>(hardware: &'a str, function: &str) -> Vec<&'a str> {
    let body = hardware.split(&format!("void {function}(void) {{")).nth(1).unwrap();
    let body = body.split("\n}").next().unwrap();
    body.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('/')).collect()
}

/// The line of a pin: `PAL_LINE(GPIOA, 8U)` for `PA8`.
fn line_of(pin: &PinName) -> String {
    format!("PAL_LINE(GPIO{}, {}U)", pin.port().unwrap(), pin.number().unwrap())
}

/// The pins of a USB link must have the function that the MCU's data sheet gives for D- and D+.
fn usb_pads(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let board = design.board(on.board).unwrap();
    if on.link.is_some() {
        return;
    }
    let mcu = board.mcu.as_ref().unwrap();
    let part = sensedsl_parts::find(mcu).unwrap();
    for (pin, _, usages) in part.sheet.pins() {
        let is_data = |signal: &str| {
            ["USB_DM", "USB_DP", "USB_OTG_FS_DM", "USB_OTG_FS_DP"]
                .contains(&signal.replace('-', "_").as_str())
        };
        let mut usages = usages.iter().filter(|usage| is_data(&usage.0));
        let Some(number) = usages.find_map(|usage| usage.1) else { continue };
        let pad = hardware.lines().find(|line| line.contains(&format!("/* {pin} */ {{PAL")));
        let found = pad.map(|pad| numbers(pad, "PAL_MODE_ALTERNATE("));
        differences.same(&format!("USB at {pin}"), found, Some(vec![i64::from(number)]));
    }
}

/// Each analog sensor must average as many samples as the design states, and the unit must take as
/// many.
fn samples(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let devices = on.devices.iter().filter_map(|one| design.device(one.device));
    for device in devices {
        let Kind::Analog(analog) = &device.kind else { continue };
        let name = &device.name.value;
        let input = format!("{{.field = SENSE_FIELD_{name}, ");
        let rows = hardware.lines().filter(|line| line.contains(&input));
        let found: BTreeSet<i64> = rows.flat_map(|row| numbers(row, ".samples = ")).collect();
        let wanted = BTreeSet::from([i64::from(analog.samples)]);
        differences.same(&format!("samples of {name}"), found, wanted);
    }
    let mut depths = numbers(hardware, ".depth = ");
    let mut rooms = numbers(hardware, "_samples[");
    depths.sort_unstable();
    rooms.sort_unstable();
    differences.same("room for samples", rooms, depths);
}

/// Each I2C bus: its wires for the recovery, its duty cycle, and a time-out longer than a transfer.
fn ports(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let board = design.board(on.board).unwrap();
    for (name, port) in tables(hardware, "up_i2c_port_t") {
        let unit = format!("I2C{}", numbers(port, "&I2CD")[0]);
        let served = on.connections.iter().find(|one| one.unit.as_deref() == Some(&unit));
        let Some(served) = served else { continue };
        for (member, role) in [(".scl = ", Role::Scl), (".sda = ", Role::Sda)] {
            let wire = served.wires.iter().find(|wire| wire.role == role).unwrap();
            let wanted = format!("{member}{},", line_of(&wire.pin(board).unwrap().name));
            differences.same(&wanted, port.contains(&wanted), true);
        }
        let config = name.replace("_port", "_config");
        let configs = tables(hardware, "I2CConfig");
        let (_, config) = configs.iter().find(|(name, _)| *name == config).unwrap();
        let Some(speed_hz) = numbers(config, ".clock_speed = ").first().copied() else { continue };
        let is_fast = config.contains(".duty_cycle = FAST_DUTY_CYCLE_");
        differences.same(&format!("duty cycle of {unit}"), is_fast, speed_hz > 100_000);
        // Nine clocks a byte, assuming that the longest of all transfers is on this bus.
        let longest = numbers(hardware, "_work[").into_iter().max().unwrap_or(0);
        let least_ms = PATIENCE_MS + longest * 9 * 1_000 / speed_hz;
        let timeout_ms = numbers(port, ".timeout_ms = ")[0];
        let is_fit = timeout_ms >= least_ms && timeout_ms <= least_ms * 20;
        differences.same(&format!("time-out of {unit}: {timeout_ms} ms"), is_fit, true);
    }
}

/// A chip's buffer must have room for everything that one of its transfers writes and reads.
fn buffers(hardware: &str, differences: &mut Differences) {
    for (name, transfers) in tables(hardware, "up_chip_transfer_t") {
        let most = transfers.split("\n    {").skip(1).map(|one| {
            let number = |prefix: &str| numbers(one, prefix).first().copied().unwrap_or(0);
            let read = number(".select_count = ") + number(".length = ");
            read.max(number(".trigger_count = "))
        });
        let buffer = name.replace("_transfers", "_work[");
        let room = numbers(hardware, &format!(" {buffer}")).first().copied().unwrap_or(0);
        let most = most.max().unwrap_or(0);
        differences.same(&format!("{buffer}{room}] for {most} bytes"), room >= most, true);
    }
}

/// Every driver that a table names must be started, and every capture polled.
fn started(hardware: &str, differences: &mut Differences) {
    let starts = statements(hardware, "sense_start");
    for driver in after(hardware, ".driver = &").into_iter().collect::<BTreeSet<_>>() {
        let by_port = |line: &&str| {
            let port = after(line, "_start(&").first().copied().unwrap_or_default();
            hardware.contains(&format!(" {port} = {{\n    .driver = &{driver},"))
        };
        let is_started = starts.iter().any(|line| {
            line.contains(&format!("Start(&{driver},"))
                || line.contains(&format!("_start(&{driver},"))
                || by_port(line)
        });
        differences.same(&format!("{driver} is started"), is_started, true);
    }
    let polls = statements(hardware, "sense_poll");
    for (name, _) in tables(hardware, "up_icu_t") {
        let call = format!("up_icu_poll(&{name});");
        differences.same(&call, polls.contains(&call.as_str()), true);
    }
}

/// Each thread must have its own work, read the devices of its cycle, and carry the number of a
/// device of that cycle.
fn works(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let mut works = after(hardware, ".work = &");
    let stacks = after(hardware, ".stack = ");
    let own: Vec<_> = works.iter().map(|work| format!("{work}_stack")).collect();
    differences.same("stacks", stacks, own.iter().map(String::as_str).collect());
    works.sort_unstable();
    works.dedup();
    differences.same("works", works.len(), own.len());
    let delay_of = |is_it: &dyn Fn(&sensedsl_model::design::Device) -> bool| {
        let mut devices = on.devices.iter().filter_map(|one| design.device(one.device));
        devices.find(|device| is_it(device)).map(|device| i64::from(device.delay_ms))
    };
    let Some((_, tasks)) = hardware.split_once("up_task_t tasks[] = {") else { return };
    let tasks = tasks.split("\n};").next().unwrap();
    for task in tasks.split("\n    {").skip(1) {
        let (work, delay_ms) = (after(task, ".work = &")[0], numbers(task, ".delay_ms = ")[0]);
        let id = numbers(task, ".device = ")[0];
        let of_device = delay_of(&|device| i64::from(device.id.value) == id);
        differences.same(&format!("cycle of device {id}"), of_device, Some(delay_ms));
        let inputs = tables(hardware, "up_adc_input_t");
        let inputs = inputs.iter().find(|(name, _)| *name == format!("{work}_inputs"));
        for name in inputs.map_or(Vec::new(), |(_, inputs)| after(inputs, "SENSE_FIELD_")) {
            let own = delay_of(&|device| device.name.value == name);
            differences.same(&format!("cycle of {name}"), own, Some(delay_ms));
        }
    }
}

/// Each value that the design filters must have a filter at its index, with its invalid values.
fn filters(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let devices: Vec<_> = on.devices.iter().filter_map(|one| design.device(one.device)).collect();
    let rows = tables(hardware, "up_filtered_t");
    let rows = rows.first().map_or(Vec::new(), |(_, rows)| rows.lines().skip(1).collect());
    let has_filter: Vec<bool> = rows.iter().map(|row| !row.contains("NULL")).collect();
    let wanted: Vec<bool> =
        devices.iter().map(|device| device.filter != Default::default()).collect();
    let wanted = if wanted.contains(&true) { wanted } else { Vec::new() };
    differences.same("who is filtered", has_filter, wanted);
    let invalid = devices.iter().flat_map(|device| &device.filter.invalid);
    let invalid: Vec<i64> = invalid.flat_map(|(low, high)| [*low as i64, *high as i64]).collect();
    let found = hardware.replace(".high.u = UINT64_C(", ".low.u = UINT64_C(");
    differences.same("what is invalid", numbers(&found, ".low.u = UINT64_C("), invalid);
}

/// The button must be that of the board's facts.
fn button(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let board = design.board(on.board).unwrap();
    let Some(button) = board.facts.as_ref().and_then(|facts| facts.button.as_ref()) else { return };
    let line = format!(".button = {},", line_of(&button.pin));
    differences.same(&line, hardware.contains(&line), true);
    let level = if button.active_high { "PAL_HIGH" } else { "PAL_LOW" };
    differences.same("level of the button", after(hardware, ".button_pressed = "), vec![level]);
}

/// Every unit in use must be enabled; the kernel needs a timer of its own, and the watchdog its
/// oscillator.
fn settings(on: &BoardAssignment, folder: &Folder, differences: &mut Differences) {
    let settings = &folder["cfg/mcuconf.h"];
    let value = |name: &str| after(settings, &format!("#define {name} ")).first().copied();
    for unit in on.connections.iter().filter_map(|one| one.unit.as_deref()) {
        let is_on = settings.lines().any(|line| line.ends_with(&format!("_USE_{unit} TRUE")));
        differences.same(&format!("{unit} is on"), is_on, true);
    }
    if let Some(timer) = value("STM32_ST_USE_TIMER") {
        let unit = format!("TIM{timer}");
        let is_taken = on.connections.iter().any(|one| one.unit.as_deref() == Some(&unit));
        differences.same(&format!("{unit} is the kernel's and a device's"), is_taken, false);
    }
    for name in ["STM32_LSI_ENABLED", "STM32_WDG_USE_IWDG"] {
        differences.same(name, value(name), Some("TRUE"));
    }
}
