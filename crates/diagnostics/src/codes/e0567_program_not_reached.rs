//! E0567: `monitor` does not reach another program that gets the values, or is not reached by it.

use super::{Code, CodeInfo};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0567",
    title: "another program is not reached",
    explanation: r#"`monitor` passes values on to another program, and just now that does not work: a broker is not there or refuses the
user, nobody listens at an address, or another program has the address at which `monitor` wants to listen. The values
are shown and recorded meanwhile, and all other programs get theirs. It is tried again until it works, which is told as
well; then the other program gets the latest value of each device.

Way out: start the other program, or correct its address in the arguments or in the file for `--config`. Who holds an
address is told by `ss -ltnp` on Linux, `lsof -i` on macOS, `netstat -ano` on Windows."#,
});

/// What is said while the run goes on: `sink` is the name of the other program.
#[must_use]
pub fn not_reached(sink: &str, what: &str) -> String {
    format!("{sink}: {what} ({})", CODE.name())
}
