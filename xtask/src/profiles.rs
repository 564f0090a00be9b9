//! `cargo xtask profiles --check`: compares the target profiles with the source tree of ChibiOS that
//! `CHIBIOS` names.
//!
//! In the tree, one file for each family, the registry, lists what each MCU has. The C compiler (`CC`, `cc` by default)
//! preprocesses it for each MCU of each line, and its macros are compared with the profile: units, channels, widths,
//! DMA streams, ports, endpoints. Then the tree must have the files that the profile names, and the platform the driver
//! versions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};
use sensedsl_board::profile::{self, DmaRequest, LineFacts};
use sensedsl_firmware_chibios::Names;

/// The target whose profiles are compared.
const TARGET: &str = "chibios";
/// The kinds of units that are compared.
const KINDS: [&str; 12] =
    ["ADC", "CAN", "DAC", "FDCAN", "I2C", "LPUART", "OTG", "SPI", "TIM", "UART", "USART", "USB"];

type Macros = BTreeMap<String, String>;

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    if arguments != ["--check"] {
        bail!("CHIBIOS=FOLDER cargo xtask profiles --check");
    }
    let tree = std::env::var("CHIBIOS").context("CHIBIOS does not name a ChibiOS tree")?;
    let tree = Path::new(&tree);
    let lines = profile::lines(TARGET).map_err(anyhow::Error::msg)?;
    let (mut differences, mut devices) = (Vec::new(), 0);
    for line in &lines {
        let names = Names::of(&line.profile).map_err(anyhow::Error::msg)?;
        for difference in in_tree(tree, line, &names) {
            differences.push(format!("{}: {difference}", line.profile.line));
        }
        for device in &names.line.devices {
            let macros = preprocess(tree, &names, device)?;
            let found = compare(line, &macros);
            differences
                .extend(found.into_iter().map(|difference| format!("{device}: {difference}")));
            devices += 1;
        }
    }
    for difference in &differences {
        super::say(&format!("{difference}\n"))?;
    }
    ensure!(differences.is_empty(), "{} differences", differences.len());
    super::say(&format!("{devices} MCUs in {} lines are as the tree has them\n", lines.len()))
}

/// The macros of the registry for an MCU.
fn preprocess(tree: &Path, names: &Names, device: &str) -> Result<Macros> {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let file = tree.join(&names.registry);
    let defines = names.macros.iter().map(String::as_str).chain([device]);
    let output = Command::new(&compiler)
        .args(["-E", "-dM"])
        .args(defines.map(|name| format!("-D{name}")))
        .arg(&file)
        .output()
        .with_context(|| compiler.clone())?;
    let log = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{compiler} {} for {device}: {log}", file.display());
    let text = String::from_utf8_lossy(&output.stdout);
    let defined = text.lines().filter_map(|line| line.strip_prefix("#define "));
    let pair = |define: &str| {
        let (name, value) = define.split_once(' ').unwrap_or((define, ""));
        (name.to_owned(), value.trim().to_owned())
    };
    Ok(defined.map(pair).collect())
}

/// The differences between the profile and the registry about an MCU.
fn compare(line: &LineFacts, macros: &Macros) -> Vec<String> {
    let mut differences = Vec::new();
    let own: BTreeSet<&str> = line.units.iter().map(String::as_str).collect();
    let left_out: BTreeSet<&str> = line.left_out.iter().map(String::as_str).collect();
    let theirs = units(macros);
    for unit in &theirs {
        if !own.contains(unit.as_str()) && !left_out.contains(unit.as_str()) {
            differences.push(format!("{unit} is in the tree alone"));
        }
    }
    for unit in own.iter().filter(|unit| !theirs.contains(**unit)) {
        differences.push(format!("{unit} is in the profile alone"));
    }
    for unit in own.intersection(&left_out) {
        differences.push(format!("{unit} is left out and listed"));
    }
    timers(line, macros, &mut differences);
    streams(line, macros, &mut differences);
    others(line, macros, &mut differences);
    differences
}

