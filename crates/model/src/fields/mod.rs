//! The properties of one block: taken one by one by name, converted, and reported when wrong.
//!
//! A [`Fields`] is filled from a block (and from the driver it names), read by the kind and by the
//! code for what every device has, and asked at the end which properties were not taken.

#[cfg(test)]
pub(crate) mod asked;
mod bytes;
mod contradictions;
mod measure;
mod plain;
mod quantities;
mod shown;

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use sensedsl_diagnostics::codes::{
    e0202_property_twice, e0206_missing_property, e0209_wrong_value, e0211_out_of_range,
    e0212_unknown_word,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_syntax::ast::{self, AstNode as _, Property};

use crate::design::Bare;
#[cfg(test)]
use crate::meaning::Takes;
use crate::spanned::{Spanned, span};
use crate::value::constants::Constants;
use crate::value::{Evaluator, Value};
use plain::{describe, is_plain_number};
pub(crate) use plain::{name_or_text, plain_integer, plain_number, points, with_address};
pub(crate) use shown::{Codes, ValueMismatch, code_of, in_quantity, of_pulse, unit_of};

/// A property as it was written.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) name_span: Span,
    pub(crate) value: Value,
    pub(crate) value_span: Span,
    /// The value as it is written.
    node: ast::Value,
    /// 0 for the block's own properties; higher for those inherited from a driver.
    layer: u8,
    taken: bool,
}

