//! The libcluon and OpenDaVINCI hosts with the trees of those projects, if given: compiled, run on
//! a pseudo-terminal, and connected to other programs that receive their messages and send
//! commands.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use sensedsl_generate::host;
use sensedsl_job::host::{Compile, HostBoard};
use sensedsl_tests::{has, missing, run};
use sensedsl_wire::{
    Decoder, Direction, Event, Scalar, ScalarType, encode_hello, encode_hello_request,
    encode_report,
};

use super::compile::compile;
use super::terminal::Line;
use super::tools::{self, Background};
use super::{designs, files, link, shown};

/// A session identifier that is unique to a test and a run.
fn session(test: u32) -> String {
    (10 + 9 * (std::process::id() % 27) + test).to_string()
}

/// The compiler and options that the host states for its sources.
fn compiler(name: &str) -> Compile {
    host::find(name).unwrap().compile()
}

fn have_pycluon() -> bool {
    let imported = Command::new("python3").args(["-c", "import pycluon.importer"]).status();
    let found = imported.is_ok_and(|status| status.success());
    if !found {
        missing("pycluon");
    }
    found
}

/// One report with every sensor of the design `all-types`, with values that reveal mistakes.
fn full_report(board: &HostBoard) -> Vec<u8> {
    let sensors = board.schema.items.iter().filter(|item| item.direction == Direction::Sensor);
    let values: Vec<(u8, Vec<Scalar>)> = sensors
        .map(|item| {
            let scalars = (0..item.value.count()).map(|element| match item.value.scalar {
                ScalarType::Bool => Scalar::Bool(element % 2 == 0),
                ScalarType::Uint8 => Scalar::Unsigned(255 - element as u64),
                ScalarType::Uint16 => Scalar::Unsigned(65_535 - element as u64),
                ScalarType::Uint32 => Scalar::Unsigned(4_294_967_295 - element as u64),
                ScalarType::Uint64 => Scalar::Unsigned(u64::MAX - element as u64),
                ScalarType::Int8 => Scalar::Signed(-128 + element as i64),
                ScalarType::Int16 => Scalar::Signed(-32_768 + element as i64),
                ScalarType::Int32 => Scalar::Signed(-2_147_483_648 + element as i64),
                ScalarType::Int64 => Scalar::Signed(i64::MIN + element as i64),
                ScalarType::Float32 => Scalar::Float32(-0.5 * element as f32),
                ScalarType::Float64 => Scalar::Float64(0.1 + element as f64),
            });
            (item.id, scalars.collect())
        })
        .collect();
    encode_report(&board.schema, Direction::Sensor, &values).unwrap()
}

/// Waits until the board has received each of these commands at least once, and nothing else.
fn hear_commands(line: &mut Line, board: &HostBoard, expected: &[(u8, Vec<Scalar>)]) {
    let mut decoder = Decoder::new(&board.schema, Direction::Actuator);
    let mut received = Vec::new();
    let start = Instant::now();
    while !expected.iter().all(|value| received.contains(value)) {
        assert!(start.elapsed() < Duration::from_secs(30), "heard {received:?}");
        let bytes = line.hear(1, Duration::from_millis(100));
        decoder.feed(&bytes, |event| match event {
            Event::Report(_, values) => received.extend(values),
            // The host repeats its request until it is answered, so one more may have been on its
            // way.
            Event::HelloRequest | Event::HealthRequest => {}
            Event::Hello(_) | Event::Health(_) | Event::OtherHealth(_) => panic!("{event:?}"),
        });
    }
    assert_eq!(decoder.dropped_bytes(), 0);
    assert!(received.iter().all(|value| expected.contains(value)), "{received:?}");
}

/// Lets the host find its board: request, hello, report.
fn greet(line: &mut Line, board: &HostBoard) {
    let request = encode_hello_request(&board.schema);
    assert_eq!(line.hear(request.len(), Duration::from_secs(30)), request);
    line.say(&encode_hello(&board.schema));
}

#[test]
fn message_files_are_taken_by_cluon_msc() {
    if !have_pycluon() {
        return;
    }
    for (name, boards) in designs::all() {
        for host in ["libcluon", "opendavinci"] {
            let folder = files::generate(host, &format!("{name}-odvd"), &boards);
            let out = folder.join("sense.hpp");
            run(Command::new("cluon-msc")
                .arg("--cpp")
                .arg(format!("--out={}", out.display()))
                .arg(folder.join("sense.odvd")));
            let text = std::fs::read_to_string(out).unwrap();
            let messages = std::fs::read_to_string(folder.join("sense.odvd")).unwrap();
            let count = messages.lines().filter(|line| line.starts_with("message ")).count();
            assert_eq!(text.matches("inline static int32_t ID()").count(), count, "{name}");
        }
    }
}

