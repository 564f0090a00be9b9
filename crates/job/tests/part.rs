//! Which bytes of a chip are read together, and what its tables contain: small designs in, plans out.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic, reason = "a test may panic")]

use sensedsl_job::part::{BusPlan, FieldCoding, Number, PartPlan};
use sensedsl_model::design::PartIndex;
use sensedsl_model::{NoFiles, Request, resolve};

/// The plan of a chip with this driver.
#[track_caller]
fn plan(kind: &str, driver: &str, devices: &str) -> PartPlan {
    let text = format!(
        "driver own for {kind} {{ {driver} }}\n\
         board STM32F407G_DISC1 {{ chip Chip {{ driver = own; id = 1; {devices} }} }}"
    );
    let request = Request { path: "x.sense", text: &text, ..Request::default() };
    let resolved = resolve(&request, &NoFiles);
    let design = resolved.design.unwrap_or_else(|| panic!("{:#?}", resolved.diagnostics));
    PartPlan::new(&design, PartIndex(0)).unwrap()
}

fn bus(driver: &str, devices: &str) -> BusPlan {
    plan("i2c", &format!("address = 0x20; {driver}"), devices).buses.remove(0)
}

/// `trigger|select:length` for each transfer, and `transfer+offset` for each reading.
fn shape(bus: &BusPlan) -> (Vec<String>, Vec<String>) {
    let digits = |bytes: &[u8]| bytes.iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    let transfers = bus
        .transfers
        .iter()
        .map(|one| format!("{}|{}:{}", digits(&one.trigger), digits(&one.select), one.length));
    let readings = bus.readings.iter().map(|one| format!("{}+{}", one.transfer, one.offset));
    (transfers.collect(), readings.collect())
}

#[track_caller]
fn reads(driver: &str, devices: &str, transfers: &[&str], readings: &[&str]) {
    let (found_transfers, found_readings) = shape(&bus(driver, devices));
    assert_eq!(found_transfers, transfers, "{driver}");
    assert_eq!(found_readings, readings, "{driver}");
}

#[test]
fn neighbours_are_read_in_one_transfer() {
    let all = "reading b returns uint16 { register = 0x12; } reading a returns uint16 { register = 0x10; }";
    reads(all, "", &["|10:4"], &["0+2", "0+0"]);
    // Across a gap that costs less than a separate transfer, but not across a longer one.
    let near =
        "reading a returns uint8 { register = 0x10; } reading b returns uint8 { register = 0x15; }";
    reads(near, "", &["|10:6"], &["0+0", "0+5"]);
    let far =
        "reading a returns uint8 { register = 0x10; } reading b returns uint8 { register = 0x16; }";
    reads(far, "", &["|10:1", "|16:1"], &["0+0", "1+0"]);
    // A reading that lies within another one.
    let within = "reading a returns uint8[8] { register = 0x10; } reading b returns uint8 { register = 0x12; }";
    reads(within, "", &["|10:8"], &["0+0", "0+2"]);
}

#[test]
fn a_pause_begins_when_the_line_has_sent_what_is_before_it() {
    let driver = "baud = 9600; init = [5 ms, [1, 2, 3, 4], [5, 6, 7, 8], 100 ms]; start = [0x42]; length = 1; reading a returns uint8 { byte = 0; }";
    let part = plan("uart", driver, "sensor A returns uint8 { }");
    let pauses: Vec<u16> = part.message.unwrap().init.iter().map(|step| step.pause_ms).collect();
    // Eight characters of twelve bits: 10 ms.
    assert_eq!(pauses, [5, 0, 110]);
}

#[test]
fn registers_that_stand_alone_are_read_alone() {
    let all = "burst = false; reading a returns uint16 { register = 1; } reading b returns uint16 { register = 2; } \
               reading c returns uint8 { register = 1; bits = 3..0; }";
    reads(all, "", &["|01:2", "|02:2"], &["0+0", "1+0", "0+0"]);
}

