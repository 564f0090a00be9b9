//! Full disks: file systems in memory, with different sizes and numbers of files.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use sensedsl_tests::{RunOutput, missing};

use super::{Stage, asked, identity, nothing_beside, run};

/// A file system of the test's own, unmounted on drop.
struct Disk(PathBuf);

impl Disk {
    /// `None` if this user may not mount.
    fn new(at: PathBuf) -> Option<Self> {
        std::fs::create_dir_all(&at).unwrap();
        let disk = Self(at);
        disk.mount("size=64m,nr_inodes=10000").then_some(disk)
    }

    fn mount(&self, options: &str) -> bool {
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", options, "tmpfs"]).arg(&self.0);
        mount.stderr(Stdio::null()).status().is_ok_and(|status| status.success())
    }

    /// Leaves free space for this number of bytes and files.
    fn leave(&self, bytes: u64, files: u64) {
        let used = rustix::fs::statvfs(&self.0).unwrap();
        let size = (used.f_blocks - used.f_bfree) * used.f_frsize + bytes;
        let inodes = used.f_files - used.f_ffree + files;
        assert!(self.mount(&format!("remount,size={size},nr_inodes={inodes}")));
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}

#[test]
fn a_full_disk_leaves_the_old_tree() {
    let count = asked().map_or(4, |all| all / 15);
    let stage = Stage::new("disks");
    let mut full = 0;
    for number in 0..count {
        let Some(disk) = Disk::new(stage.scratch.join(&format!("disk{number}"))) else {
            missing("the right to mount a small disk (root has it)");
            return;
        };
        // Every fourth output folder is the disk itself, so that nothing can be created beside it.
        let is_disk = number % 4 == 3;
        let out = if is_disk { disk.0.clone() } else { disk.0.join("out") };
        let _ = run(&stage.designs[0], &out).exits(0);
        stage.settle_in(&out);
        let own = identity(&out);
        // The free space goes from nearly nothing to nearly enough, alternating between bytes and
        // files.
        let part = (number / 2 + 1) as u64;
        let parts = (count / 2 + 2) as u64;
        match number % 2 {
            0 => disk.leave(4096 + 400_000 * part / parts, 10_000),
            _ => disk.leave(10_000_000, 2 + 150 * part / parts),
        }
        let ran = run(&stage.designs[1], &out);
        full += usize::from(is_refused(&stage, &ran, &out));
        assert_eq!(identity(&out), own, "{number}");
        if !is_disk {
            nothing_beside(&out);
        }
        disk.leave(10_000_000, 10_000);
        let _ = run(&stage.designs[1], &out).exits(0);
        assert_eq!(stage.which(&out), 1, "{number}");
        assert_eq!(identity(&out), own, "{number}");
    }
    eprintln!("{count} disks: {full} were full, {} had room enough", count - full);
    assert!(full > count / 2, "{full} of {count} were full");
}

/// Whether the disk was full for the run; if not, the run has written the other tree.
#[track_caller]
fn is_refused(stage: &Stage, ran: &RunOutput, out: &Path) -> bool {
    let now = stage.which(out);
    match ran.status {
        0 => assert_eq!(now, 1),
        _ => {
            assert_eq!((ran.status, now), (2, 0), "{}", ran.stderr);
            assert!(ran.stderr.contains("error[E0509]"), "{}", ran.stderr);
            assert!(ran.stderr.contains("No space left on device"), "{}", ran.stderr);
            assert!(ran.stderr.contains("as it was before"), "{}", ran.stderr);
        }
    }
    ran.status != 0
}
