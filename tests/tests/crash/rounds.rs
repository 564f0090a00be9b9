//! Four runs at the same time, with a check of the folder after each round.

use sensedsl_tests::is_thorough;

use super::{Stage, asked, identity, nothing_beside, run, start};

#[test]
fn runs_at_the_same_time_follow_one_another() {
    let rounds = asked().map_or(if is_thorough() { 3 } else { 1 }, |all| all / 3);
    let stage = Stage::new("rounds");
    let out = stage.out();
    let _ = run(&stage.designs[0], &out).exits(0);
    stage.settle_in(&out);
    let own = identity(&out);
    let mut ended = [0, 0];
    for round in 0..rounds {
        let runs: Vec<_> = (0..4).map(|which| start(&stage.designs[which % 2], &out)).collect();
        for run in runs {
            let ran = run.wait_with_output().unwrap();
            assert!(ran.status.success(), "{round}: {}", String::from_utf8_lossy(&ran.stderr));
        }
        ended[stage.which(&out)] += 1;
        assert_eq!(identity(&out), own, "{round}");
        nothing_beside(&out);
    }
    eprintln!("{rounds} rounds of 4 runs: {ended:?} ended with the first and the second design");
}

#[test]
fn runs_at_the_same_time_make_a_folder_that_was_not_there() {
    let stage = Stage::new("first");
    for _ in 0..asked().map_or(1, |all| all / 10) {
        let _ = std::fs::remove_dir_all(stage.out());
        let runs: Vec<_> =
            (0..4).map(|which| start(&stage.designs[which % 2], &stage.out())).collect();
        for run in runs {
            let ran = run.wait_with_output().unwrap();
            assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
        }
        let _ = stage.which(&stage.out());
        nothing_beside(&stage.out());
    }
}
