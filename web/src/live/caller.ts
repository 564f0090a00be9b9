import type { Seen } from "../../../crates/wasm/sensedsl.mjs";
import type { Calls, FromWorker, Runner, ToWorker } from "./messages.js";
import { endServed } from "./served.js";

/** Where the worker's program is, as the build names it. */
declare const LIVE_WORKER_URL: string;

/** A worker that has a board, and calls of it. */
export class Caller {
    readonly #worker = new Worker(LIVE_WORKER_URL);
    readonly #asked = new Map<number, { done: (answer: never) => void; failed: (error: Error) => void }>();
    readonly #runner: Runner;
    #next = 0;
    #isEnded = false;

    onSeen: (seen: Seen, pace: number | null) => void = () => {};
    onSend: (bytes: Uint8Array<ArrayBuffer>) => void = () => {};
    /** The tool has failed; the worker does nothing more. */
    onEnded: (error: string) => void = () => {};

    constructor(runner: Runner) {
        this.#runner = runner;
        this.#worker.addEventListener("message", ({ data }: MessageEvent<FromWorker>) => this.#take(data));
        this.#worker.addEventListener("error", (event) => this.#fail(event.message || "the worker cannot be started"));
        this.#post(runner);
        if (runner.kind === "server") addEventListener("pagehide", this.#left);
    }

    /** The page is left: the server need not wait until nobody has called for long. */
    readonly #left = (): void => this.end();

    /** Asks the worker for something. */
    call<Name extends keyof Calls>(name: Name, given: Calls[Name]["given"]): Promise<Calls[Name]["answer"]> {
        if (this.#isEnded) return Promise.reject(new Error("the board has ended"));
        const id = this.#next++;
        return new Promise((done, failed) => {
            this.#asked.set(id, { done, failed });
            this.#post({ kind: "call", id, name, given } as ToWorker);
        });
    }

    /** Gives it bytes of a link. */
    feed(bytes: Uint8Array<ArrayBuffer>): void {
        if (!this.#isEnded) this.#worker.postMessage({ kind: "bytes", bytes } satisfies ToWorker, [bytes.buffer]);
    }

    /** Ends the worker and the server's board, and frees their memory. */
    end(): void {
        if (this.#isEnded) return;
        this.#isEnded = true;
        this.#worker.terminate();
        if (this.#runner.kind === "server") {
            removeEventListener("pagehide", this.#left);
            endServed(this.#runner.served);
        }
        for (const { failed } of this.#asked.values()) failed(new Error("the board has ended"));
        this.#asked.clear();
    }

    #post(message: ToWorker): void {
        this.#worker.postMessage(message);
    }

    #fail(error: string): void {
        if (this.#isEnded) return;
        this.end();
        this.onEnded(error);
    }

    #take(message: FromWorker): void {
        // What was under way when the worker was ended is nobody's.
        if (this.#isEnded) return;
        switch (message.kind) {
            case "answer":
                this.#asked.get(message.id)?.done(message.answer as never);
                this.#asked.delete(message.id);
                break;
            case "refused":
                this.#asked.get(message.id)?.failed(new Error(message.error));
                this.#asked.delete(message.id);
                break;
            case "seen":
                this.#post({ kind: "taken" });
                this.onSeen(message.seen, message.pace);
                break;
            case "send":
                this.onSend(message.bytes);
                break;
            case "ended":
                this.#fail(message.error);
                break;
        }
    }
}
