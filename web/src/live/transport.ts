/** What stands between a panel and a board, whatever the board is. */

import type { RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";
import type { Answered } from "./messages.js";

/** Why nothing comes any more. */
export interface Closed {
    /** What happened. */
    text: string;
    /** What helps; empty if nothing does. */
    help: string;
    /** Whether it is opened again as soon as the board is back. */
    isWaiting: boolean;
}

/** A link that carries bytes: Web Serial, or what stands for it. */
export interface Link {
    /** Opens it. A failure is told by {@link Refused}. */
    start(): Promise<void>;
    /** Sends bytes; those that cannot be sent are lost, as on a cable. */
    write(bytes: Uint8Array): Promise<void>;
    /** Closes it for good. */
    stop(): Promise<void>;
    /** It is open, for the first time or again. */
    onOpened: () => void;
    /** Bytes came. */
    onBytes: (bytes: Uint8Array<ArrayBuffer>) => void;
    /** Nothing comes any more. */
    onClosed: (closed: Closed) => void;
}

/** A board with the host that understands it, simulated or real. */
export interface Board {
    readonly info: RobotInfo;
    /** What a host has seen, and for a simulated board how many times as fast as real time it goes. */
    onSeen: (seen: Seen, pace: number | null) => void;
    onOpened: () => void;
    onClosed: (closed: Closed) => void;
    /** Begins to run it, or opens its link. */
    start(): Promise<void>;
    /** Sets an actuator to a value as people write it. */
    set(device: string, value: string): Promise<Answered>;
    /** Ends it for good and frees what it holds. */
    stop(): Promise<void>;
}

/** A failure that people can do something about. */
export class Refused extends Error {
    constructor(
        message: string,
        readonly help: string,
    ) {
        super(message);
    }
}
