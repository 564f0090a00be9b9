//! E0512: no ChibiOS tree is named.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0512",
    title: "no ChibiOS tree is named",
    explanation: r#"Firmware is built together with a source tree of ChibiOS, which is not part of this tool. `build` and `flash`
look for it in `--chibios PATH`, then in the variable `CHIBIOS`.

Way out: fetch a tree once and name it:

    git clone --depth 1 -b stable_21.11.x https://github.com/ChibiOS/ChibiOS.git
    export CHIBIOS=$PWD/ChibiOS"#,
});

/// `version` is the required release: `21.11`.
pub fn no_tree(span: Span, version: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("this firmware needs a source tree of ChibiOS {version}, and none is named"))
        .help(format!(
            "name it with `--chibios PATH` or in the variable CHIBIOS; to fetch one: \
             `git clone --depth 1 -b stable_{version}.x https://github.com/ChibiOS/ChibiOS.git`"
        ))
}
