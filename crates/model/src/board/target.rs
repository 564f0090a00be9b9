//! The system that a board's firmware runs on: what the file or the caller asks for and the MCU in, its profile out.

use sensedsl_board::profile::{self, NoProfile, Target};
use sensedsl_diagnostics::codes::{
    e0201_unknown_property, e0313_unknown_target, e0504_no_firmware_target, h0702_target_none,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_syntax::ast;

use super::context::Context;
use crate::fields::Fields;

/// The properties of a board.
const PROPERTIES: &[&str] = &["target"];

/// The requested target, and where it is requested.
pub(crate) struct RequestedTarget {
    /// None for the default, if that covers the MCU.
    name: Option<String>,
    at: Span,
    /// Whether it is the file that requests it.
    is_of_file: bool,
}

/// Reads the properties of a board. A target given on the command line overrides the file's.
pub(crate) fn asked(
    context: &mut Context<'_>,
    file: FileId,
    node: &ast::Board,
    board: Span,
) -> RequestedTarget {
    let reported = (context.constants, &mut *context.diagnostics);
    let mut fields = Fields::new(node.properties(), file, "a board", board, reported);
    let stated = fields.name("target", "a target such as chibios or embassy");
    for field in fields.rest() {
        let meant = nearest(&field.name, PROPERTIES.iter().copied());
        fields.say(e0201_unknown_property::unknown_property(
            field.name_span,
            &field.name,
            "a board",
            meant,
        ));
    }
    match (context.request.target, stated) {
        (Some(name), _) => {
            RequestedTarget { name: Some(name.to_owned()), at: board, is_of_file: false }
        }
        (None, Some(name)) => {
            RequestedTarget { name: Some(name.value), at: name.span, is_of_file: true }
        }
        (None, None) => RequestedTarget { name: None, at: board, is_of_file: true },
    }
}

/// The requested profile for the MCU of the table `shown`.
pub(crate) fn find(
    asked: &RequestedTarget,
    shown: &str,
    mcu: Option<&str>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Target> {
    let (at, is_of_file) = (asked.at, asked.is_of_file);
    let asked = asked.name.as_deref();
    let no_firmware = |why: &str| e0504_no_firmware_target::no_firmware_target(at, shown, why);
    let Some(mcu) = mcu else {
        let named = asked.unwrap_or(profile::NONE);
        if profile::full_name(named) == Some(profile::NONE) {
            if asked.is_none() {
                let why = "it does not say which MCU it describes";
                diagnostics.push(h0702_target_none::target_none(at, shown, why));
            }
            return Some(Target::None);
        }
        let why = "its table does not say which MCU it describes";
        diagnostics.push(no_firmware(why));
        return None;
    };
    match profile::find(asked.unwrap_or_else(|| profile::usual(mcu)), mcu) {
        Ok(target) => Some(target),
        Err(NoProfile::UnknownTarget { known, .. }) => {
            let name = asked.unwrap_or_default();
            let meant = nearest(name, known.iter().map(AsRef::as_ref)).filter(|_| is_of_file);
            let list = known.join(", ");
            let report = e0313_unknown_target::unknown_target(at, name, &list, meant);
            diagnostics.push(report);
            None
        }
        Err(NoProfile::UnknownMcu { covered, .. }) => {
            let covered = covered.join(", ");
            if asked.is_none() {
                let hint = h0702_target_none::no_profile(at, shown, mcu, &covered);
                diagnostics.push(hint);
                return Some(Target::None);
            }
            let why = format!("there is no target profile for {mcu}, only for {covered}");
            diagnostics.push(no_firmware(&why));
            None
        }
        Err(NoProfile::Broken { message }) => {
            let why = format!("its target profile is damaged ({message})");
            diagnostics.push(no_firmware(&why));
            None
        }
    }
}
