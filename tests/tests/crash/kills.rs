//! Signals at random moments while a run writes.

use std::fs;
use std::os::unix::process::ExitStatusExt as _;
use std::path::Path;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use sensedsl_tests::{Random, is_thorough, sensedsl};

use super::{Stage, asked, identity, nothing_beside, run, start};

/// How often the signal came at each stage of the run.
#[derive(Debug, Default)]
struct Met {
    /// The run was writing the new tree beside the old one.
    before: usize,
    /// The new tree already had the folder's name, and the old one was being replaced.
    within: usize,
    /// The new tree was complete, and the remains beside it were being removed.
    after: usize,
    /// The run had ended.
    late: usize,
}

/// The event from which the random moment is counted.
#[derive(Clone, Copy)]
enum Sign {
    /// Writing has begun: the lock exists.
    Locked,
    /// The new tree has taken the folder's name.
    Switched,
}

#[test]
fn signals_at_any_moment_of_writing() {
    let kills = asked().unwrap_or(if is_thorough() { 14 } else { 3 });
    let third = asked().map_or(if is_thorough() { 3 } else { 1 }, |all| all / 3);
    let stage = Stage::new("kills");
    let out = stage.out();
    let _ = run(&stage.designs[0], &out).exits(0);
    stage.settle_in(&out);
    let own = identity(&out);
    let mut random = Random::new(2026);
    for (signal, count) in [(Signal::KILL, kills), (Signal::TERM, third), (Signal::INT, third)] {
        let mut met = Met::default();
        let mut writing = Duration::from_millis(20);
        for number in 0..count {
            let old = stage.which(&out);
            let new = 1 - old;
            // Sometimes the user's folder of the other board has to be created again.
            if new == 1 && random.below(3) == 0 {
                let _ = fs::remove_dir_all(out.join("firmware/Rover/user"));
            }
            // Every third signal comes in the shortest stage, which the others seldom hit.
            let sign = if number % 3 == 2 { Sign::Switched } else { Sign::Locked };
            let now = one(&stage, new, signal, (sign, writing), &mut random, &mut met);
            assert!(now == old || now == new);
            assert_eq!(identity(&out), own, "{signal:?} {number}");
            let wanted = if random.below(2) == 0 { old } else { new };
            let check = sensedsl(["generate", "-q", "--check"]).arg(&stage.designs[now]);
            let _ = check.arg("-o").arg(&out).run().exits(0);
            let began = Instant::now();
            let _ = run(&stage.designs[wanted], &out).exits(0);
            // The duration of writing is estimated along the way, as other tests run at the same
            // time.
            if wanted != now {
                writing = (writing * 3 + began.elapsed()) / 4;
            }
            assert_eq!(stage.which(&out), wanted, "{signal:?} {number}");
            assert_eq!(identity(&out), own, "{signal:?} {number}");
            nothing_beside(&out);
        }
        eprintln!("{count} of {signal:?}: {met:?}");
        assert!(count < 100 || met.before + met.within + met.after > count / 2, "{met:?}");
    }
}

/// Starts a run, stops it while it writes, and returns which tree is there.
fn one(
    stage: &Stage,
    new: usize,
    signal: Signal,
    (sign, writing): (Sign, Duration),
    random: &mut Random,
    met: &mut Met,
) -> usize {
    let out = stage.out();
    let work = out.with_file_name(".out.sensedsl-work");
    let list = out.join(".sensedsl-files");
    let mut child = start(&stage.designs[new], &out);
    let pid = Pid::from_child(&child);
    let is_time = || match sign {
        Sign::Locked => work.exists(),
        Sign::Switched => is_link(&list),
    };
    let began = Instant::now();
    while !is_time() && began.elapsed() < Duration::from_secs(2) {
        std::thread::yield_now();
    }
    let span = match sign {
        Sign::Locked => writing,
        Sign::Switched => writing / 5,
    };
    let moment = span.as_micros() as usize * random.below(1000) / 1000;
    // Sleeping is too coarse for the shortest spans.
    let began = Instant::now();
    while began.elapsed() < Duration::from_micros(moment as u64) {
        std::hint::spin_loop();
    }
    let _ = kill_process(pid, signal);
    let ended = child.wait().unwrap();
    let now = stage.which(&out);
    let beside = out.with_file_name(".out.sensedsl-unfinished");
    if ended.signal().is_none() {
        assert!(ended.success() && now == new);
        met.late += 1;
    } else if is_link(&list) {
        assert_eq!(now, new);
        met.within += 1;
    } else if now == new {
        met.after += 1;
    } else {
        met.before += 1;
    }
    assert!(ended.signal().is_some() || !beside.exists());
    now
}

fn is_link(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_symlink())
}
