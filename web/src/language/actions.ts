// What the keys of the editor do with the language server: fixes, renaming, going to a definition, formatting.

import { nextDiagnostic } from "@codemirror/lint";
import type { Extension } from "@codemirror/state";
import { EditorView, keymap } from "@codemirror/view";
import type { Studio } from "../studio";
import type { CodeAction, Range, TextEdit, WorkspaceEdit } from "../talk";
import { announce } from "../ui/dom";
import { ask, menu } from "../ui/dialog";
import { changesOf, positionOf, rangeOf, spanOf } from "./places";
import { pathOf } from "./server";

interface Location {
    uri: string;
    range: Range;
}

const NAME = /^[A-Za-z_][A-Za-z0-9_]*$/;

/** Offers what can be done where the cursor is. */
async function offer(studio: Studio, view: EditorView): Promise<void> {
    const { from, to, head } = view.state.selection.main;
    const asked = { range: rangeOf(view.state.doc, from, to), context: { diagnostics: [] } };
    const found = await studio.server.ask<CodeAction[] | null>("textDocument/codeAction", studio.editor.path, asked).catch(() => null);
    const actions = (found ?? []).filter((one) => one.edit);
    if (actions.length === 0) {
        announce("Nothing is offered here.");
        return;
    }
    const at = view.coordsAtPos(head);
    const place = { x: at?.left ?? 0, y: (at?.bottom ?? 0) + 4 };
    menu("Changes", place, actions.map(({ title, edit }) => ({ title, run: () => studio.problems.apply(edit, title) })));
}

async function rename(studio: Studio, view: EditorView): Promise<void> {
    const { path } = studio.editor;
    const position = positionOf(view.state.doc, view.state.selection.main.head);
    try {
        const place = await studio.server.ask<{ range: Range; placeholder?: string } | Range | null>("textDocument/prepareRename", path, { position });
        if (!place) {
            announce("There is no name here that can be changed.");
            return;
        }
        const range = "range" in place ? place.range : place;
        const { from, to } = spanOf(view.state.doc, range);
        const old = view.state.sliceDoc(from, to);
        const check = (text: string) => (NAME.test(text) ? null : "A name has letters, digits and _, and does not begin with a digit.");
        const newName = await ask(`Rename ${old}`, "New name", old, check);
        if (newName === null || newName === old) return;
        const edit = await studio.server.ask<WorkspaceEdit | null>("textDocument/rename", path, { position, newName });
        studio.problems.apply(edit ?? undefined, `${old} is ${newName} now`);
    } catch (why) {
        announce(why instanceof Error ? why.message : String(why));
    }
}

async function define(studio: Studio, view: EditorView, at: number): Promise<void> {
    const position = positionOf(view.state.doc, at);
    const found = await studio.server
        .ask<Location | Location[] | null>("textDocument/definition", studio.editor.path, { position })
        .catch(() => null);
    const first = Array.isArray(found) ? found[0] : found;
    const path = first ? pathOf(first.uri) : "";
    const doc = studio.editor.state(path)?.doc;
    if (first && doc) studio.editor.go(path, spanOf(doc, first.range));
    else announce("Its definition is not in a file of the project.");
}

/** Lays a file out. */
export async function format(studio: Studio): Promise<void> {
    const { path } = studio.editor;
    const options = { tabSize: 4, insertSpaces: true };
    const edits = await studio.server.ask<TextEdit[] | null>("textDocument/formatting", path, { options }).catch(() => null);
    const doc = studio.editor.state(path)?.doc;
    if (!edits || !doc) announce("Text with syntax errors is not formatted.");
    else if (edits.length === 0) announce("It is laid out well.");
    else studio.editor.change(path, changesOf(doc, edits));
}

/** The keys; the studio is not there yet when the editor is made. */
export function actions(studio: () => Studio): Extension {
    const run = (what: (studio: Studio, view: EditorView) => Promise<void>) => (view: EditorView) => {
        void what(studio(), view);
        return true;
    };
    return [
        keymap.of([
            { key: "Mod-.", run: run(offer), preventDefault: true },
            { key: "F2", run: run(rename) },
            { key: "F8", run: nextDiagnostic },
            { key: "F12", run: run((of, view) => define(of, view, view.state.selection.main.head)) },
            { key: "Shift-Alt-f", run: run(format) },
        ]),
        EditorView.domEventHandlers({
            mousedown: (event, view) => {
                if (!(event.ctrlKey || event.metaKey) || event.button !== 0) return false;
                const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
                if (at === null) return false;
                event.preventDefault();
                void define(studio(), view, at);
                return true;
            },
        }),
    ];
}
