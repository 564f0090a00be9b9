//! The format of the shipped table: facts in, bytes out, and back.
//!
//! Everything that repeats is stored once and referred to by number: signals, pins, rows (a pin and
//! its usages), dies (lists of rows), layouts (the pins of a package), parts. Numbers are written
//! as the difference from the one before, seven bits per byte; names as the difference from the
//! name before; the whole is deflated.

use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;

/// Version of the format.
const VERSION: u64 = 2;
/// The most bytes that an unpacked table may have: ten times what it has.
const UNPACKED_MAX: usize = 16 << 20;

/// The facts of all parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Data {
    /// Names of usages.
    pub signals: Vec<String>,
    /// Names of pins.
    pub pins: Vec<String>,
    /// Names of places on a package: `12`, `A4`.
    pub positions: Vec<String>,
    /// Names of packages.
    pub packages: Vec<String>,
    /// Codes that follow the base of a part number: `T6`.
    pub codes: Vec<String>,
    /// Processor cores: `Cortex-M7`, and `Cortex-M7 + Cortex-M4` if a part has both.
    pub cores: Vec<String>,
    /// Pins with their usages.
    pub rows: Vec<Row>,
    /// Lists of rows, each ascending.
    pub dies: Vec<Vec<usize>>,
    /// Packages with their pins.
    pub layouts: Vec<Layout>,
    /// The parts.
    pub parts: Vec<PartData>,
}

/// A pin and its usages.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Row {
    /// Index into the pins.
    pub pin: usize,
    /// Indices into the signals, ascending, with the numbers of the alternate functions.
    pub usages: Vec<(usize, Option<u8>)>,
}

/// The pins of a package.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Layout {
    /// Index into the packages.
    pub package: usize,
    /// Index into the positions and into the pins; several pins may share a position.
    pub places: Vec<(usize, usize)>,
}

/// A part.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct PartData {
    /// The part number without package and grade: `STM32F407VG`.
    pub base: String,
    /// Indices into the codes: what may follow the base.
    pub codes: Vec<usize>,
    /// Index into the dies.
    pub die: usize,
    /// Index into the layouts; `None` if the package is not known.
    pub layout: Option<usize>,
    /// Index into the cores.
    pub core: usize,
    /// Bytes of flash in the part; zero if all of it is outside.
    pub flash_bytes: usize,
    /// Bytes of RAM in the part.
    pub ram_bytes: usize,
}

/// Facts of parts that are written column by column.
const COLUMNS: [fn(&mut PartData) -> &mut usize; 3] =
    [|part| &mut part.core, |part| &mut part.flash_bytes, |part| &mut part.ram_bytes];

/// Packs the facts.
#[must_use]
pub fn pack(data: &Data) -> Vec<u8> {
    let mut out = Writer::default();
    out.number(VERSION);
    let names = [&data.signals, &data.pins, &data.positions, &data.packages, &data.codes];
    for names in names.into_iter().chain([&data.cores]) {
        out.names(names.iter().map(String::as_str));
    }
    out.count(data.rows.len());
    let mut pin = 0;
    for row in &data.rows {
        out.difference(&mut pin, row.pin);
        out.count(row.usages.len());
        let mut signal = 0;
        for (of, alternate) in &row.usages {
            out.difference(&mut signal, *of);
            out.number(alternate.map_or(0, |number| u64::from(number) + 1));
        }
    }
    out.count(data.dies.len());
    for die in &data.dies {
        out.differences(die);
    }
    out.count(data.layouts.len());
    for layout in &data.layouts {
        out.count(layout.package);
        out.differences(&layout.places.iter().map(|(position, _)| *position).collect::<Vec<_>>());
        out.differences(&layout.places.iter().map(|(_, pin)| *pin).collect::<Vec<_>>());
    }
    out.names(data.parts.iter().map(|part| part.base.as_str()));
    let (mut die, mut layout) = (0, 0);
    for part in &data.parts {
        out.differences(&part.codes);
        out.difference(&mut die, part.die);
        out.difference(&mut layout, part.layout.map_or(0, |index| index + 1));
    }
    // Column by column: neighbours are similar, which packs well.
    for of in COLUMNS {
        let mut before = 0;
        for part in &data.parts {
            let mut part = part.clone();
            out.difference(&mut before, *of(&mut part));
        }
    }
    compress_to_vec(&out.bytes, 10)
}

