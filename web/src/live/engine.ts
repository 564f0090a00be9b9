// What the worker's loop needs of a simulated board, whoever runs it.

import type { Seen, Tool } from "../../../crates/wasm/sensedsl.mjs";
import type { Answered, Design, Started } from "./messages.js";

/** The module goes on in steps, so that a slow machine is late by one of them at most. */
const STEP_MS = 20;

/** Runs a simulated board. A call that fails leaves it in an unknown state. */
export interface Engine {
    /** The most virtual time of one call. */
    readonly step_ms: number;
    robot(design: Design): Started | Promise<Started>;
    run(until_ms: number): Seen | Promise<Seen>;
    steer(device: string, element: number, shown: number | null): unknown;
    set(device: string, value: string): Answered | Promise<Answered>;
}

/** The module as what runs a board. */
export function engineOf(tool: Tool): Engine {
    const { robot, run, steer, set } = tool;
    return { step_ms: STEP_MS, robot, run, steer, set };
}
