// What needs no page of the panels "Run" and "Connect": what is kept, plotted and recorded, and the serial link.

import assert from "node:assert/strict";
import { after, test } from "node:test";
import { build, stop } from "esbuild";
import { root } from "./site.mjs";

// Else its process is waited for.
after(stop);

/** Modules of the panels as one, as Node takes it. */
async function modules(...names) {
    const contents = names.map((name) => `export * from "./${name}";`).join("\n");
    const stdin = { contents, resolveDir: `${root}/web/src/live`, loader: "ts" };
    const { outputFiles } = await build({ stdin, bundle: true, write: false, format: "esm", platform: "node", logLevel: "error" });
    return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}

const { History, histories, Columns, summary, Readings, rate, isOverdue, shownNumber, Recorder, MemorySink, Full, Newest, Window, merged, SerialLink, notChosen, Trail, scaleLength, shownLength, directionName, controllersNote, isWorld, usualWorld, ServedBoard, endServed } =
    await modules("history", "plotdata", "readings", "record", "newest", "window", "merge", "serial", "trail", "controllers", "worlds", "served");

function device(name, more = {}) {
    const slider = { min: 0, max: 100, step: 1 };
    return {
        name, id: 1, direction: "sensor", kind: "analog", type: "uint16", elements: 1, is_bool: false, unit: "cm",
        min: null, max: null, slider, cycle_ms: 50, ...more,
    };
}

function info(...devices) {
    return { board: "Rover", boards: ["Rover"], hash: "0x00000001", baud: null, devices };
}

/** Waits until something is so; what is slow here is the machine. */
async function until(holds) {
    for (let tries = 0; !holds() && tries < 2_000; tries += 1) await new Promise((resolve) => setTimeout(resolve, 5));
}

const COUNTS = { bytes: 0, frames: 0, dropped_bytes: 0, withheld: 0, lost: 0 };

function seen(now_ms, values = [], more = {}) {
    return { now_ms, state: "matched", values, notes: [], health: null, counts: COUNTS, ...more };
}

test("a history keeps the newest points in order, as many as it has room for", () => {
    const history = new History(2, 5_000);
    for (let time = 0; time < 12_000; time += 1) history.push(time, [time, -time]);
    assert.equal(history.length, 5_000);
    assert.equal(history.time(0), 7_000);
    assert.equal(history.time(4_999), 11_999);
    for (const at of [0, 1, 2_500, 4_999]) assert.equal(history.value(at, 1), -history.time(at));
    assert.equal(history.from(8_000), 1_000);
    assert.equal(history.from(8_000.5), 1_001);
    assert.equal(history.from(99_999), 5_000);
});

test("a history forgets what is older than ten minutes", () => {
    const history = new History(1, 5_000);
    for (let time = 0; time <= 1_200_000; time += 1_000) history.push(time, [1]);
    assert.equal(history.time(0), 600_000);
    assert.equal(history.length, 601);
});

test("histories of many fast devices share the memory", () => {
    const [slow] = histories([device("A", { cycle_ms: 10 })]);
    assert.ok(slow.capacity >= 60_000);
    const many = histories(Array.from({ length: 200 }, () => device("A", { cycle_ms: 1, elements: 8 })));
    const bytes = many.reduce((sum, one) => sum + one.capacity * 9 * 8, 0);
    assert.ok(bytes <= 64 << 20, `${bytes}`);
});

test("a plot loses no peak, whatever its width", () => {
    const history = new History(1, 100_000);
    for (let time = 0; time < 60_000; time += 1) history.push(time, [time === 31_234 ? 500 : time === 31_235 ? -500 : 1]);
    for (const pixels of [50, 333, 1_000]) {
        const columns = new Columns({ from_ms: 0, to_ms: 60_000 }, pixels);
        const values = columns.measured(history, 0, 1).filter((one) => one != null);
        assert.equal(Math.max(...values), 500);
        assert.equal(Math.min(...values), -500);
        assert.ok(values.length <= (pixels + 3) * 3);
        assert.equal(columns.times_s().length, (pixels + 3) * 3);
    }
});

