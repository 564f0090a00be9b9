import type { RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";
import type { LiveStudio } from "./contract.js";
import { button, make, write } from "./dom.js";
import { fileSink, type Format, Full, MemorySink, Recorder, type Sink, TYPES } from "./record.js";

const MEMORY_BYTES = 64 << 20;
const FLUSH_EVERY_MS = 1_000;

/** Buttons that record what comes to a file. */
export class Recording {
    readonly element: HTMLElement;
    readonly #info: RobotInfo;
    readonly #studio: LiveStudio;
    readonly #format: HTMLSelectElement;
    readonly #button: HTMLButtonElement;
    readonly #told = make("span", { class: "live-hint" });
    #recorder: Recorder | null = null;
    #isEnding = false;
    #flushed_ms = 0;

    constructor(info: RobotInfo, studio: LiveStudio) {
        this.#info = info;
        this.#studio = studio;
        this.#format = make(
            "select",
            { "aria-label": "Format of the record" },
            make("option", { value: "ndjson" }, "NDJSON"),
            make("option", { value: "csv" }, "CSV"),
        );
        this.#button = button("Record", () => void this.#toggle(), { "aria-pressed": "false" });
        this.element = make("div", { class: "live-bar live-recording", role: "group", "aria-label": "Record" }, this.#button, this.#format, this.#told);
    }

    get isOn(): boolean {
        return this.#recorder !== null;
    }

    take(seen: Seen): void {
        this.#recorder?.take(seen);
    }

    /** An actuator of a real board was set. */
    sent(time_ms: number, index: number, numbers: readonly (number | null)[]): void {
        this.#recorder?.add(time_ms, index, numbers);
    }

    update(): void {
        const recorder = this.#recorder;
        if (recorder === null) return;
        if (performance.now() - this.#flushed_ms > FLUSH_EVERY_MS) {
            this.#flushed_ms = performance.now();
            recorder.flush();
        }
        write(this.#told, `${recorder.values} values, ${shownBytes(recorder.bytes)}`);
    }

    async #toggle(): Promise<void> {
        if (this.#recorder === null) await this.#start();
        else await this.stop();
    }

    async #start(): Promise<void> {
        const format = this.#format.value as Format;
        const name = `${this.#info.board}-${stamp(new Date())}.${format}`;
        const memory = () => new MemorySink(MEMORY_BYTES, (bytes) => this.#studio.save(name, bytes, TYPES[format]));
        let sink: Sink;
        try {
            sink = (await fileSink(name, format)) ?? memory();
        } catch (error) {
            if (error instanceof DOMException && error.name === "AbortError") return;
            // A frame of another page may not ask for files; the record is offered at its end.
            sink = memory();
        }
        const recorder = new Recorder(this.#info, format, sink);
        recorder.onFailed = (error) => this.#failed(error);
        this.#recorder = recorder;
        this.#show();
        addEventListener("beforeunload", warn);
        this.#studio.announce("Recording.");
    }

    /** Ends the record, if there is one, and offers it if it has no file yet. */
    async stop(): Promise<void> {
        const recorder = this.#recorder;
        if (recorder === null || this.#isEnding) return;
        this.#isEnding = true;
        this.#recorder = null;
        removeEventListener("beforeunload", warn);
        try {
            await recorder.stop();
            this.#tell(`Recorded ${recorder.values} values, ${shownBytes(recorder.bytes)}.`);
        } catch (error) {
            this.#tell(`The record cannot be finished: ${error instanceof Error ? error.message : error}`);
        }
        this.#isEnding = false;
        this.#show();
    }

    #failed(error: unknown): void {
        const why =
            error instanceof Full
                ? `The record has reached ${shownBytes(MEMORY_BYTES)}, which is all that is kept in memory; it ends here.`
                : `The record cannot be written: ${error instanceof Error ? error.message : error}`;
        void this.stop().then(() => this.#tell(why));
    }

    #tell(text: string): void {
        write(this.#told, text);
        this.#studio.announce(text);
    }

    #show(): void {
        const isOn = this.isOn;
        this.#button.setAttribute("aria-pressed", `${isOn}`);
        write(this.#button, isOn ? "Stop recording" : "Record");
        this.#format.disabled = isOn;
    }
}

/** Asks whether to leave the page while a record is not finished. */
function warn(event: Event): void {
    event.preventDefault();
}

function shownBytes(bytes: number): string {
    if (bytes < 1_000) return `${bytes} B`;
    if (bytes < 1_000_000) return `${(bytes / 1_000).toFixed(0)} kB`;
    return `${(bytes / 1_000_000).toFixed(1)} MB`;
}

function stamp(date: Date): string {
    const two = (number: number) => `${number}`.padStart(2, "0");
    const day = `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
    return `${day}-${two(date.getHours())}${two(date.getMinutes())}${two(date.getSeconds())}`;
}
