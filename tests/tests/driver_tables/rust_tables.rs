//! The tables of a part for the runtime in Rust, from the same plan that the C is printed of.
//!
//! The plan's words are C: names of constants and literals. They are read back here.

use sense_rt::{
    Bridge, BridgeMode, Calibration, ChipTable, Code, Coding, Command, Crc, FieldFormat,
    FilterTable, Formula, Identity, InitStep, Item, MessageChecksum, MessageField, MessageTable,
    Number, Range, Reading, Scalar, Schema, TrainConfig, Transfer, WIDE,
};
use sensedsl_codegen::part::{
    BridgePlan, BusPlan, FilterPlan, InitPlan, MessagePlan, PartPlan, TrainPlan, ValuePlan,
};
use sensedsl_wire::{Direction, ScalarType};

use super::library::Unit;

/// What a device has beside the tables of its part.
#[derive(Clone, Copy, Default)]
pub struct Own {
    pub filter: Option<&'static FilterTable>,
    pub formula: Option<(Formula, &'static [i32], u8)>,
    pub train: Option<TrainConfig>,
    pub bridge: Option<Bridge>,
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

/// `0x3bU`
fn byte(text: &str) -> u8 {
    let digits = text.trim_end_matches('U');
    let hex = digits.strip_prefix("0x").map(|digits| u8::from_str_radix(digits, 16).unwrap());
    hex.unwrap_or_else(|| digits.parse().unwrap())
}

fn bytes(texts: &[String]) -> &'static [u8] {
    all(texts.iter().map(|text| byte(text)))
}

/// `"R\015"`
fn text(literal: &str) -> &'static [u8] {
    let mut rest = &literal[1..literal.len() - 1];
    let mut found = Vec::new();
    while let Some(first) = rest.chars().next() {
        if first == '\\' {
            found.push(u8::from_str_radix(&rest[1..4], 8).unwrap());
            rest = &rest[4..];
        } else {
            found.push(first as u8);
            rest = &rest[1..];
        }
    }
    found.leak()
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
            "UP_CODE_INTEGER" => Code::Integer,
            "UP_CODE_FLOAT" => Code::Float,
            "UP_CODE_BCD" => Code::Bcd,
            "UP_CODE_PACKED" => Code::Packed,
            other => panic!("{other}"),
        },
        crc: match plan.crc {
            "UP_CRC_NONE" => Crc::None,
            "UP_CRC_SENSIRION" => Crc::Sensirion,
            other => panic!("{other}"),
        },
        word_bytes: plan.word_bytes,
        low: plan.low,
        bits: plan.bits,
        is_signed: plan.is_signed,
        is_little_endian: plan.is_little_endian,
    }
}

fn formula(name: &str) -> Formula {
    match name {
        "up_formula_bmp280" => sense_rt::BMP280,
        "up_formula_bme280" => sense_rt::BME280,
        "up_formula_ntc" => sense_rt::NTC,
        "up_formula_tsl2561" => sense_rt::TSL2561,
        other => panic!("{other}"),
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
    });
    ChipTable {
        init: init(&plan.init),
        identity,
        calibration: all(calibration),
        transfers: all(transfers),
        readings: all(readings),
        commands: all(commands),
        formula: plan.formula.map(formula),
        parameters: all(plan.parameters.iter().copied()),
        cycle_ms: plan.cycle_ms,
        address: byte(&plan.address),
    }
}

fn message(plan: &MessagePlan, index: impl Fn(&str) -> u16) -> MessageTable {
    let fields = plan.fields.iter().map(|one| MessageField {
        item: index(&one.field),
        format: match one.format {
            "UP_FORMAT_BINARY" => FieldFormat::Binary,
            "UP_FORMAT_DECIMAL" => FieldFormat::Decimal,
            "UP_FORMAT_DEGREES" => FieldFormat::Degrees,
            "UP_FORMAT_HEX" => FieldFormat::Hex,
            other => panic!("{other}"),
        },
        byte: one.byte,
        value: one.value.as_ref().map_or(Coding::NEW, coding),
        sentence: one.sentence.as_deref().map(text),
        separator: byte(&one.separator),
        index: one.index,
        decimals: one.decimals,
    });
    MessageTable {
        start: bytes(&plan.start),
        end: bytes(&plan.end),
        fields: all(fields),
        length: plan.length,
        bytes_max: plan.bytes_max,
        checksum: match plan.checksum {
            "UP_CHECKSUM_NONE" => MessageChecksum::None,
            "UP_CHECKSUM_SUM8" => MessageChecksum::Sum8,
            "UP_CHECKSUM_XOR8" => MessageChecksum::Xor8,
            "UP_CHECKSUM_IBUS" => MessageChecksum::Ibus,
            "UP_CHECKSUM_CRC8_DVB_S2" => MessageChecksum::Crc8DvbS2,
            "UP_CHECKSUM_NMEA" => MessageChecksum::Nmea,
            other => panic!("{other}"),
        },
        checksum_from: plan.checksum_from,
    }
}

/// A literal of C as a number of the type that `member` of the runtime's union has.
fn number(member: &str, literal: &str) -> Number {
    let digits = literal.trim_start_matches("UINT64_C(").trim_start_matches("INT64_C(");
    let digits = digits.trim_end_matches(')');
    match member {
        "u" => Number::unsigned(digits.parse().unwrap()),
        "i" if digits == "INT64_MIN" => Number::signed(i64::MIN),
        "i" => Number::signed(digits.parse().unwrap()),
        "f" => Number::float32(digits.trim_end_matches('F').parse().unwrap()),
        "d" => Number::float64(digits.parse().unwrap()),
        other => panic!("{other}"),
    }
}

fn filter(plan: &FilterPlan) -> FilterTable {
    let ranges = plan.invalid.iter().map(|(low, high)| Range {
        low: number(plan.member, low),
        high: number(plan.member, high),
    });
    let distance = if plan.member == "i" { "u" } else { plan.member };
    FilterTable {
        invalid: all(ranges),
        wide: plan.is_wide.then_some(WIDE),
        median: plan.median,
        smooth_ms: plan.smooth_ms,
        change: plan.change.as_deref().map(|change| number(distance, change)),
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
    let mode = match plan.mode {
        "UP_DRIVE_DIRECTION_PINS" => BridgeMode::DirectionPins,
        "UP_DRIVE_TWO_PWM" => BridgeMode::TwoPwm,
        other => panic!("{other}"),
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
    }
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
        let schema = fixed(Schema { items: all(items), hash: 0, stamp: false, checksum: false });
        let names: Vec<String> = unit.devices().map(|device| device.name.value.clone()).collect();
        let index =
            |name: &str| u16::try_from(names.iter().position(|one| one == name).unwrap()).unwrap();
        let plan = super::program::plan(unit);
        let plan = plan.as_ref();
        let bus = plan.and_then(|plan| plan.bus.as_ref());
        let table = bus.map(|bus| fixed(chip(bus, index)));
        if let (Some(bus), Some(table)) = (bus, table) {
            assert_eq!(table.work_bytes(schema), bus.work_bytes, "the work buffer of {names:?}");
        }
        let port = plan.and_then(|plan| plan.message.as_ref());
        Self {
            schema,
            chip: table.map(|table| &*table),
            message: port.map(|port| &*fixed(message(port, index))),
            own: names
                .iter()
                .map(|name| plan.map_or(Own::default(), |plan| own(plan, name)))
                .collect(),
        }
    }
}
