// The language server in a worker: which files it knows, what it is asked, when it is started anew.
//
// A worker that searches for a wiring hears nothing. If something is typed meanwhile and the search has run for a while,
// the worker is ended, and another gets the same files; the module is compiled only once.

import { module } from "../tool";
import type { FromWorker, Problem, ToWorker, Wiring } from "../talk";

/** How long a search may go on after something newer was typed. */
const SEARCH_MS = 300;
/** How long nothing must be typed before a search that takes long is begun. */
const IDLE_MS = 200;
/** What takes long. */
const LONG_MS = 60;

/** What the language server tells without being asked. */
export interface Listener {
    problems(path: string, problems: Problem[]): void;
    /** The wiring of the file that is shown; `isNewest` unless something was typed since. */
    wiring(path: string, wiring: Wiring | null, isNewest: boolean): void;
    /** A search has begun or ended. */
    searching(isSearching: boolean): void;
    failed(why: string): void;
}

interface Waiting {
    resolve(value: unknown): void;
    reject(why: Error): void;
}

/** The URI of a path of the project. */
export function uriOf(path: string): string {
    return `file:///${path.split("/").map(encodeURIComponent).join("/")}`;
}

/** The path in the project of a URI. */
export function pathOf(uri: string): string {
    return decodeURIComponent(uri.replace(/^file:\/\/\/?/, ""));
}

function isDesign(path: string): boolean {
    return path.endsWith(".sense");
}

const CAPABILITIES = {
    textDocument: {
        completion: { completionItem: { snippetSupport: true, documentationFormat: ["markdown"] } },
        hover: { contentFormat: ["markdown"] },
        codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ["quickfix", "refactor", "source"] } } },
        publishDiagnostics: { relatedInformation: true, tagSupport: { valueSet: [1] } },
    },
};

/** The language server, with the texts that it knows. */
export class LanguageServer {
    private worker: Worker | undefined;
    private texts = new Map<string, { text: string; version: number }>();
    private waiting = new Map<number, Waiting>();
    private id = 0;
    private change = 0;
    private shown: string | null = null;
    private isBroken = false;
    private searching_since_ms: number | undefined;
    private search_ms = 0;
    private impatience: ReturnType<typeof setTimeout> | undefined;

    constructor(private readonly listener: Listener) {
        this.start();
    }

    /** Takes all texts of the project; those that are as before are not told again. */
    update(texts: Record<string, string>): void {
        const messages: object[] = [];
        const given: Record<string, string | null> = {};
        for (const path of [...this.texts.keys()].filter((path) => texts[path] === undefined)) {
            this.texts.delete(path);
            given[uriOf(path)] = null;
            if (isDesign(path)) messages.push(told("textDocument/didClose", { textDocument: { uri: uriOf(path) } }));
        }
        for (const [path, text] of Object.entries(texts)) {
            const known = this.texts.get(path);
            if (known?.text === text) continue;
            const version = (known?.version ?? 0) + 1;
            this.texts.set(path, { text, version });
            if (!isDesign(path)) given[uriOf(path)] = text;
            else if (known) messages.push(changed(path, version, text));
            else messages.push(opened(path, version, text));
        }
        if (Object.keys(given).length > 0) messages.unshift(told("sensedsl/files", { files: given }));
        if (messages.length === 0) return;
        this.change += 1;
        if (this.isBroken) {
            this.start();
            return;
        }
        const wait_ms = this.search_ms > LONG_MS ? IDLE_MS : 0;
        this.send({ type: "change", messages, change: this.change, wait_ms });
        this.lose();
    }

    /** Says which file's wiring is wanted from now on. */
    show(path: string): void {
        if (path === this.shown) return;
        this.shown = path;
        this.send({ type: "show", uri: uriOf(path) });
    }

    /** Asks something about a file. */
    ask<T>(method: string, path: string, params: object = {}): Promise<T> {
        return this.request(method, { textDocument: { uri: uriOf(path) }, ...params });
    }

    /** Asks something. */
    request<T>(method: string, params: object): Promise<T> {
        this.id += 1;
        const { id } = this;
        return new Promise<T>((resolve, reject) => {
            this.waiting.set(id, { resolve: (value) => resolve(value as T), reject });
            this.send({ type: "language", message: { jsonrpc: "2.0", id, method, params } });
        });
    }

