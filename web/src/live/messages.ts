/** What the panels and the worker of a board say to each other. */

import type { Diagnostic, RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";

/** A design, and which board of it. */
export interface Design {
    path: string;
    files: Record<string, string>;
    /** What takes the place of the board that the text names. */
    board?: string;
    /** Which of the design's boards; the first unless given. */
    name?: string;
    /** Which of the files is its world; the usual one unless given. */
    world?: string;
}

/** A board that the page's server runs. */
export interface Served {
    /** The secret that the server has put into the page. */
    token: string;
    /** What the server is to call the board: a name that no other has. */
    board: string;
}

/** What runs a board: the module in a worker, or the page's server. */
export type Runner = { kind: "module"; module: WebAssembly.Module } | { kind: "server"; served: Served };

/** The answer to a design: a board, or why there is none. */
export interface Started {
    diagnostics: Diagnostic[];
    robot: RobotInfo | null;
}

/** The answer to a value for an actuator. */
export interface Answered {
    /** Why it was not sent. */
    error: string | null;
    /** What was sent. */
    text: string | null;
}

/** What the worker can be asked for, and what it answers. */
export interface Calls {
    /** Starts a simulated board. */
    robot: { given: Design; answer: Started };
    /** Makes a host for a real board. */
    host: { given: Design; answer: Started };
    /** So many times as fast as real time; 0 is a pause. */
    pace: { given: number; answer: null };
    /** Holds an element of a sensor at a value, or lets the world have it again. */
    steer: { given: { device: string; element: number; shown: number | null }; answer: null };
    /** Sets an actuator. */
    set: { given: { device: string; value: string }; answer: Answered };
    /** The link to the real board is open. */
    opened: { given: null; answer: null };
}

/** A message to the worker. */
export type ToWorker =
    | Runner
    | { [Name in keyof Calls]: { kind: "call"; id: number; name: Name; given: Calls[Name]["given"] } }[keyof Calls]
    | { kind: "bytes"; bytes: Uint8Array<ArrayBuffer> }
    | { kind: "taken" };

/** A message from the worker. */
export type FromWorker =
    | { kind: "answer"; id: number; answer: unknown }
    | { kind: "refused"; id: number; error: string }
    | { kind: "seen"; seen: Seen; pace: number | null }
    | { kind: "send"; bytes: Uint8Array<ArrayBuffer> }
    | { kind: "ended"; error: string };
