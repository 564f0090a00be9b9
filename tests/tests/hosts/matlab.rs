//! The host `matlab`: what Octave reads from a record is what `sensedsl convert` makes of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use sensedsl_tests::{TempDir, answered, has, root, sensedsl};
use sensedsl_wire::{
    DeviceHealth, Direction, Health, ResetCause, Scalar, ScalarType, Schema, Status, encode_health,
    encode_hello, encode_report, encode_stamped_report,
};

use super::designs;

/// Prints a record as `convert` does, but for how numbers are written.
const PRINT: &str = "
[run, link] = read_record('run.mcap');
boards = fieldnames(run);
for b = 1:numel(boards)
    devices = fieldnames(run.(boards{b}));
    for d = 1:numel(devices)
        one = run.(boards{b}).(devices{d});
        for i = 1:numel(one.t)
            for k = 1:size(one.value, 2)
                raw = one.raw(i, k);
                if any(strcmp(class(raw), {'int64', 'uint64'}))
                    halves = typecast(raw, 'uint32');
                    raw = sprintf('%d:%d', halves(2), halves(1));
                elseif isfloat(raw)
                    raw = sprintf('%.17g', raw);
                else
                    raw = sprintf('%d', raw);
                end
                fprintf('%.6f,%s,%d,%s,%.17g,%s\\n', one.t(i), one.name, k - 1, raw, one.value(i, k), one.unit);
            end
        end
        fprintf('class,%s,%s,%s\\n', one.name, class(one.raw), one.type);
        if isfield(one, 'stamp_us') && ~isempty(one.t)
            fprintf('stamp,%s,%d,%d\\n', one.name, one.stamp_us(end), one.counter(end));
        end
    end
end
fprintf('whole,%d\\n', link.is_whole);
if isfield(link, 'Rover') && isfield(link.Rover, 'health') && ~isempty(link.Rover.health)
    health = link.Rover.health(end);
    fprintf('health,%d,%s,%s\\n', health.uptime_ms, health.devices(2).device, health.devices(2).status);
end
";

/// A call of Octave with a script, in a folder.
fn octave(folder: &Path, script: &str) -> Command {
    let mut octave = Command::new("octave-cli");
    octave.current_dir(folder).args(["--norc", "--quiet", "--path"]);
    octave.arg(root().join("crates/host-matlab/runtime")).args(["--eval", script]);
    octave
}

/// Each scalar type by itself and as an array, in a schema and in the words of `schema.json`.
fn schema(is_stamped: bool) -> (Schema, String) {
    let mut schema = Schema { stamp: is_stamped, ..Schema::default() };
    let mut items = Vec::new();
    for (index, scalar) in ScalarType::ALL.into_iter().enumerate() {
        for (first, length) in [(1, None), (31, Some(3))] {
            let id = first + u8::try_from(index).unwrap();
            let brackets = length.map_or(String::new(), |length| format!("[{length}]"));
            schema.items.push(designs::item(&format!("{id} sensor D{id} {scalar}{brackets}")));
            let length = length.map_or("null".to_owned(), |length: u16| length.to_string());
            items.push(format!(
                r#"{{ "id": {id}, "name": "D{id}", "direction": "sensor", "type": "{scalar}", "length": {length},
                    "quantity": "°C, dry", "scale": 0.1, "offset": -3.5 }}"#
            ));
        }
    }
    let (hash, items) = (schema.hash(), items.join(", "));
    let json = format!(
        r#"{{ "version": 2, "boards": [ {{ "name": "Rover", "hash": "0x{hash:08x}", "checksum": "none",
            "stamp": {is_stamped}, "items": [ {items} ] }} ] }}"#
    );
    (schema, json)
}

/// The least, the greatest and a usual value, and what is no number.
fn values(scalar: ScalarType) -> [Scalar; 3] {
    use Scalar::{Bool, Float32, Float64, Signed, Unsigned};
    match scalar {
        ScalarType::Bool => [Bool(true), Bool(false), Bool(true)],
        ScalarType::Uint8 => [Unsigned(0), Unsigned(255), Unsigned(7)],
        ScalarType::Uint16 => [Unsigned(0), Unsigned(65_535), Unsigned(700)],
        ScalarType::Uint32 => [Unsigned(0), Unsigned(4_294_967_295), Unsigned(70_000)],
        ScalarType::Uint64 => [Unsigned(0), Unsigned(u64::MAX), Unsigned((1 << 53) + 1)],
        ScalarType::Int8 => [Signed(-128), Signed(127), Signed(-7)],
        ScalarType::Int16 => [Signed(-32_768), Signed(32_767), Signed(-700)],
        ScalarType::Int32 => [Signed(-2_147_483_648), Signed(2_147_483_647), Signed(-70_000)],
        ScalarType::Int64 => [Signed(i64::MIN), Signed(i64::MAX), Signed(-(1 << 53) - 1)],
        ScalarType::Float32 => [Float32(0.1), Float32(f32::NAN), Float32(-3e38)],
        ScalarType::Float64 => [Float64(0.1), Float64(f64::NAN), Float64(-1e300)],
    }
}

