//! Strips of LEDs and a display as firmware for both targets: what people see is what the host says; and mistakes put
//! into the generated C, which the judge must notice.

use std::path::Path;

use sensedsl_tests::{read, root};
use sensedsl_twin::bench::Bench;
use sensedsl_twin::commands::Commands;
use sensedsl_twin::emulated::EmulatedBoard;
use sensedsl_twin::world::World;
use sensedsl_wire::encode_hello_request;

use super::bench::{MS, folder};
use super::seeded::made;
use super::trial::System;
use crate::embassy::with_job;
use crate::firmware::chibios::tree;

const SECONDS: u64 = 4;

/// The design, on a Discovery board and on a Nucleo whose buses have other clocks.
fn design(board: &str) -> String {
    let text = read(&root().join("tests/firmware/lamps.sense"));
    text.replacen("board BOARD {", &format!("board {board} {{"), 1)
}

/// The actuators that do not do what the host says, each with the first difference.
fn wrong(system: System, text: &str, image: &[u8]) -> Vec<(String, String)> {
    with_job(text, system.target(), |job| {
        let bench = Bench::new(job, &World::default(), 1);
        let mut commands = Commands::new(job, &bench, SECONDS * 1_000 * MS);
        let mut board = EmulatedBoard::new(job, bench, image).unwrap();
        for ms in 1..=SECONDS * 1_000 {
            if ms == 300 {
                board.link_write(&encode_hello_request(&job.schema));
            }
            board.link_write(&commands.host(ms * MS, ms >= 400));
            board.run_until(ms * MS);
            assert!(board.halt().is_none(), "{:?}", board.halt());
            assert_eq!(board.mismatches().len(), 0);
            if commands.looks(ms * MS) {
                commands.look(ms * MS, &board.outputs());
            }
        }
        let all = commands.finish();
        assert!(all.iter().all(|one| one.commands >= 5 && one.looks >= 5), "{all:#?}");
        let wrong = all.into_iter().filter(|one| one.wrong > 0);
        wrong.map(|one| (one.name.clone(), format!("{one:?}"))).collect()
    })
}

fn shows(system: System, board: &str) {
    let text = design(board);
    let Some(image) = system.image(&format!("lamps_{board}_{system:?}"), &text) else { return };
    assert_eq!(wrong(system, &text, &image), []);
}

#[test]
fn a_discovery_with_chibios_shows_what_it_is_told() {
    shows(System::Chibios, "STM32F407G_DISC1");
}

#[test]
fn a_discovery_with_embassy_shows_what_it_is_told() {
    shows(System::Embassy, "STM32F407G_DISC1");
}

#[test]
fn an_f103_with_chibios_shows_what_it_is_told() {
    shows(System::Chibios, "NUCLEO_F103RB");
}

/// A file of a board's folder, what stands in it, what is put in its place, and who must notice.
const MISTAKES: [(&str, &str, &str, &str); 5] = [
    ("core/up_lamps.c", "how->elements[place]", "how->elements[how->words - 1U - place]", "Ring"),
    ("core/up_lamps.c", "how->word_bytes : how->low", "how->word_bytes : how->low + 1U", "Ring"),
    ("core/up_lamps.c", "#define REST_BYTES 40U", "#define REST_BYTES 4U", "Ring"),
    ("core/up_lamps.c", "return 2U * LED_START_BYTES", "return 1U * LED_START_BYTES", "Bar"),
    ("core/up_letters.c", "[i * UP_LETTER_COLUMNS], col", "[i * 5U], col", "Title"),
];

/// The actuators that the judge blames once the mistake is made.
fn blamed(
    (tree, board): (&Path, &Path),
    text: &str,
    (file, from, to): (&str, &str, &str),
) -> Vec<String> {
    let path = board.join("uproxy").join(file);
    let right = read(&path);
    assert!(right.contains(from), "{file}: {from}");
    std::fs::write(&path, right.replacen(from, to, 1)).unwrap();
    let image = made(tree, board);
    std::fs::write(&path, right).unwrap();
    wrong(System::Chibios, text, &image.unwrap()).into_iter().map(|(name, _)| name).collect()
}

#[test]
fn a_mistake_in_a_frame_is_noticed() {
    let Some(tree) = tree() else { return };
    let text = design("STM32F407G_DISC1");
    let board = folder("lamps_seeded", &text);
    for (file, from, to, name) in MISTAKES {
        let blamed = blamed((&tree, &board), &text, (file, from, to));
        assert!(blamed.iter().any(|one| one == name), "{from}: {blamed:?}");
    }
}