#[test]
fn one_measurement_is_read_over_longer_gaps() {
    let all = "trigger = [9]; reading a returns uint8 { register = 0x10; } reading b returns uint8 { register = 0x20; }";
    reads(all, "", &["09|10:17"], &["0+0", "0+16"]);
    let two = "reading a returns uint8 { register = 0; trigger = [1]; } reading b returns uint8 { register = 1; trigger = [2]; } \
               reading c returns uint8 { register = 2; trigger = [2]; wait = 3 ms; }";
    reads(two, "", &["01|00:1", "02|01:1", "02|02:1"], &["0+0", "1+0", "2+0"]);
}

#[test]
fn values_of_other_cycles_are_read_by_themselves() {
    let all = "reading a returns uint8 { register = 0; } reading b returns uint8 { register = 1; }";
    let devices =
        "sensor A returns uint8 { delay = 10 ms; } sensor B returns uint8 { delay = 20 ms; }";
    reads(all, devices, &["|00:1", "|01:1"], &["0+0", "1+0"]);
    let plan = bus(all, devices);
    assert_eq!(
        (plan.cycle_ms, plan.transfers[0].cycle_ms, plan.transfers[1].cycle_ms),
        (10, 10, 20)
    );
}

#[test]
fn checksums_are_counted_as_on_the_wire() {
    let all = "trigger = [0x24, 0x00]; reading a returns uint16 { byte = 0; crc = sensirion; } \
               reading b returns uint16[2] { byte = 2; crc = sensirion; }";
    reads(all, "", &["2400|:9"], &["0+0", "0+3"]);
}

#[test]
fn registers_have_their_size_and_their_read_bit() {
    let mut spi = plan(
        "spi",
        "register_size = 2; read_mask = 0x80; identity = [0x0001, 0x55]; init = [5 ms, [0x12, 0x34, 1], 2 ms, [1]]; \
         reading a returns uint8 { register = 0x0102; } command b accepts uint8 { register = 0x0304; }",
        "",
    );
    let bus = spi.buses.remove(0);
    assert_eq!(bus.transfers[0].select, [0x81, 0x02]);
    assert_eq!(bus.identity.unwrap().select, [0x80, 0x01]);
    assert_eq!(bus.commands[0].prefix, [0x03, 0x04]);
    let init: Vec<(usize, u16)> =
        bus.init.iter().map(|one| (one.bytes.len(), one.pause_ms)).collect();
    assert_eq!(init, [(0, 5), (3, 2), (1, 0)]);
    assert_eq!(bus.work_bytes, 3);
}

#[test]
fn messages_are_as_long_as_their_driver_says() {
    let fixed = plan(
        "uart",
        "start = [1, 2]; length = 4; checksum = ibus; reading a returns uint16 { byte = 2; order = little; }",
        "",
    );
    let fixed = fixed.message.unwrap();
    assert_eq!((fixed.length, fixed.bytes_max), (4, 8));
    let FieldCoding::Binary { byte, value } = &fixed.fields[0].how else { panic!("a text") };
    assert_eq!((value.word_bytes, value.is_little_endian, *byte), (2, true, 2));
    let open = plan(
        "uart",
        "start = \"$\"; end = \"\\r\\n\"; checksum = nmea; reading a returns int32 { sentence = \"RMC\"; field = 3; format = decimal; }",
        "",
    );
    let open = open.message.unwrap();
    assert_eq!((open.length, open.bytes_max), (0, 128));
    let FieldCoding::Text(text) = &open.fields[0].how else { panic!("not a text") };
    assert_eq!((text.sentence.as_deref(), text.separator), (Some("RMC"), Some(b',')));
}

#[test]
fn ranges_that_are_invalid_are_numbers_of_the_type() {
    let devices = "sensor A returns int8 { invalid = [-500..-3.5, 7, 200]; change = 0.2; }";
    let part = plan("i2c", "address = 0x20; reading a returns int8 { register = 0; }", devices);
    let filter = &part.filters[0];
    let ends = |low: i64, high: i64| (Number::Signed(low), Number::Signed(high));
    assert_eq!(filter.invalid, [ends(-128, -4), ends(7, 7)]);
    assert_eq!((filter.change, filter.memory_words), (Some(Number::Unsigned(1)), 1));
}
