//! The tables of a board's parts for the runtime: they are built while the program runs, whereas a generator prints
//! them as constants.
//!
//! The runtime takes tables that live for ever, as constants do. They take a few kilobytes for each board and are never
//! freed.

use sense_rt::{
    Bridge, BridgeMode, Calibration, Checksum, ChipTable, Code, Coding, Command, Compose, Crc,
    Exchange, FieldFormat, FilterTable, Formula, Identity, InitStep, Item, MessageChecksum,
    MessageField, MessageTable, Number, Range, Reading, Scalar, Schema, Transfer, WIDE,
};
use sensedsl_job::BoardJob;
use sensedsl_job::part::{
    self, BridgePlan, BusPlan, ComposePlan, ExchangePlan, FieldCoding, FilterPlan, InitPlan,
    MessageFieldPlan, MessagePlan, ValuePlan,
};
use sensedsl_model::design::Device;
use sensedsl_model::kind::uart;
use sensedsl_model::protocol::{self, Drive, Format};
use sensedsl_model::words::{self, Words};
use sensedsl_wire::{Direction, ScalarType};

/// A value that lives as long as the program.
pub fn kept<T>(one: T) -> &'static T {
    Box::leak(Box::new(one))
}

fn all<T>(items: impl IntoIterator<Item = T>) -> &'static [T] {
    items.into_iter().collect::<Vec<T>>().leak()
}

/// The schema of a board's link.
pub fn schema(job: &BoardJob<'_>) -> Schema {
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
        checksum: match job.schema.checksum {
            sensedsl_wire::Checksum::None => Checksum::None,
            sensedsl_wire::Checksum::Crc16 => Checksum::Crc16,
            sensedsl_wire::Checksum::Crc32 => Checksum::Crc32,
        },
    }
}

/// The runtime's scalar of that type.
#[must_use]
pub const fn scalar(of: ScalarType) -> Scalar {
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

fn bytes(of: &[u8]) -> &'static [u8] {
    all(of.iter().copied())
}

/// The runtime's formula of that name.
pub const fn formula(of: protocol::Formula) -> Formula {
    match of {
        protocol::Formula::Bmp280 => sense_rt::BMP280,
        protocol::Formula::Bme280 => sense_rt::BME280,
        protocol::Formula::Hx711 => sense_rt::HX711,
        protocol::Formula::Ntc => sense_rt::NTC,
        protocol::Formula::Tsl2561 => sense_rt::TSL2561,
    }
}

/// A chip on a bus. `place` is the place of a device in the schema, by its name.
pub fn chip(plan: &BusPlan, place: impl Fn(&str) -> u16) -> ChipTable {
    let transfers = plan.transfers.iter().map(|one| Transfer {
        trigger: bytes(&one.trigger),
        select: bytes(&one.select),
        cycle_ms: one.cycle_ms,
        wait_ms: one.wait_ms,
        length: one.length,
        exchange: one.is_exchange,
    });
    let readings = plan.readings.iter().map(|one| Reading {
        item: place(&one.field),
        offset: one.offset,
        transfer: u8::try_from(one.transfer).unwrap_or(u8::MAX),
        output: one.output,
        value: one.value.as_ref().map_or(Coding::NEW, coding),
    });
    let commands = plan.commands.iter().map(|one| Command {
        prefix: bytes(&one.prefix),
        item: place(&one.field),
        value: coding(&one.value),
        own: one.own.as_ref().map_or(&[], |own| bytes(&own.bits)),
        kept: one.own.as_ref().map_or(0, |own| own.kept),
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
        kept: bytes(&plan.kept),
        formula: plan.formula.map(formula),
        parameters: all(plan.parameters.iter().copied()),
        cycle_ms: plan.cycle_ms,
        address: plan.address,
    }
}

/// The steps that start a part.
pub fn init(steps: &[InitPlan]) -> &'static [InitStep] {
    all(steps.iter().map(|one| InitStep { bytes: bytes(&one.bytes), pause_ms: one.pause_ms }))
}

/// How a value is coded.
pub fn coding(plan: &ValuePlan) -> Coding {
    Coding {
        elements: all(plan.elements.iter().copied()),
        words: plan.words,
        code: match plan.code {
            words::Code::Integer => Code::Integer,
            words::Code::Float => Code::Float,
            words::Code::Bcd => Code::Bcd,
            words::Code::Magnitude => Code::Magnitude,
            words::Code::Packed => Code::Packed,
            words::Code::Pulses => Code::Pulses,
            words::Code::Leds => Code::Leds,
            words::Code::Text => Code::Text,
        },
        crc: match plan.crc {
            None => Crc::None,
            Some(protocol::Crc::Sensirion) => Crc::Sensirion,
        },
        word_bytes: plan.word_bytes,
        low: plan.low,
        bits: plan.bits,
        is_signed: plan.is_signed,
        is_little_endian: plan.is_little_endian,
    }
}

/// A value in a CAN frame.
pub fn in_frame(index: usize, device: &Device) -> Option<MessageField> {
    let can = device.kind.can()?;
    let value = coding(&ValuePlan::new(&Words::of(device)?));
    let item = u16::try_from(index).ok()?;
    Some(MessageField { item, byte: can.byte.into(), value, ..MessageField::NEW })
}

/// A value in a message.
fn field(plan: &MessageFieldPlan, item: u16) -> MessageField {
    let text = match &plan.how {
        FieldCoding::Binary { byte, value } => {
            return MessageField { item, byte: *byte, value: coding(value), ..MessageField::NEW };
        }
        FieldCoding::Text(text) => text,
    };
    MessageField {
        item,
        format: format(text),
        sentence: text.sentence.as_ref().map(|sentence| bytes(sentence.as_bytes())),
        separator: text.separator.unwrap_or(0),
        index: text.field,
        decimals: text.decimals,
        ..MessageField::NEW
    }
}

