//! A run of a fleet: a router, monitors with simulated boards, a subscriber; one monitor is killed at the end.
//!
//! In: groups of boards. Out: the file with all that the subscriber got, when what happened, and what each program used.

use std::fs::File;
use std::io::{BufRead as _, BufReader, Lines, Write as _};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use anyhow::{Context as _, Result, bail, ensure};

use super::design::Group;
use crate::programs::{Ended, Used};

/// How long the monitors have to find their wirings and to greet their boards.
const STARTS_WITHIN: Duration = Duration::from_secs(180);
/// How long it goes on before it is measured, and after a monitor was killed.
const SETTLES: Duration = Duration::from_secs(3);
/// How long a router has to notice that a monitor is gone.
const GONE_WITHIN: Duration = Duration::from_secs(10);
/// How long a monitor has to end.
const ENDS_WITHIN: Duration = Duration::from_secs(20);
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// What the sorts of programs used while it was measured.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Share {
    /// Of one core.
    pub(super) processor: f64,
    pub(super) memory_bytes: u64,
}

/// What came of a run.
pub(super) struct Ran {
    /// All that the subscriber got.
    pub(super) samples: PathBuf,
    /// When it was measured, in nanoseconds since 1970.
    pub(super) measured_ns: (u64, u64),
    /// When the rest was ended.
    pub(super) ended_ns: u64,
    /// How long it took until all tokens of the killed monitor were gone.
    pub(super) gone_after: Option<Duration>,
    /// Which other tokens went with them.
    pub(super) other_gone: usize,
    pub(super) router: Share,
    pub(super) monitors: Share,
    pub(super) subscriber: Share,
    /// What everything else on the machine took, of one core.
    pub(super) others: f64,
    /// What the monitors said at their end.
    pub(super) logs: Vec<String>,
}

/// The subscriber, which answers a line with a line.
struct Subscriber {
    program: Ended,
    to: ChildStdin,
    from: Lines<BufReader<ChildStdout>>,
}

impl Subscriber {
    fn start(endpoint: &str) -> Result<Self> {
        let script = root().join("xtask/src/fleet/subscriber.py");
        let mut child = python(&script, &[endpoint])?;
        let to = child.stdin.take().context("no input")?;
        let from = BufReader::new(child.stdout.take().context("no output")?).lines();
        let mut subscriber = Self { program: Ended(child), to, from };
        let ready = subscriber.line()?;
        ensure!(ready == "ready", "the subscriber says {ready}");
        Ok(subscriber)
    }

    fn line(&mut self) -> Result<String> {
        Ok(self.from.next().context("the subscriber is gone")??)
    }

    fn ask(&mut self, question: &str) -> Result<(usize, u64)> {
        writeln!(self.to, "{question}")?;
        let line = self.line()?;
        let mut words = line.split(' ');
        let first = words.next().unwrap_or_default().parse()?;
        Ok((first, words.next().unwrap_or("0").parse()?))
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

fn python(script: &Path, arguments: &[&str]) -> Result<Child> {
    let mut python = Command::new("python3");
    python.arg(script).args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped());
    python.spawn().context("python3, with `pip install eclipse-zenoh`")
}

fn now_ns() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_nanos()).unwrap_or(u64::MAX)
}

/// The seconds that all processors together were busy.
fn busy_s() -> Result<f64> {
    let text = std::fs::read_to_string("/proc/stat")?;
    let first = text.lines().next().unwrap_or_default();
    let ticks: Vec<f64> = first.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    // User, nice and system; then idle and waiting; then interrupts.
    Ok([0, 1, 2, 5, 6].iter().filter_map(|at| ticks.get(*at)).sum::<f64>() / 100.0)
}

fn monitor(program: &Path, folder: &Path, group: &Group, endpoint: &str) -> Result<Ended> {
    let name = group.name.replace('/', "-");
    let file = |ending: &str| folder.join(format!("{name}.{ending}"));
    std::fs::write(file("sense"), &group.design)?;
    std::fs::write(file("world"), &group.world)?;
    let prefix = &group.name;
    let config = format!(
        "[zenoh]\nmode = \"client\"\nconnect = [\"{endpoint}\"]\nscouting = false\nprefix = \"{prefix}\"\n"
    );
    std::fs::write(file("toml"), config)?;
    let mut monitor = Command::new(program);
    monitor.args(["monitor", "simulate"]).arg(file("sense")).arg("--world").arg(file("world"));
    monitor.args(["--format", "table", "--config"]).arg(file("toml"));
    monitor.stdin(Stdio::null()).stdout(Stdio::null()).stderr(File::create(file("log"))?);
    Ok(Ended(monitor.spawn()?))
}

/// What all of them have used by now.
fn used<'a>(programs: impl IntoIterator<Item = &'a Ended>) -> Result<Used> {
    let mut all = Used::default();
    for program in programs {
        let one = program.used().context("a program of the fleet is over")?;
        all.processor_s += one.processor_s;
        all.memory_bytes += one.memory_bytes;
    }
    Ok(all)
}

/// A fleet that runs.
struct Fleet {
    router: Ended,
    subscriber: Subscriber,
    monitors: Vec<Ended>,
}

