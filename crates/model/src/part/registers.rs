//! Registers that several commands of a chip share, each with bits of its own, such as the outputs
//! of a port expander. What such a register holds before the host sets anything, and reports of
//! conflicts.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0240_overlap_in_register;
use sensedsl_wire::Direction;

use crate::design::protocol::{InitStep, Protocol};
use crate::design::{ConnectionIndex, Design, Device, PartIndex};
use crate::kind::encoding::Encoding;
use crate::part::words::Words;

/// Most bytes of a register that commands share.
const BYTES_MAX: u16 = 8;

/// The place where a command is written.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Register {
    /// The connection that it is reached over.
    connection: ConnectionIndex,
    /// Its number; none if the part has only one register.
    number: Option<u16>,
    /// Its size in bytes.
    bytes: u16,
}

/// A command's own bits of a register.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Own {
    /// The register that the command is written to.
    pub register: Register,
    /// The command's bits, in the bytes of the register.
    pub bits: Vec<u8>,
    /// What the register holds before the host sets anything.
    pub start: Vec<u8>,
}

impl Register {
    /// The register that a device is written to; none if there is none.
    #[must_use]
    pub fn of(device: &Device) -> Option<Self> {
        let number = device.kind.register_access()?.register;
        // A line of text is no register with bits, whatever its length.
        let is_plain = device.kind.encoding() == Encoding::Plain;
        let words = Words::of(device).filter(|words| words.crc.is_none() && is_plain)?;
        let bytes = words.wire_bytes();
        let is_written = device.direction == Direction::Actuator && bytes <= BYTES_MAX;
        let connection = *device.connections.first()?;
        is_written.then_some(Self { connection, number, bytes })
    }

    /// The bytes before the value.
    fn prefix(&self, protocol: &Protocol) -> Vec<u8> {
        self.number.map(|number| protocol.register(number.into())).unwrap_or_default()
    }

    /// The last initialization step that writes the whole register.
    fn written_by(&self, protocol: &Protocol) -> Option<usize> {
        let prefix = self.prefix(protocol);
        let count = prefix.len() + usize::from(self.bytes);
        protocol.init.iter().rposition(|step| match step {
            InitStep::Write(bytes) => bytes.len() == count && bytes.starts_with(&prefix),
            InitStep::Wait { .. } => false,
        })
    }

    /// The register's contents after initialization; 0 if that does not write it.
    fn start(&self, protocol: &Protocol) -> Vec<u8> {
        let step = self.written_by(protocol).and_then(|step| protocol.init.get(step));
        let count = usize::from(self.bytes);
        match step {
            Some(InitStep::Write(bytes)) => {
                bytes.iter().skip(bytes.len() - count).copied().collect()
            }
            Some(InitStep::Wait { .. }) | None => vec![0; count],
        }
    }
}

/// The bits of a command whose register has other bits to preserve; none if it has all bits of its
/// register, or no other bits are ever set.
#[must_use]
pub fn own(design: &Design, device: &Device) -> Option<Own> {
    let register = Register::of(device)?;
    let bits = bits(device, &register)?;
    let start = register.start(design.part(device.part)?.chip.as_ref()?);
    let beside = design.devices.iter().filter(|other| other.part == device.part);
    let is_shared =
        beside.filter(|other| Register::of(other).as_ref() == Some(&register)).count() > 1;
    let is_set = start.iter().zip(&bits).any(|(start, bits)| start & !bits != 0);
    (is_shared || is_set).then_some(Own { register, bits, start })
}

/// The bits of a command, in the bytes of its register; none if it has all of them.
fn bits(device: &Device, register: &Register) -> Option<Vec<u8>> {
    let all = Words::of(device)?.in_frame(0).to_le_bytes();
    let bits = all.get(..register.bytes.into())?;
    bits.iter().any(|byte| *byte != 0xFF).then(|| bits.to_vec())
}

/// Sets the initial contents of registers from their commands, and reports commands that take the
/// same bits.
pub(crate) fn settle(design: &mut Design, diagnostics: &mut Vec<Diagnostic>) {
    let mut shared: BTreeMap<(PartIndex, Register), Vec<usize>> = BTreeMap::new();
    for (index, device) in design.devices.iter().enumerate() {
        let is_chip = design.part(device.part).is_some_and(|part| part.chip.is_some());
        if let Some(register) = Register::of(device).filter(|_| is_chip) {
            shared.entry((device.part, register)).or_default().push(index);
        }
    }
    for ((part, register), indices) in shared {
        let devices: Vec<&Device> =
            indices.iter().filter_map(|index| design.devices.get(*index)).collect();
        overlap(&devices, &register, diagnostics);
        let first: Vec<(u64, u64)> = devices.iter().filter_map(|one| first(one)).collect();
        let chip = design.parts.get_mut(part.0).and_then(|part| part.chip.as_mut());
        if let Some(protocol) = chip.filter(|_| !first.is_empty()) {
            begin(protocol, &register, &first);
        }
    }
}

/// The bits of a command that has an initial value, and that value.
fn first(device: &Device) -> Option<(u64, u64)> {
    let is_on = device.coding.initial?;
    let words = Words::of(device)?;
    Some((words.in_frame(0), words.placed(0, u64::from(is_on))?))
}

/// Makes the initialization write the commands' initial values: in the step that writes the
/// register anyway, or else at the end.
fn begin(protocol: &mut Protocol, register: &Register, first: &[(u64, u64)]) {
    let mut start = register.start(protocol);
    for (bits, value) in first {
        let pairs = bits.to_le_bytes().into_iter().zip(value.to_le_bytes());
        for (byte, (bits, value)) in start.iter_mut().zip(pairs) {
            *byte = *byte & !bits | value;
        }
    }
    let mut bytes = register.prefix(protocol);
    bytes.append(&mut start);
    let step = InitStep::Write(bytes);
    let place = register.written_by(protocol).and_then(|place| protocol.init.get_mut(place));
    match place {
        Some(place) => *place = step,
        None => protocol.init.push(step),
    }
}

/// Reports commands that take the same bits of a register, where at least one takes only part of
/// it.
fn overlap(devices: &[&Device], register: &Register, diagnostics: &mut Vec<Diagnostic>) {
    let taken = |device: &Device| Words::of(device).map_or(0, |words| words.in_frame(0));
    let is_partial = |device: &Device| bits(device, register).is_some();
    for (at, device) in devices.iter().enumerate() {
        let clash = devices.iter().take(at).find(|other| {
            taken(device) & taken(other) != 0 && (is_partial(device) || is_partial(other))
        });
        if let Some(other) = clash {
            let shown = register.number.map(|number| format!("0x{number:02X}"));
            let (name, from) = (&device.name, &other.name);
            diagnostics.push(e0240_overlap_in_register::overlap_in_register(
                name.span,
                &name.value,
                &from.value,
                from.span,
                shown.as_deref(),
            ));
        }
    }
}
