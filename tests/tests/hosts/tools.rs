//! Finding and running this machine's programs.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// The tree that the environment variable names; without it the test is skipped, with a notice.
pub(crate) fn tree(variable: &str) -> Option<PathBuf> {
    let path = std::env::var(variable).ok().map(PathBuf::from);
    if path.is_none() {
        eprintln!("SKIPPED: {variable} names no tree");
    }
    path
}

/// A program in the background that ends with the test.
pub(crate) struct Background {
    pub(crate) child: Child,
    /// The file with its output.
    log: PathBuf,
}

impl Background {
    /// Starts it, with its output in a file in `folder`.
    pub(crate) fn start(command: &mut Command, folder: &Path) -> Self {
        Self::start_with(command, folder, |output| output.try_clone().unwrap())
    }

    /// Like [`Self::start`], with standard error in a file named `errors`.
    #[cfg(feature = "machine")]
    pub(crate) fn start_apart(command: &mut Command, folder: &Path, errors: &str) -> Self {
        Self::start_with(command, folder, |_| File::create(folder.join(errors)).unwrap())
    }

    fn start_with(command: &mut Command, folder: &Path, errors: impl Fn(&File) -> File) -> Self {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let log = folder.join(format!("log{}.txt", NUMBER.fetch_add(1, Ordering::Relaxed)));
        let file = File::create(&log).unwrap();
        let errors = errors(&file);
        let child = command.stdin(Stdio::null()).stdout(file).stderr(errors).spawn();
        Self { child: child.unwrap_or_else(|error| panic!("{command:?}: {error}")), log }
    }

    /// Its output so far.
    pub(crate) fn output(&self) -> String {
        String::from_utf8_lossy(&std::fs::read(&self.log).unwrap()).into_owned()
    }

    /// Waits until it has ended; `None` if a signal ended it.
    pub(crate) fn exit_status(&mut self) -> Option<i32> {
        let start = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.code();
            }
            assert!(start.elapsed() < Duration::from_secs(30), "goes on:\n{}", self.output());
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Waits until it has printed `text`.
    pub(crate) fn wait_for(&self, text: &str) {
        let start = Instant::now();
        while !self.output().contains(text) {
            assert!(
                start.elapsed() < Duration::from_secs(30),
                "no {text:?} in:\n{}",
                self.output()
            );
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Background {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
