//! The command `simulate`, as users run it: verdicts, the same bytes for the same
//! seed, and a generated host application that uses the pseudo-terminal as if it were a board.

use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use sensedsl_tests::{TempDir, binary, few, has, root, run, sensedsl};

const FIG2: &str = "examples/fig2.sense";
const CAR: &str = "examples/miniature_car.sense";

#[test]
fn examples_agree_with_their_worlds() {
    let all = [
        ("fig2", "fig2"),
        ("line_follower", "line_follower"),
        ("miniature_car", "car"),
        ("quadcopter", "quadcopter"),
    ];
    for (name, world) in few(&all, 2) {
        let (file, world) =
            (format!("examples/{name}.sense"), format!("examples/worlds/{world}.toml"));
        let ran = sensedsl(["simulate", &file, "--world", &world, "--judge"]).run().exits(0);
        assert!(ran.stdout.contains("agree with the world"), "{name}: {}", ran.stdout);
        // Every sensor of the table has reported; the table of the actuators comes after it.
        let rows = ran.stdout.lines().skip(1).take_while(|line| line.starts_with("  "));
        let counts = rows.map(|row| row.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap());
        let counts: Vec<u64> = counts.collect();
        assert!(!counts.is_empty() && counts.iter().all(|count| *count > 0), "{}", ran.stdout);
    }
}

#[test]
fn a_seed_gives_the_same_bytes() {
    let scratch = TempDir::new("frames");
    let frames = |name: &str, seed: &str| {
        let path = scratch.join(name);
        let world = ["--world", "examples/worlds/car.toml", "--judge", "--seconds", "3"];
        let call = sensedsl(["simulate", CAR]).args(world).args(["--seed", seed, "--frames"]);
        let _ = call.arg(&path).run().exits(0);
        std::fs::read(path).unwrap()
    };
    let once = frames("once", "5");
    assert!(once.len() > 1_000, "{}", once.len());
    assert!(once == frames("again", "5"));
    assert!(once != frames("other", "6"));
}

#[test]
fn lines_are_printed() {
    let ran = sensedsl(["simulate", FIG2, "--stdout", "--seconds", "2"]).run().exits(0);
    let lines: Vec<&str> = ran.stdout.lines().collect();
    assert!(lines.len() > 50 && lines.iter().all(|line| line.contains(" s  ")), "{}", ran.stdout);
    assert!(ran.stdout.contains("USRear ") && ran.stdout.contains(" cm"), "{}", ran.stdout);
}

/// A process that is ended with the test, whatever its result.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Running {
    fn new(command: &mut Command) -> Self {
        Self(command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn().unwrap())
    }

    fn lines(&mut self) -> impl Iterator<Item = String> + use<> {
        BufReader::new(self.0.stdout.take().unwrap()).lines().map_while(Result::ok)
    }
}

fn monitor(scratch: &TempDir, file: &str, board: &str) -> std::path::PathBuf {
    let out = scratch.join("out");
    let _ = sensedsl(["generate", file, "--quiet", "-o"]).arg(&out).run().exits(0);
    let program = scratch.join("monitor");
    let host: &Path = &out.join("host/cpp");
    let mut compiler = Command::new("g++");
    compiler.args(["-std=c++17", "-pthread", "-I"]).arg(host.join("include"));
    run(compiler.arg(host.join(format!("src/monitor_{board}.cpp"))).arg("-o").arg(&program));
    program
}

/// The end of the README's first minutes: live values from a simulated car in the generated host
/// application.
#[test]
fn a_generated_host_reads_the_pseudo_terminal() {
    if !has("g++") {
        return;
    }
    let scratch = TempDir::new("host");
    let program = monitor(&scratch, CAR, "STM32F4DiscoveryBoard");
    let mut simulate = Command::new(binary());
    simulate.args(["simulate", CAR, "--seconds", "60"]).current_dir(root()).stderr(Stdio::null());
    let mut board = Running::new(&mut simulate);
    let mut reported = board.lines();
    let name = reported.find_map(|line| line.strip_prefix("the board is at ").map(str::to_owned));
    let mut host = Running::new(Command::new(program).arg(name.unwrap()));
    let wanted = ["IRFrontRight = ", "USFront = ", "WheelLeftA = ", "RCSteering = "];
    let mut missing: Vec<&str> = wanted.to_vec();
    let mut read = Vec::new();
    for line in host.lines().take(500) {
        missing.retain(|one| !line.starts_with(one));
        read.push(line);
        if missing.is_empty() {
            break;
        }
    }
    assert!(missing.is_empty(), "{missing:?} in {read:#?}");
}

