//! Signature help: what the property takes in whose value the cursor is.

use super::completion::described::described;
use super::completion::site::Site;
use super::completion::subject::Subject;
use crate::context::Context;
use crate::protocol::{Markup, ParameterInformation, SignatureHelp, SignatureInformation};

/// What the value at an offset may be.
pub(crate) fn help(cx: &Context<'_>, offset: usize) -> Option<SignatureHelp> {
    let site = Site::of(cx, offset)?;
    let subject = Subject::of(cx, &site);
    let (name, _) = site.property()?;
    let (takes, documentation) = match subject.meaning() {
        Some(meaning) => (meaning.takes.to_string().replace('`', ""), described(meaning)),
        None => {
            let kind = subject.connection(name)?;
            let wire = kind.with_article().replace(" device", "");
            ("a pin".to_owned(), format!("Fixes the pin of the connection `{name}`, {wire}."))
        }
    };
    let signature = SignatureInformation {
        label: format!("{name} = {takes}"),
        documentation: Markup::new(documentation),
        parameters: vec![ParameterInformation { label: takes }],
    };
    Some(SignatureHelp { signatures: vec![signature], active_signature: 0, active_parameter: 0 })
}