const fn format(text: &protocol::TextField) -> FieldFormat {
    match text.format {
        Format::Decimal => FieldFormat::Decimal,
        Format::Degrees => FieldFormat::Degrees,
        Format::Hex => FieldFormat::Hex,
    }
}

/// The messages of a serial part. `place` is the place of a device in the schema, by its name.
pub fn message(plan: &MessagePlan, place: impl Fn(&str) -> u16) -> MessageTable {
    MessageTable {
        start: bytes(&plan.start),
        end: bytes(&plan.end),
        fields: all(plan.fields.iter().map(|one| field(one, place(&one.field)))),
        length: plan.length,
        bytes_max: plan.bytes_max,
        checksum: checksum(plan.checksum),
        checksum_from: plan.checksum_from,
    }
}

/// A message that is sent to a serial part.
pub fn compose(plan: &ComposePlan) -> Compose {
    Compose {
        start: bytes(&plan.start),
        behind: bytes(&plan.behind),
        end: bytes(&plan.end),
        format: plan.text.as_ref().map_or(FieldFormat::Binary, format),
        value: coding(&plan.value),
        separator: plan.text.as_ref().and_then(|text| text.separator).unwrap_or(0),
        decimals: plan.text.as_ref().map_or(0, |text| text.decimals),
        checksum: checksum(plan.checksum),
        checksum_from: plan.checksum_from,
    }
}

/// A request to a serial part, and the message that answers it.
pub fn exchange(plan: &ExchangePlan, place: impl Fn(&str) -> u16) -> Exchange {
    let answer = MessageTable {
        start: bytes(&plan.start),
        end: bytes(&plan.end),
        fields: all(plan.fields.iter().map(|one| field(one, place(&one.field)))),
        length: plan.length,
        bytes_max: plan.bytes_max,
        checksum: checksum(plan.checksum),
        checksum_from: plan.checksum_from,
    };
    Exchange {
        request: bytes(&plan.request),
        answer: kept(answer),
        is_primed: plan.is_primed,
        wait_ms: plan.wait_ms,
    }
}

const fn checksum(of: uart::MessageChecksum) -> MessageChecksum {
    match of {
        uart::MessageChecksum::None => MessageChecksum::None,
        uart::MessageChecksum::Sum8 => MessageChecksum::Sum8,
        uart::MessageChecksum::Xor8 => MessageChecksum::Xor8,
        uart::MessageChecksum::Ibus => MessageChecksum::Ibus,
        uart::MessageChecksum::Crc8DvbS2 => MessageChecksum::Crc8DvbS2,
        uart::MessageChecksum::Crc8Ld06 => MessageChecksum::Crc8Ld06,
        uart::MessageChecksum::Sum16 => MessageChecksum::Sum16,
        uart::MessageChecksum::Nmea => MessageChecksum::Nmea,
        uart::MessageChecksum::Sum7 => MessageChecksum::Sum7,
        uart::MessageChecksum::NotSum8 => MessageChecksum::NotSum8,
        uart::MessageChecksum::NegSum8 => MessageChecksum::NegSum8,
        uart::MessageChecksum::NegSum16 => MessageChecksum::NegSum16,
        uart::MessageChecksum::Crc16Umts => MessageChecksum::Crc16Umts,
        uart::MessageChecksum::Crc16Xmodem => MessageChecksum::Crc16Xmodem,
        uart::MessageChecksum::Slamtec => MessageChecksum::Slamtec,
    }
}

/// A number in its type, most significant byte first; the model has made sure that the type holds it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the type holds it")]
pub fn value(scalar: Scalar, number: f64) -> Vec<u8> {
    match scalar {
        Scalar::Float32 => (number as f32).to_be_bytes().to_vec(),
        Scalar::Float64 => number.to_be_bytes().to_vec(),
        Scalar::Bool
        | Scalar::Uint8
        | Scalar::Int8
        | Scalar::Uint16
        | Scalar::Int16
        | Scalar::Uint32
        | Scalar::Int32
        | Scalar::Uint64
        | Scalar::Int64 => {
            let whole = if number < 0.0 { (number as i64).cast_unsigned() } else { number as u64 };
            let from = 8 - scalar.bytes().min(8);
            whole.to_be_bytes().get(from..).unwrap_or_default().to_vec()
        }
    }
}

/// The processing of a value before it is reported.
pub fn filter(plan: &FilterPlan) -> FilterTable {
    let ranges = plan.invalid.iter();
    let ranges = ranges.map(|&(low, high)| Range { low: number(low), high: number(high) });
    FilterTable {
        invalid: all(ranges),
        wide: plan.is_wide.then_some(WIDE),
        median: plan.median,
        smooth_ms: plan.smooth_ms,
        change: plan.change.map(number),
        heartbeat_ms: plan.heartbeat_ms,
    }
}

fn number(number: part::Number) -> Number {
    match number {
        part::Number::Unsigned(number) => Number::unsigned(number),
        part::Number::Signed(number) => Number::signed(number),
        part::Number::Float32(number) => Number::float32(number),
        part::Number::Float64(number) => Number::float64(number),
    }
}

/// The outputs of a bridge.
#[must_use]
pub const fn bridge(plan: &BridgePlan) -> Bridge {
    let mode = match plan.drive {
        Drive::DirectionPins => BridgeMode::DirectionPins,
        Drive::DirectionPin => BridgeMode::DirectionPin,
        Drive::TwoPwm => BridgeMode::TwoPwm,
    };
    Bridge { mode, full: plan.full }
}