/// Unpacks what [`pack`] made; `None` if the bytes are damaged.
#[must_use]
pub fn unpack(packed: &[u8]) -> Option<Data> {
    let bytes = decompress_to_vec_with_limit(packed, UNPACKED_MAX).ok()?;
    let mut input = Reader { rest: &bytes };
    if input.number()? != VERSION {
        return None;
    }
    let mut data = Data {
        signals: input.names()?,
        pins: input.names()?,
        positions: input.names()?,
        packages: input.names()?,
        codes: input.names()?,
        cores: input.names()?,
        ..Data::default()
    };
    let mut pin = 0;
    for _ in 0..input.count()? {
        input.difference(&mut pin)?;
        let mut row = Row { pin, usages: Vec::new() };
        let mut signal = 0;
        for _ in 0..input.count()? {
            input.difference(&mut signal)?;
            let alternate = match input.number()? {
                0 => None,
                number => Some(u8::try_from(number - 1).ok()?),
            };
            row.usages.push((signal, alternate));
        }
        data.rows.push(row);
    }
    for _ in 0..input.count()? {
        data.dies.push(input.differences()?);
    }
    for _ in 0..input.count()? {
        let package = input.count()?;
        let positions = input.differences()?;
        let places = positions.into_iter().zip(input.differences()?).collect();
        data.layouts.push(Layout { package, places });
    }
    let (mut die, mut layout) = (0, 0);
    for base in input.names()? {
        let codes = input.differences()?;
        input.difference(&mut die)?;
        input.difference(&mut layout)?;
        let layout = layout.checked_sub(1);
        data.parts.push(PartData { base, codes, die, layout, ..PartData::default() });
    }
    for of in COLUMNS {
        let mut before = 0;
        for part in &mut data.parts {
            input.difference(&mut before)?;
            *of(part) = before;
        }
    }
    input.rest.is_empty().then_some(data)
}

#[derive(Default)]
struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    fn number(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.bytes.push(0x80 | u8::try_from(number & 0x7F).unwrap_or_default());
            number >>= 7;
        }
        self.bytes.push(u8::try_from(number).unwrap_or_default());
    }

    fn count(&mut self, count: usize) {
        self.number(u64::try_from(count).unwrap_or_default());
    }

    /// A number by its distance from the one before, which it replaces; the sign is the last bit.
    fn difference(&mut self, before: &mut usize, number: usize) {
        let far = u64::try_from(number.abs_diff(*before)).unwrap_or_default();
        self.number(far << 1 | u64::from(number < *before));
        *before = number;
    }

    fn differences(&mut self, numbers: &[usize]) {
        self.count(numbers.len());
        let mut before = 0;
        for number in numbers {
            self.difference(&mut before, *number);
        }
    }

    fn names<'a>(&mut self, names: impl ExactSizeIterator<Item = &'a str>) {
        self.count(names.len());
        let mut before: &[u8] = &[];
        for name in names {
            let name = name.as_bytes();
            let same = before.iter().zip(name).take_while(|(a, b)| a == b).count();
            let rest = name.get(same..).unwrap_or_default();
            self.count(same);
            self.count(rest.len());
            self.bytes.extend_from_slice(rest);
            before = name;
        }
    }
}

struct Reader<'a> {
    rest: &'a [u8],
}

