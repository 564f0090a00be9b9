// The tool and its language server, in a worker: a search runs to its end, and the page must not wait for it.
//
// The first message is `{ type: "module" }`, the compiled module. The language server is given its messages as they come;
// once none waits it looks for wirings, and the picture of the file that is shown goes along with what it found. A worker
// that searches cannot listen: the page ends it and starts another if it has something newer.

import { load, type Tool } from "../../crates/wasm/sensedsl.mjs";
import type { FromWorker, ToWorker } from "./talk";

let tool: Tool | undefined;
let waiting: ToWorker[] = [];
let timer: ReturnType<typeof setTimeout> | undefined;
let isWaiting = false;
let shown: string | null = null;
let change = 0;
let request = 0;

function tell(message: FromWorker): void {
    postMessage(message);
}

function language(of: Tool, message: object): void {
    for (const answer of of.message(message)) tell({ type: "language", message: answer });
}

/** The answer to `sensedsl/wiring` for the file that is shown. */
function wiring(of: Tool): unknown {
    if (shown === null) return null;
    request += 1;
    const params = { textDocument: { uri: shown } };
    const [answer] = of.message({ jsonrpc: "2.0", id: `wiring ${request}`, method: "sensedsl/wiring", params });
    return (answer as { result?: unknown } | undefined)?.result ?? null;
}

function settle(of: Tool): void {
    isWaiting = false;
    tell({ type: "searching" });
    const started_ms = performance.now();
    const messages = of.settle();
    tell({ type: "settled", messages, uri: shown, wiring: wiring(of), change, took_ms: performance.now() - started_ms });
}

function take(of: Tool, message: ToWorker): void {
    switch (message.type) {
        case "module":
            return;
        case "language":
            language(of, message.message);
            break;
        case "change":
            for (const one of message.messages) language(of, one);
            change = message.change;
            clearTimeout(timer);
            isWaiting = true;
            timer = setTimeout(() => settle(of), message.wait_ms);
            break;
        case "show":
            shown = message.uri;
            // A search comes anyway, and has it then.
            if (isWaiting) return;
            tell({ type: "settled", messages: [], uri: shown, wiring: wiring(of), change, took_ms: 0 });
            break;
        case "call":
            void call(of, message);
    }
}

/** The texts of generated projects, which `build.mjs` has taken out of the module. */
let texts: Promise<void> | undefined;

async function fill(of: Tool): Promise<void> {
    const response = await fetch(TEXTS_URL);
    if (!response.ok) throw new Error(`${TEXTS_URL}: ${response.status} ${response.statusText}`);
    of.fill(new Uint8Array(await response.arrayBuffer()));
}

async function call(of: Tool, { id, name, args }: ToWorker & { type: "call" }): Promise<void> {
    try {
        if (name === "project") {
            texts ??= fill(of);
            await texts.catch((why: unknown) => {
                // The next call tries again.
                texts = undefined;
                throw why;
            });
        }
        const value: unknown = name === "ask" ? of(args[0] as never) : (of[name] as (...args: unknown[]) => unknown)(...args);
        tell({ type: "answer", id, value });
    } catch (why) {
        tell({ type: "answer", id, error: String(why) });
    }
}

onmessage = async ({ data }: MessageEvent<ToWorker>) => {
    if (data.type !== "module") {
        if (tool) take(tool, data);
        else waiting.push(data);
        return;
    }
    const started = await load(data.module);
    tool = started;
    tell({ type: "ready" });
    const all = waiting;
    waiting = [];
    for (const one of all) take(started, one);
};
