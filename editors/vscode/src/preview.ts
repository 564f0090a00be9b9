// The wiring beside the text: which file is shown, what the view is told, what a click in it does.

import * as vscode from "vscode";
import { isOurs } from "./extension";
import { LANGUAGE, type Server } from "./server";
import type { ToEditor, ToView } from "./talk";

const VIEW = "sensedsl.wiring";
/** How long nothing may be typed before the picture is asked for. A search that ends earlier brings it sooner. */
const TYPED_MS = 600;
const SETTLED_MS = 30;
/** How long a part that was picked is marked in the text. */
const MARKED_MS = 1500;

interface Position {
    line: number;
    character: number;
}

interface Range {
    start: Position;
    end: Position;
}

/** The answer to `sensedsl/wiring`. */
interface Wiring {
    svg: string | null;
    is_current: boolean;
    parts: { name: string; range: Range; selection_range: Range }[];
}

export class Preview implements vscode.Disposable, vscode.WebviewPanelSerializer<{ uri?: string }> {
    private panel: vscode.WebviewPanel | undefined;
    private uri: vscode.Uri | undefined;
    private parts: Wiring["parts"] = [];
    private timer: ReturnType<typeof setTimeout> | undefined;
    private asked = 0;
    private readonly mark = vscode.window.createTextEditorDecorationType({
        backgroundColor: new vscode.ThemeColor("editor.rangeHighlightBackground"),
        isWholeLine: true,
    });
    private readonly disposables: vscode.Disposable[] = [this.mark];

