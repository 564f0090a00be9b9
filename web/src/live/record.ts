import type { RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";

/** How values are written: an object a value, or a row an element. */
export type Format = "ndjson" | "csv";

/** Where a record goes. */
export interface Sink {
    write(bytes: Uint8Array<ArrayBuffer>): Promise<void>;
    close(): Promise<void>;
}

/** What a file of a format is called elsewhere. */
export const TYPES: Record<Format, string> = { ndjson: "application/x-ndjson", csv: "text/csv" };

const FLUSH_BYTES = 1 << 16;

/** Writes values down as they come, as `sensedsl monitor` does. */
export class Recorder {
    /** How many values were written. */
    values = 0;
    /** How many bytes they are. */
    bytes = 0;
    /** Called once if it cannot be written any more. */
    onFailed: (error: unknown) => void = () => {};
    readonly #info: RobotInfo;
    readonly #format: Format;
    readonly #sink: Sink;
    readonly #set = new Map<number, string>();
    #text = "";
    #written: Promise<void> = Promise.resolve();
    #hasFailed = false;

    constructor(info: RobotInfo, format: Format, sink: Sink) {
        this.#info = info;
        this.#format = format;
        this.#sink = sink;
        if (format === "csv") this.#text = "time_s,device,element,raw,value,unit\n";
    }

    /** Writes what was seen; of actuators, what has changed. */
    take(seen: Seen): void {
        for (const [time_ms, index, numbers, , raw] of seen.values) this.add(time_ms, index, numbers, raw);
        for (const [index, numbers] of seen.outputs ?? []) {
            const key = numbers.join(" ");
            if (this.#set.get(index) === key) continue;
            this.#set.set(index, key);
            this.add(seen.now_ms, index, numbers);
        }
        if (this.#text.length > FLUSH_BYTES) this.flush();
    }

    /** Writes a value: its shown numbers, and what the board sent; of an actuator only what is shown is known. */
    add(time_ms: number, index: number, numbers: readonly (number | null)[], raw: readonly (number | boolean | null)[] = []): void {
        const device = this.#info.devices[index];
        if (device === undefined) return;
        this.values += 1;
        const time_s = time_ms / 1_000;
        if (this.#format === "ndjson") {
            const { name, unit, is_bool } = device;
            const shown = numbers.map((one) => (is_bool && one !== null ? one !== 0 : one));
            const of = <T>(all: readonly T[]) => (device.type.endsWith("]") ? all : (all[0] ?? null));
            const value = { time_s, board: this.#info.board, device: name, raw: of(raw), value: of(shown), unit };
            this.#text += `${JSON.stringify(value)}\n`;
            return;
        }
        for (const [element, number] of numbers.entries()) {
            const cells = [time_s, quoted(device.name), element, raw[element] ?? "", number ?? "", quoted(device.unit ?? "")];
            this.#text += `${cells.join()}\n`;
        }
    }

    /** Gives what has come so far to the sink. */
    flush(): void {
        if (this.#text === "" || this.#hasFailed) return;
        const bytes = new TextEncoder().encode(this.#text);
        this.#text = "";
        this.bytes += bytes.length;
        this.#written = this.#written.then(() => this.#sink.write(bytes)).catch((error) => this.#fail(error));
    }

    /** Ends the record. */
    async stop(): Promise<void> {
        this.flush();
        await this.#written;
        await this.#sink.close();
    }

    #fail(error: unknown): void {
        if (this.#hasFailed) return;
        this.#hasFailed = true;
        this.onFailed(error);
    }
}

function quoted(text: string): string {
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** A record has become larger than what is kept in memory. */
export class Full extends Error {}

/** Keeps a record in memory until it ends. */
export class MemorySink implements Sink {
    readonly #parts: Uint8Array<ArrayBuffer>[] = [];
    #bytes = 0;

    constructor(
        readonly bytes_max: number,
        readonly save: (bytes: Uint8Array) => void,
    ) {}

    async write(bytes: Uint8Array<ArrayBuffer>): Promise<void> {
        if (this.#bytes + bytes.length > this.bytes_max) throw new Full();
        this.#bytes += bytes.length;
        this.#parts.push(bytes);
    }

    async close(): Promise<void> {
        const all = new Uint8Array(this.#bytes);
        let at = 0;
        for (const part of this.#parts) {
            all.set(part, at);
            at += part.length;
        }
        this.save(all);
    }
}

interface FilePicker {
    showSaveFilePicker?: (options: {
        suggestedName: string;
        types: { description: string; accept: Record<string, string[]> }[];
    }) => Promise<{ createWritable(): Promise<Sink> }>;
}

/** Asks for a file to write to; null where the browser cannot. It rejects if nobody chooses one. */
export async function fileSink(name: string, format: Format): Promise<Sink | null> {
    const { showSaveFilePicker } = window as FilePicker;
    if (showSaveFilePicker === undefined) return null;
    const description = format === "csv" ? "Table" : "JSON lines";
    const types = [{ description, accept: { [TYPES[format]]: [`.${format}`] } }];
    const file = await showSaveFilePicker.call(window, { suggestedName: name, types });
    return file.createWritable();
}
