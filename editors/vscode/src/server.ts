// The language server that runs: how it is started, what it is, the files that it asks for.

import * as vscode from "vscode";
import type { BaseLanguageClient, LanguageClientOptions } from "vscode-languageclient";

export const LANGUAGE = "sensedsl";

/** A server that was started. */
export interface Started {
    client: BaseLanguageClient;
    /** What people are told of it. */
    name: string;
    /** The program, where it is one on this machine. */
    program?: string;
    /** Ends what the client does not end. */
    end(): void;
}

/** What starts a server: the two hosts of extensions have different ones. */
export type Start = (options: LanguageClientOptions) => Promise<Started>;

export class Server implements vscode.Disposable {
    private started: Started | undefined;
    private readonly status: vscode.LanguageStatusItem;
    private readonly bar: vscode.StatusBarItem;
    private readonly channel = vscode.window.createOutputChannel("SenseDSL", { log: true });
    private readonly watcher = vscode.workspace.createFileSystemWatcher("**/*.{sense,csv,toml}");
    private readonly settledEmitter = new vscode.EventEmitter<void>();
    private readonly startedEmitter = new vscode.EventEmitter<void>();
    /** By URI as the editor writes it: the URI as the server does, of each file that it has asked for. */
    private readonly wanted = new Map<string, string>();

    /** The diagnostics of a file were told. */
    readonly onSettled = this.settledEmitter.event;
    /** There is a server, perhaps another one. */
    readonly onStarted = this.startedEmitter.event;

    constructor(
        private readonly start: Start,
        private readonly show: (title: string, text: string) => Promise<void>,
    ) {
        this.status = vscode.languages.createLanguageStatusItem("sensedsl.server", { language: LANGUAGE });
        this.status.name = "SenseDSL";
        this.status.command = { command: "sensedsl.restart", title: "Restart" };
        this.bar = vscode.window.createStatusBarItem("sensedsl.server", vscode.StatusBarAlignment.Right, 90);
        this.bar.name = "SenseDSL";
        this.bar.command = "sensedsl.restart";
        const changed = (uri: vscode.Uri) => void this.again(uri);
        this.watcher.onDidChange(changed);
        this.watcher.onDidCreate(changed);
        this.watcher.onDidDelete(changed);
    }

    get client(): BaseLanguageClient | undefined {
        return this.started?.client;
    }

    get program(): string | undefined {
        return this.started?.program;
    }

    async restart(): Promise<void> {
        this.say("$(sync~spin) SenseDSL", "is starting", false);
        await this.stop();
        this.wanted.clear();
        try {
            const started = await this.start(this.options());
            this.started = started;
            started.client.onNotification("sensedsl/wanted", ({ uris }: { uris: string[] }) => this.give(uris));
            await started.client.start();
            const version = started.client.initializeResult?.serverInfo?.version ?? "";
            this.say("$(circuit-board) SenseDSL", `${started.name}, version ${version}`, false);
        } catch (error) {
            const why = error instanceof Error ? error.message : String(error);
            this.channel.error(why);
            this.say("$(error) SenseDSL", why, true);
            void vscode.window.showErrorMessage(`The language server of SenseDSL did not start: ${why}`);
        }
        this.startedEmitter.fire();
    }

    async stop(): Promise<void> {
        const { started } = this;
        this.started = undefined;
        // It may have died by itself.
        await started?.client.dispose().catch(() => undefined);
        started?.end();
    }

    dispose(): void {
        void this.stop();
        for (const one of [this.status, this.bar, this.channel, this.watcher, this.settledEmitter, this.startedEmitter]) {
            one.dispose();
        }
    }

    /** Shows the item while a file of the language is there to be edited. */
    showBar(isShown: boolean): void {
        if (isShown) this.bar.show();
        else this.bar.hide();
    }

    private say(text: string, detail: string, isWrong: boolean): void {
        this.status.text = "Language server";
        this.status.detail = detail;
        this.status.severity = isWrong ? vscode.LanguageStatusSeverity.Error : vscode.LanguageStatusSeverity.Information;
        this.bar.text = text;
        this.bar.tooltip = `SenseDSL: ${detail}\nClick to restart`;
        this.bar.accessibilityInformation = { label: `SenseDSL: ${detail}. Restart` };
    }

    private options(): LanguageClientOptions {
        return {
            documentSelector: [{ language: LANGUAGE }],
            outputChannel: this.channel,
            synchronize: { fileEvents: this.watcher },
            middleware: {
                handleDiagnostics: (uri, diagnostics, next) => {
                    next(uri, diagnostics);
                    this.settledEmitter.fire();
                },
                // The commands of the server's code lenses answer with a text.
                executeCommand: async (command, args, next) => {
                    const text: unknown = await next(command, args);
                    const isRoom = command === "sensedsl.capacity";
                    const title = `${isRoom ? "Room left on" : "Why"} ${String(args[1])}`;
                    // The reasons are columns, which Markdown would run together.
                    if (typeof text === "string") await this.show(title, isRoom ? text : `\`\`\`text\n${text.trimEnd()}\n\`\`\`\n`);
                    return text;
                },
            },
        };
    }

    /** Gives the server the texts that it has asked for. */
    private async give(uris: string[]): Promise<void> {
        const files: Record<string, string | null> = {};
        for (const uri of uris) {
            const at = vscode.Uri.parse(uri);
            this.wanted.set(at.toString(), uri);
            files[uri] = await textOf(at);
        }
        await this.client?.sendNotification("sensedsl/files", { files });
    }

    /** Gives the server a file again that it has asked for. */
    private async again(uri: vscode.Uri): Promise<void> {
        const asked = this.wanted.get(uri.toString());
        if (asked) await this.give([asked]);
    }
}

async function textOf(uri: vscode.Uri): Promise<string | null> {
    try {
        return new TextDecoder().decode(await vscode.workspace.fs.readFile(uri));
    } catch {
        return null;
    }
}
