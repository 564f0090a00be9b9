//! The tables of a part for the runtime in Rust, from the same plan that the C tables are printed
//! from.

use sense_rt::{
    Bridge, BridgeMode, Calibration, ChipTable, Code, Coding, Command, Crc, FieldFormat,
    FilterTable, Formula, Identity, InitStep, Item, MessageChecksum, MessageField, MessageTable,
    Number, Range, Reading, Scalar, Schema, TrainConfig, Transfer, WIDE,
};
use sensedsl_job::part::{
    self, BridgePlan, BusPlan, FieldCoding, FilterPlan, InitPlan, MessageFieldPlan, MessagePlan,
    PartPlan, TrainPlan, ValuePlan,
};
use sensedsl_model::design::Device;
use sensedsl_model::kind::uart;
use sensedsl_model::protocol::{self, Drive, Format};
use sensedsl_model::words;
use sensedsl_wire::{Direction, ScalarType};

use super::library::Unit;

/// The tables of a device besides those of its part.
#[derive(Clone, Copy, Default)]
pub struct Own {
    pub filter: Option<&'static FilterTable>,
    pub formula: Option<(Formula, &'static [i32], u8)>,
    pub train: Option<TrainConfig>,
    pub bridge: Option<Bridge>,
    /// The coding of a value in a CAN frame, and the index of its first byte.
    pub can: Option<(Coding, u8)>,
}

/// All tables of a unit.
pub struct Tables {
    pub schema: &'static Schema,
    pub chip: Option<&'static ChipTable>,
    pub message: Option<&'static MessageTable>,
    pub own: Vec<Own>,
}

fn fixed<T>(one: T) -> &'static T {
    Box::leak(Box::new(one))
}

fn all<T>(of: impl Iterator<Item = T>) -> &'static [T] {
    of.collect::<Vec<_>>().leak()
}

fn bytes(of: &[u8]) -> &'static [u8] {
    all(of.iter().copied())
}

