// For tests: a board at a serial port that is not there, in the page in place of Web Serial.

import { crc32 } from "node:zlib";

/** What the board's shell answers to `schema`, of which the hash is made. */
export const SCHEMA = `checksum none
1 sensor Light uint16
2 sensor Bumper bool
3 actuator Servo uint16
4 actuator Lamp bool
`;

/** The design that the board has firmware of. */
export const DESIGN = `board Rover on STM32F4DiscoveryBoard {
    sensor Light returns uint16 { id = 1; type = analog; delay = 50 ms; }
    sensor Bumper returns bool { id = 2; type = digital; pull = up; delay = 50 ms; }
    actuator Servo accepts uint16 { id = 3; driver = servo; }
    actuator Lamp accepts bool { id = 4; type = digital; }
}
`;

/** What a page is given: the schema of the board, its hash, and how choosing and opening a port fails, if it does. */
export function board({ schema = SCHEMA, refused = null, busy = null } = {}) {
    return { schema, hash: crc32(schema), refused, busy };
}

/**
 * Stands in for `navigator.serial`; it is evaluated in the page. `window.board` has `pull()` and `plug()`, what was
 * received, and the value that is reported.
 */
export function fakeSerial({ schema, hash, refused, busy }) {
    const frame = (payload) => new Uint8Array([...new TextEncoder().encode(`${payload.length}:`), ...payload, 44]);
    const word = (number, bytes) => Array.from({ length: bytes }, (_, at) => (number >>> (8 * (bytes - 1 - at))) & 255);
    const serial = new EventTarget();
    const board = { light: 1_000, received: [], asked: 0, opened: 0, baud: null, isReporting: true };

    class Port extends EventTarget {
        readable = null;
        writable = null;
        getInfo() {
            return { usbVendorId: 0x0483, usbProductId: 0x5740 };
        }
        async open({ baudRate }) {
            if (busy !== null) throw new DOMException("Failed to open serial port.", busy);
            if (this.readable !== null) throw new DOMException("The port is already open.", "InvalidStateError");
            board.baud = baudRate;
            board.opened += 1;
            this.text = "";
            this.readable = new ReadableStream({ start: (source) => void (this.source = source) });
            this.writable = new WritableStream({ write: (bytes) => this.take(bytes) });
            this.timer = setInterval(() => this.report(), 50);
        }
        async close() {
            if (this.readable?.locked || this.writable?.locked) throw new TypeError("Cannot close a locked stream.");
            clearInterval(this.timer);
            this.readable = null;
        }
        report() {
            if (!board.isReporting) return;
            this.source.enqueue(frame([1, ...word(board.light, 2), 2, 0]));
        }
        take(bytes) {
            this.text += String.fromCharCode(...bytes);
            for (;;) {
                if (this.text.includes("schema\r")) {
                    this.text = "";
                    this.source.enqueue(new TextEncoder().encode(`schema\r\n${schema.replaceAll("\n", "\r\n")}ch> `));
                }
                const found = /(\d+):/.exec(this.text);
                if (found === null) return;
                const begin = found.index + found[0].length;
                const end = begin + Number(found[1]);
                if (this.text.length <= end) return;
                this.payload([...this.text.slice(begin, end)].map((one) => one.charCodeAt(0)));
                this.text = this.text.slice(end + 1);
            }
        }
        payload(payload) {
            if (payload[0] !== 0) board.received.push(payload);
            else if (payload.length === 1) this.source.enqueue(frame([0, ...word(hash, 4)]));
            else this.health();
        }
        /** The second device has failed, three times by its time running out. */
        health() {
            board.asked += 1;
            const devices = [0, 1, 2, 3].flatMap((at) => [at === 1 ? 3 : 1, ...word(7, 4), ...[0, 0, 0, at === 1 ? 3 : 0, 0, 0].flatMap((one) => word(one, 2))]);
            this.source.enqueue(frame([255, 1, ...word(61_000, 4), 4, 0, ...word(500, 4), ...word(2, 4), 17, ...word(900, 2), ...devices]));
        }
    }

    let port = new Port();
    let isThere = true;
    board.pull = () => {
        isThere = false;
        clearInterval(port.timer);
        port.readable = null;
        port.source.error(new DOMException("The device has been lost.", "NetworkError"));
        port.dispatchEvent(new Event("disconnect", { bubbles: true }));
    };
    /** The same port comes back, or another one of the same board. */
    board.plug = (isSame) => {
        isThere = true;
        if (!isSame) port = new Port();
        const event = new Event("connect");
        Object.defineProperty(event, "target", { value: port });
        serial.dispatchEvent(event);
    };
    serial.getPorts = async () => (isThere && board.isChosen ? [port] : []);
    serial.requestPort = async () => {
        if (refused !== null) throw new DOMException("No port selected by the user.", refused);
        board.isChosen = true;
        return port;
    };
    Object.defineProperty(navigator, "serial", { value: serial, configurable: true });
    window.board = board;
}
