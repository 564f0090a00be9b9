//! The facts about parts, as tables and JSON show them and filters check them.

use sensedsl_parts::{Found, Part};
use serde_json::{Map, Value, json};

use crate::cli::PartsArgs;

const KB: usize = 1024;

/// The known facts about a part.
#[derive(Clone, Debug, Default)]
pub(super) struct Facts {
    pub(super) package: Option<&'static str>,
    pub(super) contacts: Option<u32>,
    cores: Vec<&'static str>,
    /// `None` if the flash is a chip beside the part.
    pub(super) flash_bytes: Option<usize>,
    pub(super) ram_bytes: Option<usize>,
}

impl Facts {
    pub(super) fn of(part: Part) -> Self {
        Self {
            package: part.package(),
            contacts: part.contacts(),
            cores: part.cores().collect(),
            flash_bytes: part.flash_bytes(),
            ram_bytes: Some(part.ram_bytes()),
        }
    }

    /// The facts about a board's MCU; none if it is not a known part.
    pub(super) fn of_mcu(mcu: &str) -> Self {
        let Some(found) = sensedsl_parts::find(mcu) else { return Self::default() };
        let first = found.parts.first().map(|part| Self::of(*part)).unwrap_or_default();
        Self { package: Found::package(&found), ..first }
    }

    /// Package, core, flash and RAM in the short form for a table: `LQFP100`, `M4`, `1024`, `192`.
    pub(super) fn cells(&self) -> [String; 4] {
        // Two packages have further words, which the part number also tells.
        let package = self.package.unwrap_or("-").split(' ').next().unwrap_or_default().to_owned();
        let cores: Vec<&str> =
            self.cores.iter().map(|core| core.strip_prefix("Cortex-").unwrap_or(core)).collect();
        let core = match cores.as_slice() {
            [] => "-".to_owned(),
            [first, second] if first == second => format!("2x {first}"),
            some => some.join("+"),
        };
        let flash = match (self.flash_bytes, self.ram_bytes) {
            (Some(bytes), _) => kb(bytes),
            (None, Some(_)) => "ext".to_owned(),
            (None, None) => "-".to_owned(),
        };
        [package, core, flash, self.ram_bytes.map_or_else(|| "-".to_owned(), kb)]
    }

    /// A line of JSON with the part's number, its facts, and further values.
    pub(super) fn json_line<'a>(
        &self,
        part: &str,
        more: impl IntoIterator<Item = (&'a str, Value)>,
    ) -> String {
        format!("{}\n", self.json(part, more))
    }

    /// The part's number, its facts, and further values.
    pub(super) fn json<'a>(
        &self,
        part: &str,
        more: impl IntoIterator<Item = (&'a str, Value)>,
    ) -> Value {
        let own = [
            ("part", json!(part)),
            ("package", json!(self.package)),
            ("cores", json!(self.cores)),
            ("flash_bytes", json!(self.flash_bytes)),
            ("ram_bytes", json!(self.ram_bytes)),
        ];
        let fields = own.into_iter().chain(more);
        let object: Map<String, Value> =
            fields.map(|(name, value)| (name.to_owned(), value)).collect();
        Value::Object(object)
    }

    /// Whether the part has memory but no flash.
    pub(super) const fn is_flash_outside(&self) -> bool {
        self.ram_bytes.is_some() && self.flash_bytes.is_none()
    }
}

/// Bytes in KB: `64`, `2.5`.
fn kb(bytes: usize) -> String {
    match (bytes / KB, bytes % KB * 10 / KB) {
        (whole, 0) => whole.to_string(),
        (whole, tenths) => format!("{whole}.{tenths}"),
    }
}

/// The legend below a table for the memory sizes in it.
pub(super) fn units<'a>(mut shown: impl Iterator<Item = &'a Facts>) -> &'static str {
    if shown.any(Facts::is_flash_outside) {
        "flash and RAM in KB; ext: the flash is a chip beside the part"
    } else {
        "flash and RAM in KB"
    }
}

/// The filters of a call.
pub(super) struct Filter {
    family: Option<String>,
    package: Option<String>,
    core: Option<String>,
    pins_max: Option<u32>,
    flash_min: usize,
    ram_min: usize,
}

impl Filter {
    pub(super) fn of(args: &PartsArgs) -> Self {
        let upper = |text: &Option<String>| text.as_ref().map(|text| text.to_uppercase());
        let bytes = |kb: Option<usize>| kb.unwrap_or(0).saturating_mul(KB);
        Self {
            family: upper(&args.family),
            package: upper(&args.package),
            core: upper(&args.core),
            pins_max: args.max_pins,
            flash_min: bytes(args.min_flash),
            ram_min: bytes(args.min_ram),
        }
    }

    /// Whether a part, or a board's MCU, passes the filters.
    pub(super) fn leaves(&self, base: &str, facts: &Facts) -> bool {
        let begins = |family: &String| {
            let short = base.strip_prefix("STM32").unwrap_or(base);
            base.starts_with(family) || short.starts_with(family)
        };
        let packed = |package: &String| {
            facts.package.is_some_and(|of| of.to_uppercase().starts_with(package))
                || facts.contacts.is_some_and(|contacts| contacts.to_string() == *package)
        };
        let has_core = |wanted: &String| {
            let short = |core: &str| core.strip_prefix("CORTEX-").unwrap_or(core).to_owned();
            facts.cores.iter().any(|core| short(&core.to_uppercase()) == short(wanted))
        };
        // The flash beside a part can have any size.
        let flash =
            if facts.is_flash_outside() { usize::MAX } else { facts.flash_bytes.unwrap_or(0) };
        self.family.as_ref().is_none_or(begins)
            && self.package.as_ref().is_none_or(packed)
            && self.core.as_ref().is_none_or(has_core)
            && self.pins_max.is_none_or(|most| facts.contacts.is_some_and(|pins| pins <= most))
            && flash >= self.flash_min
            && facts.ram_bytes.unwrap_or(0) >= self.ram_min
    }
}
