import { type Closed, type Link, Refused } from "./transport.js";
import { portName, type Serial, type SerialPort } from "./webserial.js";

/** A port that is there again cannot be opened at once on every system. */
const OPEN_AGAIN_MS = 250;
const OPEN_TRIES = 20;
/** Room for a second of the fastest link, while the page is busy. */
const BUFFER_BYTES = 1 << 18;

const SYSTEM_HELP =
    "Close other programs that use the port. On Linux your user must be in the port's group, which is often “dialout”.";

/** Says why a port was not chosen. */
export function notChosen(error: unknown): Refused {
    const name = error instanceof DOMException ? error.name : "";
    if (name === "NotFoundError") return new Refused("No port was chosen.", "");
    if (name === "SecurityError") {
        const help = "Allow serial ports in the browser's settings for this page. An embedded page also needs the permission of the page around it.";
        return new Refused("The browser does not let this page use serial ports.", help);
    }
    return new Refused(`No port was opened: ${text(error)}`, "");
}

function text(error: unknown): string {
    return error instanceof Error ? error.message : String(error);
}

function notOpened(error: unknown): Refused {
    const name = error instanceof DOMException ? error.name : "";
    if (name === "InvalidStateError") {
        return new Refused("The port is already open in this page.", "Disconnect it first, or load the page again.");
    }
    if (name === "NetworkError") return new Refused("The port cannot be opened.", SYSTEM_HELP);
    return new Refused(`The port cannot be opened: ${text(error)}`, SYSTEM_HELP);
}

/** A serial port that is opened again whenever it comes back. */
export class SerialLink implements Link {
    onOpened: () => void = () => {};
    onBytes: (bytes: Uint8Array<ArrayBuffer>) => void = () => {};
    onClosed: (closed: Closed) => void = () => {};
    readonly #serial: Serial;
    readonly #baud: number;
    #port: SerialPort;
    #reader: ReadableStreamDefaultReader<Uint8Array<ArrayBuffer>> | null = null;
    #writer: WritableStreamDefaultWriter<Uint8Array> | null = null;
    #reading: Promise<void> = Promise.resolve();
    #isStopped = false;
    #isReopening = false;

    constructor(serial: Serial, port: SerialPort, baud: number) {
        this.#serial = serial;
        this.#port = port;
        this.#baud = baud;
    }

    async start(): Promise<void> {
        try {
            await this.#open();
        } catch (error) {
            throw notOpened(error);
        }
        this.#serial.addEventListener("connect", this.#back);
    }

    async write(bytes: Uint8Array): Promise<void> {
        try {
            await this.#writer?.write(bytes);
        } catch {
            // The reader tells that the port is gone.
        }
    }

    async stop(): Promise<void> {
        this.#isStopped = true;
        this.#serial.removeEventListener("connect", this.#back);
        await this.#reader?.cancel().catch(() => {});
        // A port cannot be closed as long as somebody reads it.
        await this.#reading;
        await this.#close();
    }

    async #open(): Promise<void> {
        const port = this.#port;
        await port.open({ baudRate: this.#baud, bufferSize: BUFFER_BYTES });
        if (this.#isStopped) {
            await port.close();
            return;
        }
        this.#writer = port.writable?.getWriter() ?? null;
        this.onOpened();
        this.#reading = this.#read(port);
    }

    async #read(port: SerialPort): Promise<void> {
        let why = "";
        // After an error that is not the end, such as an overrun, the port has a new stream.
        while (port.readable !== null && !this.#isStopped) {
            const reader = port.readable.getReader();
            this.#reader = reader;
            try {
                for (;;) {
                    const { value, done } = await reader.read();
                    if (done) break;
                    this.onBytes(value);
                }
                // A stream that ended without an error does not begin again.
                break;
            } catch (error) {
                why = text(error);
            } finally {
                reader.releaseLock();
                this.#reader = null;
            }
        }
        if (this.#isStopped) return;
        await this.#close();
        this.#tellGone(why);
    }

    #tellGone(why: string): void {
        const reason = why === "" ? "" : ` (${why.replace(/\.$/, "")})`;
        this.onClosed({
            text: `The board is gone${reason}.`,
            help: "Plug it in again: it is opened as soon as it is there.",
            isWaiting: true,
        });
        // It may be back already.
        void this.#look();
    }

    async #close(): Promise<void> {
        const writer = this.#writer;
        this.#writer = null;
        writer?.releaseLock();
        // A port that is gone says so once more.
        await this.#port.close().catch(() => {});
    }

    readonly #back = (event: Event): void => {
        if (event.target instanceof EventTarget && event.target !== this.#serial) {
            const port = event.target as SerialPort;
            if (this.#isOurs(port)) void this.#reopen(port);
            return;
        }
        void this.#look();
    };

    #isOurs(port: SerialPort): boolean {
        if (port === this.#port) return true;
        const { usbVendorId } = port.getInfo();
        return usbVendorId !== undefined && portName(port) === portName(this.#port);
    }

    /** Whether the port is among those that are there. */
    async #look(): Promise<void> {
        const ports = await this.#serial.getPorts();
        const found = ports.find((one) => one === this.#port) ?? ports.find((one) => this.#isOurs(one));
        if (found !== undefined) await this.#reopen(found);
    }

    async #reopen(port: SerialPort): Promise<void> {
        if (this.#isReopening || this.#isStopped || this.#reader !== null) return;
        this.#isReopening = true;
        this.#port = port;
        try {
            for (let tries = 0; tries < OPEN_TRIES && !this.#isStopped; tries += 1) {
                try {
                    await this.#open();
                    return;
                } catch {
                    await new Promise((done) => setTimeout(done, OPEN_AGAIN_MS));
                }
            }
        } finally {
            this.#isReopening = false;
        }
    }
}