test("a plotted value is where its time is", () => {
    const history = new History(1, 100);
    for (const time of [1_000, 4_000, 9_000]) history.push(time, [time]);
    const columns = new Columns({ from_ms: 0, to_ms: 10_000 }, 500);
    const times = columns.times_s();
    const values = columns.measured(history, 0, null);
    const found = values.flatMap((value, at) => (value == null ? [] : [[value, times[at]]]));
    assert.equal(found.length, 3);
    for (const [value, time_s] of found) assert.ok(Math.abs(value / 1_000 - time_s) < 0.03, `${value} at ${time_s} s`);
});

test("a line is broken where values are missing, and only there", () => {
    const history = new History(1, 10_000);
    for (let time = 0; time < 60_000; time += 50) if (time < 20_000 || time > 30_000) history.push(time, [1]);
    const values = new Columns({ from_ms: 0, to_ms: 60_000 }, 600).measured(history, 0, 50);
    assert.equal(values.filter((one) => one === null).length, 1);
    const at = values.indexOf(null);
    assert.ok(at > 3 * 200 && at < 3 * 304, `${at}`);
    assert.equal(new Columns({ from_ms: 0, to_ms: 60_000 }, 600).measured(history, 0, null).filter((one) => one === null).length, 0);
});

test("what is set holds until now, and from before the plot begins", () => {
    const history = new History(1, 100);
    history.push(1_000, [5]);
    history.push(20_000, [7]);
    const of = (from_ms, to_ms) => new Columns({ from_ms, to_ms }, 100).held(history, 0).filter((one) => one != null);
    assert.deepEqual(of(5_000, 15_000), [5, 5]);
    assert.deepEqual(of(15_000, 25_000), [5, 7, 7]);
    assert.deepEqual(of(30_000, 40_000), [7, 7]);
});

test("numbers of a part of the run", () => {
    const history = new History(1, 100);
    for (let time = 0; time < 10; time += 1) history.push(time * 1_000, [time === 4 ? null : time]);
    assert.deepEqual(summary(history, 0, { from_ms: 2_000, to_ms: 6_000 }), { count: 4, first: 2, least: 2, mean: 4, most: 6, last: 6 });
    assert.equal(summary(history, 0, { from_ms: 90_000, to_ms: 99_000 }).count, 0);
});

test("missing values, rate, range and age of a device", () => {
    const readings = new Readings(info(device("A", { max: 90 }), device("B", { cycle_ms: null })));
    for (let time = 0; time <= 10_000; time += 50) {
        if (time > 2_000 && time < 2_200) continue;
        readings.take(seen(time, [[time, 0, [time / 100], `${time / 100} cm`]]));
    }
    const [a, b] = readings.all;
    assert.equal(a.missed, 3);
    assert.equal(a.text, "100 cm");
    assert.deepEqual([a.least, a.most], [0, 100]);
    assert.ok(Math.abs(rate(a, 10_000) - 20) < 0.5);
    assert.equal(isOverdue(a, 10_900), false);
    assert.equal(isOverdue(a, 11_100), true);
    assert.equal(isOverdue(b, 11_100), false);
    assert.equal(b.time_ms, null);
});

test("what was sent to a real board is shown as it was sent", () => {
    const readings = new Readings(info(device("Servo", { direction: "actuator", unit: "deg" }), device("Lamps", { direction: "actuator", is_bool: true, elements: 3 })));
    readings.take(seen(500));
    readings.sent("Servo", "-45.5 deg");
    readings.sent("Lamps", "true, false, true");
    assert.deepEqual(readings.all[0].numbers, [-45.5]);
    assert.equal(readings.all[0].text, "-45.5 deg");
    assert.deepEqual(readings.all[1].numbers, [1, 0, 1]);
    assert.equal(readings.all[1].time_ms, 500);
});

test("numbers are shown with the digits that mean something", () => {
    const shown = [0, 1 / 3, 1e9, 123456789.25, -0.0001234567, null, NaN].map(shownNumber);
    assert.deepEqual(shown, ["0", "0.333333", "1000000000", "123457000", "-0.000123457", "–", "–"]);
});

