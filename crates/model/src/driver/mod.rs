//! Drivers: the blocks of the file and the library that ships with the tool (`drivers/`) in, the driver that a name
//! means out.

pub(crate) mod bounds;
pub mod facts;
pub(crate) mod known;
pub(crate) mod library;
pub(crate) mod module;
pub(crate) mod near;

use std::cell::OnceCell;

use sensedsl_diagnostics::codes::{
    e0207_unknown_kind, e0216_unknown_driver, e0217_driver_of_other_kind,
};
use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap, Span, nearest};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::parse;

use crate::kind::KindName;
use crate::rule::names::folded;
use crate::spanned::{Spanned, span};

/// The driver that an i2c device without a protocol gets because of its address, as in the paper's
/// example.
pub(crate) const DEFAULT_RANGER: &str = "srf08";
/// The 8-bit addresses that such a device can have.
pub(crate) const RANGER_ADDRESSES: std::ops::RangeInclusive<i64> = 0xE0..=0xFE;

/// A driver that devices and chips can name.
#[derive(Clone, Debug)]
pub(crate) struct Driver {
    pub(crate) name: Spanned<String>,
    /// None for a part with connections of several kinds.
    pub(crate) kind: Option<KindName>,
    pub(crate) file: FileId,
    pub(crate) node: ast::Driver,
    /// Other names that people may use for it.
    aliases: Vec<String>,
}

impl Driver {
    /// Whether it names its values, which makes it a driver for a chip.
    pub(crate) fn has_values(&self) -> bool {
        self.node.readings().next().is_some() || self.node.commands().next().is_some()
    }

    /// The words after `driver = …` in a message: `an i2c driver`, or a driver of several
    /// connections.
    pub(crate) fn what(&self) -> String {
        match self.kind {
            Some(kind) => kind.with_article().replace("device", "driver"),
            None => "a driver of several connections".to_owned(),
        }
    }

    fn is_called(&self, folded_name: &str) -> bool {
        folded(&self.name.value) == folded_name
            || self.aliases.iter().any(|alias| folded(alias) == folded_name)
    }
}

/// A file of the library, parsed when something in it is first requested.
#[derive(Debug)]
struct Volume {
    name: &'static str,
    file: FileId,
    text: &'static str,
    drivers: OnceCell<Vec<Driver>>,
}

impl Volume {
    fn drivers(&self) -> &[Driver] {
        self.drivers.get_or_init(|| {
            let parsed = parse(self.text).ast();
            parsed.drivers().filter_map(|node| read(self.file, &node, &mut Vec::new())).collect()
        })
    }
}

/// All available drivers, those of the file first.
#[derive(Debug, Default)]
pub(crate) struct Drivers {
    own: Vec<Driver>,
    /// The names of the file's drivers whose head is wrong, which has been reported.
    broken: Vec<String>,
    library: Vec<Volume>,
}

impl Drivers {
    /// The drivers of the file and of the library; adds the library's texts to `sources`.
    pub(crate) fn new(
        own: &[(FileId, ast::Driver)],
        sources: &mut SourceMap,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut broken = Vec::new();
        let mut head = |(file, node): &(FileId, ast::Driver)| {
            let driver = read(*file, node, diagnostics);
            let name = node.name().filter(|_| driver.is_none());
            broken.extend(name.map(|name| name.text().to_owned()));
            driver
        };
        let own = own.iter().filter_map(&mut head).collect();
        let volume = |(name, text): &(&'static str, &'static str)| Volume {
            name,
            file: sources.add(*name, *text),
            text,
            drivers: OnceCell::new(),
        };
        let library = library::LIBRARY.iter().map(volume).collect();
        Self { own, broken, library }
    }

    /// The file's own drivers.
    pub(crate) fn own(&self) -> &[Driver] {
        &self.own
    }

    /// The names of the file's own drivers.
    pub(crate) fn own_names(&self) -> Vec<&Spanned<String>> {
        self.own.iter().map(|driver| &driver.name).collect()
    }

    /// The file's own drivers: the name and the whole block of each.
    pub(crate) fn own_blocks(&self) -> impl Iterator<Item = (&str, Span)> {
        self.own.iter().map(|one| (one.name.value.as_str(), span(one.file, one.node.range())))
    }

