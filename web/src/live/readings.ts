import type { RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";
import { type History, histories } from "./history.js";

/** A device as the tool describes it. */
export type Device = RobotInfo["devices"][number];
/** What a board told of its health. */
export type Health = NonNullable<Seen["health"]>;
/** A note for people. */
export type Note = Seen["notes"][number] & { time_ms: number };

const RATE_OVER_MS = 5_000;
const NOTES_MAX = 200;
/** A device is overdue if so many of its cycles, and at least a second, have passed. */
const OVERDUE_CYCLES = 3;
const OVERDUE_MS = 1_000;

/** What is known of one device. */
export interface Reading {
    readonly device: Device;
    readonly history: History;
    /** The last value as the tool writes it. */
    text: string;
    /** Its numbers; empty if there was none. */
    numbers: readonly (number | null)[];
    /** When it came; null if there was none. */
    time_ms: number | null;
    /** Values that did not come, by the device's cycle. */
    missed: number;
    /** The least and the greatest number since the start. */
    least: number;
    most: number;
    /** What an actuator's wires do, in words. */
    hardware: string;
}

/** What a board has told since it was started or connected. */
export class Readings {
    readonly all: Reading[];
    readonly notes: Note[] = [];
    health: Health | null = null;
    counts: Seen["counts"] = { bytes: 0, frames: 0, dropped_bytes: 0, withheld: 0, lost: 0 };
    state: Seen["state"] = "asking";
    now_ms = 0;
    /** Counts the notes and health that came. */
    told = 0;

    /** Whether the board is the one that is meant, as far as anybody can tell. */
    get isBelieved(): boolean {
        return this.state === "matched" || this.state === "playing";
    }

    constructor(readonly info: RobotInfo) {
        const rings = histories(info.devices);
        this.all = info.devices.map((device, index) => ({
            device,
            history: rings[index] as History,
            text: "",
            numbers: [],
            time_ms: null,
            missed: 0,
            least: Infinity,
            most: -Infinity,
            hardware: "",
        }));
    }

    /** Takes what was seen. */
    take(seen: Seen): void {
        this.now_ms = seen.now_ms;
        this.state = seen.state;
        this.counts = seen.counts;
        for (const [time_ms, index, numbers, text] of seen.values) {
            const reading = this.all[index];
            if (reading !== undefined) take(reading, time_ms, numbers, text);
        }
        for (const [index, numbers, hardware] of seen.outputs ?? []) {
            const reading = this.all[index];
            if (reading === undefined) continue;
            reading.hardware = hardware ?? "";
            take(reading, seen.now_ms, numbers, shownText(reading.device, numbers));
        }
        for (const note of seen.notes) this.note(note.level, note.text);
        if (seen.health !== null) {
            this.health = seen.health;
            this.told += 1;
        }
    }

    /** Adds a note. */
    note(level: Note["level"], text: string): void {
        this.notes.push({ level, text, time_ms: this.now_ms });
        if (this.notes.length > NOTES_MAX) this.notes.shift();
        this.told += 1;
    }

    /** Remembers what was sent to an actuator of a real board, which does not tell. */
    sent(name: string, text: string): void {
        const reading = this.all.find((one) => one.device.name === name);
        if (reading === undefined) return;
        const words = text.match(/-?\d+(\.\d+)?([eE][-+]?\d+)?|true|false/g) ?? [];
        const numbers = words.slice(0, reading.device.elements).map((one) => (one === "true" ? 1 : one === "false" ? 0 : +one));
        take(reading, this.now_ms, numbers, text);
    }
}

function take(reading: Reading, time_ms: number, numbers: readonly (number | null)[], text: string): void {
    const { cycle_ms, direction } = reading.device;
    if (reading.time_ms !== null && cycle_ms && direction === "sensor") {
        const cycles = Math.round((time_ms - reading.time_ms) / cycle_ms);
        reading.missed += Math.max(0, cycles - 1);
    }
    reading.history.push(time_ms, numbers);
    reading.time_ms = time_ms;
    reading.numbers = numbers;
    reading.text = text;
    for (const number of numbers) {
        if (number === null) continue;
        reading.least = Math.min(reading.least, number);
        reading.most = Math.max(reading.most, number);
    }
}

/** Values a second, over the last five seconds. */
export function rate(reading: Reading, now_ms: number): number {
    const { history } = reading;
    const since_ms = Math.max(now_ms - RATE_OVER_MS, history.length > 0 ? history.time(0) : now_ms);
    const passed_ms = now_ms - since_ms;
    if (passed_ms <= 0) return 0;
    return ((history.length - history.from(since_ms)) * 1_000) / passed_ms;
}

/** Whether a device that has a cycle is late by several of them. */
export function isOverdue(reading: Reading, now_ms: number): boolean {
    const { cycle_ms, direction } = reading.device;
    if (!cycle_ms || direction === "actuator" || reading.time_ms === null) return false;
    return now_ms - reading.time_ms > Math.max(OVERDUE_MS, OVERDUE_CYCLES * cycle_ms);
}

/** A number for people: at most six digits that mean something. */
export function shownNumber(number: number | null): string {
    if (number === null || !Number.isFinite(number)) return "–";
    if (Number.isInteger(number) && Math.abs(number) < 1e12) return `${number}`;
    return `${Number(number.toPrecision(6))}`;
}

/** Numbers of a device with their unit. */
export function shownText(device: Device, numbers: readonly (number | null)[]): string {
    if (device.is_bool) return numbers.map((one) => (one === null ? "–" : one === 0 ? "false" : "true")).join(", ");
    const all = numbers.map(shownNumber).join(", ");
    return device.unit === null ? all : `${all} ${device.unit}`;
}

/** A device's name, with the place of an element if it has several. */
export function elementName(device: Device, element: number): string {
    return device.elements === 1 ? device.name : `${device.name}[${element}]`;
}