/// The units of a registry under the names of the profiles. A timer without channels serves no device.
fn units(macros: &Macros) -> BTreeSet<String> {
    let mut units = BTreeSet::new();
    for name in macros.keys().filter(|name| is_true(macros, name)) {
        let Some(unit) = name.strip_prefix("STM32_HAS_") else { continue };
        let unit = unit.split_once("_CH").map_or(unit, |(unit, _)| unit);
        let kind = unit.trim_end_matches(|c: char| c.is_ascii_digit());
        let channels = number(macros, &format!("STM32_{unit}_CHANNELS"));
        if KINDS.contains(&kind) && (kind != "TIM" || channels.is_some_and(|channels| channels > 0))
        {
            units.insert(if unit == "USB" { "USB1".to_owned() } else { unit.to_owned() });
        }
    }
    units
}

fn is_true(macros: &Macros, name: &str) -> bool {
    macros.get(name).is_some_and(|value| value == "TRUE")
}

fn number(macros: &Macros, name: &str) -> Option<usize> {
    macros.get(name)?.trim_end_matches('U').parse().ok()
}

fn differ(what: &str, own: &str, theirs: &str) -> Option<String> {
    (own != theirs).then(|| format!("{what}: {own} in the profile, {theirs} in the tree"))
}

/// Compares widths and channels. Outputs 5 and 6 of a timer are not on any pin.
fn timers(line: &LineFacts, macros: &Macros, differences: &mut Vec<String>) {
    for timer in &line.profile.timers {
        let name = &timer.name;
        let wide = is_true(macros, &format!("STM32_{name}_IS_32BITS"));
        let bits = if wide { "32" } else { "16" };
        differences.extend(differ(&format!("width of {name}"), &timer.bits.to_string(), bits));
        let channels = number(macros, &format!("STM32_{name}_CHANNELS")).unwrap_or_default().min(4);
        let pwm = timer.pwm.as_ref().map_or(0, |pwm| pwm.channels.len());
        let what = format!("channels of {name}");
        differences.extend(differ(&what, &pwm.to_string(), &channels.to_string()));
        if timer.icu.is_some() && channels < 2 {
            differences.push(format!("{name} measures with one channel"));
        }
    }
}

/// Compares the streams of each request, if the registry has them.
fn streams(line: &LineFacts, macros: &Macros, differences: &mut Vec<String>) {
    let profile = &line.profile;
    let buses = profile.i2cs.iter().chain(&profile.spis).map(|unit| (&unit.name, &unit.dma));
    let all = buses.chain(profile.adcs.iter().map(|unit| (&unit.name, &unit.dma)));
    for (unit, requests) in all {
        for DmaRequest { name, streams, .. } in requests {
            let kind = unit.trim_end_matches(|c: char| c.is_ascii_digit());
            let of_registry =
                [format!("STM32_{name}_DMA_MSK"), format!("STM32_{kind}_{name}_DMA_STREAM")];
            let theirs =
                of_registry.iter().find_map(|name| macros.get(name)).map(|mask| listed(mask));
            let theirs = match theirs {
                Some(theirs) if !theirs.is_empty() => theirs,
                _ if is_true(macros, "STM32_DMA_SUPPORTS_DMAMUX") => channels(macros),
                _ => continue,
            };
            let own: BTreeSet<String> = streams.iter().map(ToString::to_string).collect();
            if own != theirs && !theirs.is_empty() {
                let list =
                    |set: &BTreeSet<String>| set.iter().cloned().collect::<Vec<_>>().join(" ");
                let (own, theirs) = (list(&own), list(&theirs));
                differences
                    .push(format!("{name}: streams {own} in the profile, {theirs} in the tree"));
            }
        }
    }
}

/// The streams in a mask: `STM32_DMA_STREAM_ID_MSK(1, 0) | ...`.
fn listed(mask: &str) -> BTreeSet<String> {
    let calls = mask.split("STM32_DMA_STREAM_ID").skip(1);
    let inside = calls.filter_map(|call| call.split_once('(')?.1.split_once(')'));
    inside.map(|(stream, _)| stream.replace(' ', "")).collect()
}

/// All channels of the controllers behind a multiplexer.
fn channels(macros: &Macros) -> BTreeSet<String> {
    let of = |controller: u8| {
        let count =
            number(macros, &format!("STM32_DMA{controller}_NUM_CHANNELS")).unwrap_or_default();
        (1..=count).map(move |channel| format!("{controller},{channel}"))
    };
    of(1).chain(of(2)).collect()
}

