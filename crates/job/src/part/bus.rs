//! A part on a register bus: `up_chip_t` and the tables that it points to.

use std::collections::BTreeMap;

use sensedsl_model::design::{Connection, ConnectionIndex, Design, Device};
use sensedsl_model::kind::encoding::Encoding;
use sensedsl_model::kind::onewire::OneWire;
use sensedsl_model::protocol::{Formula, Identity, InitStep, Protocol};
use sensedsl_model::registers::{self, Register};
use sensedsl_model::words::{Code, Words};
use sensedsl_timing::{Pulses, sent_bytes};
use sensedsl_wire::Direction;

use super::source::Source;
use super::transfers::{self, Place, TransferPlan, register_to_read};
use super::value::ValuePlan;
use crate::snake;

/// Asks a part on 1-Wire for its address.
const READ_ROM: u8 = 0x33;
/// Bytes of such an address.
const ROM_BYTES: usize = 8;

/// An `up_chip_t`.
#[derive(Clone, Debug)]
pub struct BusPlan {
    /// The prefix of the names of its tables.
    pub prefix: String,
    /// The connection that the bus goes over.
    pub connection: ConnectionIndex,
    /// The 7-bit address; 0 on SPI, where a chip select takes its place, and on one wire.
    pub address: u8,
    /// The steps that start the part.
    pub init: Vec<InitPlan>,
    /// The register that identifies the part, and its contents.
    pub identity: Option<IdentityPlan>,
    /// The calibration that the formula needs.
    pub calibration: Vec<CalibrationPlan>,
    /// The bytes that are read together.
    pub transfers: Vec<TransferPlan>,
    /// The values in the transfers.
    pub readings: Vec<ReadingPlan>,
    /// The values that are written.
    pub commands: Vec<CommandPlan>,
    /// The start values of the registers that commands share, one after the other.
    pub kept: Vec<u8>,
    /// The clock that the bus must run at for a strip of LEDs without a clock line; `None` if any will do.
    pub clock_hz: Option<u32>,
    /// The runtime's formula.
    pub formula: Option<Formula>,
    /// The formula's constants.
    pub parameters: Vec<i32>,
    /// How often the part is served.
    pub cycle_ms: u32,
    /// Bytes of all calibration blocks.
    pub calibration_bytes: u16,
    /// The most bytes that any transfer writes and reads together.
    pub work_bytes: usize,
    /// The number of 64-bit words that hold the largest value.
    pub scratch_words: usize,
}

/// An `up_chip_init_t`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InitPlan {
    /// The bytes to write; empty for a pause only.
    pub bytes: Vec<u8>,
    /// The pause after them.
    pub pause_ms: u16,
}

/// An `up_chip_identity_t`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IdentityPlan {
    /// The register.
    pub select: Vec<u8>,
    /// The contents that it must have.
    pub expected: Vec<u8>,
    /// The bits that are compared; empty for all.
    pub mask: Vec<u8>,
}

/// An `up_chip_calibration_t`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CalibrationPlan {
    /// The register.
    pub select: Vec<u8>,
    /// The number of bytes to read.
    pub count: u16,
}

/// An `up_chip_reading_t`.
#[derive(Clone, Debug)]
pub struct ReadingPlan {
    /// The device's name.
    pub field: String,
    /// The device's identifier in code.
    pub ident: String,
    /// The index of the transfer.
    pub transfer: usize,
    /// The offset in the transfer, counting checksums.
    pub offset: u16,
    /// The output of the formula that it is, if any.
    pub output: Option<u8>,
    /// The coding; `None` for an output of the formula.
    pub value: Option<ValuePlan>,
}

/// An `up_chip_command_t`.
#[derive(Clone, Debug)]
pub struct CommandPlan {
    /// The device's name.
    pub field: String,
    /// The device's identifier in code.
    pub ident: String,
    /// The bytes written before the value.
    pub prefix: Vec<u8>,
    /// The coding.
    pub value: ValuePlan,
    /// The command's own bits, if other commands have bits of the same register; `None` if it has the whole register.
    pub own: Option<OwnBitsPlan>,
    /// The bytes that are sent for the value.
    bytes: u16,
    /// How it is sent, with the number of its elements.
    encoding: (Encoding, u16),
}

/// The bits of a command in a register that it shares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnBitsPlan {
    /// The bits, in as many bytes as the value has.
    pub bits: Vec<u8>,
    /// The offset of the register in [`BusPlan::kept`].
    pub kept: u16,
}

