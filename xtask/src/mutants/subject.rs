//! A design for a target: its generated folder, its build, and the behaviour of the program without a mistake.

use std::hash::{Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use anyhow::{Context as _, Result, ensure};

use sensedsl_wire::Schema;

use super::draw::{self, Site};
use super::same::{self, Seen};

/// The time in seconds after which a run is stopped and does not count.
const PATIENCE_S: &str = "240";
/// The exit status of a run that was stopped.
const OUT_OF_TIME: i32 = 124;
/// The board whose MCU is emulated.
const EMULATED: &str = "STM32F407G_DISC1";
/// The class of an image that has to be run.
const IMAGE: &str = "image";
const TRIPLE: &str = "thumbv7em-none-eabihf";

/// The settings that all subjects share.
pub(super) struct Settings {
    /// The `sensedsl` program with an emulated MCU.
    pub(super) program: PathBuf,
    pub(super) seconds: String,
    pub(super) scratch: PathBuf,
    /// Whether images are only built and kept, but not run.
    pub(super) is_building: bool,
}

/// One design for one target.
pub(super) struct Subject<'a> {
    settings: &'a Settings,
    /// The name in the table.
    pub(super) name: String,
    design: PathBuf,
    /// A world with faults, for mistakes that change nothing in one without.
    world: Option<PathBuf>,
    pub(super) is_rust: bool,
    pub(super) board: PathBuf,
    /// The sites in generated files, and those in the runtime.
    pub(super) groups: [Vec<Site>; 2],
    schema: Schema,
    right: Vec<u8>,
    /// The output in the usual world, and in the design's own.
    seen: Vec<Seen>,
}

/// The message of the command, and the output of the MCU.
struct Run {
    log: Option<String>,
    is_out_of_time: bool,
    seen: Seen,
}

impl<'a> Subject<'a> {
    /// Generates, builds and runs the program without a mistake.
    pub(super) fn new(
        settings: &'a Settings,
        file: &Path,
        is_rust: bool,
        embassy: &Path,
    ) -> Result<Self> {
        let stem = file.file_stem().context("a design has a name")?.to_string_lossy().into_owned();
        let folder = settings.scratch.join(format!("{stem}-{}", target(is_rust)));
        std::fs::create_dir_all(&folder)?;
        let design = folder.join(format!("{stem}.sense"));
        std::fs::write(&design, on_emulated(&std::fs::read_to_string(file)?))?;
        let short = stem.strip_prefix("miniature_").unwrap_or(&stem);
        let world = file.with_file_name("worlds").join(format!("{short}.toml"));
        let world = world.is_file().then_some(world);
        let schema = same::schema(&design, target(is_rust))?;
        let mut subject = Self {
            settings,
            name: stem,
            design,
            world,
            is_rust,
            board: PathBuf::new(),
            groups: Default::default(),
            schema,
            right: Vec::new(),
            seen: Vec::new(),
        };
        subject.board = subject.generate(&folder)?;
        let built = subject.build(embassy)?;
        ensure!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        subject.right = subject.flash()?;
        subject.groups = subject.sites()?;
        let image = subject.image();
        let worlds = if settings.is_building { Vec::new() } else { subject.worlds() };
        let runs: Result<Vec<Run>> =
            worlds.into_iter().map(|world| subject.run(world, &image)).collect();
        for run in runs? {
            let name = &subject.name;
            ensure!(!run.is_out_of_time, "{name}: the program without a mistake takes too long");
            ensure!(run.log.is_none(), "{name}: a false alarm: {}", run.log.unwrap_or_default());
            subject.seen.push(run.seen);
        }
        Ok(subject)
    }

    /// The usual world, and the example's own.
    fn worlds(&self) -> Vec<Option<&Path>> {
        let own = self.world.as_deref().map(Some);
        [None].into_iter().chain(own).collect()
    }

