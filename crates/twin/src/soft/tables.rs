//! The tables of a board's parts for the runtime: what a generator prints as constants, made while the program runs.
//!
//! The runtime takes tables that live for ever, as constants do. They are a few kilobytes a board, and are never given
//! back.

use sense_rt::{
    Calibration, ChipTable, Code, Coding, Command, Crc, FieldFormat, FilterTable, Formula,
    Identity, InitStep, Item, MessageChecksum, MessageField, MessageTable, Number, Range, Reading,
    Scalar, Schema, Transfer, WIDE,
};
use sensedsl_codegen::job::BoardJob;
use sensedsl_codegen::part::{BusPlan, InitPlan, MessagePlan, ValuePlan};
use sensedsl_model::design::Device;
use sensedsl_model::kind::uart::{self, Uart};
use sensedsl_model::protocol::{self, Format};
use sensedsl_model::words::Words;
use sensedsl_wire::{Checksum, Direction, ScalarType};

use crate::arith::rounded;

/// Something that lives as long as the program.
pub(super) fn kept<T>(one: T) -> &'static T {
    Box::leak(Box::new(one))
}

fn all<T>(items: impl IntoIterator<Item = T>) -> &'static [T] {
    items.into_iter().collect::<Vec<T>>().leak()
}

/// The wire of a board.
pub(super) fn schema(job: &BoardJob<'_>) -> Schema {
    let items = job.schema.items.iter().map(|item| {
        let count = u16::try_from(item.value.count()).unwrap_or(u16::MAX);
        match item.direction {
            Direction::Sensor => Item::sensor(item.id, scalar(item.value.scalar), count),
            Direction::Actuator => Item::actuator(item.id, scalar(item.value.scalar), count),
        }
    });
    Schema {
        items: all(items),
        hash: job.schema.hash(),
        stamp: job.schema.stamp,
        checksum: job.schema.checksum == Checksum::Crc16,
    }
}

const fn scalar(of: ScalarType) -> Scalar {
    match of {
        ScalarType::Bool => Scalar::Bool,
        ScalarType::Uint8 => Scalar::Uint8,
        ScalarType::Int8 => Scalar::Int8,
        ScalarType::Uint16 => Scalar::Uint16,
        ScalarType::Int16 => Scalar::Int16,
        ScalarType::Uint32 => Scalar::Uint32,
        ScalarType::Int32 => Scalar::Int32,
        ScalarType::Uint64 => Scalar::Uint64,
        ScalarType::Int64 => Scalar::Int64,
        ScalarType::Float32 => Scalar::Float32,
        ScalarType::Float64 => Scalar::Float64,
    }
}

/// Bytes that a plan has as literals of C.
fn bytes(literals: &[String]) -> &'static [u8] {
    all(literals.iter().filter_map(|literal| byte(literal)))
}

/// `0x3bU`
fn byte(literal: &str) -> Option<u8> {
    u8::from_str_radix(literal.strip_prefix("0x")?.trim_end_matches('U'), 16).ok()
}

fn item(job: &BoardJob<'_>, name: &str) -> u16 {
    let place = job.devices.iter().position(|one| one.name() == name);
    place.and_then(|place| u16::try_from(place).ok()).unwrap_or(u16::MAX)
}

/// The formula of a name.
pub(super) const fn formula(of: protocol::Formula) -> Formula {
    match of {
        protocol::Formula::Bmp280 => sense_rt::BMP280,
        protocol::Formula::Bme280 => sense_rt::BME280,
        protocol::Formula::Ntc => sense_rt::NTC,
        protocol::Formula::Tsl2561 => sense_rt::TSL2561,
    }
}

/// A chip on a bus.
pub(super) fn chip(job: &BoardJob<'_>, plan: &BusPlan, of: Option<protocol::Formula>) -> ChipTable {
    let transfers = plan.transfers.iter().map(|one| Transfer {
        trigger: bytes(&one.trigger),
        select: bytes(&one.select),
        cycle_ms: one.cycle_ms,
        wait_ms: one.wait_ms,
        length: one.length,
        exchange: one.is_exchange,
    });
    let readings = plan.readings.iter().map(|one| Reading {
        item: item(job, &one.field),
        offset: one.offset,
        transfer: u8::try_from(one.transfer).unwrap_or(u8::MAX),
        output: one.output,
        value: one.value.as_ref().map_or(Coding::NEW, coding),
    });
    let commands = plan.commands.iter().map(|one| Command {
        prefix: bytes(&one.prefix),
        item: item(job, &one.field),
        value: coding(&one.value),
    });
    let calibration = plan.calibration.iter();
    let calibration =
        calibration.map(|one| Calibration { select: bytes(&one.select), count: one.count });
    ChipTable {
        init: init(&plan.init),
        identity: plan.identity.as_ref().map(|one| Identity {
            select: bytes(&one.select),
            expected: bytes(&one.expected),
            mask: bytes(&one.mask),
        }),
        calibration: all(calibration),
        transfers: all(transfers),
        readings: all(readings),
        commands: all(commands),
        formula: of.map(formula),
        parameters: all(plan.parameters.iter().copied()),
        cycle_ms: plan.cycle_ms,
        address: byte(&plan.address).unwrap_or(0),
    }
}