pub fn scalar(scalar: ScalarType) -> Scalar {
    match scalar {
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

fn coding(plan: &ValuePlan) -> Coding {
    Coding {
        elements: all(plan.elements.iter().copied()),
        words: plan.words,
        code: match plan.code {
            words::Code::Integer => Code::Integer,
            words::Code::Float => Code::Float,
            words::Code::Bcd => Code::Bcd,
            words::Code::Packed => Code::Packed,
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

fn formula(of: protocol::Formula) -> Formula {
    match of {
        protocol::Formula::Bmp280 => sense_rt::BMP280,
        protocol::Formula::Bme280 => sense_rt::BME280,
        protocol::Formula::Ntc => sense_rt::NTC,
        protocol::Formula::Tsl2561 => sense_rt::TSL2561,
    }
}

fn init(steps: &[InitPlan]) -> &'static [InitStep] {
    all(steps.iter().map(|step| InitStep { bytes: bytes(&step.bytes), pause_ms: step.pause_ms }))
}

fn chip(plan: &BusPlan, index: impl Fn(&str) -> u16) -> ChipTable {
    let identity = plan.identity.as_ref().map(|one| Identity {
        select: bytes(&one.select),
        expected: bytes(&one.expected),
        mask: bytes(&one.mask),
    });
    let calibration = plan
        .calibration
        .iter()
        .map(|one| Calibration { select: bytes(&one.select), count: one.count });
    let transfers = plan.transfers.iter().map(|one| Transfer {
        trigger: bytes(&one.trigger),
        select: bytes(&one.select),
        cycle_ms: one.cycle_ms,
        wait_ms: one.wait_ms,
        length: one.length,
        exchange: one.is_exchange,
    });
    let readings = plan.readings.iter().map(|one| Reading {
        item: index(&one.field),
        offset: one.offset,
        transfer: u8::try_from(one.transfer).unwrap(),
        output: one.output,
        value: one.value.as_ref().map_or(Coding::NEW, coding),
    });
    let commands = plan.commands.iter().map(|one| Command {
        prefix: bytes(&one.prefix),
        item: index(&one.field),
        value: coding(&one.value),
        own: one.own.as_ref().map_or(&[], |own| bytes(&own.bits)),
        kept: one.own.as_ref().map_or(0, |own| own.kept),
    });
    ChipTable {
        init: init(&plan.init),
        identity,
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

fn field(plan: &MessageFieldPlan, item: u16) -> MessageField {
    match &plan.how {
        FieldCoding::Binary { byte, value } => MessageField {
            item,
            format: FieldFormat::Binary,
            byte: *byte,
            value: coding(value),
            ..MessageField::NEW
        },
        FieldCoding::Text(text) => MessageField {
            item,
            format: match text.format {
                Format::Decimal => FieldFormat::Decimal,
                Format::Degrees => FieldFormat::Degrees,
                Format::Hex => FieldFormat::Hex,
            },
            sentence: text.sentence.as_ref().map(|sentence| bytes(sentence.as_bytes())),
            separator: text.separator.unwrap_or(0),
            index: text.field,
            decimals: text.decimals,
            ..MessageField::NEW
        },
    }
}

fn message(plan: &MessagePlan, index: impl Fn(&str) -> u16) -> MessageTable {
    let fields = plan.fields.iter().map(|one| field(one, index(&one.field)));
    MessageTable {
        start: bytes(&plan.start),
        end: bytes(&plan.end),
        fields: all(fields),
        length: plan.length,
        bytes_max: plan.bytes_max,
        checksum: match plan.checksum {
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

fn number(number: part::Number) -> Number {
    match number {
        part::Number::Unsigned(number) => Number::unsigned(number),
        part::Number::Signed(number) => Number::signed(number),
        part::Number::Float32(number) => Number::float32(number),
        part::Number::Float64(number) => Number::float64(number),
    }
}

fn filter(plan: &FilterPlan) -> FilterTable {
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

fn train(plan: &TrainPlan) -> TrainConfig {
    TrainConfig {
        tick_hz: plan.tick_hz,
        gap_ticks: u32::try_from(plan.gap_ticks).unwrap(),
        min_ticks: u32::try_from(plan.min_ticks).unwrap(),
    }
}

fn bridge(plan: &BridgePlan) -> Bridge {
    let mode = match plan.drive {
        Drive::DirectionPins => BridgeMode::DirectionPins,
        Drive::TwoPwm => BridgeMode::TwoPwm,
    };
    Bridge { mode, full: plan.full }
}

fn own(plan: &PartPlan, name: &str) -> Own {
    let formula_of = plan.formulas.iter().find(|one| one.field == name);
    Own {
        filter: plan.filters.iter().find(|one| one.field == name).map(|one| fixed(filter(one))),
        formula: formula_of
            .map(|one| (formula(one.formula), &*one.parameters.clone().leak(), one.output)),
        train: plan.trains.iter().find(|one| one.field == name).map(train),
        bridge: plan.bridges.iter().find(|one| one.field == name).map(bridge),
        can: None,
    }
}

fn in_frame(device: &Device) -> Option<(Coding, u8)> {
    let words = words::Words::of(device)?;
    device.kind.can().map(|can| (coding(&ValuePlan::new(&words)), can.byte))
}

impl Tables {
    pub fn new(unit: &Unit) -> Self {
        let items = unit.devices().map(|device| Item {
            id: device.id.value,
            scalar: scalar(device.value.value.scalar),
            count: u16::try_from(device.value.value.count()).unwrap(),
            direction: match device.direction {
                Direction::Sensor => sense_rt::Direction::ToHost,
                Direction::Actuator => sense_rt::Direction::ToBoard,
            },
        });
        let schema = fixed(Schema {
            items: all(items),
            hash: 0,
            stamp: false,
            checksum: sense_rt::Checksum::None,
        });
        let names: Vec<String> = unit.devices().map(|device| device.name.value.clone()).collect();
        let index =
            |name: &str| u16::try_from(names.iter().position(|one| one == name).unwrap()).unwrap();
        let plan = super::program::plan(unit);
        let plan = plan.as_ref();
        let bus = plan.and_then(|plan| plan.buses.first());
        let table = bus.map(|bus| fixed(chip(bus, index)));
        if let (Some(bus), Some(table)) = (bus, table) {
            assert_eq!(table.work_bytes(schema), bus.work_bytes, "the work buffer of {names:?}");
        }
        let port = plan.and_then(|plan| plan.message.as_ref());
        Self {
            schema,
            chip: table,
            message: port.map(|port| fixed(message(port, index))),
            own: unit
                .devices()
                .map(|device| {
                    let own = plan.map_or(Own::default(), |plan| own(plan, &device.name.value));
                    Own { can: in_frame(device), ..own }
                })
                .collect(),
        }
    }
}
