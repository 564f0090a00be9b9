// The extension where there is Node: the server is the program, or else WebAssembly in a thread.

import { Worker } from "node:worker_threads";
import * as vscode from "vscode";
import {
    AbstractMessageReader,
    AbstractMessageWriter,
    type DataCallback,
    type Disposable,
    LanguageClient,
    type LanguageClientOptions,
    type Message,
} from "vscode-languageclient/node";
import { begin } from "./extension";
import { findProgram } from "./program";
import type { Started } from "./server";
import { registerTasks } from "./tasks";
import { registerTests } from "./tests";

export async function activate(context: vscode.ExtensionContext): Promise<void> {
    const server = await begin(context, async (options) => {
        const program = await findProgram();
        return program ? native(program, options) : threaded(context, options);
    });
    registerTasks(context, server);
    registerTests(context, server);
}

function native(program: string, options: LanguageClientOptions): Started {
    const client = new LanguageClient("sensedsl", "SenseDSL", { command: program, args: ["lsp"] }, options);
    return { client, name: program, program, end: () => undefined };
}

async function threaded(context: vscode.ExtensionContext, options: LanguageClientOptions): Promise<Started> {
    const worker = new Worker(context.asAbsolutePath("dist/worker.js"));
    const wasm = await vscode.workspace.fs.readFile(vscode.Uri.joinPath(context.extensionUri, "dist", "server.wasm"));
    worker.postMessage({ wasm });
    const talk = async () => ({ reader: new Reader(worker), writer: new Writer(worker) });
    const client = new LanguageClient("sensedsl", "SenseDSL", talk, options);
    return { client, name: "language server of the extension", end: () => void worker.terminate() };
}

class Reader extends AbstractMessageReader {
    constructor(private readonly worker: Worker) {
        super();
        worker.on("error", (error) => this.fireError(error));
        worker.on("exit", () => this.fireClose());
    }

    listen(callback: DataCallback): Disposable {
        this.worker.on("message", callback);
        return { dispose: () => this.worker.off("message", callback) };
    }
}

class Writer extends AbstractMessageWriter {
    constructor(private readonly worker: Worker) {
        super();
    }

    async write(message: Message): Promise<void> {
        this.worker.postMessage(message);
    }

    end(): void {
        // The thread is ended with the server.
    }
}
