//! Two controllers of the same kind at once, and complementary outputs, on both targets.

use sensedsl_machine::LinkPort;
use sensedsl_surroundings::{CanFrame, TimerOutput};

use super::bench::{Bench, MS, unsigned, values};
use super::kinds::items;
use crate::firmware::chibios::tree;
use crate::firmware::embassy;
use crate::firmware::emulated::frame;

/// CAN2 has its filters in CAN1; the fan is on the complementary output of a channel, the pump on a
/// channel of the same timer.
const BOTH: &str = include_str!("../../../firmware/designs/both.sense");

/// The second controller without the first, although it needs the clock of the first.
const SECOND: &str = "
board STM32F407G_DISC1 {
    link { transport = uart; unit = USART3; }
    sensor Speed returns uint16 { id = 1; type = can; unit = CAN2; bitrate = 500 kHz; frame = 0x120; byte = 2; }
    actuator Torque accepts int16 { id = 2; type = can; unit = CAN2; bitrate = 500 kHz; frame = 0x18FF1234; }
}
";

fn chibios(name: &str, text: &str) -> Option<Bench> {
    let name = format!("twin_{name}");
    Some(Bench::build(&tree()?, &name, text, "production", LinkPort::Serial(3)))
}

fn in_rust(name: &str, text: &str) -> Option<Bench> {
    let program = embassy::program(&format!("twin_embassy_{name}"), text)?;
    Some(Bench::of(&program, LinkPort::Serial(3)))
}

fn can(id: u32, extended: bool, value: u8) -> CanFrame {
    let data = [9, 9, 0x12, value, 9, 9, 9, 9];
    CanFrame { id, extended, remote: false, length: 8, data }
}

/// The values that a device has reported.
fn told(bench: &Bench, id: u8) -> Vec<u64> {
    let schema = items(&[
        "1 sensor Speed uint16",
        "2 actuator Torque int16",
        "3 sensor Heat uint16",
        "4 actuator Valve int16",
        "5 actuator Fan uint16",
        "6 actuator Pump uint16",
    ]);
    values(&bench.reports(&schema), id).iter().map(|(_, value)| unsigned(value)).collect()
}

/// The frames that a controller has sent: identifier and data.
fn left(bench: &Bench, unit: u8) -> Vec<(u32, bool, Vec<u8>)> {
    let world = bench.world();
    let own = world.from_can.iter().filter(|(by, _)| *by == unit).map(|(_, frame)| frame);
    let data = |frame: &CanFrame| frame.data[..usize::from(frame.length)].to_vec();
    own.map(|frame| (frame.id, frame.extended, data(frame))).collect()
}

fn both_are_served(mut bench: Bench) {
    bench.run_until_ms(300);
    // The identifiers of one bus belong to no device on the other.
    let of_one = [can(0x18FF_0121, true, 1), can(0x120, false, 0x34)];
    let of_two = [can(0x120, false, 1), can(0x18FF_0121, true, 0x56)];
    bench.world().to_can.entry(1).or_default().extend(of_one);
    bench.world().to_can.entry(2).or_default().extend(of_two);
    bench.machine.link_write(&frame(&[2, 0xFE, 0xDC]));
    bench.machine.link_write(&frame(&[4, 0x01, 0x02]));
    bench.run_until_ms(2_500);
    assert_eq!((told(&bench, 1), told(&bench, 3)), (vec![0x1234], vec![0x1256]));
    assert_eq!(left(&bench, 1).first(), Some(&(0x18FF_1234, true, vec![0xFE, 0xDC])));
    assert_eq!(left(&bench, 2).first(), Some(&(0x122, false, vec![1, 2])));
    complements_have_the_widths_of_their_channels(bench);
}

/// The complementary output has the duty cycle and polarity that the host sets, and its main
/// channel has no output.
fn complements_have_the_widths_of_their_channels(mut bench: Bench) {
    bench.assert_wires(&[("PE8", "TIM1_CH1N"), ("PE11", "TIM1_CH2")]);
    let near = |is: u64, wanted: u64| is.abs_diff(wanted) * 1_000 <= wanted;
    let gives = |bench: &Bench, channel, is_complement, width_ns: u64| {
        let output = TimerOutput { timer: 1, channel, is_complement };
        let (period, width) = bench.world().waves.get(&output).copied().unwrap_or_default();
        assert!(near(width, width_ns), "{output:?}: {width} of {period}, and not {width_ns}");
        assert!(width_ns == 0 || near(period, MS), "{output:?}: {period}");
    };
    gives(&bench, 1, true, MS / 4);
    gives(&bench, 1, false, 0);
    gives(&bench, 2, false, MS / 10);
    gives(&bench, 2, true, 0);
    bench.machine.link_write(&frame(&[5, 0x23, 0x28]));
    bench.run_until_ms(2_600);
    gives(&bench, 1, true, MS * 9 / 10);
    gives(&bench, 1, false, 0);
}

fn the_second_is_served_alone(mut bench: Bench) {
    bench.run_until_ms(300);
    let frames = [can(0x121, false, 1), can(0x120, false, 0x34)];
    bench.world().to_can.entry(2).or_default().extend(frames);
    bench.machine.link_write(&frame(&[2, 0xFE, 0xDC]));
    bench.run_until_ms(2_500);
    let schema = items(&["1 sensor Speed uint16", "2 actuator Torque int16"]);
    let speeds = values(&bench.reports(&schema), 1);
    assert_eq!(speeds.iter().map(|(_, value)| unsigned(value)).collect::<Vec<_>>(), [0x1234]);
    assert_eq!(left(&bench, 2).first(), Some(&(0x18FF_1234, true, vec![0xFE, 0xDC])));
    assert!(left(&bench, 1).is_empty());
}

#[test]
fn both_controllers_and_a_complement_on_chibios() {
    if let Some(bench) = chibios("buses", BOTH) {
        both_are_served(bench);
    }
}

#[test]
fn both_controllers_and_a_complement_on_embassy() {
    if let Some(bench) = in_rust("buses", BOTH) {
        both_are_served(bench);
    }
}

#[test]
fn the_second_controller_alone_on_chibios() {
    if let Some(bench) = chibios("second", SECOND) {
        the_second_is_served_alone(bench);
    }
}

#[test]
fn the_second_controller_alone_on_embassy() {
    if let Some(bench) = in_rust("second", SECOND) {
        the_second_is_served_alone(bench);
    }
}
