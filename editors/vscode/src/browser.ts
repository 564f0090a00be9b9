// The extension where there is no Node: the server is WebAssembly in a worker.

import * as vscode from "vscode";
import { LanguageClient } from "vscode-languageclient/browser";
import { begin } from "./extension";

export async function activate(context: vscode.ExtensionContext): Promise<void> {
    const read = (name: string) => vscode.workspace.fs.readFile(vscode.Uri.joinPath(context.extensionUri, "dist", name));
    await begin(context, async (options) => {
        const [code, wasm] = await Promise.all([read("worker.js"), read("server.wasm")]);
        // Workers are not made from files of an extension that is elsewhere.
        const url = URL.createObjectURL(new Blob([new Uint8Array(code)], { type: "text/javascript" }));
        const worker = new Worker(url);
        worker.postMessage({ wasm });
        const client = new LanguageClient("sensedsl", "SenseDSL", worker, options);
        return {
            client,
            name: "language server of the extension, in the browser",
            end: () => {
                worker.terminate();
                URL.revokeObjectURL(url);
            },
        };
    });
}
