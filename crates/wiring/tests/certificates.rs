#![allow(clippy::unwrap_used)]
#[path = "../../solve/tests/support/mod.rs"]
mod support;
use sensedsl_wiring::certificate::{AlternativeLabels, Claim, Labels, certify};
use sensedsl_wiring::solver::{Options, Outcome, problem::{Problem, Holder}, solve};
use std::time::Instant;
use support::generate::{self, Mix};

/// Names made of numbers alone.
fn numbered(problem: &Problem) -> Labels {
    let list = |word: &str, count: usize| -> Vec<String> {
        (0..count).map(|number| format!("{word}{number}")).collect()
    };
    let alternatives = problem.devices.iter().map(|device| {
        let names = list("way", device.alternatives.len()).into_iter();
        let all = names.zip(&device.alternatives).map(|(name, alternative)| {
            AlternativeLabels { name, roles: list("wire", alternative.roles.len()) }
        });
        all.collect()
    });
    let all = || problem.devices.iter().flat_map(|device| &device.alternatives);
    let candidates = || all().flat_map(|one| &one.roles).flat_map(|role| &role.candidates);
    let signals = candidates().map(|one| (one.signal.0, format!("signal{}", one.signal.0)));
    let claims = all().flat_map(|one| &one.claims).chain(candidates().flat_map(|one| &one.claims));
    let holders = claims.map(|claim| claim.holder).chain(candidates().map(|one| one.holder));
    let groups = holders.map(|holder| match holder {
        Holder::Own => 0,
        Holder::Group(group) => group as usize + 1,
    });
    Labels {
        boards: list("board", problem.boards.len()),
        pins: list("pin", problem.pins.len()),
        devices: list("device", problem.devices.len()),
        alternatives: alternatives.collect(),
        signals: signals.collect(),
        resources: list("resource", problem.resources as usize),
        groups: list("group", groups.max().unwrap_or(0)),
        rules: list("rule", problem.rules as usize),
        dma: list("user", problem.dma.len()),
        streams: list("stream", problem.streams as usize),
    }
}

#[test]
#[ignore]
fn measure() {
    let only = std::env::var("FAMILY").ok();
    for (name, boards, pins, mix, dma) in [
        ("g50", 1, 50, Mix::General, false),
        ("g100", 1, 100, Mix::General, false),
        ("t100", 1, 100, Mix::Timers, false),
        ("d100", 1, 100, Mix::Dma, true),
        ("t50", 1, 50, Mix::Timers, false),
        ("2x82", 2, 82, Mix::General, false),
        ("3x82", 3, 82, Mix::General, false),
    ] {
        if only.as_ref().is_some_and(|o| o != name) { continue; }
        for n in [8, 12, 16, 24] {
            let mut times = vec![];
            let mut failed = 0;
            let mut inf = 0;
            let mut bytes = 0;
            let mut ver = 0.0;
            let mut leaves = vec![];
            for seed in 0..10u64 {
                let tables: Vec<String> = (0..boards).map(|b| generate::table(seed + 1 + b * 77, pins)).collect();
                let tables: Vec<(&str, bool)> = tables.iter().map(|t| (t.as_str(), false)).collect();
                let b = generate::problem(seed, &tables, n, mix, dma);
                let (p, l) = (&b.problem, numbered(&b.problem));
                let deadline = Instant::now();
                let stop = || deadline.elapsed().as_secs_f64() > 20.0;
                let out = solve(p, &Options { any: false, stop: Some(&stop) }).unwrap();
                let c = match &out {
                    Outcome::Solved(a) => Claim::Best(a),
                    Outcome::Infeasible(c) => {
                        inf += 1;
                        Claim::NoWiring(&c.devices)
                    }
                    _ => { println!("  {name} {n} {seed} unsolved"); continue; }
                };
                let t = Instant::now();
                let stop = || t.elapsed().as_secs_f64() > 10.0;
                match certify(p, &l, c, Some(&stop)) {
                    Ok(text) => {
                        times.push(t.elapsed().as_secs_f64() * 1e3);
                        bytes = bytes.max(text.len());
                        leaves.push(text.matches("\"leaf\"").count());
                        let t = Instant::now();
                        sensedsl_proof::verify(&sensedsl_proof::read(&text).unwrap()).unwrap();
                        ver = f64::max(ver, t.elapsed().as_secs_f64() * 1e3);
                    }
                    Err(e) => {
                        failed += 1;
                        println!(
                            "  {name} {n} {seed} {e:?} {:?} {:.0}ms",
                            match c { Claim::Best(a) => format!("{:?}", a.objective), Claim::NoWiring(d) => format!("{d:?}") },
                            t.elapsed().as_secs_f64() * 1e3
                        );
                    }
                }
            }
            times.sort_by(f64::total_cmp);
            leaves.sort();
            println!(
                "{name:5} n={n:2} failed {failed} inf {inf} median {:.1} max {:.0} ms, leaves {} max {}, bytes {bytes} verify max {ver:.0} ms",
                times.get(times.len() / 2).unwrap_or(&0.),
                times.last().unwrap_or(&0.),
                leaves.get(leaves.len() / 2).unwrap_or(&0),
                leaves.last().unwrap_or(&0)
            );
        }
    }
}
