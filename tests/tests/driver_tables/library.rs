//! The library as parts of designs, each with one driver and all its values.

use sensedsl_job::part::has_coding;
use sensedsl_model::design::{Design, Device, Part};
use sensedsl_model::kind::KindName;
use sensedsl_model::kind::can::Can;
use sensedsl_model::protocol::Protocol;
use sensedsl_model::words::Words;
use sensedsl_model::{LIBRARY, NoFiles, Request, resolve};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::parse;
use sensedsl_tests::text;
use sensedsl_wire::Direction;

use super::vectors::{self, Case};

/// A driver in a design that contains nothing else.
pub struct Unit {
    pub driver: String,
    pub design: Design,
    pub cases: Vec<Case>,
}

fn drivers() -> Vec<ast::Driver> {
    LIBRARY.iter().flat_map(|(_, text)| parse(text).ast().drivers().collect::<Vec<_>>()).collect()
}

/// The names of all drivers.
pub fn names() -> Vec<String> {
    drivers().iter().map(|driver| driver.name().unwrap().text().to_owned()).collect()
}

/// All drivers, in the order of the library.
pub fn units() -> Vec<Unit> {
    let all = drivers();
    let mut wrong = String::new();
    let units = all
        .iter()
        .flat_map(|driver| {
            let name = driver.name().unwrap().text().to_owned();
            let cases = vectors::read(&name, &text(&format!("tests/vectors/drivers/{name}.txt")));
            // A driver without readings becomes one unit for each type in its vectors.
            let mut types: Vec<Option<String>> = Vec::new();
            for case in &cases {
                if !types.contains(&case.ty) {
                    types.push(case.ty.clone());
                }
            }
            let mut cases: Vec<Option<Case>> = cases.into_iter().map(Some).collect();
            let mut units = Vec::new();
            for (number, ty) in types.into_iter().enumerate() {
                let own =
                    cases.iter_mut().filter(|case| case.as_ref().is_some_and(|one| one.ty == ty));
                let own: Vec<Case> = own.filter_map(Option::take).collect();
                let text = example(driver, "NUCLEO_F446RE", number, ty.as_deref());
                match design(&text) {
                    Ok(design) => units.push(Unit { driver: name.clone(), design, cases: own }),
                    Err(reported) => wrong.push_str(&format!("{name}: {reported}\n")),
                }
            }
            units
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong}");
    units
}

/// Drivers for what no driver of the library does, so that these tables are compiled too: filters
/// over all kinds of numbers, a bus with two-byte registers, floats, packed numbers, words out of
/// order, hostile texts.
pub fn others() -> Vec<Unit> {
    const TEXTS: [&str; 3] = [
        r#"driver every_filter for i2c {
            address = 0x20; register = 0x00; length = 8;
            reading d returns float64 {}
            reading i returns int64 {}
            reading u returns uint64 {}
            reading f returns float32 { register = 0x10; length = 4; }
            reading b returns bool { register = 0x20; length = 1; }
        }
        board STM32F407G_DISC1 { chip Filters {
            driver = every_filter; id = 1;
            sensor FilterD returns float64 { reading = d; invalid = [-1e300..-1, 5.5]; median = 5; smooth = 1 s; change = 0.1; heartbeat = 2 s; }
            sensor FilterI returns int64 { reading = i; invalid = [-9223372036854775808, 7..9]; smooth = 10 ms; change = 2.5; }
            sensor FilterU returns uint64 { reading = u; invalid = [-5..3, 18446744073709551615]; median = 15; }
            sensor FilterF returns float32 { reading = f; invalid = 1e40; median = 3; smooth = 5 ms; change = 1; }
            sensor FilterB returns bool { reading = b; invalid = [true_is, 1]; change = 1; }
        } }
        const true_is = 2;"#,
        r#"driver wide_registers for spi {
            register_size = 2; read_mask = 0x80; order = little; trigger = [1, 2, 3]; wait = 5 ms;
            reading near returns uint16[2] { register = 0x0100; elements = [3, 1]; length = 8; }
            reading far returns int32[2] { register = 0x7FF0; packed = 17; length = 5; }
            command gain accepts uint8 { register = 0x1234; bits = 6..2; }
        }
        board STM32F407G_DISC1 { chip Wide { driver = wide_registers; id = 1; } }"#,
        r#"driver hostile for uart {
            start = "\"*/"; end = "??/\\"; init = ["a", 10 ms];
            reading text returns int32 { sentence = "\"%s\\"; field = 63; format = decimal; separator = "'"; }
            reading hex returns uint64 { field = 0; format = hex; }
        }
        board STM32F407G_DISC1 { chip Hostile { driver = hostile; id = 1; } }"#,
    ];
    let unit = |text: &&str| Unit {
        driver: (*text).to_owned(),
        design: design(text).unwrap(),
        cases: Vec::new(),
    };
    TEXTS.iter().map(unit).collect()
}