/// Compares ports, interrupt lines, outputs of converters, endpoints.
fn others(line: &LineFacts, macros: &Macros, differences: &mut Vec<String>) {
    let profile = &line.profile;
    let own: String = profile.gpio_ports.iter().collect();
    let has = |port: &char| is_true(macros, &format!("STM32_HAS_GPIO{port}"));
    let theirs: String = ('A'..='K').filter(has).collect();
    differences.extend(differ("ports", &own, &theirs));
    let lines = number(macros, "STM32_EXTI_NUM_LINES").unwrap_or_default();
    if lines < usize::from(profile.exti.lines) {
        differences.push(format!("the tree has {lines} interrupt lines"));
    }
    for dac in &profile.dacs {
        let has = |n: &usize| is_true(macros, &format!("STM32_HAS_{}_CH{n}", dac.name));
        let outputs = (1..=2).filter(has).count();
        let what = format!("outputs of {}", dac.name);
        differences.extend(differ(&what, &dac.outputs.len().to_string(), &outputs.to_string()));
    }
    for usb in &profile.usbs {
        if let Some(endpoints) = number(macros, &format!("STM32_{}_ENDPOINTS", usb.name)) {
            let what = format!("endpoints of {}", usb.name);
            differences.extend(differ(&what, &usb.endpoints.to_string(), &endpoints.to_string()));
        }
    }
}

/// The files and driver versions that the tree lacks.
fn in_tree(root: &Path, line: &LineFacts, names: &Names) -> Vec<String> {
    let tree = &names.tree;
    let files =
        [&tree.startup_mk, &tree.platform_mk, &tree.port_mk, &tree.osal_mk, &tree.rules_dir];
    let missing = files.into_iter().filter(|file| !root.join(file).exists());
    let mut differences: Vec<String> =
        missing.map(|file| format!("the tree has no {file}")).collect();
    let platform = std::fs::read_to_string(root.join(&tree.platform_mk)).unwrap_or_default();
    let drivers = &names.drivers;
    let mut versions = vec![
        &drivers.adc,
        &drivers.dma,
        &drivers.exti,
        &drivers.gpio,
        &drivers.i2c,
        &drivers.serial,
        &drivers.spi,
        &drivers.timer,
    ];
    if !line.profile.cans.is_empty() {
        versions.push(&drivers.can);
    }
    if !line.profile.dacs.is_empty() {
        versions.push(&drivers.dac);
    }
    let usbs = line.profile.usbs.iter().filter_map(|usb| names.usb(&usb.name));
    versions.extend(usbs.map(|usb| &usb.version));
    let absent = versions.into_iter().filter(|version| !platform.contains(version.as_str()));
    differences.extend(absent.map(|version| format!("{} has no {version}", tree.platform_mk)));
    differences
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_and_units_are_read() {
        let mask = "(STM32_DMA_STREAM_ID_MSK(1, 0) | STM32_DMA_STREAM_ID_MSK(1,5))";
        assert_eq!(listed(mask), ["1,0", "1,5"].map(str::to_owned).into());
        assert_eq!(listed("STM32_DMA_STREAM_ID(2, 3)"), ["2,3".to_owned()].into());
        let macros = [
            ("STM32_HAS_USB", "TRUE"),
            ("STM32_HAS_DAC1_CH2", "TRUE"),
            ("STM32_HAS_TIM3", "TRUE"),
            ("STM32_TIM3_CHANNELS", "4"),
            ("STM32_HAS_TIM6", "TRUE"),
            ("STM32_TIM6_CHANNELS", "0"),
            ("STM32_HAS_SPI1", "FALSE"),
            ("STM32_HAS_RTC", "TRUE"),
        ];
        let macros: Macros = macros.map(|(name, value)| (name.to_owned(), value.to_owned())).into();
        assert_eq!(units(&macros), ["DAC1", "TIM3", "USB1"].map(str::to_owned).into());
    }

    /// A profile is compared with itself, and with a tree that has a different number of channels.
    #[test]
    fn differences_are_named() {
        let lines = profile::lines(TARGET).unwrap();
        let line = lines.iter().find(|line| line.profile.line == "STM32F103xB").unwrap();
        let found = compare(line, &Macros::new());
        assert!(found.contains(&"TIM2 is in the profile alone".to_owned()), "{found:?}");
        let what = "channels of TIM2: 4 in the profile, 0 in the tree".to_owned();
        assert!(found.contains(&what), "{found:?}");
        let names = Names::of(&line.profile).unwrap();
        assert_eq!(in_tree(Path::new("/nowhere"), line, &names).len(), 5 + 9);
    }
}