test("what was seen in several steps is one", () => {
    const health = { uptime_s: 1, reset_cause: "power on", devices: [] };
    const first = seen(10, [[5, 0, [1], "1"]], { health, outputs: [[1, [0], "low"]] });
    const all = merged(merged(null, first), seen(20, [[15, 0, [2], "2"]], { state: "refused", outputs: [[1, [1], "high"]] }));
    assert.deepEqual(all.values.map(([time]) => time), [5, 15]);
    assert.equal(all.now_ms, 20);
    assert.equal(all.state, "refused");
    assert.equal(all.health, health);
    assert.deepEqual(all.outputs, [[1, [1], "high"]]);
});

test("where a robot was in several steps is one path on each map, and the newest figures count", () => {
    const step = (at, figures) => seen(at, [], { poses: [[[at, 0, 1, 0]], [[0, at, 0, 1]]], figures });
    const all = merged(merged(merged(null, step(1, ["A: 1 m"])), step(2, ["A: 2 m"])), step(3, ["A: 3 m"]));
    assert.deepEqual(all.poses, [[[1, 0, 1, 0], [2, 0, 1, 0], [3, 0, 1, 0]], [[0, 1, 0, 1], [0, 2, 0, 1], [0, 3, 0, 1]]]);
    assert.deepEqual(all.figures, ["A: 3 m"]);
    // A real board has neither.
    assert.equal(merged(seen(1), seen(2)).poses, undefined);
});

test("a path of hours keeps its newest part, without a gap and in bounded memory", () => {
    const trail = new Trail(5);
    let [x, points] = [0, 0];
    for (let at = 0; at < 200_000; at += 1) {
        x += 2;
        if (trail.push(x, -x)) points += 1;
    }
    assert.ok(points > 60_000, `${points}`);
    const paths = trail.pieces.map((one) => one.path);
    assert.ok(paths.length > 10 && paths.join("").length < 60_000, `${paths.length}`);
    const ends = paths.map((path) => [/^M([^L]+)/.exec(path)[1], /L([^L]+)$/.exec(path)[1]]);
    for (const [index, [begin]] of ends.entries()) if (index > 0) assert.equal(begin, ends[index - 1][1]);
    assert.ok(x - Number(ends.at(-1)[1].split(" ")[0]) < 6);
    const opacities = trail.pieces.map((_, index) => trail.opacity(index));
    assert.equal(opacities.at(-1), 1);
    assert.ok(opacities.every((one, index) => one > 0.1 && (index === 0 || one > opacities[index - 1])));
    // A robot that stands adds nothing, and a place that is none is not drawn.
    assert.equal(trail.push(x, -x) || trail.push(x + 1, -x) || trail.push(NaN, 0), false);
});

test("a scale is round, and directions have names", () => {
    assert.deepEqual([0.72, 0.5, 0.3, 12, 0.019].map(scaleLength), [0.5, 0.5, 0.2, 10, 0.01]);
    assert.deepEqual([10, 2.4, 0.5, 0.05, 0.002].map(shownLength), ["10 m", "2.4 m", "50 cm", "5 cm", "2 mm"]);
    const of = (degrees) => directionName(Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180));
    assert.deepEqual([0, 10, 46, 90, 180, -179, -90, -46].map(of), ["right", "right", "up and right", "up", "left", "left", "down", "down and right"]);
});

test("what is said of controllers whose code does not run", () => {
    const of = (more) => ({ ...info(), controllers: ["Follow"], has_code: false, ...more });
    const text = (more, isServed) => controllersNote(of(more), isServed).join("");
    assert.equal(text({ has_code: true }, true), "");
    assert.equal(text({ controllers: [] }, false), "");
    assert.equal(text({}, true), "Follow has no code yet and sets nothing: sensedsl generate makes its first file.");
    assert.match(text({}, false), /^Follow sets nothing here: .* sensedsl studio can, .* \[controllers\.Follow\.OUTPUT\] of a world stands in for it\.$/);
    assert.equal(text({ stand_ins: ["Follow"] }, false), "Follow is run by the world’s PID.");
    assert.equal(text({ controllers: ["A", "B", "C"], stand_ins: ["C"] }, true), "A and B have no code yet and set nothing: sensedsl generate makes their first files. C is run by the world’s PID.");
});

