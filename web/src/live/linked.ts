import type { Diagnostic, RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";
import { Caller } from "./caller.js";
import type { Answered, Design } from "./messages.js";
import type { Board, Closed, Link } from "./transport.js";

/** A host of a real board, in a worker that is ready before the link is. */
export class Host {
    constructor(
        readonly info: RobotInfo,
        readonly caller: Caller,
    ) {}

    /** Makes the host of a design; or tells why there is none. */
    static async of(
        design: Design,
        module: WebAssembly.Module,
    ): Promise<{ host: Host | null; diagnostics: Diagnostic[] }> {
        const caller = new Caller({ kind: "module", module });
        try {
            const { robot, diagnostics } = await caller.call("host", design);
            if (robot === null) caller.end();
            return { host: robot === null ? null : new Host(robot, caller), diagnostics };
        } catch (error) {
            caller.end();
            throw error;
        }
    }
}

/** A board at a link, with its host. */
export class LinkedBoard implements Board {
    onSeen: (seen: Seen, pace: number | null) => void = () => {};
    onOpened: () => void = () => {};
    onClosed: (closed: Closed) => void = () => {};
    readonly #caller: Caller;
    readonly #link: Link;
    readonly info: RobotInfo;

    constructor(host: Host, link: Link) {
        this.info = host.info;
        this.#caller = host.caller;
        this.#link = link;
        this.#caller.onSeen = (seen) => this.onSeen(seen, null);
        this.#caller.onSend = (bytes) => void link.write(bytes);
        this.#caller.onEnded = (error) => {
            void link.stop();
            this.onClosed({ text: `The host failed: ${error}`, help: "Connect again.", isWaiting: false });
        };
        link.onBytes = (bytes) => this.#caller.feed(bytes);
        link.onClosed = (closed) => this.onClosed(closed);
        link.onOpened = () => {
            // A host that has ended has already told so.
            this.#caller.call("opened", null).catch(() => {});
            this.onOpened();
        };
    }

    start(): Promise<void> {
        return this.#link.start();
    }

    set(device: string, value: string): Promise<Answered> {
        return this.#caller.call("set", { device, value });
    }

    async stop(): Promise<void> {
        this.#caller.end();
        await this.#link.stop();
    }
}