/// The properties of one block.
pub(crate) struct Fields<'a> {
    fields: Vec<Field>,
    /// The index of each name in the list.
    names: BTreeMap<String, usize>,
    constants: &'a Constants,
    /// How many times properties were inherited.
    layers: u8,
    /// The number of layers that the user wrote, which come first.
    own_layers: u8,
    /// The driver's reading or command that the block is.
    reading: String,
    /// Bytes in the number of a register.
    register_bytes: u8,
    /// The 7-bit addresses that the part can have; empty if its driver gives none.
    addresses: Vec<u8>,
    /// The bare number that was taken as a shown value, if its code is a different number.
    bare: Option<Bare>,
    /// What the block is, for messages ("an analog device").
    owner: String,
    owner_span: Span,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl<'a> Fields<'a> {
    /// The properties `own` of a block in `file`; a duplicate name is reported.
    pub(crate) fn new(
        own: impl Iterator<Item = Property>,
        file: FileId,
        owner: &str,
        owner_span: Span,
        (constants, diagnostics): (&'a Constants, &'a mut Vec<Diagnostic>),
    ) -> Self {
        let (owner, names) = (owner.to_owned(), BTreeMap::new());
        let mut fields = Self {
            fields: Vec::new(),
            names,
            constants,
            layers: 0,
            own_layers: 1,
            reading: String::new(),
            register_bytes: 1,
            addresses: Vec::new(),
            bare: None,
            owner,
            owner_span,
            diagnostics,
        };
        fields.add(own, file);
        fields
    }

    /// Sets what messages call the block from now on.
    pub(crate) fn rename_owner(&mut self, owner: String) {
        self.owner = owner;
    }

    /// What the block is, for messages.
    pub(crate) fn owner(&self) -> &str {
        &self.owner
    }

    /// The place of the block's name.
    pub(crate) const fn owner_span(&self) -> Span {
        self.owner_span
    }

    /// Inherits the properties of a driver; the block's own properties win.
    pub(crate) fn inherit(&mut self, driver: impl Iterator<Item = Property>, file: FileId) {
        self.layers += 1;
        self.add(driver, file);
    }

    fn add(&mut self, properties: impl Iterator<Item = Property>, file: FileId) {
        let layer = self.layers;
        for property in properties {
            let (Some(name), Some(node)) = (property.name(), property.value()) else { continue };
            let name_span = span(file, name.range());
            if let Some(first) = self.field(name.text()) {
                if first.layer == layer {
                    self.diagnostics.push(e0202_property_twice::property_twice(
                        name_span,
                        name.text(),
                        first.name_span,
                    ));
                }
                continue;
            }
            self.names.insert(name.text().into(), self.fields.len());
            let (constants, diagnostics) = (self.constants, &mut *self.diagnostics);
            let computed = measure::computed(name.text(), &node);
            let value = match computed {
                None => Evaluator::new(file, constants, diagnostics).value(&node),
                Some(_) => Value::Unknown,
            };
            let field = Field {
                name: name.text().into(),
                name_span,
                value_span: span(file, node.range()),
                value,
                node,
                layer,
                taken: false,
            };
            let (name, at) = ((name.text(), name_span), field.value_span);
            let report = computed.map(|report| measure::not_computed(name.0, at, &report));
            let misplaced = || measure::misplaced(name, (&field.value, at));
            self.diagnostics.extend(report.or_else(misplaced));
            self.fields.push(field);
        }
    }

    /// Marks everything inherited so far as the user's own; what follows is the driver's.
    pub(crate) fn drivers_follow(&mut self) {
        self.own_layers = self.layers + 1;
    }

    /// Whether the property comes from the driver, not from what the user wrote.
    pub(crate) const fn is_inherited(&self, field: &Field) -> bool {
        field.layer >= self.own_layers
    }

    /// Sets the driver's reading or command that the block is.
    pub(crate) fn set_reading(&mut self, name: &str) {
        name.clone_into(&mut self.reading);
    }

    /// Whether the block is a driver's reading or command.
    pub(crate) const fn is_of_reading(&self) -> bool {
        !self.reading.is_empty()
    }

    /// Sets the number of bytes in the number of a register.
    pub(crate) const fn set_register_bytes(&mut self, bytes: u8) {
        self.register_bytes = bytes;
    }

    /// The number of bytes in the number of a register.
    pub(crate) const fn register_bytes(&self) -> u8 {
        self.register_bytes
    }

    /// Sets the 7-bit addresses that the part can have.
    pub(crate) fn set_addresses(&mut self, addresses: Vec<u8>) {
        self.addresses = addresses;
    }

    /// The 7-bit addresses that the part can have.
    pub(crate) fn addresses(&self) -> &[u8] {
        &self.addresses
    }

    /// The name of the driver's reading or command that the block is.
    pub(crate) fn reading_name(&self) -> String {
        self.reading.clone()
    }

    fn field(&self, name: &str) -> Option<&Field> {
        self.fields.get(*self.names.get(name)?)
    }

    /// Adds a diagnostic.
    pub(crate) fn say(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Whether the property was written, in the block or its driver.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.names.contains_key(name)
    }

    /// The whole number of a property, without taking the property.
    pub(crate) fn peek_integer(&self, name: &str) -> Option<i64> {
        let field = self.field(name)?;
        i64::try_from(plain_integer(&field.value)?).ok()
    }

    /// The name in a property, without taking the property.
    pub(crate) fn peek_name(&self, name: &str) -> Option<String> {
        name_or_text(&self.field(name)?.value)
    }

    /// The place of a property's value.
    pub(crate) fn value_span(&self, name: &str) -> Option<Span> {
        self.field(name).map(|field| field.value_span)
    }

    /// The place, from name to value, of a property that the block itself gives.
    pub(crate) fn own_span(&self, name: &str) -> Option<Span> {
        let field = self.field(name).filter(|field| !self.is_inherited(field))?;
        Some(field.name_span.cover(field.value_span))
    }

    /// The properties that were not taken, including the driver's.
    pub(crate) fn rest(&self) -> Vec<Field> {
        self.fields.iter().filter(|field| !field.taken).cloned().collect()
    }

    pub(crate) fn take(&mut self, name: &str) -> Option<Field> {
        #[cfg(test)]
        asked::name(name);
        let field = self.fields.get_mut(*self.names.get(name)?)?;
        field.taken = true;
        Some(field.clone())
    }

    pub(crate) fn wrong(&mut self, field: &Field, takes: &str) {
        // A value that could not be computed has already been reported.
        if field.value == Value::Unknown {
            return;
        }
        let (at, name) = (field.value_span, &field.name);
        let is_number = |text: &&String| is_plain_number(text) && takes.contains("number");
        let quoted = field.value.text().filter(is_number);
        self.diagnostics.push(match quoted {
            Some(number) => e0209_wrong_value::quoted_number(at, name, takes, number),
            None => e0209_wrong_value::wrong_value(at, name, takes, describe(&field.value)),
        });
    }

    /// What a property's value says, read in some way; `takes` is what else it should be.
    pub(crate) fn read<T>(
        &mut self,
        name: &str,
        takes: &str,
        read: impl FnOnce(&Value) -> Option<T>,
    ) -> Option<Spanned<T>> {
        let field = self.take(name)?;
        let value = read(&field.value);
        if value.is_none() {
            self.wrong(&field, takes);
        }
        Some(Spanned { value: value?, span: field.value_span })
    }

    /// The values of a list, each read in the same way; empty if there is none.
    pub(crate) fn list<T>(
        &mut self,
        name: &str,
        takes: &str,
        one: impl Fn(&Value) -> Option<T>,
    ) -> Vec<T> {
        let all = |value: &Value| value.list()?.iter().map(|item| one(&item.value)).collect();
        self.read(name, takes, all).map(|all| all.value).unwrap_or_default()
    }

    fn out_of_range(&mut self, field: &Field, written: &str, range: &str) {
        self.diagnostics.push(e0211_out_of_range::out_of_range(
            field.value_span,
            &field.name,
            written,
            range,
        ));
    }

    /// A whole number without a unit.
    pub(crate) fn integer(
        &mut self,
        name: &str,
        range: RangeInclusive<i64>,
    ) -> Option<Spanned<i64>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Whole(*range.start(), *range.end()));
        let field = self.take(name)?;
        let Some(value) = plain_integer(&field.value) else {
            self.wrong(
                &field,
                &format!("a whole number from {} to {}", range.start(), range.end()),
            );
            return None;
        };
        match i64::try_from(value) {
            Ok(value) if range.contains(&value) => Some(Spanned { value, span: field.value_span }),
            Ok(_) | Err(_) => {
                let range = format!("{} to {}", range.start(), range.end());
                self.out_of_range(&field, &value.to_string(), &range);
                None
            }
        }
    }

    /// A required whole number; `example` is a line that would do.
    pub(crate) fn required_integer(
        &mut self,
        name: &str,
        range: RangeInclusive<i64>,
        example: &str,
    ) -> Option<Spanned<i64>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Whole(*range.start(), *range.end()));
        if self.has(name) {
            return self.integer(name, range);
        }
        self.missing(name, example);
        None
    }

    /// Reports that a required property is missing.
    pub(crate) fn missing(&mut self, name: &str, example: &str) {
        #[cfg(test)]
        asked::name(name);
        self.diagnostics.push(e0206_missing_property::missing_property(
            self.owner_span,
            name,
            &self.owner,
            example,
        ));
    }

    /// Any number without a unit.
    pub(crate) fn number(&mut self, name: &str) -> Option<Spanned<f64>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Number);
        self.read(name, "a number", plain_number)
    }

    /// One of a few words.
    pub(crate) fn word<T: Copy>(&mut self, name: &str, words: &[(&str, T)]) -> Option<Spanned<T>> {
        #[cfg(test)]
        asked::words(name, words);
        let field = self.take(name)?;
        let all = || words.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(", ");
        // `8E1` is a number to the parser, but can be a word here.
        let as_written = field.node.syntax().text().to_string();
        let is_word = words.iter().any(|(word, _)| *word == as_written);
        let found = name_or_text(&field.value).or_else(|| is_word.then_some(as_written));
        let Some(found) = found else {
            self.wrong(&field, &format!("one of {}", all()));
            return None;
        };
        if let Some((_, value)) = words.iter().find(|(word, _)| *word == found) {
            return Some(Spanned { value: *value, span: field.value_span });
        }
        self.unknown_word(field.value_span, name, &found, words);
        None
    }

    /// Reports a word that is not one of the few accepted.
    pub(crate) fn unknown_word<T>(
        &mut self,
        at: Span,
        name: &str,
        found: &str,
        words: &[(&str, T)],
    ) {
        let all: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let meant = nearest(found, all.iter().copied());
        let unknown = e0212_unknown_word::unknown_word;
        self.diagnostics.push(unknown(at, name, found, &all.join(", "), meant));
    }

    /// Two whole numbers as a range, or one number for both ends.
    pub(crate) fn integer_range(
        &mut self,
        name: &str,
        range: RangeInclusive<u8>,
    ) -> Option<Spanned<(u8, u8)>> {
        let within = |value: &Value| {
            u8::try_from(plain_integer(value)?).ok().filter(|number| range.contains(number))
        };
        let ends = |value: &Value| match value.range() {
            Some([first, last]) => within(&first.value).zip(within(&last.value)),
            None => within(value).map(|one| (one, one)),
        };
        let (least, most) = (range.start(), range.end());
        let takes = format!("a range of whole numbers from {least} to {most}, such as 7..0");
        self.read(name, &takes, ends)
    }

    /// One name, or a list of names.
    pub(crate) fn names(&mut self, name: &str, takes: &str) -> Option<Vec<Spanned<String>>> {
        let field = self.take(name)?;
        let one = |value: &Spanned<Value>| {
            Some(Spanned { value: name_or_text(&value.value)?, span: value.span })
        };
        let all: Option<Vec<_>> = match field.value.list() {
            Some(list) => list.iter().map(one).collect(),
            None => name_or_text(&field.value)
                .map(|value| vec![Spanned { value, span: field.value_span }]),
        };
        if all.is_none() {
            self.wrong(&field, takes);
        }
        all
    }

    /// Takes the property if its value is the given word, and leaves it otherwise.
    pub(crate) fn take_word_if(&mut self, name: &str, word: &str) -> bool {
        let field = self.field(name);
        let is = field.is_some_and(|field| name_or_text(&field.value).as_deref() == Some(word));
        is && self.take(name).is_some()
    }

    /// `true` or `false`, as a value.
    pub(crate) fn boolean(&mut self, name: &str) -> Option<Spanned<bool>> {
        self.word(name, &[("true", true), ("false", false)])
    }

    /// A name, or a text that is a name.
    pub(crate) fn name(&mut self, name: &str, takes: &str) -> Option<Spanned<String>> {
        self.read(name, takes, name_or_text)
    }

    /// A text between quotes, or a single name.
    pub(crate) fn text(&mut self, name: &str) -> Option<Spanned<String>> {
        self.name(name, "a text between quotes")
    }
}
