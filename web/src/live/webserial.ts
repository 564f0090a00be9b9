/** The part of the Web Serial API that is used here; TypeScript's library does not have it yet. */

export interface SerialPort extends EventTarget {
    readonly readable: ReadableStream<Uint8Array<ArrayBuffer>> | null;
    readonly writable: WritableStream<Uint8Array> | null;
    getInfo(): { usbVendorId?: number; usbProductId?: number };
    open(options: { baudRate: number; bufferSize?: number }): Promise<void>;
    close(): Promise<void>;
}

export interface Serial extends EventTarget {
    getPorts(): Promise<SerialPort[]>;
    requestPort(): Promise<SerialPort>;
}

/** The browser's Web Serial; null where there is none. */
export function webSerial(): Serial | null {
    return (navigator as { serial?: Serial }).serial ?? null;
}

/** Why there is no Web Serial, and what helps. */
export function missing(): { text: string; help: string } {
    if (!window.isSecureContext) {
        return {
            text: "This page may not use serial ports, because it did not come over a secure connection.",
            help: "Open it over https, or from localhost.",
        };
    }
    return {
        text: "This browser cannot use serial ports: it has no Web Serial.",
        help: "Chrome, Edge and Opera on a computer have it. Everywhere else, “sensedsl monitor” shows the same in a terminal.",
    };
}

/** A name for people: USB vendor and product in the four digits that system tools print. */
export function portName(port: SerialPort): string {
    const { usbVendorId, usbProductId } = port.getInfo();
    if (usbVendorId === undefined) return "serial port";
    const digits = (number: number | undefined) => (number ?? 0).toString(16).padStart(4, "0");
    return `USB ${digits(usbVendorId)}:${digits(usbProductId)}`;
}
