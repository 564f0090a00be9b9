//! The Python package `modm-devices`. In: its STM32 device files. Out: part numbers with packages
//! and positions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use roxmltree::{Document, Node};
use sensedsl_board::pin::{PinName, natural};

use super::metapac::RESERVED;
use super::sources::{entries, text};

/// A part number.
#[derive(Clone, Debug)]
pub(crate) struct Device {
    /// The base of the part number: `STM32F407VG`.
    pub(crate) base: String,
    /// The rest of the part number: package, grade, variant.
    pub(crate) package_code: String,
    pub(crate) grade: String,
    pub(crate) variant: String,
    pub(crate) package: String,
    /// Positions and pins.
    pub(crate) places: Vec<(String, String)>,
    /// The cores: `Cortex-M7 + Cortex-M4`.
    pub(crate) core: String,
    pub(crate) ram_bytes: usize,
}

impl Device {
    /// The whole part number.
    pub(crate) fn number(&self) -> String {
        format!("{}{}{}{}", self.base, self.package_code, self.grade, self.variant)
    }
}

/// The attributes that tell the devices of a file apart.
pub(super) type Identity = BTreeMap<String, String>;

/// All part numbers.
pub(crate) fn read(folder: &Path) -> Result<Vec<Device>> {
    let mut devices = Vec::new();
    for path in entries(folder)? {
        let text = text(&path)?;
        let document = Document::parse(&text).with_context(|| path.display().to_string())?;
        let root = child(document.root_element(), "device").context("no device")?;
        let schema =
            child(root, "naming-schema").and_then(|node| node.text()).context("no schema")?;
        // The cores of a device share its pins, and each has a list of the memory that it reaches.
        let mut cores: BTreeMap<String, Vec<Identity>> = BTreeMap::new();
        for identity in identities(root, schema) {
            let name = spell(schema, &identity);
            let number = name.split('@').next().unwrap_or(&name).to_owned();
            cores.entry(number).or_default().push(identity);
        }
        for (number, identities) in cores {
            devices.extend(device(root, &identities).with_context(|| number)?);
        }
    }
    Ok(devices)
}

pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &'static str) -> Option<Node<'a, 'i>> {
    children(node, name).next()
}

pub(super) fn children<'a, 'i>(
    node: Node<'a, 'i>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |node| node.has_tag_name(name))
}

/// The devices of a file: all combinations of the values that it lists for the fields of its
/// schema, without those that it marks as invalid; if it marks any as valid, only those.
pub(super) fn identities(root: Node<'_, '_>, schema: &str) -> Vec<Identity> {
    let fields = schema.split('{').filter_map(|part| Some(part.split_once('}')?.0));
    let mut all = vec![Identity::new()];
    for field in fields {
        let values = root.attribute(field).unwrap_or_default().split('|');
        let with = |value: &str| {
            let with = |one: &Identity| {
                let mut one = one.clone();
                one.insert(field.to_owned(), value.to_owned());
                one
            };
            all.iter().map(with).collect::<Vec<_>>()
        };
        all = values.flat_map(with).collect();
    }
    let named =
        |tag| -> BTreeSet<&str> { children(root, tag).filter_map(|node| node.text()).collect() };
    let (valid, invalid) = (named("valid-device"), named("invalid-device"));
    all.retain(|one| {
        let name = spell(schema, one);
        !invalid.contains(name.as_str()) && (valid.is_empty() || valid.contains(name.as_str()))
    });
    all.sort_by_cached_key(|one| spell(schema, one));
    all
}

/// The name of a device.
pub(super) fn spell(schema: &str, identity: &Identity) -> String {
    let value = |part: &str| match part.split_once('}') {
        Some((field, rest)) => {
            format!("{}{rest}", identity.get(field).map(String::as_str).unwrap_or_default())
        }
        None => part.to_owned(),
    };
    schema.split('{').map(value).collect()
}

/// Whether a node's `device-…` attributes apply to the device.
pub(super) fn applies(node: Node<'_, '_>, identity: &Identity) -> bool {
    node.attributes().all(|attribute| match attribute.name().strip_prefix("device-") {
        Some(field) => {
            identity.get(field).is_none_or(|own| attribute.value().split('|').any(|one| one == own))
        }
        None => true,
    })
}