test("a world is told from other tables, and the usual one is that of the first test", () => {
    const world = '# A world.\nseed = 1\n[plants.Robot]\nleft = "Left"\npoints = [\n  ["a", 1],\n]\n[[command]]\ndevice = "Left"\n';
    assert.equal(isWorld("oval.toml", world), true);
    assert.equal(isWorld("new.toml", ""), true);
    assert.equal(isWorld("Cargo.toml", "[package]\nname = 'x'\n[dependencies]\n"), false);
    assert.equal(isWorld("oval.csv", world), false);
    const design = "board Robot on X {\n    actuator Left accepts int16 { id = 1; }\n}\n";
    const tested = `${design}test Drives {\n    world = "worlds/b.toml";\n}\ntest More { world = "a.toml"; }\n`;
    const files = { "Cargo.toml": "[package]\n", "p/a.toml": world, "p/worlds/b.toml": world };
    assert.equal(usualWorld("p/robot.sense", { ...files, "p/robot.sense": tested }), "p/worlds/b.toml");
    // One of two is not chosen for somebody, the only one is; but not that of another design.
    assert.equal(usualWorld("p/robot.sense", { ...files, "p/robot.sense": design }), "");
    assert.equal(usualWorld("robot.sense", { "robot.sense": design, "oval.toml": world }), "oval.toml");
    assert.equal(usualWorld("robot.sense", { "robot.sense": design.replace("Left", "Arm"), "oval.toml": world }), "");
    const parts = { "robot.sense": 'use "parts.sense";\nboard B on X {}\n', "parts.sense": design, "oval.toml": world };
    assert.equal(usualWorld("robot.sense", parts), "oval.toml");
});

test("calls of a served board are requests, and a failure says what has happened", async () => {
    const asked = [];
    let answer = () => Response.json({ now_ms: 20 });
    const { fetch } = globalThis;
    globalThis.fetch = async (place, { method, headers, body, keepalive }) => {
        asked.push([method, place, headers["X-Sensedsl-Token"], body && JSON.parse(body), keepalive ?? false]);
        return answer();
    };
    const served = { token: "secret", board: "b-1" };
    const board = new ServedBoard(served);
    assert.deepEqual(await board.run(20), { now_ms: 20 });
    await board.robot({ path: "a.sense", files: { "a.sense": "" }, world: "w.toml" });
    await board.steer("Light", 0, null);
    answer = () => Response.json({ error: "no", text: null });
    assert.equal((await board.set("Servo", "x")).error, "no");
    await assert.rejects(board.run(40), /^Error: no$/);
    answer = () => Response.json({ error: "it has ended" }, { status: 410 });
    await assert.rejects(board.run(40), /the server has ended the board/);
    answer = () => Response.json({ error: "too large" }, { status: 413 });
    await assert.rejects(board.run(40), /too large/);
    answer = () => Promise.reject(new TypeError("Failed to fetch"));
    await assert.rejects(board.run(40), /the server does not answer/);
    endServed(served);
    await until(() => asked.length === 9);
    globalThis.fetch = fetch;
    const at = (call) => ["POST", "/api/boards/b-1", "secret", call, false];
    assert.deepEqual(asked.slice(0, 4), [
        at({ do: "run", until_ms: 20 }),
        at({ do: "robot", of: { path: "a.sense", files: { "a.sense": "" } }, world: "w.toml" }),
        at({ do: "steer", device: "Light", element: 0, shown: null }),
        at({ do: "set", device: "Servo", value: "x" }),
    ]);
    assert.deepEqual(asked[8], ["DELETE", "/api/boards/b-1", "secret", undefined, true]);
});