/// Bytes of a board: three reports of everything, and health.
fn stream(schema: &Schema) -> Vec<u8> {
    let mut bytes = encode_hello(schema);
    for round in 0..3 {
        let of = |item: &sensedsl_wire::Item| {
            let all = values(item.value.scalar);
            let value = if item.value.length.is_some() { all.to_vec() } else { vec![all[round]] };
            (item.id, value)
        };
        let all: Vec<_> = schema.items.iter().map(of).collect();
        let counter = u8::try_from(round).unwrap();
        let stamp = sensedsl_wire::Stamp { time_us: 4_000_000_000, counter: 253 + counter };
        bytes.extend(if schema.stamp {
            encode_stamped_report(schema, stamp, &all).unwrap()
        } else {
            encode_report(schema, Direction::Sensor, &all).unwrap()
        });
    }
    let devices = schema.items.iter().map(|item| DeviceHealth {
        id: item.id,
        status: Status::Failed,
        age_ms: 7,
        causes: [1, 2, 3, 4, 5, 6].into(),
    });
    let health = Health {
        uptime_ms: 12_345,
        reset_cause: ResetCause::Watchdog,
        reset_device: 1,
        reports_sent: 5,
        reports_refused: 1,
        load_percent: 40,
        stack_left_bytes: 200,
        devices: devices.collect(),
    };
    bytes.extend(encode_health(schema, &health).unwrap());
    bytes
}

/// A folder with `run.mcap`, as `monitor` writes it of these bytes.
fn record(name: &str, schema: &Schema, json: &str) -> (TempDir, PathBuf) {
    let scratch = TempDir::new(name);
    let (json, bytes) =
        (scratch.write("schema.json", json), scratch.write("bytes", stream(schema)));
    let file = scratch.join("run.mcap");
    let call = sensedsl(["monitor", "--quiet", "--format", "csv", "--schema"]).arg(json);
    let _ = call.arg("--record").arg(&file).arg(bytes).run().exits(0);
    (scratch, file)
}

/// A number of a cell: whole ones in full and modulo two to the 64, `true` as 1, an empty cell as what is no number.
/// Octave prints 64 bits in two halves.
fn number(cell: &str) -> String {
    let half = |text: &str| text.parse::<u64>().unwrap();
    let halves = cell.split_once(':').map(|(high, low)| (half(high) << 32) | half(low));
    match cell {
        "true" => "1".to_owned(),
        "false" => "0".to_owned(),
        "" | "NaN" => "none".to_owned(),
        whole if halves.is_some() || whole.parse::<i128>().is_ok() => {
            let signed = whole.parse::<i128>().map(|whole| whole.rem_euclid(1 << 64).to_string());
            halves.map_or_else(|| signed.unwrap(), |bits| bits.to_string())
        }
        real => format!("{:e}", real.parse::<f64>().unwrap()),
    }
}

/// The rows of each element: times, raw and shown numbers. Whole shown numbers are reals like others.
fn table(csv: &str) -> BTreeMap<String, Vec<(f64, String, String)>> {
    let mut table: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for line in csv.lines() {
        let cells: Vec<&str> = line.splitn(6, ',').collect();
        let [time, name, element, raw, value, unit] = cells[..] else { continue };
        let Ok(time) = time.parse::<f64>() else { continue };
        let value =
            number(value).parse::<f64>().map_or("none".to_owned(), |real| format!("{real:e}"));
        let key = format!("{name} {element} {}", unit.trim_matches('"'));
        table.entry(key).or_default().push((time, number(raw), value));
    }
    table
}

