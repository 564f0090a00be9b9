// The tool in a worker of its own, for what may take long: reports, projects, places. The language server never waits for it.

import type { Answers, Call, FromWorker, ToWorker } from "./talk";

interface Waiting {
    id: number;
    name: Call;
    args: unknown[];
    resolve(value: never): void;
    reject(why: Error): void;
}

/** An answer that is not wanted any more. */
export class Superseded extends Error {}

let compiled: Promise<WebAssembly.Module> | undefined;

async function compile(): Promise<WebAssembly.Module> {
    const response = await fetch(WASM_URL);
    if (!response.ok) throw new Error(`${WASM_URL}: ${response.status} ${response.statusText}`);
    const isStreamed = response.headers.get("content-type") === "application/wasm";
    return isStreamed ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** The compiled module; it is fetched once. */
export function module(): Promise<WebAssembly.Module> {
    compiled ??= compile();
    return compiled;
}

/** Why the tool did not understand a request; `pin` says in the same way why it cannot write a text. */
function refused(value: unknown): string | undefined {
    const answer = value as { error?: unknown; files?: unknown } | null | undefined;
    return typeof answer?.error === "string" && answer.files === undefined ? answer.error : undefined;
}

/** A worker with the tool, started when it is first called. */
export class ToolWorker {
    private worker: Worker | undefined;
    private waiting: Waiting[] = [];
    private id = 0;
    private topics = new Map<string, number>();

    /**
     * Calls a function of the tool. A later call of the same topic takes the place of this one, which is refused with
     * [`Superseded`]: a search that runs for it is ended.
     */
    call<Name extends Call>(name: Name, args: unknown[], topic?: string): Promise<Answers[Name]> {
        this.id += 1;
        const { id } = this;
        if (topic !== undefined) {
            this.drop(this.topics.get(topic));
            this.topics.set(topic, id);
        }
        return new Promise((resolve, reject) => {
            this.waiting.push({ id, name, args, resolve, reject });
            this.send({ type: "call", id, name, args });
        });
    }

    private drop(id: number | undefined): void {
        const at = this.waiting.findIndex((one) => one.id === id);
        const [old] = at < 0 ? [] : this.waiting.splice(at, 1);
        if (!old) return;
        old.reject(new Superseded());
        this.again();
    }

    /** Ends the worker; another one does what is left. */
    private again(): void {
        this.worker?.terminate();
        this.worker = undefined;
        for (const { id, name, args } of this.waiting) this.send({ type: "call", id, name, args });
    }

    private send(message: ToWorker): void {
        this.worker ??= this.start();
        this.worker.postMessage(message);
    }

    /** Ends the worker; a later call starts another. */
    end(): void {
        this.worker?.terminate();
        this.worker = undefined;
    }

    private start(): Worker {
        const worker = new Worker(WORKER_URL);
        worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
            if (data.type === "answer") this.take(data);
        };
        worker.onerror = (event) => this.fail(worker, event.message);
        module().then(
            (compiled) => worker.postMessage({ type: "module", module: compiled } satisfies ToWorker),
            (why: unknown) => this.fail(worker, String(why)),
        );
        return worker;
    }

    private take({ id, value, error: failed }: FromWorker & { type: "answer" }): void {
        const error = failed ?? refused(value);
        const at = this.waiting.findIndex((one) => one.id === id);
        const [one] = at < 0 ? [] : this.waiting.splice(at, 1);
        if (error === undefined) {
            one?.resolve(value as never);
            return;
        }
        one?.reject(new Error(error));
        // What has failed inside may be left half done.
        this.again();
    }

    private fail(worker: Worker, why: string): void {
        if (worker !== this.worker) return;
        worker.terminate();
        this.worker = undefined;
        for (const one of this.waiting.splice(0)) one.reject(new Error(why));
    }
}
