// The editor: one view, and a state for each file of the project. The states are the texts; all else follows them.

import { acceptCompletion, autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap, startCompletion } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, foldGutter, foldKeymap, indentOnInput, indentUnit } from "@codemirror/language";
import { lintGutter, lintKeymap } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorSelection, EditorState, Facet, Prec, StateEffect, StateField, type ChangeSpec, type Extension, type Transaction } from "@codemirror/state";
import {
    Decoration, drawSelection, dropCursor, EditorView, highlightActiveLine, highlightActiveLineGutter,
    highlightSpecialChars, keymap, lineNumbers, rectangularSelection, tooltips, type DecorationSet,
} from "@codemirror/view";
import { sensedsl } from "./highlight";
import { difference } from "./places";

/** The path of the file that a state is of. */
export const pathFacet = Facet.define<string, string>({ combine: (all) => all[0] ?? "" });

const mark = StateEffect.define<{ from: number; to: number } | null>();
const marked = StateField.define<DecorationSet>({
    create: () => Decoration.none,
    update(marks, transaction) {
        let now = marks.map(transaction.changes);
        for (const effect of transaction.effects) {
            if (!effect.is(mark)) continue;
            const { state } = transaction;
            const lines = [];
            if (effect.value) {
                const last = state.doc.lineAt(effect.value.to).number;
                for (let line = state.doc.lineAt(effect.value.from).number; line <= last; line += 1) {
                    lines.push(Decoration.line({ class: "is-shown" }).range(state.doc.line(line).from));
                }
            }
            now = Decoration.set(lines);
        }
        return now;
    },
    provide: (field) => EditorView.decorations.from(field),
});

/** How long a place that was gone to stays marked. */
const MARKED_MS = 1500;

const THEME = EditorView.theme({
    "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--paper)" },
    ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.5" },
    ".cm-content": { caretColor: "var(--ink)" },
    "&.cm-focused": { outline: "2px solid var(--focus)", outlineOffset: "-2px" },
    ".cm-gutters": { backgroundColor: "var(--paper)", color: "var(--soft)", border: "none" },
    ".cm-activeLine": { backgroundColor: "var(--line-here)" },
    ".cm-activeLineGutter": { backgroundColor: "var(--line-here)", color: "var(--ink)" },
    ".cm-cursor, .cm-dropCursor": { borderLeftColor: "var(--ink)", borderLeftWidth: "2px" },
    "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--selected)" },
    ".is-shown": { backgroundColor: "var(--shown)" },
    ".cm-tooltip": { backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--edge)", borderRadius: "6px", maxWidth: "min(36rem, 94vw)" },
    ".cm-tooltip-autocomplete > ul > li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--on-accent)" },
    ".cm-panels": { backgroundColor: "var(--raised)", color: "var(--ink)" },
    ".cm-hint": { color: "var(--soft)", fontSize: "0.85em", padding: "0 0.3em" },
    ".cm-diagnostic": { whiteSpace: "pre-wrap", maxHeight: "40vh", overflow: "auto" },
    ".cm-diagnosticAction": { backgroundColor: "var(--accent)", color: "var(--on-accent)" },
    ".cm-diagnosticSource": { opacity: "1", color: "var(--soft)" },
    ".cm-foldGutter": { color: "var(--soft)" },
    ".cm-foldPlaceholder": { backgroundColor: "var(--raised)", color: "var(--ink)", borderColor: "var(--edge)" },
    ".cm-button": { backgroundImage: "none", backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--edge)", borderRadius: "6px" },
    ".cm-textfield": { backgroundColor: "var(--paper)", color: "var(--ink)", border: "1px solid var(--edge)", borderRadius: "6px" },
    ".cm-panels .cm-panel.cm-search [name=close]": { color: "var(--ink)" },
    ".cm-panels.cm-panels-bottom": { borderTop: "1px solid var(--edge)" },
    ".cm-matchingBracket, &.cm-focused .cm-matchingBracket": { backgroundColor: "var(--shown)" },
    ".cm-selectionMatch, .cm-searchMatch": { backgroundColor: "var(--shown)" },
});

/** What happens to the texts and the cursor. */
export interface EditorListener {
    /** Texts have changed, or files have come or gone. */
    changed(): void;
    /** Another file is open, or the list of files has changed. */
    listed(): void;
    moved(): void;
}

/** Files of a project, by path. */
export type Texts = Record<string, string>;

export class Editor {
    readonly view: EditorView;
    private states = new Map<string, EditorState>();
    private marking: ReturnType<typeof setTimeout> | undefined;
    path = "";

    constructor(
        host: HTMLElement,
        private readonly listener: EditorListener,
        private readonly features: Extension,
    ) {
        this.view = new EditorView({ parent: host, dispatchTransactions: (transactions, view) => this.dispatched(transactions, view) });
    }