/// Compares what Octave prints of a record with what `convert` makes of it.
fn compare(folder: &Path, file: &Path) -> String {
    let printed = answered(&mut octave(folder, PRINT), "");
    let converted = sensedsl(["convert", "--quiet", "--to", "csv"]).arg(file).run().exits(0);
    let (mine, other) = (table(&printed), table(&converted.stdout));
    assert_eq!(mine.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    for (key, rows) in &other {
        for (row, own) in rows.iter().zip(&mine[key]) {
            assert!((row.0 - own.0).abs() <= 2e-6, "{key}: {row:?} {own:?}");
            let (raw, of_single) = (&row.1, key.starts_with("D10 ") || key.starts_with("D40 "));
            // A `float32` is told in the digits that it needs, and is that number again as a single.
            let single = |text: &str| text.parse::<f32>().map(f32::to_bits);
            let is_raw = if of_single { single(raw) == single(&own.1) } else { *raw == own.1 };
            assert!(is_raw && row.2 == own.2, "{key}: {row:?} {own:?}");
        }
        assert_eq!(rows.len(), mine[key].len(), "{key}");
    }
    printed
}

#[test]
fn a_record_is_what_convert_makes_of_it() {
    if !has("octave-cli") {
        return;
    }
    for is_stamped in [false, true] {
        let (schema, json) = schema(is_stamped);
        let (scratch, file) = record("matlab-record", &schema, &json);
        let printed = compare(&scratch.join(""), &file);
        for expected in [
            "class,D1,logical,bool\n",
            "class,D4,uint16,uint16\n",
            "class,D39,int64,int64[3]\n",
            "class,D10,single,float32\n",
            "whole,1\n",
            "health,12345,D31,failed\n",
        ] {
            assert!(printed.contains(expected), "{expected}: {printed}");
        }
        assert_eq!(printed.contains("stamp,D1,4000000000,255\n"), is_stamped, "{printed}");
        assert_eq!(table(&printed).len(), 11 + 33, "{printed}");
    }
}

#[test]
fn a_record_that_was_cut_gives_what_is_whole() {
    if !has("octave-cli") {
        return;
    }
    let (schema, json) = schema(false);
    let (scratch, file) = record("matlab-cut", &schema, &json);
    let bytes = std::fs::read(&file).unwrap();
    let mut counts = Vec::new();
    for part in [bytes.len() / 2, bytes.len() - 20] {
        std::fs::write(&file, &bytes[..part]).unwrap();
        let printed = compare(&scratch.join(""), &file);
        assert!(printed.contains("whole,0\n"), "{printed}");
        counts.push(table(&printed).len());
    }
    assert_eq!(counts.last(), Some(&44), "{counts:?}");
}

#[test]
fn other_files_are_refused() {
    if !has("octave-cli") {
        return;
    }
    let scratch = TempDir::new("matlab-others");
    scratch.write("text", "time_s,device\n");
    let magic = b"\x89MCAP0\r\n";
    scratch.write("empty", [&magic[..], &[2, 20, 0, 0, 0, 0, 0, 0, 0], &[0; 20], magic].concat());
    for (name, expected) in [
        ("text", "text is no MCAP file"),
        ("empty", "empty has no attachment schema.json: it is no record of a board"),
        ("none", "none cannot be opened"),
    ] {
        let call = octave(&scratch.join(""), &format!("read_record('{name}')")).output();
        let Output { status, stderr, .. } = call.unwrap();
        let said = String::from_utf8_lossy(&stderr).into_owned();
        assert!(!status.success() && said.contains(&format!("error: {expected}")), "{said}");
    }
}

#[test]
fn what_is_plotted_is_in_the_record() {
    if !has("octave-cli") {
        return;
    }
    let scratch = TempDir::new("matlab-plot");
    let design = "board Rover on NUCLEO_F446RE {
        sensor until returns uint16 { id = 17; type = analog; scale = 0.5; quantity = cm; }
        sensor Turns returns int32 { id = 18; type = encoder; }
        sensor Bumper returns bool[3] { id = 19; type = digital; }
        actuator Servo accepts uint16 { id = 20; type = dac; }
    }";
    let file = scratch.write("robot.sense", design);
    let out = scratch.join("out");
    let call = sensedsl(["generate", "--quiet", "--without", "firmware", "--host", "matlab", "-o"]);
    let _ = call.arg(&out).arg(&file).run().exits(0);
    let record = scratch.join("run.mcap");
    let call = sensedsl(["monitor", "simulate", "--quiet", "--seconds", "0.5", "--format", "csv"]);
    let _ = call.arg("--record").arg(&record).arg(&file).run().exits(0);
    // Without a screen nothing can be plotted: each expression that the plots name is computed.
    let script = "
        run = read_record('run.mcap');
        text = fileread('out/host/matlab/plot_robot.m');
        found = regexp(text, 'run\\.\\w+\\.\\w+\\.\\w+', 'match');
        for i = 1:numel(found), fprintf('%s %d\\n', found{i}, size(eval(found{i}), 2)); end";
    let said = answered(&mut octave(&scratch.join(""), script), "");
    let expected = "run.Rover.until_.t 1\nrun.Rover.until_.value 1\nrun.Rover.Turns.t 1\nrun.Rover.Turns.value 1\n\
        run.Rover.Bumper.t 1\nrun.Rover.Bumper.value 3\nrun.Rover.Servo.t 1\nrun.Rover.Servo.value 1\n";
    assert_eq!(said, expected);
}
