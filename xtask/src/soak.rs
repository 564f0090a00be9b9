//! `cargo xtask soak [--seconds N] [--limits]`: a monitor that watches and records a busy board for a long time.
//!
//! A simulated board with 24 sensors reports a thousand times a second over a pseudo-terminal. No report may be lost and
//! no byte dropped; with `--limits` the figures below are held, too, which a machine with other work cannot do.

use std::fs::File;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, bail};
use sensedsl_record::RecordReader;
use sensedsl_record::convert::Part;
use sensedsl_record::summary::{Summary, summary};

use super::say;
use crate::programs::Ended;

const SENSORS: usize = 24;
/// What `--limits` holds: the processor's share, the median latency, and how much memory may grow after the first third.
const CPU_MAX: f64 = 0.10;
const LATENCY_MAX: Duration = Duration::from_millis(2);
const GROWTH_MAX_BYTES: u64 = 4 << 20;
/// How often the monitor is looked at.
const LOOK_EVERY: Duration = Duration::from_millis(500);

/// What the monitor used.
#[derive(Default)]
struct Used {
    processor_s: f64,
    /// Its memory each time that it was looked at.
    memory_bytes: Vec<u64>,
}

pub(super) fn run(arguments: &[String]) -> Result<()> {
    let (mut seconds, mut has_limits) = (600, false);
    let mut rest = arguments.iter();
    while let Some(one) = rest.next() {
        match one.as_str() {
            "--seconds" => seconds = rest.next().context("--seconds N")?.parse()?,
            "--limits" => has_limits = true,
            other => bail!("`{other}`: there are --seconds N and --limits"),
        }
    }
    let mut cargo = Command::new(env!("CARGO"));
    // What is measured is what is handed out.
    let profile = if has_limits { "dist" } else { "release" };
    cargo.args(["build", "--quiet", "--profile", profile, "--package", "sensedsl"]);
    if !cargo.status()?.success() {
        bail!("it does not build");
    }
    let folder = std::env::temp_dir().join(format!("sensedsl-soak-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let done = soak(&Path::new("target").join(profile).join("sensedsl"), &folder, seconds);
    let _ = std::fs::remove_dir_all(&folder);
    let (used, summary) = done?;
    judge(&used, &summary, has_limits)
}

/// The design: analog inputs and levels, each a thousand times a second.
fn design() -> String {
    let sensors = (1..=SENSORS).map(|id| {
        let (value, kind) = if id <= 8 { ("uint16", "analog") } else { ("bool", "digital") };
        format!(
            "    sensor S{id:02} returns {value} {{ id = {id}; type = {kind}; delay = 1 ms; }}\n"
        )
    });
    let link = "link { transport = usb; rate = 1000 Hz; stamp = true; checksum = crc16; }";
    format!("board Soak on NUCLEO_F767ZI {{\n{}    {link}\n}}\n", sensors.collect::<String>())
}

fn soak(program: &Path, folder: &Path, seconds: u64) -> Result<(Used, Summary)> {
    let (file, record) = (folder.join("soak.sense"), folder.join("soak.mcap"));
    std::fs::write(&file, design())?;
    let mut simulate = Command::new(program);
    simulate.arg("simulate").arg(&file).stdin(Stdio::null()).stderr(Stdio::null());
    let mut board = Ended(simulate.stdout(Stdio::piped()).spawn()?);
    let mut line = String::new();
    let _ = BufReader::new(board.0.stdout.take().context("no output")?).read_line(&mut line)?;
    let device = line.trim().rsplit(' ').next().unwrap_or_default().to_owned();
    let mut monitor = Command::new(program);
    monitor.args(["monitor", &device]).arg(&file).args(["--quiet", "--format", "table"]);
    monitor.arg("--record").arg(&record).args(["--seconds", &seconds.to_string()]);
    let mut monitor = Ended(monitor.stdin(Stdio::null()).stdout(Stdio::null()).spawn()?);
    let used = watched(&mut monitor)?;
    let reader = RecordReader::new(BufReader::new(File::open(&record)?))?;
    let summary =
        summary(reader, &Part::default()).map_err(|error| anyhow::anyhow!("{error:?}"))?;
    Ok((used, summary))
}

/// What a program uses until it ends.
fn watched(monitor: &mut Ended) -> Result<Used> {
    let mut used = Used::default();
    let began = Instant::now();
    loop {
        if let Some(status) = monitor.0.try_wait()? {
            if !status.success() {
                bail!("the monitor ended with {status} after {:.0?}", began.elapsed());
            }
            return Ok(used);
        }
        if let Some(now) = monitor.used() {
            used.processor_s = now.processor_s;
            used.memory_bytes.push(now.memory_bytes);
        }
        std::thread::sleep(LOOK_EVERY);
    }
}

fn judge(used: &Used, summary: &Summary, has_limits: bool) -> Result<()> {
    let board = summary.boards.first().context("no board")?;
    let lasted_s = summary.lasted.as_secs_f64();
    let share = used.processor_s / lasted_s;
    let third = used.memory_bytes.len() / 3;
    let settled = used.memory_bytes.get(third).copied().unwrap_or_default();
    let most = used.memory_bytes.iter().skip(third).copied().max().unwrap_or_default();
    let latencies =
        board.devices.iter().filter_map(|device| device.stats.latencies().quantile(0.5));
    let latency = latencies.max().unwrap_or_default();
    let values: u64 = board.devices.iter().map(|device| device.stats.count()).sum();
    let (counts, mebibyte) = (board.counts, f64::from(1_u32 << 20));
    say(&format!(
        "{lasted_s:.0} s: {} frames with {values} values; {} reports lost, {} bytes dropped\n\
         processor {:.1} % of a core; median latency of the slowest sensor {latency:.2?}; memory {:.1} MiB, at most {:.1} MiB\n",
        counts.frames,
        counts.lost,
        counts.dropped_bytes,
        share * 100.0,
        settled as f64 / mebibyte,
        most as f64 / mebibyte,
    ))?;
    if counts.lost > 0 || counts.dropped_bytes > 0 {
        bail!("nothing may be lost");
    }
    if values < (SENSORS as u64) * (lasted_s * 900.0) as u64 {
        bail!("the board reported less than it was asked to: was this machine too busy?");
    }
    if has_limits && (share > CPU_MAX || latency > LATENCY_MAX || most > settled + GROWTH_MAX_BYTES)
    {
        bail!(
            "a limit is passed: {CPU_MAX} of a core, {LATENCY_MAX:?}, {GROWTH_MAX_BYTES} bytes more"
        );
    }
    Ok(())
}