impl Fleet {
    fn start(program: &Path, folder: &Path, groups: &[Group]) -> Result<Self> {
        // Free now; whoever takes it before the router does makes this run fail.
        let port = TcpListener::bind("127.0.0.1:0")?.local_addr()?.port();
        let endpoint = format!("tcp/127.0.0.1:{port}");
        let script = root().join("tests/hosts/zenoh_peer.py");
        let mut router = Ended(python(&script, &["router", &endpoint])?);
        let mut line = String::new();
        let _ =
            BufReader::new(router.0.stdout.take().context("no output")?).read_line(&mut line)?;
        ensure!(line.trim() == "ready", "the router does not start");
        let subscriber = Subscriber::start(&endpoint)?;
        let monitors = groups.iter().map(|group| monitor(program, folder, group, &endpoint));
        Ok(Self { router, subscriber, monitors: monitors.collect::<Result<_>>()? })
    }

    fn used(&self) -> Result<[Used; 3]> {
        let of = [used([&self.router])?, used(&self.monitors)?, used([&self.subscriber.program])?];
        Ok(of)
    }

    /// Waits until all boards are there.
    fn meet(&mut self, boards: usize, folder: &Path) -> Result<()> {
        let began = Instant::now();
        loop {
            let (alive, _) = self.subscriber.ask("count")?;
            if alive == boards {
                return Ok(());
            }
            let over = self.monitors.iter_mut().any(|one| !matches!(one.0.try_wait(), Ok(None)));
            if over || began.elapsed() > STARTS_WITHIN {
                let kept = folder.display();
                bail!("{alive} of {boards} boards are there; {kept} has what the monitors say");
            }
            std::thread::sleep(LOOK_EVERY);
        }
    }

    /// Kills the last monitor, as a crash or a cut cable would: how long until its tokens were gone, and how many others
    /// went as well.
    fn kill_last(&mut self, boards: usize) -> Result<(Option<Duration>, usize)> {
        let mut last = self.monitors.pop().context("no monitor")?;
        let killed_ns = now_ns();
        last.0.kill()?;
        let began = Instant::now();
        let mut gone_after = None;
        while gone_after.is_none() && began.elapsed() < GONE_WITHIN {
            let (gone, last_ns) = self.subscriber.ask("gone")?;
            if gone >= boards {
                gone_after = Some(Duration::from_nanos(last_ns.saturating_sub(killed_ns)));
            } else {
                std::thread::sleep(LOOK_EVERY);
            }
        }
        std::thread::sleep(SETTLES);
        let (gone, _) = self.subscriber.ask("gone")?;
        Ok((gone_after, gone.saturating_sub(boards)))
    }

    /// Ends the monitors as Ctrl-C does.
    fn end(&mut self) -> Result<()> {
        for one in &self.monitors {
            let _ = Command::new("kill").args(["-s", "INT", &one.0.id().to_string()]).status()?;
        }
        let began = Instant::now();
        while self.monitors.iter_mut().any(|one| matches!(one.0.try_wait(), Ok(None))) {
            ensure!(began.elapsed() < ENDS_WITHIN, "a monitor does not end");
            std::thread::sleep(LOOK_EVERY);
        }
        Ok(())
    }
}

/// Runs a fleet, and measures it for so long.
pub(super) fn run(program: &Path, folder: &Path, groups: &[Group], seconds: u64) -> Result<Ran> {
    let boards = groups.iter().map(|group| group.boards).sum();
    let mut fleet = Fleet::start(program, folder, groups)?;
    fleet.meet(boards, folder)?;
    std::thread::sleep(SETTLES);
    let (before, busy, began_ns) = (fleet.used()?, busy_s()?, now_ns());
    std::thread::sleep(Duration::from_secs(seconds));
    let (after, busy, measured_ns) = (fleet.used()?, busy_s()? - busy, (began_ns, now_ns()));
    let lasted_s = measured_ns.1.saturating_sub(measured_ns.0) as f64 / 1e9;
    let mut shares = before.iter().zip(&after).map(|(before, after)| Share {
        processor: (after.processor_s - before.processor_s) / lasted_s,
        memory_bytes: after.memory_bytes,
    });
    let mut share = || shares.next().unwrap_or_default();
    let (router, monitors, subscriber) = (share(), share(), share());
    let own = router.processor + monitors.processor + subscriber.processor;
    let last = groups.last().map_or(0, |group| group.boards);
    let (gone_after, other_gone) = fleet.kill_last(last)?;
    let ended_ns = now_ns();
    fleet.end()?;
    let samples = folder.join("samples.tsv");
    let (_, _) = fleet.subscriber.ask(&format!("write {}", samples.display()))?;
    let alive = groups.iter().take(groups.len().saturating_sub(1));
    let logs = alive.map(|group| folder.join(format!("{}.log", group.name.replace('/', "-"))));
    let logs = logs.map(std::fs::read_to_string).collect::<std::io::Result<_>>()?;
    let others = (busy / lasted_s - own).max(0.0);
    Ok(Ran {
        samples,
        measured_ns,
        ended_ns,
        gone_after,
        other_gone,
        router,
        monitors,
        subscriber,
        others,
        logs,
    })
}
