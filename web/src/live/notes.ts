import { make, shownTime, write } from "./dom.js";
import type { Health, Note, Readings } from "./readings.js";

const SHOWN_MAX = 50;
const WORDS = { info: "", warning: "Warning: ", error: "Error: " };

/** What the host has to tell, the newest first. */
export class Notes {
    readonly element = make("ol", { class: "live-notes", reversed: true, "aria-label": "Notes" });
    readonly #readings: Readings;
    #shown = -1;

    constructor(readings: Readings) {
        this.#readings = readings;
    }

    update(): void {
        if (this.#shown === this.#readings.told) return;
        this.#shown = this.#readings.told;
        const newest = this.#readings.notes.slice(-SHOWN_MAX).reverse();
        this.element.replaceChildren(...newest.map(item));
        if (newest.length === 0) this.element.replaceChildren(make("li", { class: "live-hint" }, "Nothing to note yet."));
    }
}

function item(note: Note): HTMLElement {
    const time = make("span", { class: "live-time" }, shownTime(note.time_ms));
    return make("li", { "data-level": note.level }, time, ` ${WORDS[note.level]}${note.text}`);
}

/** How the board and its link are. */
export class Condition {
    readonly element = make("dl", { class: "live-health" });
    readonly #readings: Readings;
    readonly #values = new Map<string, HTMLElement>();

    constructor(readings: Readings) {
        this.#readings = readings;
    }

    update(): void {
        const { health, counts, info } = this.#readings;
        this.#tell("Frames", `${counts.frames}`);
        this.#tell("Bytes outside frames", `${counts.dropped_bytes}`);
        this.#tell("Reports lost", `${counts.lost}`);
        if (counts.withheld > 0) this.#tell("Reports not believed", `${counts.withheld}`);
        this.#tell("Firmware's hash", info.hash);
        if (health === null) {
            this.#tell("Health", "not told yet");
            return;
        }
        this.#tell("Health", troubles(health));
        this.#tell("Runs for", shownTime(health.uptime_s * 1_000));
        this.#tell("Started by", health.reset_cause);
        for (const [name, value] of Object.entries(health)) {
            if (typeof value === "number" && name !== "uptime_s") this.#tell(named(name), `${value}`);
        }
    }

    #tell(name: string, text: string): void {
        let value = this.#values.get(name);
        if (value === undefined) {
            value = make("dd");
            this.#values.set(name, value);
            this.element.append(make("div", {}, make("dt", {}, name), value));
        }
        write(value, text);
    }
}

function named(name: string): string {
    const words = name.replaceAll("_", " ");
    return words.charAt(0).toUpperCase() + words.slice(1);
}

function troubles(health: Health): string {
    const bad = health.devices.filter((one) => !["good", "never read"].includes(one.status));
    if (bad.length === 0) return "all devices are good";
    return bad.map((one) => `${one.name}: ${one.status}${one.causes === "" ? "" : ` (${one.causes})`}`).join("; ");
}

const SAME_AFTER_MS = 30_000;
const NEXT_AFTER_MS = 3_000;

/** Says to everybody what is worth it, and neither the same again and again nor one thing upon the other. */
export class Speaker {
    readonly #said = new Map<string, number>();
    #last_ms = -Infinity;

    constructor(readonly announce: (text: string) => void) {}

    /** Says what somebody has asked for. */
    say(text: string): void {
        this.#last_ms = performance.now();
        this.announce(text);
    }

    /** Says warnings and errors, unless there are too many of them. */
    note(level: Note["level"], text: string): void {
        const now_ms = performance.now();
        if (level === "info" || now_ms - this.#last_ms < NEXT_AFTER_MS) return;
        if (now_ms - (this.#said.get(text) ?? -Infinity) < SAME_AFTER_MS) return;
        this.#said.set(text, now_ms);
        this.#last_ms = now_ms;
        this.announce(text);
    }
}
