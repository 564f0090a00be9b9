//! The text of a profile file.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result};
use sensedsl_board::pin::natural;

use super::facts::{Facts, Family};
use super::lines::{Group, Line, Lines, of};
use super::metadata::{Chip, sampling, switches};

const METADATA: &str = "stm32-metapac 21.0.0";
const HAL: &str = "embassy-stm32 0.6.0";

/// The file of a family.
pub(crate) fn file(facts: &Facts, name: &str, chips: &[Chip], folder: &Path) -> Result<String> {
    let lines = of(facts, name, chips);
    let own = facts.family.get(name).context("a family without facts")?;
    let mut text = format!(
        "# What Embassy 0.6 can do on {name}. Written by `cargo xtask profiles embassy` from {METADATA} and\n\
         # xtask/src/embassy/facts.toml; do not edit.\ntarget = \"{}\"\nfamily = \"{name}\"\n",
        facts.target
    );
    for line in &lines.lines {
        self::line(&mut text, facts, own, line)?;
    }
    kernel(&mut text, &lines)?;
    multiplexers(&mut text, &lines)?;
    timers(&mut text, &lines)?;
    adcs(&mut text, name, own, chips, &lines, folder)?;
    let i2c =
        if chips.iter().any(|chip| version(chip, "I2C1") == "v1") { 400_000 } else { 1_000_000 };
    writeln!(
        text,
        "\n[i2cs]\nfacts = {{ speed_max_hz = {i2c}, read_bytes_min = 1, source = \"{HAL}: src/i2c\" }}\n{}",
        units(&lines, Group::I2cs)
    )?;
    writeln!(
        text,
        "\n[spis]\ndividers = {{ range = [2, 256], powers_of_two = true, source = \"{HAL}: src/spi/mod.rs\" }}\n{}\
         source = \"{METADATA}\"",
        units(&lines, Group::Spis)
    )?;
    writeln!(
        text,
        "\n[serials]\ndividers = {{ range = [16, 65_535], source = \"{HAL}: src/usart/mod.rs\" }}\n{}\
         source = \"{METADATA}\"",
        units(&lines, Group::Serials)
    )?;
    rest(&mut text, &lines)?;
    system(&mut text, facts, own, &lines, chips, folder)?;
    Ok(text)
}

fn version<'a>(chip: &'a Chip, unit: &str) -> &'a str {
    chip.body.units.get(unit).map_or("", |unit| unit.version.as_str())
}

fn line(text: &mut String, facts: &Facts, own: &Family, line: &Line) -> Result<()> {
    let mut names: Vec<&str> = line.facts.units.keys().map(|(_, name)| name.as_str()).collect();
    names.sort_by(|a, b| natural(a, b));
    writeln!(
        text,
        "\n[[line]]\nname = \"{}\"\nparts = [{}]\ngpio_ports = \"{}\"\nunits = \"\"\"\n{}\"\"\"",
        line.name,
        quoted(line.parts.iter()),
        line.facts.ports,
        wrapped(&names),
    )?;
    if !line.facts.left_out.is_empty() {
        let all: Vec<&str> = line.facts.left_out.iter().map(String::as_str).collect();
        writeln!(text, "left_out = \"{}\"", all.join(" "))?;
    }
    let clock = line.clock.and_then(|index| facts.clock.get(index));
    match clock {
        Some(clock) => {
            let hz = clock.hz.iter().map(|(name, hz)| format!("{name} = {hz}"));
            writeln!(text, "clocks_hz = {{ {} }}", hz.collect::<Vec<_>>().join(", "))?;
        }
        None => {
            let names = ["HCLK1", "PCLK1", "PCLK2", "PCLK1_TIM", "PCLK2_TIM"];
            let hz = names.map(|name| format!("{name} = {}", own.hz));
            writeln!(text, "clocks_hz = {{ {} }}", hz.join(", "))?;
        }
    }
    writeln!(text, "source = \"{METADATA}\"\n\n[line.system]")?;
    let mut chips: Vec<&str> = line.chips.iter().map(String::as_str).collect();
    chips.sort_by(|a, b| natural(a, b));
    writeln!(text, "chips = \"\"\"\n{}\"\"\"", wrapped(&chips))?;
    writeln!(text, "spare = [{}]", quoted(line.facts.spare.iter()))?;
    if let Some(clock) = clock {
        text.push_str("\n[line.system.clock]\n");
        if !clock.set.is_empty() {
            writeln!(text, "set = [{}]", quoted(clock.set.iter()))?;
        }
        for way in &clock.ways {
            write!(text, "\n[[line.system.clock.ways]]\n")?;
            for (name, value) in way {
                writeln!(text, "{name} = {value}")?;
            }
        }
    }
    Ok(())
}

/// Words, wrapped into lines.
fn wrapped(words: &[&str]) -> String {
    let mut text = String::new();
    let mut width = 0;
    for word in words {
        if width > 0 && width + word.len() >= 110 {
            text.push('\n');
            width = 0;
        }
        if width > 0 {
            text.push(' ');
        }
        text.push_str(word);
        width += word.len() + 1;
    }
    text.push('\n');
    text
}