/// The part's tables, one for each connection to a register bus that carries a value.
pub(super) fn plans(source: Source<'_>, prefix: &str) -> Vec<BusPlan> {
    let connections = source.design.connections.iter().enumerate();
    let own: Vec<(ConnectionIndex, &Connection)> = connections
        .map(|(at, one)| (ConnectionIndex(at), one))
        .filter(|(_, one)| one.part == source.index)
        .filter(|(_, one)| one.kind.register_access().is_some())
        .collect();
    let is_one = own.len() < 2;
    let plan = |(index, one): (ConnectionIndex, &Connection)| {
        let name = one.name.as_deref().filter(|_| !is_one);
        let prefix =
            name.map_or_else(|| prefix.to_owned(), |name| format!("{prefix}_{}", snake(name)));
        plan(source, index, prefix)
    };
    own.into_iter().filter_map(plan).collect()
}

fn plan(source: Source<'_>, connection: ConnectionIndex, prefix: String) -> Option<BusPlan> {
    let protocol = source.protocol;
    let all: Vec<&Device> = source
        .devices(|kind| kind.register_access().is_some())
        .filter(|device| device.connections.contains(&connection))
        .collect();
    let address = all.first()?.kind.register_access()?.address.unwrap_or(0);
    let of = |direction| all.iter().copied().filter(move |one| one.direction == direction);
    let sensors: Vec<&Device> = of(Direction::Sensor).collect();
    let (transfers, places) = transfers::plan(&sensors, protocol);
    let readings = sensors.iter().zip(places);
    let sizes = all.iter().map(|device| device.value.value.size_bytes().div_ceil(8));
    let calibration = protocol.calibration.iter().map(|&(number, count)| CalibrationPlan {
        select: register_to_read(u32::from(number), protocol),
        count,
    });
    let (commands, kept) = commands(source.design, of(Direction::Actuator), protocol);
    let init = init(&protocol.init);
    let identity = protocol.identity.as_ref().map(|one| IdentityPlan::new(one, protocol));
    let wire = all.first().and_then(|device| device.kind.onewire());
    let identity = identity.or_else(|| IdentityPlan::of_wire(wire?));
    let calibration: Vec<CalibrationPlan> = calibration.collect();
    Some(BusPlan {
        clock_hz: clock_hz(&commands),
        work_bytes: work_bytes((&init, identity.as_ref(), &calibration), &transfers, &commands),
        prefix,
        connection,
        address,
        init,
        identity,
        calibration,
        transfers,
        readings: readings.filter_map(|(device, place)| reading(device, place?)).collect(),
        commands,
        kept,
        formula: protocol.formula,
        parameters: protocol.parameters.clone(),
        cycle_ms: all.iter().map(|device| device.delay_ms).min().unwrap_or(0),
        calibration_bytes: protocol.calibration.iter().map(|(_, count)| count).sum(),
        scratch_words: sizes.max().unwrap_or(1),
    })
}

/// The steps of the initialisation: bytes and the pause after them are one step.
pub(super) fn init(steps: &[InitStep]) -> Vec<InitPlan> {
    let mut all: Vec<InitPlan> = Vec::new();
    for step in steps {
        match step {
            InitStep::Write(bytes) => {
                all.push(InitPlan { bytes: bytes.clone(), pause_ms: 0 });
            }
            InitStep::Wait { ms } => match all.last_mut().filter(|last| last.pause_ms == 0) {
                Some(last) => last.pause_ms = *ms,
                None => all.push(InitPlan { bytes: Vec::new(), pause_ms: *ms }),
            },
        }
    }
    all
}

impl IdentityPlan {
    fn new(identity: &Identity, protocol: &Protocol) -> Self {
        Self {
            select: register_to_read(u32::from(identity.register), protocol),
            expected: identity.expected.clone(),
            mask: identity.mask.clone(),
        }
    }

    /// The family of a part that is alone on its wire, which is the first byte of its address. One that shares its wire
    /// is called by its address, so that no other answers.
    fn of_wire(wire: &OneWire) -> Option<Self> {
        let family = wire.family.filter(|_| wire.rom.is_none())?;
        let (mut expected, mut mask) = (vec![0; ROM_BYTES], vec![0; ROM_BYTES]);
        *expected.first_mut()? = family;
        *mask.first_mut()? = 0xFF;
        Some(Self { select: vec![READ_ROM], expected, mask })
    }
}