    /// Generates the firmware, and returns the folder of the design's first board.
    fn generate(&self, folder: &Path) -> Result<PathBuf> {
        let folder = folder.join("out");
        let mut generate = Command::new(&self.settings.program);
        generate.arg("generate").arg(&self.design).args(["--target", target(self.is_rust), "-o"]);
        let output = generate.arg(&folder).output()?;
        ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = std::fs::read_to_string(&self.design)?;
        let board = text.lines().find_map(|line| line.strip_prefix("board "));
        let board = board.and_then(|rest| rest.split([' ', '{']).next());
        Ok(folder.join("firmware").join(board.context("a design has a board")?))
    }

    fn build(&self, embassy: &Path) -> Result<Output> {
        if !self.is_rust {
            let tree = std::env::var("CHIBIOS").context("CHIBIOS names the tree")?;
            let mut make = Command::new("make");
            make.args(["-j2", "UP_MODE=production", "USE_LTO=no"]).arg(format!("CHIBIOS={tree}"));
            return Ok(make.current_dir(&self.board).output()?);
        }
        // All projects have the same name: cargo would take another project's program for this one's.
        let main = std::fs::File::options().append(true).open(self.board.join("src/main.rs"))?;
        main.set_modified(std::time::SystemTime::now())?;
        let mut cargo = Command::new("cargo");
        cargo.args(["build", "--release", "-Zbuild-std=core", "--locked"]);
        cargo.arg("--target-dir").arg(embassy);
        let linker = format!("target.{TRIPLE}.linker=\"arm-none-eabi-ld\"");
        // As in the tests: link-time optimisation takes long and changes no behaviour.
        for setting in [&linker, "profile.release.lto=false", "profile.release.codegen-units=16"] {
            cargo.args(["--config", setting]);
        }
        cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", "/usr/bin/rustc").env_remove("RUSTFLAGS");
        let output = cargo.current_dir(&self.board).output()?;
        if output.status.success() {
            let built = embassy.join(TRIPLE).join("release/firmware");
            let _ = std::fs::copy(built, self.image())?;
        }
        Ok(output)
    }

    /// The program that was built last.
    fn image(&self) -> PathBuf {
        if self.is_rust {
            self.design.with_extension("elf")
        } else {
            self.board.join("build/production/sense.elf")
        }
    }

    /// The contents of the flash.
    fn flash(&self) -> Result<Vec<u8>> {
        let to = self.design.with_extension("bin");
        let mut copy = Command::new("arm-none-eabi-objcopy");
        copy.args(["-O", "binary"]).arg(self.image()).arg(&to);
        ensure!(copy.status()?.success(), "objcopy failed");
        Ok(std::fs::read(to)?)
    }

    /// Runs the command in a world; it prints nothing if all is well.
    fn run(&self, world: Option<&Path>, image: &Path) -> Result<Run> {
        let [wires, frames] = ["wires", "frames"].map(|name| self.design.with_extension(name));
        let mut simulate = Command::new("timeout");
        simulate.arg(PATIENCE_S).arg(&self.settings.program).arg("simulate").arg(&self.design);
        simulate.args(["--target", target(self.is_rust), "--judge"]);
        simulate.args(["--seconds", &self.settings.seconds]);
        simulate.arg("--wires").arg(&wires).arg("--frames").arg(&frames);
        if let Some(world) = world {
            simulate.arg("--world").arg(world);
        }
        for file in [&wires, &frames] {
            let _ = std::fs::remove_file(file);
        }
        let output = simulate.arg("--firmware").arg(image).output()?;
        let seen = Seen {
            frames: std::fs::read(&frames).unwrap_or_default(),
            wires: std::fs::read_to_string(&wires).unwrap_or_default(),
        };
        let is_out_of_time = output.status.code() == Some(OUT_OF_TIME);
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let first = text.lines().find(|line| line.starts_with("error"));
        let log = first.unwrap_or("the command has ended without a word").to_owned();
        Ok(Run { log: (!output.status.success()).then_some(log), is_out_of_time, seen })
    }