async function recorded(format) {
    let text = "";
    const sink = new MemorySink(1 << 20, (bytes) => (text = new TextDecoder().decode(bytes)));
    const recorder = new Recorder(info(device("A"), device("Pair", { elements: 2, type: "uint16[2]", unit: null }), device("Servo", { direction: "actuator", unit: "deg" })), format, sink);
    recorder.take(seen(1_500, [[1_412, 0, [37.98], "37.98 cm", [3798]], [1_412, 1, [1, null], "1, –", [1, null]]], { outputs: [[2, [90], ""]] }));
    recorder.take(seen(1_600, [], { outputs: [[2, [90], ""]] }));
    recorder.take(seen(1_700, [], { outputs: [[2, [45], ""]] }));
    await recorder.stop();
    return text;
}

test("a record has an object a value", async () => {
    const lines = (await recorded("ndjson")).trimEnd().split("\n").map((line) => JSON.parse(line));
    assert.deepEqual(lines, [
        { time_s: 1.412, board: "Rover", device: "A", raw: 3798, value: 37.98, unit: "cm" },
        { time_s: 1.412, board: "Rover", device: "Pair", raw: [1, null], value: [1, null], unit: null },
        { time_s: 1.5, board: "Rover", device: "Servo", raw: null, value: 90, unit: "deg" },
        { time_s: 1.7, board: "Rover", device: "Servo", raw: null, value: 45, unit: "deg" },
    ]);
});

test("a record as a table has a row an element", async () => {
    const lines = (await recorded("csv")).trimEnd().split("\n");
    assert.deepEqual(lines, [
        "time_s,device,element,raw,value,unit",
        "1.412,A,0,3798,37.98,cm",
        "1.412,Pair,0,1,1,",
        "1.412,Pair,1,,,",
        "1.5,Servo,0,,90,deg",
        "1.7,Servo,0,,45,deg",
    ]);
});

test("a record in memory ends at its limit, and keeps what it has", async () => {
    let saved = 0;
    const sink = new MemorySink(1_000, (bytes) => (saved = bytes.length));
    const recorder = new Recorder(info(device("A")), "csv", sink);
    const failed = new Promise((resolve) => (recorder.onFailed = resolve));
    for (let time = 0; time < 100; time += 1) {
        recorder.take(seen(time, [[time, 0, [time], ""]]));
        recorder.flush();
    }
    assert.ok((await failed) instanceof Full);
    await recorder.stop();
    assert.ok(saved > 900 && saved <= 1_000, `${saved}`);
});

test("of what waits, only the newest is done, and one thing after another", async () => {
    const done = [];
    const newest = new Newest();
    const work = (name) => async () => {
        done.push(name);
        await new Promise((resolve) => setTimeout(resolve, 5));
        done.push(`${name}.`);
        if (name === "a") throw new Error("refused");
    };
    for (const name of ["a", "b", "c"]) newest.run("x", work(name));
    newest.run("y", work("d"));
    await until(() => done.length >= 6);
    assert.deepEqual(done, ["a", "d", "a.", "c", "d.", "c."]);
});

test("a window goes with the time until it is held, and scrolls no farther than what is kept", () => {
    const window = new Window();
    window.setSpan(10_000);
    assert.deepEqual(window.span(3_000), { from_ms: 0, to_ms: 10_000 });
    assert.deepEqual(window.span(50_000), { from_ms: 40_000, to_ms: 50_000 });
    window.scroll(true, 50_000);
    assert.deepEqual(window.span(60_000), { from_ms: 35_000, to_ms: 45_000 });
    window.zoom(true);
    assert.deepEqual(window.span(60_000), { from_ms: 37_500, to_ms: 42_500 });
    window.show({ from_ms: 12_000, to_ms: 13_000 });
    assert.deepEqual(window.span(60_000), { from_ms: 12_000, to_ms: 13_000 });
    window.showUntil(0, 60_000);
    assert.deepEqual(window.span(60_000), { from_ms: 0, to_ms: 1_000 });
    window.showUntil(99_000, 60_000);
    assert.equal(window.isHeld, false);
    window.setSpan(9e9);
    assert.equal(window.span_ms, 600_000);
});

