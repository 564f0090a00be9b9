//! Where the boards of tests run: in this program, as an image on an emulated MCU, or for real at a port.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::Result;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0539_board_of_test as no_board;
use sensedsl_host::port::{Port, usb_ports};
use sensedsl_job::BoardJob;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::trial::{Culprit, Stopped, Tested};

use super::bed::Bed;
use crate::commands::input;
use crate::commands::monitor::cure;
use crate::commands::simulate::{tested_image, usual_code};
use crate::files::shown;

/// An image on the emulated MCU.
pub(super) fn image(
    bed: &Bed<'_>,
    (job, bench): (&BoardJob<'_>, Bench),
    path: Option<&Path>,
) -> Result<Result<Box<dyn Tested>, Box<Diagnostic>>> {
    let at = input::place(bed.design);
    let path = match path {
        Some(path) => path.to_path_buf(),
        None => {
            let folder = usual_code(&bed.args.file, &job.board.name.value);
            match built_in(&folder) {
                Some(path) => path,
                None => {
                    let name = &job.board.name.value;
                    return Ok(Err(no_board::no_image(at, name, &shown(&folder)).into()));
                }
            }
        }
    };
    tested_image((job, at), bench, &path)
}

/// The image that `build` has made of a firmware's folder.
fn built_in(folder: &Path) -> Option<PathBuf> {
    let of_make = folder.join("build/development/sense.elf");
    let of_cargo = std::fs::read_dir(folder.join("target")).ok();
    let of_cargo = of_cargo.into_iter().flatten().flatten().map(|one| one.path());
    let mut of_cargo: Vec<PathBuf> = of_cargo.map(|one| one.join("release/firmware")).collect();
    of_cargo.sort();
    [of_make].into_iter().chain(of_cargo).find(|path| path.is_file())
}

/// A real board.
pub(super) fn port(
    bed: &Bed<'_>,
    job: &BoardJob<'_>,
    path: &str,
) -> Result<Box<dyn Tested>, Box<Diagnostic>> {
    let baud = bed.args.baud.unwrap_or(job.board.link.baud);
    match Port::open(path, baud) {
        Ok(port) => Ok(Box::new(RealBoard::new(port))),
        Err(why) => {
            let ports: Vec<String> = usb_ports().into_iter().map(|(name, _)| name).collect();
            let at = input::place(bed.design);
            let (name, cured) = (shown(Path::new(path)), cure(&why, path, &ports));
            Err(no_board::not_opened(at, &name, &why.to_string(), &cured).into())
        }
    }
}

/// A board at a port, in real time.
struct RealBoard {
    port: Port,
    began: Instant,
    now_ns: u64,
    inbox: Vec<u8>,
    lost: Option<String>,
}

impl RealBoard {
    fn new(port: Port) -> Self {
        Self { port, began: Instant::now(), now_ns: 0, inbox: Vec::new(), lost: None }
    }
}

impl Tested for RealBoard {
    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn run_until(&mut self, until_ns: u64) {
        self.now_ns = until_ns;
        let until = Duration::from_nanos(until_ns);
        while self.lost.is_none() {
            let left = until.saturating_sub(self.began.elapsed());
            if left.is_zero() {
                return;
            }
            match self.port.read(left) {
                Ok(bytes) => self.inbox.extend(bytes),
                Err(why) => self.lost = Some(why.to_string()),
            }
        }
    }

    fn link_open(&mut self) {
        self.began = Instant::now();
    }

    fn link_write(&mut self, bytes: &[u8]) {
        if bytes.is_empty() {
            return;
        }
        if let Err(why) = self.port.write(bytes) {
            self.lost = Some(why.to_string());
        }
    }

    fn link_read(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.inbox)
    }

    fn stopped(&mut self) -> Option<Stopped> {
        let why = self.lost.take()?;
        Some(Stopped { at_ns: self.now_ns, culprit: Culprit::Board, why })
    }
}
