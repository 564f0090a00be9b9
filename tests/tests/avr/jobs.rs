//! A board's job on the emulated AVR: the bench answers what the program asks, and faults of the world reach it.

use sensedsl_diagnostics::SourceMap;
use sensedsl_job::BoardJob;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::trial::Tested;
use sensedsl_twin::world::{self, Scene};

use super::board::AvrBoard;
use super::child::{Reset, Serial, Setting};
use super::tools::{is_possible, program};
use super::units::MS;
use crate::embassy::with_job;

/// The program sends what its converter gives for A0 and A6, of which the latter is no port's.
const LIGHTS: &str = "board ARDUINO_NANO {
    link { transport = uart; baud = 250000; }
    sensor Light returns uint16 { id = 1; type = analog; pin = PC0; }
    sensor Dark returns uint16 { id = 2; type = analog; pin = ADC6; }
}";
/// The program reads a register of two bytes.
const CHIP: &str = "board ARDUINO_NANO {
    link { transport = uart; baud = 250000; }
    sensor Range returns uint16 { id = 1; type = i2c; address = 0x50; register = 7; length = 2; }
}";

fn bench(job: &BoardJob<'_>, text: &str) -> Bench {
    let file = SourceMap::default().add("world.toml", text);
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: None,
        samples: &|_| Err("there are no files".to_owned()),
    };
    let (world, mistakes) = world::read(file, text, &scene);
    assert!(mistakes.is_empty(), "{mistakes:?}");
    Bench::new(job, &world, 1)
}

fn read(board: &mut AvrBoard, to_ms: u64) -> Vec<u8> {
    Tested::run_until(board, to_ms * MS);
    board.link_read()
}

/// Full scale is 4,095 on the bench, and 1,023 on this MCU.
#[test]
fn a_converter_measures_the_world() {
    if !is_possible() {
        return;
    }
    with_job(LIGHTS, None, |job| {
        let bench = bench(job, "[devices]\nLight = 1000\nDark = 4095");
        let mut board = AvrBoard::new(job, bench, &program("adc"));
        let sent = read(&mut board, 10);
        assert!(sent.len() >= 40, "{sent:?}");
        for four in sent.chunks_exact(4) {
            let [light, dark] = [[four[0], four[1]], [four[2], four[3]]].map(u16::from_le_bytes);
            assert!(light.abs_diff(250) <= 1 && dark == 1_023, "{light}, {dark}");
        }
        let serial = Serial { baud: 250_000, data_bits: 8, odd_parity: None, stop_bits: 1 };
        assert_eq!(board.ports()[&('u', 0)], Setting::Serial(serial));
        // The watchdog is not started.
        read(&mut board, 2_600);
        assert_eq!(board.unwatched().as_deref(), Some("does not run"));
        assert_eq!(board.stopped(), None);
    });
}

/// While something holds a wire of the bus nothing is read, and then it is again; without supply nothing is sent.
#[test]
fn faults_of_the_world_reach_the_program() {
    if !is_possible() {
        return;
    }
    let world = "[devices]\nRange = 16961\n[[fault]]\nkind = \"stuck_sda\"\ndevice = \"Range\"\nat = \"100 ms\"\nfor = \"100 ms\"\n[[fault]]\nkind = \"reset\"\nat = \"300 ms\"\nfor = \"50 ms\"";
    with_job(CHIP, None, |job| {
        let mut board = AvrBoard::new(job, bench(job, world), &program("i2c"));
        let has_read = |sent: &[u8]| sent.windows(4).any(|four| four == [0x50, 0x42, 0x58, 0x41]);
        let sent = read(&mut board, 99);
        assert!(has_read(&sent) && !sent.contains(&0xEE), "{sent:02x?}");
        read(&mut board, 110);
        let sent = read(&mut board, 190);
        assert!(!has_read(&sent) && sent.contains(&0xEE), "{sent:02x?}");
        read(&mut board, 210);
        let sent = read(&mut board, 299);
        assert!(has_read(&sent), "{sent:02x?}");
        read(&mut board, 301);
        assert_eq!(read(&mut board, 349), <[u8; 0]>::default());
        let sent = read(&mut board, 400);
        assert!(has_read(&sent), "{sent:02x?}");
        let resets = board.resets();
        assert!(matches!(resets, [Reset { cause: Reset::POWER, .. }]), "{resets:?}");
    });
}
