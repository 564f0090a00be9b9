//! In what two schemas differ, device by device, in words for people.
//!
//! In: the schema texts of this program and of the board, of which the schema hash is made (`17 sensor IRFront uint16`, a
//! line each). The board's is what its shell answers to the command `schema`.

use sensedsl_wire::crc32_iso_hdlc;

/// A line of a schema text that is a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Line<'t> {
    id: &'t str,
    direction: &'t str,
    name: &'t str,
    value: &'t str,
}

impl<'t> Line<'t> {
    fn read(line: &'t str) -> Option<Self> {
        let mut words = line.split_whitespace();
        let (id, direction) = (words.next()?, words.next()?);
        let (name, value) = (words.next()?, words.next()?);
        let is_id = id.bytes().all(|byte| byte.is_ascii_digit());
        let is_direction = matches!(direction, "sensor" | "actuator");
        (is_id && is_direction && words.next().is_none()).then_some(Self {
            id,
            direction,
            name,
            value,
        })
    }

    fn words(&self) -> String {
        format!("{} {}, identifier {}", self.direction, self.value, self.id)
    }
}

/// The lines of a text that are devices.
fn devices(text: &str) -> impl Iterator<Item = Line<'_>> {
    text.lines().filter_map(Line::read)
}

/// The checksum that a text names, and whether it has stamps.
fn link(text: &str) -> (&str, bool) {
    let checksum = text.lines().find_map(|line| line.strip_prefix("checksum "));
    (checksum.unwrap_or("none"), text.lines().any(|line| line == "stamp"))
}

/// The differences, one a line.
#[must_use]
pub fn differences(own: &str, board: &str) -> Vec<String> {
    let mut all = Vec::new();
    let ((here, is_stamped), (there, stamps)) = (link(own), link(board));
    if here != there {
        all.push(format!("checksum: {there} on the board, {here} here"));
    }
    if is_stamped != stamps {
        let on = |is_on: bool| if is_on { "on" } else { "off" };
        all.push(format!("stamp: {} on the board, {} here", on(stamps), on(is_stamped)));
    }
    for line in devices(own) {
        match devices(board).find(|one| one.name == line.name) {
            None => all.push(format!("{}: not on the board ({} here)", line.name, line.words())),
            Some(other) if other != line => all.push(format!(
                "{}: {} on the board, {} here",
                line.name,
                other.words(),
                line.words()
            )),
            Some(_) => {}
        }
    }
    for other in devices(board) {
        if !devices(own).any(|line| line.name == other.name) {
            all.push(format!("{}: only on the board ({})", other.name, other.words()));
        }
    }
    if all.is_empty() && own != board {
        all.push("the order of the devices".to_owned());
    }
    all
}

/// The schema text in what a board's shell has answered: the lines that together have the hash.
#[must_use]
pub fn answered_schema(bytes: &[u8], hash: u32) -> Option<String> {
    let text = String::from_utf8_lossy(bytes).replace('\r', "");
    let lines: Vec<&str> = text.lines().collect();
    let starts = (0..lines.len())
        .filter(|at| lines.get(*at).is_some_and(|line| line.starts_with("checksum ")));
    for start in starts {
        let mut found = String::new();
        for line in lines.get(start..).unwrap_or_default() {
            found.push_str(line);
            found.push('\n');
            if crc32_iso_hdlc(found.as_bytes()) == hash {
                return Some(found);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_difference_is_named() {
        let own = "checksum none\n17 sensor A uint16\n18 sensor B uint8\n19 actuator C int16[2]\n";
        let board =
            "checksum crc16\nstamp\n17 sensor A int16\n19 actuator C int16[2]\n20 sensor D bool\n";
        assert_eq!(
            differences(own, board),
            [
                "checksum: crc16 on the board, none here",
                "stamp: on on the board, off here",
                "A: sensor int16, identifier 17 on the board, sensor uint16, identifier 17 here",
                "B: not on the board (sensor uint8, identifier 18 here)",
                "D: only on the board (sensor bool, identifier 20)",
            ]
        );
        assert_eq!(differences(own, own), [""; 0]);
        let turned =
            "checksum none\n18 sensor B uint8\n17 sensor A uint16\n19 actuator C int16[2]\n";
        assert_eq!(differences(own, turned), ["the order of the devices"]);
    }

    #[test]
    fn a_shells_answer_is_found_among_other_text() {
        let text = "checksum none\n17 sensor A uint16\n";
        let hash = crc32_iso_hdlc(text.as_bytes());
        let answer = b"\xff3:\x11ch> schema\r\nchecksum none\r\n17 sensor A uint16\r\nch> ";
        assert_eq!(answered_schema(answer, hash).as_deref(), Some(text));
        assert_eq!(answered_schema(&answer[..30], hash), None);
    }
}
