//! Properties that are bytes: a list, a text or a number in; bytes out, with the part's address where its word stands.

use std::ops::RangeInclusive;

use sensedsl_diagnostics::Span;
use sensedsl_diagnostics::codes::e0209_wrong_value;

#[cfg(test)]
use super::asked;
use super::measure::{listed, spelled_bytes};
use super::plain::byte_list;
use super::{Field, Fields, with_address};
use crate::kind::uart::exchange::{ADDRESS, is_address};
#[cfg(test)]
use crate::meaning::Takes;
use crate::spanned::Spanned;
use crate::value::Value;

impl Fields<'_> {
    /// Reports a text that spells bytes out, if the value is one.
    pub(crate) fn spells(&mut self, name: &str, value: &Value, at: Span) -> bool {
        let Some(bytes) = spelled_bytes(value) else { return false };
        let letters = value.text().map_or(0, |text| text.chars().count());
        let report = e0209_wrong_value::spelled_bytes;
        self.diagnostics.push(report(at, name, letters, &listed(&bytes)));
        true
    }

    /// A list of bytes; a text stands for its bytes, and a single number for a list of one.
    pub(crate) fn bytes(
        &mut self,
        name: &str,
        lengths: RangeInclusive<usize>,
    ) -> Option<Spanned<Vec<u8>>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Bytes(*lengths.start(), *lengths.end()));
        let field = self.take(name)?;
        self.bytes_of(&field, &field.value, lengths)
    }

    /// Reads bytes among which the word `address` stands for the part's address.
    pub(crate) fn addressed(
        &mut self,
        name: &str,
        lengths: RangeInclusive<usize>,
        address: Option<u8>,
    ) -> Option<Spanned<Vec<u8>>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Bytes(*lengths.start(), *lengths.end()));
        let field = self.take(name)?;
        let is_named =
            field.value.list().is_some_and(|all| all.iter().any(|one| is_address(&one.value)));
        if is_named && address.is_none() {
            self.missing(ADDRESS, "address = 1;");
            return None;
        }
        let value = with_address(&field.value, address);
        self.bytes_of(&field, &value, lengths)
    }

    fn bytes_of(
        &mut self,
        field: &Field,
        value: &Value,
        lengths: RangeInclusive<usize>,
    ) -> Option<Spanned<Vec<u8>>> {
        if self.spells(&field.name, value, field.value_span) {
            return None;
        }
        let Some(numbers) = byte_list(value) else {
            self.wrong(field, "a list of whole numbers such as [0x00, 0x51]");
            return None;
        };
        let mut bytes = Vec::with_capacity(numbers.len());
        for number in numbers {
            match u8::try_from(number) {
                Ok(byte) => bytes.push(byte),
                Err(_) => {
                    self.out_of_range(field, &number.to_string(), "bytes from 0 to 255");
                    return None;
                }
            }
        }
        if !lengths.contains(&bytes.len()) {
            let range = format!("{} to {} bytes", lengths.start(), lengths.end());
            self.out_of_range(field, &format!("{} bytes", bytes.len()), &range);
            return None;
        }
        Some(Spanned { value: bytes, span: field.value_span })
    }
}