    /// The driver with that name, or of the part with that name. An unknown name is reported.
    pub(crate) fn find(
        &self,
        wanted: &Spanned<String>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<&Driver> {
        let found = self.look_up(&wanted.value);
        if found.is_none() && !self.broken.contains(&wanted.value) {
            let (span, name) = (wanted.span, &wanted.value);
            let near = self.near(name);
            let similar: Vec<&str> = near.similar.iter().map(String::as_str).collect();
            let new = near::identifier(name);
            let nearby = (near.meant.as_deref(), similar.as_slice());
            diagnostics.push(e0216_unknown_driver::unknown_driver(span, name, nearby, &new));
        }
        found
    }

    /// Like [`Self::find`], for a device of that kind.
    pub(crate) fn find_for(
        &self,
        wanted: &Spanned<String>,
        kind: Spanned<KindName>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<&Driver> {
        let driver = self.find(wanted, diagnostics)?;
        let Spanned { value: kind, span: stated } = kind;
        if driver.kind != Some(kind) {
            let (span, name) = (wanted.span, &driver.name.value);
            let wrong = e0217_driver_of_other_kind::driver_of_other_kind;
            diagnostics.push(wrong(span, name, &driver.what(), kind.name(), Some(stated)));
            return None;
        }
        Some(driver)
    }

    /// The driver with that name; otherwise the one whose part has that name, ignoring case,
    /// hyphens and underscores.
    pub(crate) fn look_up(&self, name: &str) -> Option<&Driver> {
        let own = self.own.iter().find(|driver| driver.name.value == name);
        own.or_else(|| self.library(name)).or_else(|| {
            let folded_name = folded(name);
            self.all().find(|driver| driver.is_called(&folded_name))
        })
    }

    /// The drivers of the library, each with the name of its file, without folder and extension.
    pub(crate) fn of_library(&self) -> impl Iterator<Item = (&'static str, &Driver)> {
        self.library.iter().flat_map(|volume| {
            let name = volume.name.strip_prefix("drivers/").unwrap_or(volume.name);
            let field = name.strip_suffix(".sense").unwrap_or(name);
            volume.drivers().iter().map(move |driver| (field, driver))
        })
    }

    /// The library's driver that a name finds, and the text of its file.
    fn text_of(&self, name: &str) -> Option<(&'static str, &Driver)> {
        let driver = self.look_up(name)?;
        let volume = self.library.iter().find(|volume| volume.file == driver.file)?;
        Some((volume.text, driver))
    }

    fn all(&self) -> impl Iterator<Item = &Driver> {
        self.own.iter().chain(self.library.iter().flat_map(Volume::drivers))
    }

    /// The library's driver with that name.
    pub(crate) fn library(&self, name: &str) -> Option<&Driver> {
        let volumes = self.library.iter().filter(|volume| volume.text.contains(name));
        volumes.flat_map(Volume::drivers).find(|driver| driver.name.value == name)
    }
}

/// Reads a driver's head.
fn read(file: FileId, node: &ast::Driver, diagnostics: &mut Vec<Diagnostic>) -> Option<Driver> {
    let name = node.name()?;
    let kind = match node.kind() {
        None => None,
        Some(kind) => Some(kind_of(file, &kind, diagnostics)?),
    };
    let name = Spanned { value: name.text().into(), span: span(file, name.range()) };
    let aliases = node.properties().find(|one| one.name().is_some_and(|n| n.text() == "aliases"));
    let words = aliases.and_then(|one| one.value()).into_iter().flat_map(|value| {
        value.syntax().descendants().filter_map(ast::StringValue::cast).collect::<Vec<_>>()
    });
    let aliases = words.filter_map(|one| Some(one.literal()?.value())).collect();
    Some(Driver { name, kind, file, node: node.clone(), aliases })
}

/// The kind that a name stands for; an unknown name is reported.
pub(crate) fn kind_of(
    file: FileId,
    kind: &ast::Name,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<KindName> {
    let found = KindName::from_name(kind.text());
    if found.is_none() {
        let meant = nearest(kind.text(), KindName::ALL.map(KindName::name));
        let (at, list) = (span(file, kind.range()), KindName::list());
        diagnostics.push(e0207_unknown_kind::unknown_kind(at, kind.text(), &list, meant));
    }
    found
}