impl Reader<'_> {
    fn number(&mut self) -> Option<u64> {
        let mut number = 0;
        for shift in (0..63).step_by(7) {
            let (byte, rest) = self.rest.split_first()?;
            self.rest = rest;
            number |= u64::from(byte & 0x7F) << shift;
            if byte & 0x80 == 0 {
                return Some(number);
            }
        }
        None
    }

    /// A number of things, each of which takes at least a byte.
    fn count(&mut self) -> Option<usize> {
        usize::try_from(self.number()?).ok().filter(|count| *count <= UNPACKED_MAX)
    }

    fn difference(&mut self, before: &mut usize) -> Option<()> {
        let number = self.number()?;
        let far = usize::try_from(number >> 1).ok()?;
        *before =
            if number & 1 == 0 { before.checked_add(far)? } else { before.checked_sub(far)? };
        Some(())
    }

    fn differences(&mut self) -> Option<Vec<usize>> {
        let mut before = 0;
        let count = self.count()?;
        (0..count).map(|_| self.difference(&mut before).map(|()| before)).collect()
    }

    fn names(&mut self) -> Option<Vec<String>> {
        let mut names: Vec<String> = Vec::new();
        for _ in 0..self.count()? {
            let same = self.count()?;
            let more = self.count()?;
            let (rest, tail) = self.rest.split_at_checked(more)?;
            self.rest = tail;
            let mut name = names.last().map_or(Some(""), |before| before.get(..same))?.to_owned();
            name.push_str(std::str::from_utf8(rest).ok()?);
            names.push(name);
        }
        Some(names)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn names() -> impl Strategy<Value = Vec<String>> {
        prop::collection::vec("[A-Z0-9_]{0,9}", 0..9)
    }

    prop_compose! {
        fn facts()(
            (signals, pins, codes) in (names(), names(), names()),
            rows in prop::collection::vec(
                (0..99_usize, prop::collection::vec((0..999_usize, prop::option::of(0..=255_u8)), 0..9)),
                0..9,
            ),
            dies in prop::collection::vec(prop::collection::vec(0..9999_usize, 0..9), 0..9),
            layouts in prop::collection::vec(
                (0..9_usize, prop::collection::vec((0..300_usize, 0..300_usize), 0..9)), 0..9),
            parts in prop::collection::vec(
                ("[A-Z0-9]{1,12}", prop::collection::vec(0..9_usize, 0..4), 0..99_usize,
                 prop::option::of(0..99_usize), (0..9_usize, 0..1_usize << 22, 0..1_usize << 22)),
                0..9),
        ) -> Data {
            Data {
                signals, pins, positions: Vec::new(), packages: Vec::new(), codes,
                cores: vec!["Cortex-M4".to_owned()],
                rows: rows.into_iter().map(|(pin, usages)| Row { pin, usages }).collect(),
                dies,
                layouts: layouts
                    .into_iter()
                    .map(|(package, places)| Layout { package, places })
                    .collect(),
                parts: parts
                    .into_iter()
                    .map(|(base, codes, die, layout, (core, flash_bytes, ram_bytes))| PartData {
                        base, codes, die, layout, core, flash_bytes, ram_bytes,
                    })
                    .collect(),
            }
        }
    }

    proptest! {
        #[test]
        fn what_is_packed_comes_back(data in facts()) {
            prop_assert_eq!(unpack(&pack(&data)), Some(data));
        }

        /// Damage is reported or gives other facts; it never panics and never takes unlimited
        /// memory.
        #[test]
        fn damage_does_no_harm(data in facts(), at in 0..2000_usize, to: u8, cut in 0..400_usize) {
            let mut raw = decompress_to_vec_with_limit(&pack(&data), UNPACKED_MAX).unwrap_or_default();
            if let Some(byte) = raw.get_mut(at) {
                *byte = to;
            }
            raw.truncate(raw.len().saturating_sub(cut % 7));
            let _ = unpack(&compress_to_vec(&raw, 1));
            let mut packed = pack(&data);
            packed.truncate(cut);
            let _ = unpack(&packed);
        }
    }
}