#[test]
fn libcluon_compiles() {
    let Some(tree) = tools::tree("LIBCLUON") else { return };
    if !have_pycluon() {
        return;
    }
    for (name, boards) in designs::all() {
        let folder = files::generate("libcluon", &format!("{name}-compile"), &boards);
        run(Command::new("cluon-msc")
            .arg("--cpp")
            .arg(format!("--out={}", folder.join("sense.hpp").display()))
            .arg(folder.join("sense.odvd")));
        compile(&compiler("libcluon"), &folder, &[&tree, &folder]);
    }
}

/// Builds the host as its README states.
fn build_libcluon(tree: &Path, folder: PathBuf) -> (PathBuf, PathBuf) {
    let build = folder.join("build");
    let mut configure = Command::new("cmake");
    configure.arg("-S").arg(&folder).arg("-B").arg(&build);
    run(configure.arg(format!("-DCLUON_INCLUDE_DIR={}", tree.display())));
    run(Command::new("cmake").arg("--build").arg(&build));
    (folder, build)
}

/// Starts another program of the session, which receives all messages and sends these.
fn peer(folder: &Path, cid: &str, sent: &[&str]) -> Background {
    let mut command = Command::new("python3");
    command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("hosts/od4_peer.py"));
    command.arg(cid).arg(folder.join("sense.odvd")).args(sent);
    let peer = Background::start(&mut command, folder);
    peer.wait_for("ready");
    peer
}

/// Starts the host of a board, which shows what it receives.
fn service(program: &Path, folder: &Path, cid: &str, device: &Path) -> Background {
    let mut command = Command::new(program);
    command.arg(format!("--cid={cid}")).arg(format!("--device={}", device.display()));
    Background::start(command.arg("--verbose"), folder)
}

#[test]
fn libcluon_comes_back() {
    let Some(tree) = tools::tree("LIBCLUON") else { return };
    if !have_pycluon() || !has("cmake") {
        return;
    }
    let (folder, build) =
        build_libcluon(&tree, files::generate("libcluon", "link", &link::design()));
    let cid = session(5);
    let program = "robot_STM32F4DiscoveryBoard";
    let start = |device: &Path| service(&build.join(program), &folder, &cid, device);
    link::scenes(&link::Application { name: "libcluon", program, start: &start });
}

#[test]
fn libcluon_speaks_with_an_independent_peer() {
    let Some(tree) = tools::tree("LIBCLUON") else { return };
    if !have_pycluon() || !has("cmake") {
        return;
    }
    let boards = designs::all_types();
    let (folder, build) = build_libcluon(&tree, files::generate("libcluon", "peer", &boards));
    let cid = session(0);
    let mut line = Line::new();
    let sent = [
        "21068:sense_robot_T7:raw=18446744073709551615,is_raw=True",
        "21095:sense_robot_B4:raw0=-300,raw1=32767",
        "21061:sense_robot_T0:raw=True",
    ];
    let peer = peer(&folder, &cid, &sent);
    let _service = service(&build.join("robot_Everything"), &folder, &cid, &line.device);
    greet(&mut line, &boards[0]);
    line.say(&full_report(&boards[0]));
    // Number and sender stamp, the raw value, and the scaled value if the design has one.
    for expected in [
        "21001 1 raw=True\n",
        "21003 3 raw=-128 value=-64.0\n",
        "21008 8 raw=18446744073709551615 value=",
        "21009 9 raw=-9223372036854775808 value=",
        "21039 39 raw0=-9223372036854775808 raw1=-9223372036854775807 raw2=-9223372036854775806 ",
        "21011 11 raw=0.1",
    ] {
        peer.wait_for(expected);
    }
    let expected = [
        (68, vec![Scalar::Unsigned(u64::MAX)]),
        (95, vec![Scalar::Signed(-300), Scalar::Signed(32_767)]),
        (61, vec![Scalar::Bool(true)]),
    ];
    hear_commands(&mut line, &boards[0], &expected);
}

