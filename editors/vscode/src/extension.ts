// What the extension does in every host: the server, the wiring beside the text, commands.

import * as vscode from "vscode";
import { Preview } from "./preview";
import { LANGUAGE, Server, type Start } from "./server";

const TEXTS = "sensedsl-text";

/** Begins with everything that needs no program; the caller adds what does. */
export async function begin(context: vscode.ExtensionContext, start: Start): Promise<Server> {
    const texts = new Texts();
    const server = new Server(start, (title, text) => texts.show(title, text));
    const preview = new Preview(context.extensionUri, server);
    const command = (name: string, does: () => unknown) => vscode.commands.registerCommand(`sensedsl.${name}`, does);
    context.subscriptions.push(
        server,
        preview,
        vscode.workspace.registerTextDocumentContentProvider(TEXTS, texts),
        command("showWiring", () => preview.show()),
        command("restart", () => server.restart()),
        command("openExample", () => openExample(context.extensionUri)),
        vscode.workspace.onDidChangeConfiguration((change) => {
            if (change.affectsConfiguration("sensedsl.path")) void server.restart();
        }),
        vscode.window.onDidChangeActiveTextEditor((editor) => server.showBar(isOurs(editor))),
    );
    server.showBar(isOurs(vscode.window.activeTextEditor));
    await server.restart();
    return server;
}

export function isOurs(editor: vscode.TextEditor | undefined): editor is vscode.TextEditor {
    return editor?.document.languageId === LANGUAGE;
}

/** The example as a text of its own, so that it can be changed. */
async function openExample(extension: vscode.Uri): Promise<void> {
    const bytes = await vscode.workspace.fs.readFile(vscode.Uri.joinPath(extension, "dist", "line_follower.sense"));
    const content = new TextDecoder().decode(bytes);
    const document = await vscode.workspace.openTextDocument({ language: LANGUAGE, content });
    await vscode.window.showTextDocument(document);
}

/** Texts of the server that are only read. */
class Texts implements vscode.TextDocumentContentProvider {
    private readonly texts = new Map<string, string>();
    private readonly changed = new vscode.EventEmitter<vscode.Uri>();
    readonly onDidChange = this.changed.event;

    provideTextDocumentContent(uri: vscode.Uri): string {
        return this.texts.get(uri.toString()) ?? "";
    }

    async show(title: string, text: string): Promise<void> {
        const uri = vscode.Uri.from({ scheme: TEXTS, path: `/${title}.md` });
        this.texts.set(uri.toString(), text);
        this.changed.fire(uri);
        try {
            await vscode.commands.executeCommand("markdown.showPreviewToSide", uri);
        } catch {
            // Not every VS Code has it.
            await vscode.window.showTextDocument(uri, { viewColumn: vscode.ViewColumn.Beside, preview: true });
        }
    }
}
