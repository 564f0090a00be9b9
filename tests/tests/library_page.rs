//! The examples of `docs/library.md`: the page must contain the code between the marks here.

use sensedsl_tests::{root, text};

// page: check
fn check(text: &str) -> Vec<String> {
    use sensedsl_diagnostics::render;
    use sensedsl_model::NoFiles;
    use sensedsl_session::{On, Workspace};

    let mut workspace = Workspace::default();
    workspace.open("robot.sense", text);
    let snapshot = workspace.snapshot("robot.sense", On { board: None, target: None }, &NoFiles);
    let found = snapshot.diagnostics().iter();
    found.map(|one| render::json_value(one, snapshot.sources()).to_string()).collect()
}
// end

// page: solve
fn solve(text: &str) -> Result<Vec<String>, Vec<String>> {
    use sensedsl_model::NoFiles;
    use sensedsl_session::{Ask, On, Workspace};

    let mut workspace = Workspace::default();
    workspace.open("robot.sense", text);
    let snapshot = workspace.snapshot("robot.sense", On { board: None, target: None }, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let Some((design, wiring)) = answer.wired() else {
        return Err(answer.diagnostics.iter().map(|one| one.message.clone()).collect());
    };
    let mut pins = Vec::new();
    for (board, _) in wiring.used(design) {
        for device in &board.devices {
            let name = design.device(device.device).map_or("?", |one| one.name.value.as_str());
            pins.extend(device.wires.iter().map(|wire| format!("{name}: {}", wire.pin)));
        }
    }
    Ok(pins)
}
// end

// page: generate
fn generate(text: &str) -> Vec<String> {
    use sensedsl_generate::{Selection, project};
    use sensedsl_model::NoFiles;
    use sensedsl_session::{Ask, On, Workspace};

    let mut workspace = Workspace::default();
    workspace.open("robot.sense", text);
    let snapshot = workspace.snapshot("robot.sense", On { board: None, target: None }, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let Some((design, wiring)) = answer.wired() else { return Vec::new() };
    let made = project("robot", design, wiring, &Selection::ALL);
    made.files.iter().map(|(path, file)| format!("{path}: {} bytes", file.bytes.len())).collect()
}
// end

// page: simulate
fn simulate(text: &str, world: &str) -> Vec<String> {
    use sensedsl_diagnostics::SourceMap;
    use sensedsl_job::jobs;
    use sensedsl_model::NoFiles;
    use sensedsl_session::{Ask, On, Workspace};
    use sensedsl_twin::bench::Bench;
    use sensedsl_twin::judge::Judge;
    use sensedsl_twin::soft::SoftBoard;
    use sensedsl_twin::world::{self, Scene};
    use sensedsl_wire::{Decoder, Direction, Event};

    let mut workspace = Workspace::default();
    workspace.open("robot.sense", text);
    let snapshot = workspace.snapshot("robot.sense", On { board: None, target: None }, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let Some((design, wiring)) = answer.wired() else { return Vec::new() };
    let Some(job) = jobs(design, wiring).next() else { return Vec::new() };
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: Some(1),
        samples: &|name| Err(format!("there is no {name}")),
    };
    let file = SourceMap::default().add("world.toml", world);
    let (world, _) = world::read(file, world, &scene);
    let bench = Bench::new(&job, &world, 1);
    let mut judge = Judge::new(&job, &bench);
    let mut board = SoftBoard::new(&job, bench);
    let mut decoder = Decoder::new(&job.schema, Direction::Sensor);
    const END_NS: u64 = 5_000_000_000;
    while board.now_ns() < END_NS {
        board.run_until(board.now_ns() + 1_000_000);
        let now_ns = board.now_ns();
        decoder.feed(&board.link_read(), |event| {
            if let Event::Report(_, values) = event {
                judge.take(now_ns, &values);
            }
        });
    }
    let judged = judge.finish(END_NS).into_iter();
    judged.map(|one| format!("{}: {} values, {} wrong", one.name, one.reports, one.wrong)).collect()
}
// end

const ROBOT: &str = "board STM32F407G_DISC1 {
    sensor Light returns uint16 { type = analog; delay = 100; }
    sensor Wheel returns int32 { type = encoder; delay = 20; }
}
";

#[test]
fn the_examples_do_what_the_page_says() {
    let reported = check(
        "board STM32F407G_DISC1 { sensor Light returns uint16 { type = analog; pin = PZ9; } }",
    );
    assert!(reported.iter().any(|one| one.contains("PZ9")), "{reported:?}");
    let pins = solve(ROBOT).unwrap();
    assert_eq!(pins.len(), 3, "{pins:?}");
    assert!(solve(&ROBOT.replace("encoder;", "encoder; pin = PE0;")).is_err());
    let files = generate(ROBOT);
    assert!(
        files.iter().any(|one| one.starts_with("firmware/STM32F407G_DISC1/Makefile: ")),
        "{files:?}"
    );
    let judged = simulate(ROBOT, "[devices]\nLight = 1200\n");
    assert!(
        judged.iter().any(|one| one.starts_with("Light: ") && one.ends_with(" 0 wrong")),
        "{judged:?}"
    );
}

#[test]
fn the_page_has_these_examples() {
    let (page, own) = (text("docs/library.md"), include_str!("library_page.rs"));
    assert!(root().join("docs/library.md").is_file());
    let mut count = 0;
    for part in own.split("\n// page: ").skip(1) {
        let (name, rest) = part.split_once('\n').unwrap();
        let Some((code, _)) = rest.split_once("\n// end") else { continue };
        assert!(
            page.contains(&format!("```rust\n{code}\n```")),
            "docs/library.md: {name} is another one"
        );
        count += 1;
    }
    assert_eq!(count, 4);
}
