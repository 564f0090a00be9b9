// Calls of a board that the page's server runs, which has a compiler for the code of its controllers: requests out, the
// answers of the module in.

import type { Seen } from "../../../crates/wasm/sensedsl.mjs";
import type { Engine } from "./engine.js";
import type { Answered, Design, Served, Started } from "./messages.js";

/** Longer than the module's: a request takes some time, however little it asks for. */
const STEP_MS = 20;

function place({ board }: Served): string {
    return `/api/boards/${encodeURIComponent(board)}`;
}

function headers({ token }: Served): Record<string, string> {
    return { "X-Sensedsl-Token": token };
}

/** A board of the server. */
export class ServedBoard implements Engine {
    readonly step_ms = STEP_MS;

    constructor(readonly served: Served) {}

    robot({ path, files, board, name, world }: Design): Promise<Started> {
        return this.#call({ do: "robot", of: { path, files, board }, name, world });
    }

    async run(until_ms: number): Promise<Seen> {
        const seen = await this.#call<Seen | { error: string }>({ do: "run", until_ms });
        if ("error" in seen) throw new Error(seen.error);
        return seen;
    }

    steer(device: string, element: number, shown: number | null): Promise<unknown> {
        return this.#call({ do: "steer", device, element, shown });
    }

    set(device: string, value: string): Promise<Answered> {
        return this.#call({ do: "set", device, value });
    }

    async #call<Answer>(call: object): Promise<Answer> {
        const request = { method: "POST", headers: headers(this.served), body: JSON.stringify(call) };
        const response = await fetch(place(this.served), request).catch(() => {
            throw new Error("the server does not answer; does “sensedsl studio” still run?");
        });
        if (response.status === 410) throw new Error("the server has ended the board");
        if (!response.ok) throw new Error(await reason(response));
        return (await response.json()) as Answer;
    }
}

/** Why the server has refused a call. */
async function reason(response: Response): Promise<string> {
    const { status, statusText } = response;
    const told = (await response.json().catch(() => null)) as { error?: unknown } | null;
    return typeof told?.error === "string" ? told.error : `${status} ${statusText}`;
}

/** Ends a board of the server; the request outlives the page. */
export function endServed(served: Served): void {
    // A server that is gone has ended the board as well.
    fetch(place(served), { method: "DELETE", headers: headers(served), keepalive: true }).catch(() => {});
}
