// The language server as WebAssembly, in a worker of a page or a thread of Node: messages in, messages out.
//
// The first message is `{ wasm }`, the module's bytes; all others are those of the protocol. A message is answered as it
// comes. Wirings are looked for once none has come for a moment, as a search runs to its end.

import { load } from "../../../crates/wasm/sensedsl.mjs";

const IDLE_MS = 50;

interface Port {
    postMessage(message: unknown): void;
}

let server: Awaited<ReturnType<typeof load>> | undefined;
let waiting: object[] = [];
let idle: ReturnType<typeof setTimeout> | undefined;

function send(port: Port, messages: unknown[]): void {
    for (const message of messages) port.postMessage(message);
}

function answer(port: Port, message: object): void {
    if (!server) return;
    send(port, server.message(message));
    clearTimeout(idle);
    idle = setTimeout(() => {
        if (server) send(port, server.settle());
    }, IDLE_MS);
}

async function take(port: Port, message: object): Promise<void> {
    if (!("wasm" in message)) {
        if (server) answer(port, message);
        else waiting.push(message);
        return;
    }
    server = await load(message.wasm as BufferSource);
    for (const one of waiting) answer(port, one);
    waiting = [];
}

// A page's worker is its own port.
if (typeof self === "undefined" || typeof self.postMessage !== "function") {
    const { parentPort } = require("node:worker_threads") as typeof import("node:worker_threads");
    parentPort?.on("message", (message: object) => void take(parentPort, message));
} else {
    const port: Port = { postMessage: (message) => self.postMessage(message) };
    self.onmessage = (event: MessageEvent<object>) => void take(port, event.data);
}