/// A board with a part that has all values of a driver. `number` distinguishes several parts with
/// the same driver.
pub fn example(driver: &ast::Driver, board: &str, number: usize, ty: Option<&str>) -> String {
    let name = driver.name().unwrap().text().to_owned();
    let mut part = capital(&name);
    if number > 0 {
        part.push_str(&format!("Type{number}"));
    }
    let property = |wanted: &str| {
        driver.properties().find(|one| one.name().is_some_and(|name| name.text() == wanted))
    };
    let address = match (property("address"), property("addresses")) {
        (None, Some(list)) => {
            let list = list.value().unwrap().syntax().text().to_string();
            let first = list.trim_start_matches('[').split([',', ']']).next().unwrap().to_owned();
            format!("        address = {first};\n")
        }
        _ => String::new(),
    };
    let has_values = driver.readings().next().is_some() || driver.commands().next().is_some();
    let head = if has_values {
        format!("chip {part}")
    } else {
        let kind = KindName::from_name(driver.kind().unwrap().text()).unwrap();
        let is_output = !kind.spec().directions.contains(&Direction::Sensor)
            || text(&format!("tests/vectors/drivers/{name}.txt")).contains("\ncommand");
        let ty = ty.unwrap_or("uint16");
        if is_output {
            format!("actuator {part} accepts {ty}")
        } else {
            format!("sensor {part} returns {ty}")
        }
    };
    format!(
        "board {board} {{\n    {head} {{\n        driver = {name};\n{address}        id = 1;\n    }}\n}}\n"
    )
}

/// All drivers, each with the text of its example on a board.
pub fn examples(board: &str) -> Vec<(String, String)> {
    let one = |driver: &ast::Driver| {
        let name = driver.name().unwrap().text().to_owned();
        let cases = vectors::read(&name, &text(&format!("tests/vectors/drivers/{name}.txt")));
        let ty = cases.iter().find_map(|case| case.ty.clone());
        (name, example(driver, board, 0, ty.as_deref()))
    };
    drivers().iter().map(one).collect()
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// The design, or what is wrong with it. A file that only names a driver must give no diagnostics.
fn design(text: &str) -> Result<Design, String> {
    let request = Request { path: "example.sense", text, ..Request::default() };
    let resolved = resolve(&request, &NoFiles);
    let is_silent = resolved.diagnostics.is_empty();
    let reported = || resolved.diagnostics.iter().map(|one| format!("{} ", one.message)).collect();
    resolved.design.filter(|_| is_silent).ok_or_else(reported)
}

impl Unit {
    pub fn part(&self) -> &Part {
        &self.design.parts[0]
    }

    pub fn protocol(&self) -> Option<&Protocol> {
        self.part().chip.as_ref()
    }

    pub fn devices(&self) -> impl Iterator<Item = &Device> {
        self.design.devices.iter()
    }

    /// The devices whose values are coded between wires and schema.
    pub fn coded(&self) -> impl Iterator<Item = &Device> {
        self.devices().filter(|device| has_coding(device, self.part()))
    }

    pub fn is_coded(&self, field: usize) -> bool {
        has_coding(&self.design.devices[field], self.part())
    }

    /// The length of a frame in bytes: up to the end of its last value, unless the driver states
    /// it.
    pub fn frame_bytes(&self, of: &Can) -> usize {
        let own = self.devices().filter_map(|device| Some((device, device.kind.can()?)));
        let own =
            own.filter(|(_, can)| (can.frame_id, can.is_extended) == (of.frame_id, of.is_extended));
        let end = |(device, can): (&Device, &Can)| {
            let bytes = Words::of(device).unwrap().wire_bytes();
            usize::from(can.byte) + usize::from(bytes)
        };
        let end = own.map(end).max().unwrap();
        of.length.map_or(end, usize::from)
    }

    /// The name of a value in the vectors.
    pub fn value_name(device: &Device) -> String {
        device
            .coding
            .reading
            .clone()
            .filter(|name| !name.is_empty())
            .unwrap_or_else(|| "value".to_owned())
    }

    /// The index of a value in the schema.
    pub fn field(&self, name: &str) -> Option<usize> {
        self.devices().position(|device| Self::value_name(device) == name)
    }

    pub fn device(&self, name: &str) -> Option<&Device> {
        self.design.devices.get(self.field(name)?)
    }
}