fn init(steps: &[InitPlan]) -> &'static [InitStep] {
    all(steps.iter().map(|one| InitStep { bytes: bytes(&one.bytes), pause_ms: one.pause_ms }))
}

fn coding(plan: &ValuePlan) -> Coding {
    Coding {
        elements: all(plan.elements.iter().copied()),
        words: plan.words,
        code: match plan.code {
            "UP_CODE_FLOAT" => Code::Float,
            "UP_CODE_BCD" => Code::Bcd,
            "UP_CODE_PACKED" => Code::Packed,
            _ => Code::Integer,
        },
        crc: if plan.crc == "UP_CRC_SENSIRION" { Crc::Sensirion } else { Crc::None },
        word_bytes: plan.word_bytes,
        low: plan.low,
        bits: plan.bits,
        is_signed: plan.is_signed,
        is_little_endian: plan.is_little_endian,
    }
}

/// What comes over a serial port, or in a frame of CAN.
pub(super) fn field(index: usize, device: &Device) -> Option<MessageField> {
    let item = u16::try_from(index).ok()?;
    let Some(text) = &device.coding.text else {
        let words = Words::of(device)?;
        return Some(MessageField {
            item,
            byte: device.coding.byte,
            value: coding(&ValuePlan::new(&words)),
            ..MessageField::NEW
        });
    };
    Some(MessageField {
        item,
        format: match text.format {
            Format::Decimal => FieldFormat::Decimal,
            Format::Degrees => FieldFormat::Degrees,
            Format::Hex => FieldFormat::Hex,
        },
        sentence: text.sentence.as_ref().map(|sentence| all(sentence.bytes())),
        separator: text.separator.unwrap_or(0),
        index: text.field,
        decimals: text.decimals,
        ..MessageField::NEW
    })
}

/// The messages of a serial part.
pub(super) fn message(plan: &MessagePlan, uart: &Uart, fields: Vec<MessageField>) -> MessageTable {
    MessageTable {
        start: all(uart.start.iter().copied()),
        end: all(uart.end.iter().copied()),
        fields: fields.leak(),
        length: plan.length,
        bytes_max: plan.bytes_max,
        checksum: match uart.checksum {
            uart::MessageChecksum::None => MessageChecksum::None,
            uart::MessageChecksum::Sum8 => MessageChecksum::Sum8,
            uart::MessageChecksum::Xor8 => MessageChecksum::Xor8,
            uart::MessageChecksum::Ibus => MessageChecksum::Ibus,
            uart::MessageChecksum::Crc8DvbS2 => MessageChecksum::Crc8DvbS2,
            uart::MessageChecksum::Nmea => MessageChecksum::Nmea,
        },
        checksum_from: plan.checksum_from,
    }
}

/// What becomes of a value before it is reported; none where it is reported as it is.
pub(super) fn filter(device: &Device) -> Option<FilterTable> {
    let filter = &device.filter;
    if filter.is_empty() {
        return None;
    }
    let of = device.value.value.scalar;
    let has_memory = filter.smooth_ms > 0 || filter.change.is_some();
    let ranges = filter.invalid.iter().filter_map(|ends| range(of, *ends));
    Some(FilterTable {
        invalid: all(ranges),
        wide: (of == ScalarType::Float64 && has_memory).then_some(WIDE),
        median: filter.median,
        smooth_ms: filter.smooth_ms,
        change: filter.change.map(|change| match of.integer_range() {
            Some(_) => Number::unsigned(rounded(change.ceil()).max(1).unsigned_abs()),
            None => real(of, change),
        }),
        heartbeat_ms: filter.heartbeat_ms,
    })
}

/// The numbers of the type that are in a range; none where there are none.
fn range(of: ScalarType, (low, high): (f64, f64)) -> Option<Range> {
    let Some((least, greatest)) = of.integer_range() else {
        return Some(Range { low: real(of, low), high: real(of, high) });
    };
    let low = i128::from(rounded(low.ceil())).max(least);
    let high = i128::from(rounded(high.floor())).min(greatest);
    let number = |whole: i128| {
        if least < 0 {
            Number::signed(i64::try_from(whole).unwrap_or(i64::MAX))
        } else {
            Number::unsigned(u64::try_from(whole).unwrap_or(u64::MAX))
        }
    };
    (low <= high).then(|| Range { low: number(low), high: number(high) })
}

fn real(of: ScalarType, number: f64) -> Number {
    #[expect(clippy::cast_possible_truncation, reason = "the type has no more digits")]
    if of == ScalarType::Float32 { Number::float32(number as f32) } else { Number::float64(number) }
}