#[test]
fn libcluon_shows_values_through_curves() {
    let Some(tree) = tools::tree("LIBCLUON") else { return };
    if !have_pycluon() || !has("cmake") {
        return;
    }
    let (folder, schema) = shown::generate("libcluon", "run");
    let (folder, build) = build_libcluon(&tree, folder);
    let cid = session(8);
    let mut line = Line::new();
    let sent = [
        "21020:sense_curves_Escs:raw0=1000,raw1=1500,raw2=2000,raw3=65535,is_raw=True",
        "21022:sense_curves_Winch:raw=3001",
        "21022:sense_curves_Winch:value=100",
        "21022:sense_curves_Winch:value=101",
        "21022:sense_curves_Winch:value=100",
        "21022:sense_curves_Winch:raw=3001,is_raw=True",
        "21021:sense_curves_Lamps:raw0=True,raw2=True",
        "21022:sense_curves_Winch:value=100",
    ];
    let peer = peer(&folder, &cid, &sent);
    let service = service(&build.join("curves_Rover"), &folder, &cid, &line.device);
    let board = &shown::boards()[0];
    greet(&mut line, board);
    line.say(&shown::stream());
    service.wait_for("Position = -11520");
    shown::BY_HAND.iter().for_each(|text| service.wait_for(text));
    shown::check(&service.output(), &schema);
    peer.wait_for("21014 14 raw=65535 value=3.0\n");
    peer.wait_for("21012 12 raw0=True raw1=False raw2=True\n");
    shown::check_messages(&peer.output(), &schema);
    hear_commands(&mut line, board, &shown::commands());
    let unclear = "`raw` is set and `is_raw` is not: set both, or `value` alone";
    let beyond = format!("101 N {}", shown::REFUSED);
    for refused in [unclear, &beyond, shown::REFUSED] {
        service.wait_for(&format!("Winch: not sent: {refused}\n"));
    }
}

/// Two commands of the design `all-types` for `commander.cpp`.
const BIG_AND_PAIR: &str = "sense::robot::T7 big; big.setRaw(0x0123456789ABCDEFU); \
    SEND(sense::robot::T7, big) sense::robot::B4 pair; pair.setRaw(0, -300); pair.setRaw(1, 32767); \
    SEND(sense::robot::B4, pair)";

/// One of the two OpenDaVINCI hosts, with the paths in its tree.
struct OpenDavinci {
    host: &'static str,
    include: PathBuf,
    library: PathBuf,
    supercomponent: PathBuf,
    link: &'static [&'static str],
    defines: &'static [&'static str],
}

fn opendavinci2014() -> Option<OpenDavinci> {
    let tree = tools::tree("OPENDAVINCI2014")?;
    Some(OpenDavinci {
        host: "opendavinci2014",
        include: tree.join("libopendavinci/include"),
        library: tree.join("lib/libopendavinci.a"),
        supercomponent: tree.join("bin/supercomponent"),
        link: &["-lzip", "-ldb", "-lpthread", "-lrt"],
        defines: &["-DOPENDAVINCI2014"],
    })
}

fn opendavinci() -> Option<OpenDavinci> {
    let tree = tools::tree("OPENDAVINCI")?;
    Some(OpenDavinci {
        host: "opendavinci",
        include: tree.join("include"),
        library: tree.join("lib/libopendavinci.a"),
        supercomponent: tree.join("bin/odsupercomponent"),
        link: &["-lpthread", "-lrt"],
        defines: &[],
    })
}

impl OpenDavinci {
    fn compile_all(&self) {
        for (name, boards) in designs::all() {
            let folder = files::generate(self.host, &format!("{name}-compile"), &boards);
            compile(&compiler(self.host), &folder, &[&self.include]);
        }
    }

    fn build(&self, folder: &Path, source: &Path, name: &str) -> PathBuf {
        let program = folder.join(name);
        run(Command::new("g++")
            .arg(compiler(self.host).standard)
            .args(self.defines)
            .arg("-I")
            .arg(folder.join("include"))
            .arg("-isystem")
            .arg(&self.include)
            .arg(source)
            .arg(&self.library)
            .args(self.link)
            .arg("-o")
            .arg(&program));
        program
    }

    /// Builds a program that sends these commands repeatedly.
    fn commander(&self, folder: &Path, commands: &str) -> PathBuf {
        let header = folder.join("include/commands.h");
        std::fs::write(header, format!("#define COMMANDS {commands}\n")).unwrap();
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("hosts/commander.cpp");
        self.build(folder, &source, "commander")
    }

    fn start(&self, program: &Path, cid: &str, folder: &Path, more: &[&str]) -> Background {
        let mut command = Command::new(program);
        command.current_dir(folder).arg(format!("--cid={cid}")).arg("--freq=20").args(more);
        Background::start(&mut command, folder)
    }

    /// Starts what the modules of a session get their configuration from.
    fn supercomponent(&self, cid: &str, folder: &Path, configuration: &str) -> Background {
        let path = folder.join("configuration");
        std::fs::write(&path, configuration).unwrap();
        let configured = format!("--configuration={}", path.display());
        let supercomponent = self.start(&self.supercomponent, cid, folder, &[&configured]);
        std::thread::sleep(Duration::from_secs(1));
        supercomponent
    }

    fn can_run(&self) -> bool {
        let found = self.library.exists() && self.supercomponent.exists();
        if !found {
            let (library, supercomponent) = (self.library.display(), self.supercomponent.display());
            missing(&format!("{library} or {supercomponent}"));
        }
        found
    }