fn reading(device: &Device, place: Place) -> Option<ReadingPlan> {
    let output = device.coding.output.map(|output| output.number);
    let value = match output {
        Some(_) => None,
        None => Some(ValuePlan::of(device)?),
    };
    let name = &device.name.value;
    Some(ReadingPlan {
        field: name.clone(),
        ident: snake(name),
        transfer: place.transfer,
        offset: place.offset,
        output,
        value,
    })
}

/// The commands, and the start values of the registers that they share.
fn commands<'a>(
    design: &Design,
    devices: impl Iterator<Item = &'a Device>,
    protocol: &Protocol,
) -> (Vec<CommandPlan>, Vec<u8>) {
    let mut kept: Vec<u8> = Vec::new();
    let mut places: BTreeMap<Register, usize> = BTreeMap::new();
    let mut all = Vec::new();
    for device in devices {
        let own = registers::own(design, device).map(|own| {
            let place = *places.entry(own.register).or_insert_with(|| {
                let place = kept.len();
                kept.extend(&own.start);
                place
            });
            OwnBitsPlan { bits: own.bits, kept: u16::try_from(place).unwrap_or(u16::MAX) }
        });
        all.extend(command(device, own, protocol));
    }
    (all, kept)
}

fn command(device: &Device, own: Option<OwnBitsPlan>, protocol: &Protocol) -> Option<CommandPlan> {
    let words = Words::of(device)?;
    let number = device.kind.register_access().and_then(|own| own.register);
    let register = number.map(|number| protocol.register(u32::from(number)));
    let start = device.kind.i2c().map_or(&[][..], |own| own.start.as_slice());
    let mut command = CommandPlan {
        field: device.name.value.clone(),
        ident: snake(&device.name.value),
        prefix: [register.unwrap_or_default(), start.to_vec()].concat(),
        value: ValuePlan::new(&words),
        own,
        bytes: words.wire_bytes(),
        encoding: (device.kind.encoding(), words.count),
    };
    command.pulse(Pulses::usual(device.kind.encoding()));
    Some(command)
}

/// The clock of pulses on a unit of which nothing is known.
fn clock_hz(commands: &[CommandPlan]) -> Option<u32> {
    let strip = commands.iter().find(|one| one.value.code == Code::Pulses)?;
    Some(Pulses::usual(strip.encoding.0).clock_hz)
}

impl CommandPlan {
    /// Sets the pulses of a strip, and the bytes that are sent in place of the value.
    fn pulse(&mut self, pulses: Pulses) {
        if self.value.code == Code::Pulses {
            self.value.bits = pulses.bits;
            self.value.low = pulses.short;
            self.value.word_bytes = pulses.long;
        }
        let (encoding, elements) = self.encoding;
        let sent =
            sent_bytes(encoding, elements.into(), self.value.words.into(), pulses.bits.into());
        if let Some(bytes) = sent {
            self.bytes = u16::try_from(bytes).unwrap_or(u16::MAX);
        }
    }
}

impl BusPlan {
    /// Sets the pulses that the unit of a strip makes.
    pub(crate) fn pulse(&mut self, pulses: Pulses) {
        self.clock_hz = self.clock_hz.map(|_| pulses.clock_hz);
        self.commands.iter_mut().for_each(|command| command.pulse(pulses));
        let start = (self.init.as_slice(), self.identity.as_ref(), self.calibration.as_slice());
        self.work_bytes = work_bytes(start, &self.transfers, &self.commands);
    }

    /// Whether a formula computes any of its values.
    pub(crate) fn is_computed(&self) -> bool {
        self.formula.is_some() || !self.calibration.is_empty()
    }
}

/// The size of the work buffer, as `up_chip_work_bytes()` computes it.
fn work_bytes(
    (init, identity, calibration): (&[InitPlan], Option<&IdentityPlan>, &[CalibrationPlan]),
    transfers: &[TransferPlan],
    commands: &[CommandPlan],
) -> usize {
    let init = init.iter().map(|step| step.bytes.len());
    let identity = identity.into_iter().map(|one| one.select.len() + one.expected.len());
    let calibration = calibration.iter().map(|one| one.select.len() + usize::from(one.count));
    let transfers = transfers.iter().map(|one| {
        let length = usize::from(one.length);
        let select = if one.is_exchange { length } else { one.select.len() };
        one.trigger.len().max(select + length)
    });
    let commands = commands.iter().map(|one| one.prefix.len() + usize::from(one.bytes));
    let all = init.chain(identity).chain(calibration).chain(transfers).chain(commands);
    all.max().unwrap_or(0).max(1)
}