    constructor(
        private readonly extension: vscode.Uri,
        private readonly server: Server,
    ) {
        this.disposables.push(
            vscode.window.registerWebviewPanelSerializer(VIEW, this),
            server.onSettled(() => this.later(SETTLED_MS)),
            server.onStarted(() => this.later(SETTLED_MS)),
            vscode.workspace.onDidChangeTextDocument(({ document }) => {
                if (document.languageId === LANGUAGE) this.later(TYPED_MS);
            }),
            vscode.window.onDidChangeActiveTextEditor((editor) => {
                if (isOurs(editor)) this.follow(editor.document.uri);
            }),
            vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.tellCursor(textEditor)),
        );
    }

    show(): void {
        const editor = vscode.window.activeTextEditor;
        if (isOurs(editor)) this.uri = editor.document.uri;
        if (this.panel) {
            this.panel.reveal(undefined, true);
            void this.refresh();
            return;
        }
        const place = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
        this.attach(vscode.window.createWebviewPanel(VIEW, "Wiring", place, {}));
    }

    async deserializeWebviewPanel(panel: vscode.WebviewPanel, state: { uri?: string } | undefined): Promise<void> {
        if (state?.uri) this.uri = vscode.Uri.parse(state.uri);
        this.attach(panel);
    }

    dispose(): void {
        clearTimeout(this.timer);
        this.panel?.dispose();
        for (const one of this.disposables) one.dispose();
    }

    private attach(panel: vscode.WebviewPanel): void {
        this.panel = panel;
        const dist = vscode.Uri.joinPath(this.extension, "dist");
        panel.iconPath = vscode.Uri.joinPath(this.extension, "media", "icon.png");
        panel.webview.options = { enableScripts: true, localResourceRoots: [dist] };
        panel.webview.onDidReceiveMessage((message: ToEditor) => {
            if (message.type === "ready") void this.refresh();
            else void this.pick(message.name, message.isByKey);
        });
        panel.onDidDispose(() => {
            this.panel = undefined;
        });
        panel.webview.html = page(panel.webview, dist);
    }

    private follow(uri: vscode.Uri): void {
        if (uri.toString() === this.uri?.toString()) return;
        this.uri = uri;
        this.later(SETTLED_MS);
    }

    private later(wait_ms: number): void {
        if (!this.panel) return;
        clearTimeout(this.timer);
        this.timer = setTimeout(() => void this.refresh(), wait_ms);
    }

    private async refresh(): Promise<void> {
        const { panel, uri } = this;
        const { client } = this.server;
        if (!panel || !uri || !client?.isRunning()) return;
        this.asked += 1;
        const mine = this.asked;
        const wiring = await client
            .sendRequest<Wiring | null>("sensedsl/wiring", { textDocument: { uri: client.code2ProtocolConverter.asUri(uri) } })
            .catch(() => null);
        if (mine !== this.asked || this.panel !== panel) return;
        const name = uri.path.split("/").pop() ?? "";
        this.parts = wiring?.parts ?? [];
        panel.title = `Wiring of ${name}`;
        const svg = wiring?.svg ?? null;
        const isCurrent = wiring?.is_current ?? false;
        const parts = this.parts.map((part) => part.name);
        // The picture may be of the text as it is, and yet leave out what is wrong.
        const why = firstError(uri);
        this.tell({ type: "wiring", uri: uri.toString(), name, svg, isCurrent, parts, why });
        const editor = vscode.window.visibleTextEditors.find((one) => one.document.uri.toString() === uri.toString());
        if (editor) this.tellCursor(editor);
    }

    /** Tells the view which parts the cursor is in. */
    private tellCursor(editor: vscode.TextEditor): void {
        if (editor.document.uri.toString() !== this.uri?.toString()) return;
        const at = editor.selection.active;
        const names = this.parts.filter(({ range }) => rangeOf(range).contains(at)).map(({ name }) => name);
        this.tell({ type: "cursor", names });
    }

    private tell(message: ToView): void {
        void this.panel?.webview.postMessage(message);
    }

    /** Goes to a part in the text. */
    private async pick(name: string, isByKey: boolean): Promise<void> {
        const part = this.parts.find((one) => one.name === name);
        if (!part || !this.uri) return;
        const { uri } = this;
        const open = vscode.window.visibleTextEditors.find((one) => one.document.uri.toString() === uri.toString());
        const viewColumn = open?.viewColumn ?? vscode.ViewColumn.One;
        const document = await vscode.workspace.openTextDocument(uri);
        // Who uses the keyboard stays in the picture, and goes on from there.
        const editor = await vscode.window.showTextDocument(document, { viewColumn, preserveFocus: isByKey });
        const range = rangeOf(part.range);
        const at = rangeOf(part.selection_range);
        editor.selection = new vscode.Selection(at.start, at.end);
        editor.revealRange(range, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
        editor.setDecorations(this.mark, [range]);
        setTimeout(() => editor.setDecorations(this.mark, []), MARKED_MS);
    }
}

function rangeOf({ start, end }: Range): vscode.Range {
    return new vscode.Range(start.line, start.character, end.line, end.character);
}

/** What hinders a wiring, as far as it is known. */
function firstError(uri: vscode.Uri): string | null {
    const errors = vscode.languages
        .getDiagnostics(uri)
        .filter((one) => one.severity === vscode.DiagnosticSeverity.Error)
        .sort((one, other) => one.range.start.compareTo(other.range.start));
    const first = errors[0];
    return first ? `Line ${first.range.start.line + 1}: ${first.message}` : null;
}

function page(webview: vscode.Webview, dist: vscode.Uri): string {
    const at = (name: string) => webview.asWebviewUri(vscode.Uri.joinPath(dist, name)).toString();
    const allowed = `default-src 'none'; script-src ${webview.cspSource}; style-src ${webview.cspSource}`;
    return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${allowed}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="stylesheet" href="${at("view.css")}">
<title>Wiring</title>
</head>
<body>
<div id="bar" role="toolbar" aria-label="Size">
<p id="why" role="status"></p>
<button id="less" title="Smaller" aria-label="Smaller">−</button>
<button id="fit" title="As wide as the view">Fit</button>
<button id="more" title="Larger" aria-label="Larger">+</button>
</div>
<main id="picture"><p id="empty">Looking for a wiring …</p></main>
<script src="${at("view.js")}"></script>
</body>
</html>`;
}