fn quoted<'a>(all: impl Iterator<Item = &'a String>) -> String {
    all.map(|one| format!("\"{one}\"")).collect::<Vec<_>>().join(", ")
}

fn kernel(text: &mut String, lines: &Lines) -> Result<()> {
    let is_there = |name: &&String| {
        lines
            .lines
            .iter()
            .any(|line| line.facts.units.contains_key(&(Group::Timers, (*name).clone())))
    };
    writeln!(
        text,
        "\n[kernel]\ntimers = [{}]\nsource = \"{HAL}: build.rs, time-driver features; {METADATA}: interrupts\"\n\n\
         [exti]\nlines = 16\nrule = \"one port per number\"\nsource = \"{HAL}: src/exti/mod.rs\"\n\n\
         [debug]\npins = [\"PA13\", \"PA14\"]\ntrace = [\"PB3\"]\nsource = \"the families' data sheets: SWDIO, SWCLK, SWO\"",
        quoted(lines.kernel.iter().filter(is_there))
    )?;
    Ok(())
}

fn multiplexers(text: &mut String, lines: &Lines) -> Result<()> {
    let mut all: BTreeMap<(&String, &Vec<String>), Vec<&Line>> = BTreeMap::new();
    for line in &lines.lines {
        for (name, streams) in &line.facts.multiplexers {
            all.entry((name, streams)).or_default().push(line);
        }
    }
    for ((name, streams), members) in all {
        let of = if members.len() == lines.lines.len() {
            String::new()
        } else {
            let names = members.iter().map(|line| &line.name);
            format!("lines = [{}]\n", quoted(names))
        };
        writeln!(
            text,
            "\n[[multiplexer]]\nname = \"{name}\"\n{of}streams = [{}]\nsource = \"{METADATA}\"",
            quoted(streams.iter())
        )?;
    }
    Ok(())
}

fn timers(text: &mut String, lines: &Lines) -> Result<()> {
    writeln!(
        text,
        "\n[timers]\n{}source = \"{METADATA}: blocks and clocks; the reference manuals: modes\"",
        units(lines, Group::Timers)
    )?;
    Ok(())
}

fn adcs(
    text: &mut String,
    name: &str,
    own: &Family,
    chips: &[Chip],
    lines: &Lines,
    folder: &Path,
) -> Result<()> {
    let input = |signal: &str| -> Option<u8> {
        signal.strip_prefix("INP").or_else(|| signal.strip_prefix("IN"))?.parse().ok()
    };
    let adcs =
        chips.iter().flat_map(|chip| chip.body.units.values()).filter(|unit| unit.kind == "adc");
    let last = adcs.flat_map(|unit| &unit.pins).filter_map(|(signal, _)| input(signal)).max();
    let times: Vec<String> = sampling(folder, &own.adc)?
        .into_iter()
        .map(|halves| format!("{}{}", halves / 2, if halves % 2 == 1 { ".5" } else { "" }))
        .collect();
    write!(
        text,
        "\n[adcs]\nrules.inputs = [0, {}]\nfacts.sample_cycles = [{}]\nfacts.sample_cycles_default = {}\n\
         facts.resolution_bits = {}\nfacts.channels_max = 16\n",
        last.unwrap_or(15),
        times.join(", "),
        own.sampling,
        if name == "STM32H7" {
            16
        } else if name == "STM32U5" {
            14
        } else {
            12
        },
    )?;
    if let Some(converter) = &own.converter {
        writeln!(
            text,
            "facts.clock = \"{}\"\nfacts.clock_divider = {}\nfacts.conversion_cycles = {}",
            converter.clock, converter.divider, converter.cycles
        )?;
    }
    write!(
        text,
        "facts.source = \"{METADATA}: adc_{}; {HAL}: src/adc\"\n{}",
        own.adc,
        units(lines, Group::Adcs)
    )?;
    Ok(())
}

/// The entries of a group: each unit, with its facts.
fn units(lines: &Lines, group: Group) -> String {
    let reported = |line: &Line| {
        let own = line.facts.units.iter().filter(move |((of, _), _)| *of == group);
        own.map(|((_, name), entry)| (name.clone(), entry.clone())).collect::<Vec<_>>()
    };
    format!("units = [\n{}]\n", entries(lines, reported))
}

