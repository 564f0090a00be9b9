//! Other programs that get the values: arguments and a file in, a configuration out.

use std::path::Path;

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::{e0562_sinks_address as wrong_address, e0563_sink_not_built};
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span};
use sensedsl_model::FileUse;
use sensedsl_session::has_errors;
use sensedsl_sinks::Config;
use sensedsl_sinks::config::{self, Setting, Sort};

use super::subject::{self, Subject};
use crate::cli::{MonitorArgs, SinkArgs};
use crate::commands::in_the_way;
use crate::files::{read_text, shown, write_whole};
use crate::status::{Reported, Status};
use crate::terminal::Terminal;

/// The table of ROS 2.
const ROS2: &str = "ros2";

/// How often boards are asked for their health while other programs are told of it.
const HEALTH_EVERY_S: f64 = 5.0;

/// How often boards are asked for their health.
pub(super) fn health_s(args: &MonitorArgs) -> Option<f64> {
    args.health.or_else(|| args.sinks.is_any().then_some(HEALTH_EVERY_S))
}

/// The programs that the arguments name. What is wrong with them is told.
pub(super) fn read(args: &SinkArgs, terminal: &Terminal, subject: &Subject) -> Result<Config> {
    let mut sources = SourceMap::default();
    let (mut config, mut reported, mut file) = (Config::default(), Vec::new(), None);
    if let Some(path) = &args.config {
        let text = read_text(path, FileUse::Config)?;
        let read = sources.add(shown(path), text.as_str());
        (config, reported) = config::read(read, &text, &subject.boards);
        file = Some(read);
    }
    let at = Span::new(sources.add("monitor", ""), 0..0);
    reported.extend(add_all(&mut config, args, at));
    let has_ros2 = config.sinks.iter().any(|settings| settings.spec.name == ROS2);
    if args.ros_distro.is_some() && reported.is_empty() && !has_ros2 {
        bail!(
            "`--ros-distro` is for ROS 2: write a table `[ros2]` in a file, and name it with `--config`"
        );
    }
    if let (Some(file), true, true) = (file, reported.is_empty(), config.sinks.is_empty()) {
        reported.push(config::without_sink(file));
    }
    terminal.diagnostics(&reported, &sources)?;
    if has_errors(&reported) {
        bail!(Reported(Status::Misused));
    }
    Ok(config)
}

/// Adds the sinks of all short forms; what is wrong with them is returned.
fn add_all(config: &mut Config, args: &SinkArgs, at: Span) -> Vec<Diagnostic> {
    let mut reported = Vec::new();
    let mqtt = args.mqtt.as_ref().map(|broker| Some(broker.clone()));
    for (given, name, key) in [
        (&mqtt, "mqtt", "broker"),
        (&args.websocket, "websocket", "listen"),
        (&args.plotjuggler, "plotjuggler", "to"),
    ] {
        if let Some(address) = given
            && let Err(why) = add(config, at, (name, key), address.as_deref())
        {
            reported.push(*why);
        }
    }
    if let (Some(distro), Some(spec)) = (&args.ros_distro, config::find(ROS2)) {
        if !spec.is_built {
            reported.push(e0563_sink_not_built::not_built(at, "--ros-distro", ROS2));
        } else if let Some(own) = config.sinks.iter_mut().find(|own| own.spec.name == ROS2) {
            own.set("distro", Setting::Text(distro.clone()));
        }
    }
    reported
}

/// Adds the sink of a short form.
fn add(
    config: &mut Config,
    at: Span,
    (name, key): (&'static str, &'static str),
    address: Option<&str>,
) -> Result<(), Box<Diagnostic>> {
    let Some(spec) = config::find(name) else { return Ok(()) };
    if !spec.is_built {
        return Err(Box::new(e0563_sink_not_built::not_built(at, name, name)));
    }
    let sort = spec.keys.iter().find(|one| one.name == key).map(|one| one.sort);
    let value = address.map(|text| {
        // A broker has a port that everybody knows; what listens here is on this machine unless somebody says so.
        match sort {
            Some(Sort::Remote(_)) if name == "mqtt" && !text.contains(':') => {
                format!("{text}:1883")
            }
            Some(Sort::Listen(_)) if text.parse::<u16>().is_ok() => format!("127.0.0.1:{text}"),
            _ => text.to_owned(),
        }
    });
    let wrong = value.as_ref().and_then(|text| match sort {
        Some(Sort::Remote(example)) => Some((text, config::remote(text, None).err()?, example)),
        Some(Sort::Listen(example)) => Some((text, config::listening(text).err()?, example)),
        _ => None,
    });
    if let Some((text, why, example)) = wrong {
        let example = format!("--{name}={example}");
        return Err(Box::new(wrong_address::not_an_address(at, text, &why.to_string(), &example)));
    }
    config.add(spec, key, value.map(Setting::Text));
    Ok(())
}

/// Prints or writes a configuration for the boards of the design.
pub(super) fn init(
    args: &MonitorArgs,
    file: Option<&Path>,
    to: Option<&Path>,
    terminal: &Terminal,
) -> Result<Status> {
    let subject = subject::read(args, file, terminal)?;
    let (mut sources, mut wanted) = (SourceMap::default(), Config::default());
    let at = Span::new(sources.add("monitor", ""), 0..0);
    // `--ros-distro` asks for ROS 2 here, because no configuration exists yet that could.
    if let (Some(_), Some(spec)) = (&args.sinks.ros_distro, config::find(ROS2)) {
        wanted.add(spec, "distro", None);
    }
    let reported = add_all(&mut wanted, &args.sinks, at);
    if has_errors(&reported) {
        terminal.diagnostics(&reported, &sources)?;
        return Ok(Status::Misused);
    }
    // A file for nobody would be refused, and this one reaches no other machine.
    if wanted.sinks.is_empty()
        && let Some(spec) = config::find("websocket").filter(|spec| spec.is_built)
    {
        wanted.add(spec, "listen", None);
    }
    let text = config::sample(&subject.boards, &wanted);
    let Some(path) = to else {
        terminal.result(&text)?;
        return Ok(Status::Done);
    };
    let by = "remove the file, or name another one";
    if in_the_way::refuse(&[(path, text.as_bytes())], by, terminal)? {
        return Ok(Status::Misused);
    }
    write_whole(path, text.as_bytes())?;
    terminal.aside(&format!("wrote {}", shown(path)))?;
    Ok(Status::Done)
}