/// Where there are no pseudo-terminals, and for hosts on other machines: a port of TCP, which one host at a time has. The
/// next one is served as well.
#[test]
fn hosts_read_a_port_of_tcp() {
    let mut simulate = Command::new(binary());
    let call = ["simulate", FIG2, "--tcp", "0", "--seconds", "120"];
    let mut board = Running::new(simulate.args(call).current_dir(root()).stderr(Stdio::null()));
    let mut reported = board.lines();
    let name = reported.find_map(|line| line.strip_prefix("the board is at ").map(str::to_owned));
    let name = name.unwrap();
    assert!(name.starts_with("tcp:127.0.0.1:"), "{name}");
    for _ in 0..2 {
        let call =
            ["monitor", &name, FIG2, "--seconds", "3", "--format", "lines", "--no-reconnect"];
        let ran = sensedsl(call).run().exits(0);
        assert!(ran.stderr.contains("firmware and design agree"), "{}", ran.stderr);
        assert!(ran.stdout.contains("USRear"), "{}{}", ran.stdout, ran.stderr);
    }
    if !has("python3") {
        return;
    }
    let scratch = TempDir::new("python-tcp");
    let _ = sensedsl(["generate", FIG2, "--quiet", "-o"]).arg(scratch.path()).run().exits(0);
    let mut host = Command::new("python3");
    host.args(["-m", "sense_fig2", &name]).current_dir(scratch.join("host/python"));
    let mut host = Running::new(host.stderr(Stdio::null()));
    assert!(host.lines().take(100).any(|line| line.contains("USRear")), "no value came");
}

/// A port that nothing listens at, and one that is taken.
#[test]
fn ports_of_tcp_that_cannot_be_had() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let ran = sensedsl(["simulate", FIG2, "--tcp", &port]).run().exits(2);
    assert!(ran.stderr.contains("cannot listen at"), "{}", ran.stderr);
    drop(taken);
    let name = format!("tcp:127.0.0.1:{port}");
    let ran = sensedsl(["monitor", &name, FIG2, "--seconds", "1"]).run().exits(2);
    assert!(ran.stderr.contains("nothing answers there"), "{}", ran.stderr);
    assert!(ran.stderr.contains("simulate FILE --tcp"), "{}", ran.stderr);
}

/// A board sleeps until somebody opens its terminal; it once polled 35,000 times a second.
#[test]
#[cfg(target_os = "linux")]
fn nobody_opens_the_terminal() {
    let scratch = TempDir::new("alone");
    let file = scratch.write(
        "alone.sense",
        "board STM32F407G_DISC1 { sensor A returns uint16 { id = 1; type = analog; delay = 1 s; } }",
    );
    let mut command = Command::new(binary());
    command.arg("simulate").arg(file);
    let board = Running::new(command.stderr(Stdio::null()));
    let cpu_ticks = || -> u64 {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", board.0.id())).unwrap();
        let (_, rest) = stat.rsplit_once(") ").unwrap();
        rest.split(' ').skip(11).take(2).map(|ticks| ticks.parse::<u64>().unwrap()).sum()
    };
    std::thread::sleep(std::time::Duration::from_secs(1));
    let before = cpu_ticks();
    std::thread::sleep(std::time::Duration::from_secs(2));
    let spent = cpu_ticks() - before;
    // Out of 200; a loop without a pause would use a whole processor.
    assert!(spent < 40, "{spent} hundredths of a second of processor in 2 s");
}