    private dispatched(transactions: readonly Transaction[], view: EditorView): void {
        view.update(transactions);
        this.states.set(this.path, view.state);
        if (transactions.some((one) => one.docChanged)) this.listener.changed();
        if (transactions.some((one) => one.docChanged || one.selection)) this.listener.moved();
    }

    private created(path: string, doc: string): EditorState {
        const isDesign = path.endsWith(".sense");
        const own = isDesign ? [sensedsl(), this.features, lintGutter()] : [];
        const name = path.split("/").pop() ?? path;
        return EditorState.create({
            doc,
            extensions: [
                pathFacet.of(path),
                lineNumbers(), highlightActiveLineGutter(), highlightSpecialChars(), history(), foldGutter(),
                drawSelection(), dropCursor(), rectangularSelection(), EditorState.allowMultipleSelections.of(true),
                indentOnInput(), indentUnit.of("    "), bracketMatching(), closeBrackets(),
                highlightActiveLine(), highlightSelectionMatches(), marked, tooltips({ position: "fixed" }), own,
                Prec.low(autocompletion({ icons: false, activateOnTypingDelay: 30 })),
                keymap.of([
                    ...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...foldKeymap,
                    ...completionKeymap, ...lintKeymap, { key: "Tab", run: acceptCompletion }, { key: "Ctrl-i", run: startCompletion },
                    indentWithTab,
                ]),
                EditorView.contentAttributes.of({ tabindex: "0", "aria-label": `Text of ${name}. Escape, then Tab, leaves it.` }),
                THEME,
            ],
        });
    }

    /** All texts, by path. */
    texts(): Texts {
        return Object.fromEntries([...this.states].map(([path, state]) => [path, state.doc.toString()]));
    }

    /** The paths, in the order of the tabs. */
    paths(): string[] {
        return [...this.states.keys()];
    }

    state(path: string): EditorState | undefined {
        return this.states.get(path);
    }

    /** Begins with other files. */
    replace(texts: Texts, path: string): void {
        this.states = new Map(Object.entries(texts).map(([path, text]) => [path, this.created(path, text)]));
        this.path = "";
        this.open(this.states.has(path) ? path : (this.paths()[0] ?? ""));
        this.listener.changed();
    }

    /** Shows a file. */
    open(path: string): void {
        const state = this.states.get(path);
        if (!state || path === this.path) return;
        this.path = path;
        // What was gone to in it some time ago is not marked any more.
        this.view.setState(state.update({ effects: mark.of(null) }).state);
        this.listener.listed();
        this.listener.moved();
    }

    add(path: string, text: string): void {
        this.states.set(path, this.created(path, text));
        this.open(path);
        this.listener.changed();
    }

    rename(old: string, path: string): void {
        const text = this.states.get(old)?.doc.toString();
        if (text === undefined) return;
        const all = [...this.states].map(([one, state]): [string, EditorState] =>
            one === old ? [path, this.created(path, text)] : [one, state],
        );
        this.states = new Map(all);
        if (this.path === old) this.path = "";
        this.open(this.path === "" ? path : this.path);
        this.listener.listed();
        this.listener.changed();
    }

    remove(path: string): void {
        const at = this.paths().indexOf(path);
        this.states.delete(path);
        if (this.path === path) {
            this.path = "";
            this.open(this.paths()[Math.max(0, at - 1)] ?? "");
        }
        this.listener.listed();
        this.listener.changed();
    }

    /** Gives files new texts, each as one step that can be undone. */
    write(texts: Texts): void {
        for (const [path, text] of Object.entries(texts)) {
            const state = this.states.get(path);
            if (!state) {
                this.states.set(path, this.created(path, text));
                continue;
            }
            const old = state.doc.toString();
            if (old !== text) this.change(path, [difference(old, text)]);
        }
        this.listener.listed();
    }

    /** Changes a file as one step that can be undone. */
    change(path: string, changes: ChangeSpec): void {
        const spec = { changes, userEvent: "input.tool", scrollIntoView: true };
        if (path === this.path) {
            this.view.dispatch(spec);
            return;
        }
        const state = this.states.get(path);
        if (!state) return;
        this.states.set(path, state.update(spec).state);
        this.listener.changed();
    }

    /** Goes to a place of a file, and marks its lines for a moment. */
    go(path: string, at: { from: number; to: number }, around = at, isFocused = true): void {
        this.open(path);
        this.view.dispatch({
            selection: EditorSelection.single(at.from, at.to),
            effects: [EditorView.scrollIntoView(at.from, { y: "nearest", yMargin: 60 }), mark.of(around)],
        });
        if (isFocused) this.view.focus();
        clearTimeout(this.marking);
        this.marking = setTimeout(() => this.view.dispatch({ effects: mark.of(null) }), MARKED_MS);
    }
}
