//! A board's job on the emulated AVR: the bench answers what the program asks, and faults of the world reach it.

use sensedsl_surroundings::TimerOutput;
use sensedsl_twin::trial::Tested;

use super::board::AvrBoard;
use super::child::{Reset, Serial, Setting};
use super::tools::{is_possible, program};
use super::trial::bench;
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

/// The program sends pulses of 1.5 ms, and after a tenth of a second of 2 ms.
const SERVO: &str = "board ARDUINO_UNO_R3 {
    actuator Servo accepts uint16 { id = 1; type = pwm; pin = PB1; frequency = 50 Hz; }
}";

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
        // The program waits, but does not sleep.
        assert_eq!(board.worked_ns(), board.now_ns());
    });
}

#[test]
fn pulses_are_those_of_their_device() {
    if !is_possible() {
        return;
    }
    with_job(SERVO, None, |job| {
        let mut board = AvrBoard::new(job, bench(job, ""), &program("pwm"));
        for (to_ms, width_ns) in [(90, 1_500_000), (190, 2_000_000)] {
            read(&mut board, to_ms);
            let pulses = Tested::outputs(&board).unwrap().pulses(job.connections[0].index);
            assert_eq!(pulses, Some((20 * MS, width_ns)));
        }
        let servo = TimerOutput { timer: 1, channel: 1, is_complement: false };
        assert_eq!(board.waves()[&servo], (20 * MS, 2_000_000));
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
        // No identity of it is known, so the bench has done as the design says.
        assert!(board.unasked().iter().all(|one| !one.is_known));
        assert_eq!(board.odd_transfers(), <[(String, String); 0]>::default());
    });
}
