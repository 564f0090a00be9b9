//! Drivers: those of the file, and the library that ships with the tool (`drivers/`).

use sensedsl_diagnostics::codes::{
    e0201_unknown_property, e0207_unknown_kind, e0216_unknown_driver, e0217_driver_of_other_kind,
};
use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap, Span, nearest};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::parse;

use crate::design::Spanned;
use crate::devices::{COMMON_PROPERTIES, PRESENTATION};
use crate::fields::span;
use crate::kind::KindName;

/// The files of the library: name and text.
pub const LIBRARY: &[(&str, &str)] = &[
    ("drivers/environment.sense", include_str!("../../../drivers/environment.sense")),
    ("drivers/motion.sense", include_str!("../../../drivers/motion.sense")),
    ("drivers/radio_control.sense", include_str!("../../../drivers/radio_control.sense")),
    ("drivers/rangers.sense", include_str!("../../../drivers/rangers.sense")),
];

/// The driver that an i2c device without a protocol gets by its address, as in the paper's example.
pub(crate) const DEFAULT_RANGER: &str = "srf08";
/// The 8-bit addresses such a device can have.
pub(crate) const RANGER_ADDRESSES: std::ops::RangeInclusive<i64> = 0xE0..=0xFE;

/// A driver that devices can name.
#[derive(Clone, Debug)]
pub(crate) struct Driver {
    pub(crate) name: Spanned<String>,
    pub(crate) kind: KindName,
    pub(crate) file: FileId,
    pub(crate) node: ast::Driver,
}

/// All drivers in reach, those of the file first.
#[derive(Debug, Default)]
pub(crate) struct Drivers {
    own: Vec<Driver>,
    library: Vec<Driver>,
}

impl Drivers {
    /// The drivers of the file, checked, and the library, which `sources` gets to hold only when
    /// it is needed.
    pub(crate) fn new(
        own: &[(FileId, ast::Driver)],
        sources: &mut SourceMap,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut drivers = Self::default();
        for (file, node) in own {
            drivers.own.extend(read(*file, node, diagnostics));
        }
        for (name, text) in LIBRARY {
            let file = sources.add(*name, *text);
            for node in parse(text).ast().drivers() {
                drivers.library.extend(read(file, &node, diagnostics));
            }
        }
        drivers
    }

    /// The names of the file's own drivers.
    pub(crate) fn own_names(&self) -> Vec<&Spanned<String>> {
        self.own.iter().map(|driver| &driver.name).collect()
    }

    /// The file's own drivers: the name of each, and its whole block.
    pub(crate) fn own_blocks(&self) -> impl Iterator<Item = (&str, Span)> {
        self.own.iter().map(|one| (one.name.value.as_str(), span(one.file, one.node.range())))
    }

    /// The driver of that name for a device of `kind`; otherwise the reason is reported.
    pub(crate) fn find(
        &self,
        wanted: &Spanned<String>,
        kind: KindName,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<&Driver> {
        let all = || self.own.iter().chain(&self.library);
        let Some(driver) = all().find(|driver| driver.name.value == wanted.value) else {
            let meant = nearest(&wanted.value, all().map(|driver| driver.name.value.as_str()));
            let (span, name) = (wanted.span, &wanted.value);
            diagnostics.push(e0216_unknown_driver::unknown_driver(span, name, meant));
            return None;
        };
        if driver.kind != kind {
            diagnostics.push(e0217_driver_of_other_kind::driver_of_other_kind(
                wanted.span,
                &wanted.value,
                driver.kind.name(),
                kind.name(),
            ));
            return None;
        }
        Some(driver)
    }

    /// The library's driver of that name.
    pub(crate) fn library(&self, name: &str) -> Option<&Driver> {
        self.library.iter().find(|driver| driver.name.value == name)
    }
}

/// Reads a driver's head and looks whether its kind has the properties.
fn read(file: FileId, node: &ast::Driver, diagnostics: &mut Vec<Diagnostic>) -> Option<Driver> {
    let (name, kind) = (node.name()?, node.kind()?);
    let kind_span = span(file, kind.range());
    let Some(kind_name) = KindName::from_name(kind.text()) else {
        let meant = nearest(kind.text(), KindName::ALL.map(KindName::name));
        diagnostics.push(e0207_unknown_kind::unknown_kind(
            kind_span,
            kind.text(),
            &KindName::list(),
            meant,
        ));
        return None;
    };
    for property in node.properties() {
        let Some(property) = property.name() else { continue };
        let known = || {
            let common = COMMON_PROPERTIES.iter().chain(PRESENTATION);
            kind_name.spec().properties.iter().chain(common).copied()
        };
        if !known().any(|known| known == property.text()) {
            diagnostics.push(e0201_unknown_property::unknown_property(
                span(file, property.range()),
                property.text(),
                &kind_name.with_article().replace("device", "driver"),
                nearest(property.text(), known()),
            ));
        }
    }
    let name = Spanned { value: name.text().into(), span: span(file, name.range()) };
    Some(Driver { name, kind: kind_name, file, node: node.clone() })
}
