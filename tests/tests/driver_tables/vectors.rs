//! The vector files: text goes in, cases come out. `tests/vectors/drivers/README.md` defines the
//! lines.

/// A case: what the part sends, and the values expected of it.
#[derive(Debug, Default)]
pub struct Case {
    pub title: String,
    /// The type of the device, for a driver without readings.
    pub ty: Option<String>,
    pub given: Vec<Given>,
    pub expected: Vec<(String, Expected)>,
    /// The texts that a host shows.
    pub shown: Vec<(String, Vec<String>)>,
    pub commands: Vec<Command>,
}

#[derive(Debug)]
pub enum Given {
    /// Registers from an address on; the first field is what must have been written last.
    Registers(Option<Vec<u8>>, u32, Vec<u8>),
    WrongIdentity(u32, Vec<u8>),
    Answer(Option<Vec<u8>>, Vec<u8>),
    Exchange(Vec<u8>, Vec<u8>),
    Stream(Vec<u8>),
    /// A request on a serial line, and its answer.
    Asked(Vec<u8>, Vec<u8>),
    /// A CAN frame: its identifier as `frame_name` writes it, and its bytes.
    Frame(String, Vec<u8>),
    /// A measurement of the hardware: `analog`, `level`, `pulse`, `frequency` or `counts`.
    Raw(String, i64),
    Edges(Vec<u32>),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expected {
    /// The elements, and their tolerance.
    Values(Vec<i64>, i64),
    Invalid,
    Nothing,
    WrongIdentity,
}

#[derive(Debug)]
pub struct Command {
    pub name: String,
    pub values: Vec<i64>,
    /// The effects of the command, such as `written 40 7F F0` or `in1 = 1`.
    pub effects: Vec<String>,
}

/// All cases of a file.
pub fn read(name: &str, text: &str) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let comment =
            if line.contains('"') { line.len() } else { line.find('#').unwrap_or(line.len()) };
        let line = line[..comment].trim();
        if line.is_empty() {
            continue;
        }
        if let Some(title) = line.strip_prefix("case ") {
            cases.push(Case { title: format!("{name}: {title}"), ..Case::default() });
            continue;
        }
        let case = cases.last_mut().unwrap_or_else(|| panic!("{name}: a line before any case"));
        case.line(line).unwrap_or_else(|| panic!("{name}, line {}: {line}", number + 1));
    }
    cases
}

impl Case {
    fn line(&mut self, line: &str) -> Option<()> {
        let (word, rest) = line.split_once([' ', ':']).unwrap_or((line, ""));
        let (head, tail) = rest.split_once(':').unwrap_or((rest, ""));
        match word {
            "type" => self.ty = Some(rest.to_owned()),
            "register" => self.given.push(Given::Registers(None, number(head)?, bytes(tail)?)),
            "wrong" => {
                let at = number(head.strip_prefix("identity")?)?;
                self.given.push(Given::WrongIdentity(at, bytes(tail)?));
            }
            "after" => self.given.push(match head.split_once("register") {
                Some((trigger, at)) => {
                    Given::Registers(Some(bytes(trigger)?), number(at)?, bytes(tail)?)
                }
                None => Given::Answer(Some(bytes(head)?), bytes(tail)?),
            }),
            "read" => self.given.push(Given::Answer(None, bytes(rest)?)),
            "exchange" => self.given.push(Given::Exchange(bytes(head)?, bytes(tail)?)),
            "asked" => self.given.push(Given::Asked(bytes(head)?, bytes(tail)?)),
            "asked_text" => {
                let (head, tail) = rest.split_once("\": \"")?;
                let (head, tail) = (format!("{head}\""), format!("\"{tail}"));
                self.given.push(Given::Asked(escaped(&head)?, escaped(&tail)?));
            }
            "bytes" => self.given.push(Given::Stream(bytes(rest)?)),
            "text" => self.given.push(Given::Stream(escaped(rest)?)),
            "analog" | "level" | "counts" => {
                self.given.push(Given::Raw(word.to_owned(), rest.parse().ok()?));
            }
            "pulse" | "frequency" => {
                let raw = rest.rsplit(' ').next()?.parse().ok()?;
                self.given.push(Given::Raw(word.to_owned(), raw));
            }
            "frame" if self.commands.is_empty() => {
                self.given.push(Given::Frame(head.to_owned(), bytes(tail)?));
            }
            "edges" => {
                let times = rest.strip_prefix("us")?.split_whitespace();
                self.given.push(Given::Edges(
                    times.map(|time| time.parse().ok()).collect::<Option<_>>()?,
                ));
            }
            "expect" => self.expected.push(expected(rest)?),
            "shown" => {
                let (name, values) = rest.split_once('=')?;
                let values = values.split_whitespace().map(str::to_owned).collect();
                self.shown.push((name.trim().to_owned(), values));
            }
            "command" => {
                let (name, values) = rest.split_once('=')?;
                let (name, effects) = (name.trim().to_owned(), Vec::new());
                self.commands.push(Command { name, values: numbers(values)?, effects });
            }
            _ => self.commands.last_mut()?.effects.push(line.to_owned()),
        }
        Some(())
    }
}

fn expected(text: &str) -> Option<(String, Expected)> {
    if let Some((name, values)) = text.split_once('=') {
        let (values, slack) = values.split_once("+-").unwrap_or((values, "0"));
        let what = Expected::Values(numbers(values)?, slack.trim().parse().ok()?);
        return Some((name.trim().to_owned(), what));
    }
    let (name, what) = text.split_once(':')?;
    let what = match what.trim() {
        "invalid" => Expected::Invalid,
        "nothing" => Expected::Nothing,
        "wrong" | "wrong identity" => Expected::WrongIdentity,
        _ => return None,
    };
    Some((name.trim().to_owned(), what))
}

fn numbers(text: &str) -> Option<Vec<i64>> {
    text.split_whitespace().map(|number| number.parse().ok()).collect()
}

fn number(text: &str) -> Option<u32> {
    u32::from_str_radix(text.trim().strip_prefix("0x")?, 16).ok()
}

fn bytes(text: &str) -> Option<Vec<u8>> {
    text.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).ok()).collect()
}

fn escaped(text: &str) -> Option<Vec<u8>> {
    let mut found = Vec::new();
    let mut letters = text.trim().strip_prefix('"')?.strip_suffix('"')?.bytes();
    while let Some(letter) = letters.next() {
        found.push(match letter {
            b'\\' => match letters.next()? {
                b'r' => b'\r',
                b'n' => b'\n',
                other => other,
            },
            other => other,
        });
    }
    Some(found)
}