/** A port that a test puts bytes into. */
class Port extends EventTarget {
    readable = null;
    writable = null;
    written = [];
    isOpen = false;
    failures = [];
    constructor(serial) {
        super();
        this.serial = serial;
    }
    getInfo() {
        return { usbVendorId: 0x0483, usbProductId: 0x5740 };
    }
    async open({ baudRate }) {
        const failure = this.failures.shift();
        if (failure) throw failure;
        if (this.isOpen) throw new DOMException("The port is already open.", "InvalidStateError");
        this.isOpen = true;
        this.baud = baudRate;
        this.stream();
        this.writable = new WritableStream({ write: (bytes) => void this.written.push(...bytes) });
    }
    stream() {
        this.readable = new ReadableStream({ start: (source) => void (this.source = source) });
    }
    async close() {
        if (this.readable?.locked || this.writable?.locked) throw new TypeError("Cannot close a locked stream.");
        this.isOpen = false;
        this.readable = null;
    }
    /** The cable is pulled. */
    pull() {
        const { source } = this;
        this.readable = null;
        source.error(new DOMException("The device has been lost.", "NetworkError"));
        this.serial.ports.delete(this);
    }
    /** Bytes came too fast: the stream ends, and another one is there. */
    overrun() {
        const { source } = this;
        this.stream();
        source.error(new DOMException("Buffer overrun", "BufferOverrunError"));
    }
    plug() {
        this.serial.ports.add(this);
        const event = new Event("connect");
        Object.defineProperty(event, "target", { value: this });
        this.serial.dispatchEvent(event);
    }
}

class Serial extends EventTarget {
    ports = new Set();
    async getPorts() {
        return [...this.ports];
    }
}

function link() {
    const serial = new Serial();
    const port = new Port(serial);
    serial.ports.add(port);
    const told = [];
    const made = new SerialLink(serial, port, 57_600);
    made.onOpened = () => told.push("opened");
    made.onBytes = (bytes) => told.push([...bytes]);
    made.onClosed = ({ text, isWaiting }) => told.push(`${text} ${isWaiting}`);
    return { serial, port, told, made };
}

test("a serial link is opened again when the board comes back", async () => {
    const { port, told, made } = link();
    await made.start();
    assert.equal(port.baud, 57_600);
    port.source.enqueue(new Uint8Array([1, 2]));
    await made.write(new Uint8Array([9]));
    await until(() => told.length === 2);
    port.pull();
    await until(() => told.length === 3 && !port.isOpen);
    assert.equal(port.isOpen, false);
    await made.write(new Uint8Array([8]));
    port.failures.push(new DOMException("Failed to open serial port.", "NetworkError"));
    port.plug();
    await until(() => told.length === 4);
    port.source.enqueue(new Uint8Array([3]));
    await until(() => told.length === 5);
    assert.deepEqual(told, ["opened", [1, 2], "The board is gone (The device has been lost). true", "opened", [3]]);
    assert.deepEqual(port.written, [9]);
    await made.stop();
    assert.equal(port.isOpen, false);
    port.plug();
    await new Promise((resolve) => setTimeout(resolve, 300));
    assert.equal(port.isOpen, false);
    assert.equal(told.length, 5);
});

test("a serial link that lost bytes goes on", async () => {
    const { port, told, made } = link();
    await made.start();
    port.overrun();
    await until(() => port.readable.locked);
    port.source.enqueue(new Uint8Array([4]));
    await until(() => told.length === 2);
    assert.deepEqual(told, ["opened", [4]]);
    await made.stop();
    assert.equal(port.isOpen, false);
});

test("why a port cannot be opened, and what helps", async () => {
    const failures = [
        [new DOMException("Failed to open serial port.", "NetworkError"), /cannot be opened\.$/, /Close other programs/],
        [new DOMException("The port is already open.", "InvalidStateError"), /already open in this page/, /Disconnect/],
    ];
    for (const [failure, message, help] of failures) {
        const { port, told, made } = link();
        port.failures.push(failure);
        await assert.rejects(made.start(), (refused) => message.test(refused.message) && help.test(refused.help));
        assert.deepEqual(told, []);
    }
    assert.match(notChosen(new DOMException("No port selected by the user.", "NotFoundError")).message, /No port was chosen/);
    assert.match(notChosen(new DOMException("Access denied", "SecurityError")).help, /Allow serial ports/);
});
