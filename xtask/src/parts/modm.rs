//! The Python package `modm-devices`: its STM32 device files in, part numbers with packages and
//! positions out.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result};
use roxmltree::{Document, Node};
use sensedsl_board::pin::{PinName, natural};

use super::sources::{entries, text};

/// A part number.
#[derive(Clone, Debug)]
pub(crate) struct Device {
    /// `STM32F407VG`.
    pub(crate) base: String,
    /// What follows: package, grade, variant.
    pub(crate) package_code: String,
    pub(crate) grade: String,
    pub(crate) variant: String,
    pub(crate) package: String,
    /// Position and pin.
    pub(crate) places: Vec<(String, String)>,
}

/// The attributes that tell the devices of a file apart.
type Identity = BTreeMap<String, String>;

/// All part numbers.
pub(crate) fn read(folder: &Path) -> Result<Vec<Device>> {
    let mut devices = Vec::new();
    for path in entries(folder)? {
        let text = text(&path)?;
        let document = Document::parse(&text).with_context(|| path.display().to_string())?;
        let root = child(document.root_element(), "device").context("no device")?;
        let schema =
            child(root, "naming-schema").and_then(|node| node.text()).context("no schema")?;
        let mut seen = BTreeSet::new();
        for name in children(root, "valid-device").filter_map(|node| node.text()) {
            let identity =
                identify(root, schema, name).with_context(|| format!("{name}: {schema}"))?;
            // The cores of a device share its pins.
            let number = name.split('@').next().unwrap_or(name).to_owned();
            if seen.insert(number) {
                devices.extend(device(root, &identity));
            }
        }
    }
    Ok(devices)
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &'static str) -> Option<Node<'a, 'i>> {
    children(node, name).next()
}

fn children<'a, 'i>(node: Node<'a, 'i>, name: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |node| node.has_tag_name(name))
}

/// The values of the schema's fields in a name: each is one of those that the file lists.
fn identify(root: Node<'_, '_>, schema: &str, name: &str) -> Option<Identity> {
    fn go(root: Node<'_, '_>, schema: &str, name: &str, found: &mut Identity) -> bool {
        if schema.is_empty() {
            return name.is_empty();
        }
        if let Some((field, rest)) = schema.strip_prefix('{').and_then(|s| s.split_once('}')) {
            let values = root.attribute(field).unwrap_or_default().split('|');
            for value in values.filter(|value| name.starts_with(value)) {
                found.insert(field.to_owned(), value.to_owned());
                if go(root, rest, name.get(value.len()..).unwrap_or_default(), found) {
                    return true;
                }
            }
            return false;
        }
        let mut schema = schema.chars();
        let mut name = name.chars();
        schema.next() == name.next() && go(root, schema.as_str(), name.as_str(), found)
    }
    let mut found = Identity::new();
    go(root, schema, name, &mut found).then_some(found)
}

/// Whether a node's `device-…` attributes let the device have it.
fn applies(node: Node<'_, '_>, identity: &Identity) -> bool {
    node.attributes().all(|attribute| match attribute.name().strip_prefix("device-") {
        Some(field) => {
            identity.get(field).is_none_or(|own| attribute.value().split('|').any(|one| one == own))
        }
        None => true,
    })
}

fn device(root: Node<'_, '_>, identity: &Identity) -> Option<Device> {
    let field = |name: &str| identity.get(name).cloned().unwrap_or_default().to_uppercase();
    let drivers = children(root, "driver").filter(|node| node.attribute("name") == Some("gpio"));
    let mut packages = drivers
        .chain(children(root, "driver"))
        .flat_map(|driver| children(driver, "package"))
        .filter(|package| applies(*package, identity));
    let package = packages.next()?;
    let pins = children(package, "pin").filter(|pin| applies(*pin, identity));
    let places = pins.filter_map(|pin| {
        let name = pin.attribute("name")?;
        let port = name.strip_prefix('P')?.strip_prefix(|c: char| c.is_ascii_uppercase())?;
        let pin_name = port.starts_with(|c: char| c.is_ascii_digit()).then_some(name)?;
        Some((pin.attribute("position")?.to_owned(), PinName::parse(pin_name)?.to_string()))
    });
    let mut places: Vec<(String, String)> = places.collect();
    places.sort_by(|(a, p), (b, q)| natural(a, b).then_with(|| natural(p, q)));
    places.dedup();
    Some(Device {
        base: format!("STM32{}{}{}{}", field("family"), field("name"), field("pin"), field("size")),
        package_code: field("package"),
        grade: field("temperature"),
        variant: field("variant"),
        package: package.attribute("name")?.to_owned(),
        places,
    })
}