/// The device, if it has a package.
fn device(root: Node<'_, '_>, cores: &[Identity]) -> Result<Option<Device>> {
    let identity = cores.first().context("a device without a name")?;
    let field = |name: &str| identity.get(name).cloned().unwrap_or_default().to_uppercase();
    let drivers = children(root, "driver").filter(|node| node.attribute("name") == Some("gpio"));
    let mut packages = drivers
        .chain(children(root, "driver"))
        .flat_map(|driver| children(driver, "package"))
        .filter(|package| applies(*package, identity));
    let Some(package) = packages.next() else { return Ok(None) };
    let places = places(package, identity);
    Ok(Some(Device {
        base: format!("STM32{}{}{}{}", field("family"), field("name"), field("pin"), field("size")),
        package_code: field("package"),
        grade: field("temperature"),
        variant: field("variant"),
        package: package.attribute("name").context("a package without a name")?.to_owned(),
        places,
        core: core(root, cores)?,
        ram_bytes: ram(root, cores)?,
    }))
}

/// The positions of a package, with their pins.
pub(super) fn places(package: Node<'_, '_>, identity: &Identity) -> Vec<(String, String)> {
    let pins = children(package, "pin").filter(|pin| applies(*pin, identity));
    let places = pins.filter_map(|pin| {
        let name = pin.attribute("name")?;
        let port = name.strip_prefix('P')?.trim_start_matches(|c: char| c.is_ascii_uppercase());
        let pin_name = port.starts_with(|c: char| c.is_ascii_digit()).then_some(name)?;
        Some((pin.attribute("position")?.to_owned(), PinName::parse(pin_name)?.to_string()))
    });
    let mut places: Vec<(String, String)> = places.collect();
    places.sort_by(|(a, p), (b, q)| natural(a, b).then_with(|| natural(p, q)));
    places.dedup();
    places
}

/// The driver that describes the cores.
fn core_driver<'a, 'i>(root: Node<'a, 'i>) -> Result<Node<'a, 'i>> {
    let mut drivers = children(root, "driver");
    drivers.find(|node| node.attribute("name") == Some("core")).context("no core")
}

/// The names of the cores, the more powerful first.
fn core(root: Node<'_, '_>, cores: &[Identity]) -> Result<String> {
    let driver = core_driver(root)?;
    let kind = |identity: &Identity| {
        let mut own = children(driver, "attribute-type").filter(|node| applies(*node, identity));
        let kind = own.next().and_then(|node| node.attribute("value"));
        let kind = kind.or(driver.attribute("type")).context("a core without a type")?;
        let number = kind.strip_prefix("cortex-m").with_context(|| kind.to_owned())?;
        Ok(format!("Cortex-M{}", number.replace("plus", "+")))
    };
    let mut names: Vec<String> = cores.iter().map(kind).collect::<Result<_>>()?;
    names.sort();
    names.reverse();
    Ok(names.join(" + "))
}

/// The bytes of RAM that any core reaches, without memory at a second address, and without memory
/// that a battery keeps.
fn ram(root: Node<'_, '_>, cores: &[Identity]) -> Result<usize> {
    let (mut names, mut starts, mut sum) = (BTreeSet::new(), BTreeSet::new(), 0);
    for identity in cores {
        let memories = children(core_driver(root)?, "memory");
        for memory in memories.filter(|node| applies(*node, identity)) {
            let attribute = |name: &str| memory.attribute(name);
            let name = attribute("name").context("a memory without a name")?;
            let is_ram = attribute("access").is_some_and(|access| access.contains('w'))
                && attribute("alias").is_none();
            let is_kept = name == "backup" || name.starts_with("bkp");
            let start = attribute("start").context("no start")?;
            if is_ram && !is_kept && names.insert(name) && starts.insert(start) {
                let size: usize = attribute("size").context("no size")?.parse()?;
                sum += size.next_multiple_of(RESERVED);
            }
        }
    }
    ensure!(sum > 0, "no RAM");
    Ok(sum)
}
