// Completion and hover: what the language server offers at a place, as the editor shows it.

import { snippet, type Completion, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import type { EditorView } from "@codemirror/view";
import { hoverTooltip } from "@codemirror/view";
import type { Extension } from "@codemirror/state";
import { pathFacet } from "./editor";
import { markdown } from "./markdown";
import { changesOf, positionOf, spanOf } from "./places";
import type { LanguageServer } from "./server";
import type { Range, TextEdit } from "../talk";

interface Item {
    label: string;
    kind: number;
    detail?: string;
    documentation?: { value: string };
    sortText: string;
    filterText?: string;
    insertTextFormat: 1 | 2;
    textEdit: TextEdit;
    additionalTextEdits?: TextEdit[];
    data?: unknown;
}

/** Characters that ask for a completion although no name is begun. */
const TRIGGERS = /[ ="\.]$/;

/** A snippet of the protocol as the editor takes it: places are numbered, the last is 0. */
export function template(text: string): string {
    const LAST = 99;
    const numbered = (number: string) => (number === "0" ? LAST : Number(number));
    return text
        .replace(/\$\{(\d+)\|([^,|}]*)[^}]*\|\}/g, (_, number: string, first: string) => `\${${numbered(number)}:${first}}`)
        .replace(/\$\{(\d+)(:[^}]*)?\}/g, (_, number: string, inside?: string) => `\${${numbered(number)}${inside ?? ""}}`)
        .replace(/\$(\d+)/g, (_, number: string) => `\${${numbered(number)}}`)
        .replace(/\\([$}\\])/g, "$1");
}

function applied(item: Item, view: EditorView, from: number, to: number): void {
    const text = item.textEdit.newText;
    // Changes elsewhere come after the place, or move it: they are made first, from the end.
    const more = changesOf(view.state.doc, item.additionalTextEdits ?? []);
    const moved = more.length > 0 ? view.state.changes(more) : null;
    if (moved) view.dispatch({ changes: moved, userEvent: "input.complete" });
    const at = { from: moved?.mapPos(from, 1) ?? from, to: moved?.mapPos(to, 1) ?? to };
    if (item.insertTextFormat === 2) {
        snippet(template(text))(view, null, at.from, at.to);
        return;
    }
    view.dispatch({ changes: { ...at, insert: text }, selection: { anchor: at.from + text.length }, userEvent: "input.complete" });
}

function shown(server: LanguageServer, item: Item, rank: number): Completion {
    const info = async () => {
        const full = item.data === undefined ? item : await server.request<Item>("completionItem/resolve", item).catch(() => item);
        return full.documentation ? markdown(full.documentation.value) : null;
    };
    return {
        label: item.filterText ?? item.label,
        displayLabel: item.label,
        ...(item.detail === undefined ? {} : { detail: item.detail }),
        info,
        // The server's order, where the names fit equally well.
        boost: -rank / 100,
        apply: (view, _, from, to) => applied(item, view, from, to),
    };
}

/** What may be written at a place. */
export function completionSource(server: LanguageServer) {
    return async (context: CompletionContext): Promise<CompletionResult | null> => {
        const word = context.matchBefore(/[A-Za-z_][A-Za-z0-9_]*/);
        const trigger = context.matchBefore(TRIGGERS)?.text;
        if (!context.explicit && !word && trigger === undefined) return null;
        const { doc } = context.state;
        const asked = {
            position: positionOf(doc, context.pos),
            context: trigger === undefined || word ? { triggerKind: 1 } : { triggerKind: 2, triggerCharacter: trigger },
        };
        const path = context.state.facet(pathFacet);
        const found = await server.ask<{ isIncomplete: boolean; items: Item[] } | null>("textDocument/completion", path, asked).catch(() => null);
        const first = found?.items[0];
        if (!found || !first || context.aborted) return null;
        const { from } = spanOf(doc, first.textEdit.range);
        const items = [...found.items].sort((one, other) => (one.sortText < other.sortText ? -1 : 1));
        return {
            from,
            options: items.map((item, rank) => shown(server, item, rank)),
            ...(found.isIncomplete ? {} : { validFor: /^[A-Za-z0-9_.]*$/ }),
        };
    };
}

/** What is said of the word under the pointer. */
export function hover(server: LanguageServer): Extension {
    return hoverTooltip(async (view, at) => {
        const { doc } = view.state;
        const path = view.state.facet(pathFacet);
        const found = await server
            .ask<{ contents: { value: string }; range: Range } | null>("textDocument/hover", path, { position: positionOf(doc, at) })
            .catch(() => null);
        if (!found) return null;
        const { from, to } = spanOf(doc, found.range);
        return { pos: from, end: to, above: true, create: () => ({ dom: markdown(found.contents.value) }) };
    });
}
