import type { Diagnostic, RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";
import { Caller } from "./caller.js";
import type { Answered, Design, Runner } from "./messages.js";
import type { Board, Closed } from "./transport.js";

/** A board in a simulated world, in a worker or at the page's server. */
export class SimulatedBoard implements Board {
    onSeen: (seen: Seen, pace: number | null) => void = () => {};
    onOpened: () => void = () => {};
    onClosed: (closed: Closed) => void = () => {};
    readonly #caller: Caller;
    #pace = 1;
    #isPaused = false;

    private constructor(
        readonly info: RobotInfo,
        caller: Caller,
    ) {
        this.#caller = caller;
        caller.onSeen = (seen, pace) => this.onSeen(seen, pace);
        caller.onEnded = (error) =>
            this.onClosed({ text: `The simulation failed: ${/[.?!]$/.test(error) ? error : `${error}.`}`, help: "Start it again.", isWaiting: false });
    }

    /** Makes the board of a design, which does not run yet; or tells why there is none. */
    static async of(
        design: Design,
        runner: Runner,
        signal: AbortSignal,
    ): Promise<{ board: SimulatedBoard | null; diagnostics: Diagnostic[] }> {
        const caller = new Caller(runner);
        const end = () => caller.end();
        signal.addEventListener("abort", end);
        try {
            const { robot, diagnostics } = await caller.call("robot", design);
            if (robot === null) caller.end();
            return { board: robot === null ? null : new SimulatedBoard(robot, caller), diagnostics };
        } catch (error) {
            caller.end();
            throw error;
        } finally {
            signal.removeEventListener("abort", end);
        }
    }

    async start(): Promise<void> {
        await this.#go();
        this.onOpened();
    }

    set(device: string, value: string): Promise<Answered> {
        return this.#caller.call("set", { device, value });
    }

    async stop(): Promise<void> {
        this.#caller.end();
    }

    /** Holds an element of a sensor at a shown value; null lets the world have it again. */
    async steer(device: string, element: number, shown: number | null): Promise<void> {
        await this.#caller.call("steer", { device, element, shown });
    }

    get isPaused(): boolean {
        return this.#isPaused;
    }

    /** Stops time, or lets it go on. */
    async pause(isPaused: boolean): Promise<void> {
        this.#isPaused = isPaused;
        await this.#go();
    }

    /** How many times as fast as real time it is to go. */
    get pace(): number {
        return this.#pace;
    }

    async setPace(pace: number): Promise<void> {
        this.#pace = pace;
        await this.#go();
    }

    async #go(): Promise<void> {
        await this.#caller.call("pace", this.#isPaused ? 0 : this.#pace);
    }
}