    /** Ends a search that something newer waits for, soon. */
    private lose(): void {
        if (this.searching_since_ms === undefined || this.impatience !== undefined) return;
        const left_ms = this.searching_since_ms + SEARCH_MS - performance.now();
        this.impatience = setTimeout(() => this.start(), Math.max(0, left_ms));
    }

    private start(): void {
        clearTimeout(this.impatience);
        this.impatience = undefined;
        if (this.searching_since_ms !== undefined) this.search_ms = SEARCH_MS;
        this.isBroken = false;
        this.searching_since_ms = undefined;
        this.worker?.terminate();
        for (const one of this.waiting.values()) one.reject(new Error("the language server was started anew"));
        this.waiting.clear();
        const worker = new Worker(WORKER_URL);
        this.worker = worker;
        worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
            if (worker === this.worker) this.take(data);
        };
        worker.onerror = (event) => this.fail(worker, event.message);
        module().then(
            (compiled) => worker.postMessage({ type: "module", module: compiled } satisfies ToWorker),
            (why: unknown) => this.fail(worker, String(why)),
        );
        this.send({ type: "language", message: { jsonrpc: "2.0", id: 0, method: "initialize", params: { capabilities: CAPABILITIES } } });
        const messages = [told("initialized", {}), ...this.known()];
        if (this.shown !== null) this.send({ type: "show", uri: uriOf(this.shown) });
        const wait_ms = this.search_ms > LONG_MS ? IDLE_MS : 0;
        if (this.texts.size > 0) this.send({ type: "change", messages, change: this.change, wait_ms });
    }

    /** A worker that has failed is replaced once there is another text: with the same one it would fail again. */
    private fail(worker: Worker, why: string): void {
        if (worker !== this.worker) return;
        this.isBroken = true;
        this.listener.searching(false);
        this.listener.failed(why);
    }

    /** The texts of all files, as a new server is told them. */
    private known(): object[] {
        const all = [...this.texts];
        const given = all.filter(([path]) => !isDesign(path)).map(([path, { text }]) => [uriOf(path), text]);
        const open = all.filter(([path]) => isDesign(path)).map(([path, { text, version }]) => opened(path, version, text));
        return [told("sensedsl/files", { files: Object.fromEntries(given) }), ...open];
    }

    private send(message: ToWorker): void {
        this.worker?.postMessage(message);
    }

    private take(message: FromWorker): void {
        switch (message.type) {
            case "language":
                this.hear(message.message as Heard);
                break;
            case "searching":
                this.searching_since_ms = performance.now();
                this.listener.searching(true);
                break;
            case "settled":
                this.settled(message);
                break;
            case "ready":
            case "answer":
        }
    }

    private settled({ messages, uri, wiring, change, took_ms }: FromWorker & { type: "settled" }): void {
        this.searching_since_ms = undefined;
        clearTimeout(this.impatience);
        this.impatience = undefined;
        if (took_ms > 0) this.search_ms = took_ms;
        this.listener.searching(false);
        for (const one of messages) this.hear(one as Heard);
        if (uri !== null && pathOf(uri) === this.shown) {
            this.listener.wiring(this.shown, wiring as Wiring | null, change === this.change);
        }
    }

    private hear({ id, method, params, result, error }: Heard): void {
        if (method === "textDocument/publishDiagnostics" && params) {
            this.listener.problems(pathOf(params.uri), params.diagnostics);
        }
        const one = id === undefined ? undefined : this.waiting.get(id);
        if (id === undefined || !one) return;
        this.waiting.delete(id);
        if (error) one.reject(new Error(error.message));
        else one.resolve(result);
    }
}

interface Heard {
    id?: number;
    method?: string;
    params?: { uri: string; diagnostics: Problem[] };
    result?: unknown;
    error?: { message: string };
}

function told(method: string, params: object): object {
    return { jsonrpc: "2.0", method, params };
}

function opened(path: string, version: number, text: string): object {
    return told("textDocument/didOpen", { textDocument: { uri: uriOf(path), languageId: "sensedsl", version, text } });
}

function changed(path: string, version: number, text: string): object {
    const textDocument = { uri: uriOf(path), version };
    return told("textDocument/didChange", { textDocument, contentChanges: [{ text }] });
}