/// Entries by name and facts; those that do not apply to all lines give their lines.
fn entries(lines: &Lines, reported: impl Fn(&Line) -> Vec<(String, String)>) -> String {
    let mut all: BTreeMap<String, BTreeMap<String, Vec<&String>>> = BTreeMap::new();
    for line in &lines.lines {
        for (name, entry) in reported(line) {
            all.entry(name).or_default().entry(entry).or_default().push(&line.name);
        }
    }
    let mut names: Vec<&String> = all.keys().collect();
    names.sort_by(|a, b| natural(a, b));
    let mut text = String::new();
    for name in names {
        let variants = all.get(name).into_iter().flatten();
        let has_unit = |line: &&Line| line.facts.units.keys().any(|(_, own)| own == name);
        let owners: Vec<&String> =
            lines.lines.iter().filter(has_unit).map(|line| &line.name).collect();
        for (entry, members) in variants {
            // An entry without lines must not also apply to a line that has the unit with other
            // facts.
            let is_one = all.get(name).is_some_and(|variants| variants.len() == 1);
            let of = if is_one && owners.iter().all(|line| members.contains(line)) {
                String::new()
            } else {
                format!(", lines = [{}]", quoted(members.iter().copied()))
            };
            let entry = if entry.is_empty() { String::new() } else { format!(", {entry}") };
            text.push_str(&format!("  {{ name = \"{name}\"{of}{entry} }},\n"));
        }
    }
    text
}

/// The groups that a family may lack.
fn rest(text: &mut String, lines: &Lines) -> Result<()> {
    let has =
        |group| lines.lines.iter().any(|line| line.facts.units.keys().any(|(of, _)| *of == group));
    if has(Group::Cans) {
        let is_fd = |one: &&String| one.starts_with("FDCAN");
        let mut names = lines.lines.iter().flat_map(|line| line.facts.units.keys());
        // The HAL cuts the greatest divider in the registers, 512, to nine bits.
        let (greatest, file) = match names.find_map(|(_, name)| Some(name).filter(is_fd)) {
            Some(_) => (511, "fd/config.rs"),
            None => (1_024, "util.rs"),
        };
        writeln!(
            text,
            "\n[cans]\ndividers = {{ range = [1, {greatest}], steps = [8, 25], source = \"{HAL}: src/can/{file}\" }}\n{}\
             source = \"{METADATA}\"",
            units(lines, Group::Cans)
        )?;
    }
    if has(Group::Dacs) {
        writeln!(
            text,
            "\n[dacs]\nfacts = {{ resolution_bits = 12, source = \"{HAL}: src/dac/mod.rs\" }}\n{}",
            units(lines, Group::Dacs).trim_end()
        )?;
    }
    if has(Group::Usbs) {
        writeln!(
            text,
            "\n[usbs]\n{}source = \"{METADATA}; {HAL}: src/usb\"",
            units(lines, Group::Usbs)
        )?;
    }
    Ok(())
}

/// The facts that only the generator for Embassy reads.
fn system(
    text: &mut String,
    facts: &Facts,
    own: &Family,
    lines: &Lines,
    chips: &[Chip],
    folder: &Path,
) -> Result<()> {
    let can: BTreeSet<&str> = chips
        .iter()
        .flat_map(|chip| chip.body.units.values())
        .filter(|unit| unit.kind == "can")
        .map(|unit| if unit.version == "bxcan" { "bxcan" } else { "fdcan" })
        .collect();
    let is_general = chips
        .iter()
        .any(|chip| chip.body.channels.iter().any(|channel| channel.name.starts_with("GPDMA")));
    writeln!(
        text,
        "\n# What only the generator for Embassy reads: how the HAL spells things.\n[system]\ntarget = \"{}\"\n\
         adc = {{ new = \"{}\", read = \"{}\" }}\ni2c = \"{}\"\nusart = \"{}\"\n{}can = \"{}\"\ndma = \"{}\"\nafio = {}\nsource = \"{}\"",
        own.target,
        own.new,
        own.read,
        chips
            .iter()
            .map(|chip| version(chip, "I2C1"))
            .find(|version| !version.is_empty())
            .unwrap_or(""),
        chips
            .iter()
            .flat_map(|chip| ["USART1", "USART2"].map(|unit| version(chip, unit)))
            .find(|version| !version.is_empty())
            .unwrap_or(""),
        own.reset.as_ref().map_or(String::new(), |register| format!("reset = \"{register}\"\n")),
        can.first().copied().unwrap_or("none"),
        if is_general { "GPDMA{controller}_CH{stream}" } else { "DMA{controller}_CH{stream}" },
        chips.iter().any(|chip| chip.family == "STM32F1"),
        format_args!("{HAL}; {}", facts.target),
    )?;
    let reported = |line: &Line| {
        line.facts
            .peripherals
            .iter()
            .map(|(ours, theirs)| (ours.clone(), format!("hal = \"{theirs}\"")))
            .collect()
    };
    writeln!(text, "peripherals = [\n{}]", entries(lines, reported))?;
    let switches = switches(folder)?;
    let kind = |field: &String| if switches.contains(field) { "switch" } else { "number" };
    let reported = |line: &Line| {
        line.facts
            .remaps
            .iter()
            .map(|(unit, field)| (unit.clone(), format!("remap = \"{}\"", kind(field))))
            .collect()
    };
    writeln!(text, "remaps = [\n{}]", entries(lines, reported))?;
    let reported = |line: &Line| line.facts.interrupts.clone().into_iter().collect();
    writeln!(text, "interrupts = [\n{}]", entries(lines, reported))?;
    Ok(())
}