    /// All sites: those in generated files, and those in the runtime.
    fn sites(&self) -> Result<[Vec<Site>; 2]> {
        let board = &self.board;
        if !self.is_rust {
            let of = |folder: &str| draw::below(&board.join(folder), "c");
            return Ok([of("generated")?, of("uproxy")?]);
        }
        let own = draw::below(&board.join("src"), "rs")?;
        let mut runtime = draw::below(&board.join("sense-embassy/src"), "rs")?;
        runtime.extend(draw::below(&board.join("sense-rt/src"), "rs")?);
        Ok([own, runtime])
    }

    /// The result for a mistake: a class, and the command's message.
    pub(super) fn outcome(&self, site: &Site, embassy: &Path) -> Result<(String, String)> {
        let kept = self.kept(site)?;
        let class = kept.with_extension("class");
        if !class.is_file() {
            let text = std::fs::read_to_string(&site.file)?;
            std::fs::write(&site.file, site.made(&text))?;
            let made = self.made(&kept, embassy);
            std::fs::write(&site.file, text)?;
            std::fs::write(&class, made?)?;
        }
        let class = std::fs::read_to_string(class)?;
        if class != IMAGE || self.settings.is_building {
            return Ok((class, String::new()));
        }
        let (class, log) = self.tried(&kept)?;
        Ok((class.to_owned(), log))
    }

    /// The path at which the image with a mistake is kept: the judge changes more often than the firmware that it
    /// judges.
    fn kept(&self, site: &Site) -> Result<PathBuf> {
        let mut hasher = std::hash::DefaultHasher::new();
        std::fs::read_to_string(&site.file)?.hash(&mut hasher);
        format!("{site:?}").hash(&mut hasher);
        let folder = self.settings.scratch.join("images");
        std::fs::create_dir_all(&folder)?;
        let name = format!("{}-{}-{:016x}.elf", self.name, target(self.is_rust), hasher.finish());
        Ok(folder.join(name))
    }

    /// Builds a program with a mistake, and keeps the image. Returns the class.
    fn made(&self, kept: &Path, embassy: &Path) -> Result<&'static str> {
        let built = self.build(embassy)?;
        let log = String::from_utf8_lossy(&built.stderr).into_owned();
        if !built.status.success() || log.contains("warning") {
            return Ok("compiler");
        }
        if self.flash()? == self.right {
            return Ok("same program");
        }
        let _ = std::fs::copy(self.image(), kept)?;
        Ok(IMAGE)
    }

    /// The command's message in the usual world; if there is none, whether the behaviour differs at all.
    fn tried(&self, image: &Path) -> Result<(&'static str, String)> {
        let mut what = None;
        for (world, right) in self.worlds().into_iter().zip(&self.seen) {
            let run = self.run(world, image)?;
            if run.is_out_of_time {
                return Ok(("late", String::new()));
            }
            match run.log {
                Some(log) if world.is_none() => return Ok(("command", log)),
                Some(log) => return Ok(("nobody", format!("in the example's world: {log}"))),
                None => what = what.or_else(|| same::differ(&self.schema, right, &run.seen)),
            }
        }
        Ok(what.map_or(("same behaviour", String::new()), |what| ("nobody", what)))
    }
}

pub(super) const fn target(is_rust: bool) -> &'static str {
    if is_rust { "embassy" } else { "chibios" }
}

/// The design, on the board whose MCU is emulated.
fn on_emulated(text: &str) -> String {
    let mut lines = Vec::new();
    for line in text.lines() {
        let moved = line.split_once(" on ").filter(|_| line.starts_with("board "));
        match moved {
            Some((board, _)) => lines.push(format!("{board} on {EMULATED} {{")),
            // Its link is USB, which has no baud rate.
            None if line.trim_start().starts_with("link { baud") => {}
            None => lines.push(line.to_owned()),
        }
    }
    lines.join("\n") + "\n"
}