    /// Checks how the host reacts when its board goes and comes back.
    fn comes_back(&self, cid: &str) {
        if !self.can_run() {
            return;
        }
        let folder = files::generate(self.host, "link", &link::design());
        let source = folder.join("src/STM32F4DiscoveryBoard.cpp");
        let application = self.build(&folder, &source, "robot_Board");
        let _supercomponent = self.supercomponent(cid, &folder, "robot.nothing = 1\n");
        let start = |device: &Path| {
            let device = format!("--device={}", device.display());
            self.start(&application, cid, &folder, &[&device, "--verbose=1"])
        };
        link::scenes(&link::Application { name: self.host, program: "robot_Board", start: &start });
    }

    /// Values through curves, and arrays, in both directions, as the design's file defines them.
    fn shows(&self, cid: &str) {
        if !self.can_run() {
            return;
        }
        let (folder, schema) = shown::generate(self.host, "run");
        let application = self.build(&folder, &folder.join("src/Rover.cpp"), "curves_Rover");
        let printer = self.build(&folder, &folder.join("src/print.cpp"), "curves_print");
        let commander = self.commander(&folder, shown::COMMANDS);
        let mut line = Line::new();
        let _supercomponent = self.supercomponent(cid, &folder, "curves.nothing = 1\n");
        let printer = self.start(&printer, cid, &folder, &[]);
        let device = format!("--device={}", line.device.display());
        let application = self.start(&application, cid, &folder, &[&device, "--verbose=1"]);
        let board = &shown::boards()[0];
        greet(&mut line, board);
        std::thread::sleep(Duration::from_secs(1));
        line.say(&shown::stream());
        for output in [&printer, &application] {
            output.wait_for("Position = -11520");
            shown::BY_HAND.iter().for_each(|text| output.wait_for(text));
            shown::check(&output.output(), &schema);
        }
        let _commander = self.start(&commander, cid, &folder, &[]);
        hear_commands(&mut line, board, &shown::commands());
        application.wait_for(&format!("Winch: not sent: {}\n", shown::REFUSED));
    }

    /// The board's values reach another application as Containers, and another application's
    /// Containers reach the board.
    fn run(&self, cid: &str) {
        if !self.can_run() {
            return;
        }
        let boards = designs::all_types();
        let folder = files::generate(self.host, "run", &boards);
        let application =
            self.build(&folder, &folder.join("src/Everything.cpp"), "robot_Everything");
        let printer = self.build(&folder, &folder.join("src/print.cpp"), "robot_print");
        let commander = self.commander(&folder, BIG_AND_PAIR);
        let mut line = Line::new();
        let device = format!("robot_Everything.device = {}\n", line.device.display());
        let start = |program: &Path| self.start(program, cid, &folder, &[]);
        let _supercomponent = self.supercomponent(cid, &folder, &device);
        let printer = start(&printer);
        let _application = start(&application);
        greet(&mut line, &boards[0]);
        std::thread::sleep(Duration::from_secs(1));
        line.say(&full_report(&boards[0]));
        for expected in [
            "S0 = true\n",
            "S2 = -128 (-64)\n",
            "S7 = 18446744073709551615",
            "A8 = [-9223372036854775808, -9223372036854775807, -9223372036854775806]",
            "A9 = [-0, -0.5, -1]",
            "S10 = 0.1",
        ] {
            printer.wait_for(expected);
        }
        let _commander = start(&commander);
        let expected = [
            (68, vec![Scalar::Unsigned(0x0123_4567_89AB_CDEF)]),
            (95, vec![Scalar::Signed(-300), Scalar::Signed(32_767)]),
        ];
        hear_commands(&mut line, &boards[0], &expected);
    }
}

#[test]
fn opendavinci2014_compiles() {
    if let Some(tree) = opendavinci2014() {
        tree.compile_all();
    }
}

#[test]
fn opendavinci2014_runs() {
    if let Some(tree) = opendavinci2014() {
        tree.run(&session(1));
    }
}

#[test]
fn opendavinci2014_shows_values_through_curves() {
    if let Some(tree) = opendavinci2014() {
        tree.shows(&session(6));
    }
}

#[test]
fn opendavinci_shows_values_through_curves() {
    if let Some(tree) = opendavinci() {
        tree.shows(&session(7));
    }
}

#[test]
fn opendavinci2014_comes_back() {
    if let Some(tree) = opendavinci2014() {
        tree.comes_back(&session(3));
    }
}

#[test]
fn opendavinci_comes_back() {
    if let Some(tree) = opendavinci() {
        tree.comes_back(&session(4));
    }
}

#[test]
fn opendavinci_compiles() {
    if let Some(tree) = opendavinci() {
        tree.compile_all();
    }
}

#[test]
fn opendavinci_runs() {
    if let Some(tree) = opendavinci() {
        tree.run(&session(2));
    }
}
