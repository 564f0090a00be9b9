// Hints in the text: the pins that were found, beside what they are for.

import { RangeSetBuilder, StateEffect, StateField, type Extension } from "@codemirror/state";
import { Decoration, EditorView, WidgetType, type DecorationSet } from "@codemirror/view";
import type { Editor } from "./editor";
import { offsetOf } from "./places";
import type { LanguageServer } from "./server";
import type { Position } from "../talk";

interface Hint {
    position: Position;
    label: string;
    paddingLeft: boolean;
    tooltip?: { value: string };
}

class Label extends WidgetType {
    constructor(private readonly hint: Hint) {
        super();
    }

    override eq(other: Label): boolean {
        return other.hint.label === this.hint.label;
    }

    toDOM(): HTMLElement {
        const made = document.createElement("span");
        made.className = "cm-hint";
        made.textContent = this.hint.label;
        return made;
    }
}

const set = StateEffect.define<Hint[]>();
const hints = StateField.define<DecorationSet>({
    create: () => Decoration.none,
    update(shown, transaction) {
        let now = shown.map(transaction.changes);
        for (const effect of transaction.effects) {
            if (!effect.is(set)) continue;
            const builder = new RangeSetBuilder<Decoration>();
            const { doc } = transaction.state;
            const placed = effect.value.map((hint) => ({ hint, at: offsetOf(doc, hint.position) }));
            placed.sort((one, other) => one.at - other.at);
            for (const { hint, at } of placed) builder.add(at, at, Decoration.widget({ widget: new Label(hint), side: 1 }));
            now = builder.finish();
        }
        return now;
    },
    provide: (field) => EditorView.decorations.from(field),
});

/** What shows hints in a text. */
export const hintField: Extension = hints;

let asked = 0;

/** Asks for the hints of the open file, and shows them. */
export async function refreshHints(server: LanguageServer, editor: Editor): Promise<void> {
    const { path, view } = editor;
    if (!path.endsWith(".sense")) return;
    asked += 1;
    const mine = asked;
    const range = { start: { line: 0, character: 0 }, end: { line: view.state.doc.lines, character: 0 } };
    const found = await server.ask<Hint[] | null>("textDocument/inlayHint", path, { range }).catch(() => null);
    if (found && mine === asked && editor.path === path) view.dispatch({ effects: set.of(found) });
}
