// A listing of the documentation that can be changed: the text, what is wrong in it, and how it is wired, at each letter.
//
// The tool is that of the studio: the same module in the same worker. It begins to search at once when the text changes;
// while it searches, the newest text waits, and a search that takes too long for a newer text is ended.

import { closeBrackets, closeBracketsKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { bracketMatching, indentOnInput, indentUnit } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { sensedsl } from "../language/highlight";
import { fragmentOf } from "../project/share";
import type { Solution } from "../talk";
import { Superseded, ToolWorker } from "../tool";
import { button, el } from "../ui/dom";
import { Drawing } from "./drawing";
import { listOf, spanIn, type Fix, type Hands, type Problem } from "./problems";
import { sumOf, tableOf } from "./wiring";

declare global {
    /** Where the site has the studio and its files, and what the codes mean. */
    var sensedslStudio: { wasm: string; worker: string; page: string; diagnostics: string };
}

/** A listing to be opened. */
export interface Listing {
    name: string;
    text: string;
    /** What else the page has as files. */
    files: Record<string, string>;
    /** What it is put after. */
    after: Element;
    close(): void;
}

export interface Opened {
    end(): void;
}

export interface Playground {
    open(listing: Listing): Opened;
}

/** A search for an old text may take so long. */
const PATIENCE_MS = 1000;
/** Nothing is said while somebody types. */
const SAY_MS = 800;

const THEME = EditorView.theme({
    "&": { color: "var(--ink)", backgroundColor: "var(--paper)", fontSize: "var(--code-font-size)" },
    ".cm-scroller": { fontFamily: "var(--mono-font)", lineHeight: "1.5" },
    ".cm-content": { caretColor: "var(--ink)" },
    "&.cm-focused": { outline: "2px solid var(--focus)", outlineOffset: "-2px" },
    ".cm-gutters": { backgroundColor: "var(--paper)", color: "var(--soft)", border: "none" },
    ".cm-activeLine": { backgroundColor: "var(--line-here)" },
    ".cm-cursor": { borderLeftColor: "var(--ink)", borderLeftWidth: "2px" },
    "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--selected)" },
    ".cm-matchingBracket, &.cm-focused .cm-matchingBracket": { backgroundColor: "var(--shown)" },
    ".cm-tooltip": { backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--edge)" },
});

/** All listings of a page share the tool. */
const tool = new ToolWorker();
let topics = 0;

class Editor implements Opened, Hands {
    private readonly view: EditorView;
    private readonly drawing = new Drawing();
    private readonly sum = el("p", { class: "playground-sum" });
    private readonly said = el("p", { class: "playground-unseen", role: "status" });
    private readonly problems = el("div", { class: "playground-problems" });
    private readonly wiring = el("div", { class: "playground-wiring" });
    private readonly share = el("a", { target: "_blank", rel: "noopener" }, "Open in the studio");
    private readonly host: HTMLElement;
    private readonly topic = `listing ${(topics += 1)}`;
    private busy_since_ms: number | null = null;
    private isStale = false;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private saying: ReturnType<typeof setTimeout> | undefined;

    constructor(private readonly listing: Listing) {
        const { name, text, after, close } = listing;
        const reset = () => {
            this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
            this.view.focus();
        };
        const editor = el("div", { class: "playground-editor" });
        this.host = el(
            "section",
            { class: "playground", "aria-label": name },
            el("div", { class: "playground-bar" }, el("strong", {}, name), button("Reset", reset), this.share, button("Close", close)),
            editor,
            this.sum,
            this.said,
            this.problems,
            this.wiring,
            this.drawing.host,
        );
        this.view = new EditorView({ parent: editor, state: this.state() });
        // The book has keys of its own, such as an arrow for the next page.
        this.host.addEventListener("keydown", (event) => event.stopPropagation());
        after.after(this.host);
        this.view.focus();
        this.changed();
    }

    private state(): EditorState {
        const { name, text } = this.listing;
        return EditorState.create({
            doc: text.replace(/\n$/, ""),
            extensions: [
                lineNumbers(), history(), drawSelection(), indentOnInput(), indentUnit.of("    "), bracketMatching(), closeBrackets(),
                highlightActiveLine(), lintGutter(), sensedsl(), THEME,
                // Tab goes on to the next button, as everywhere in the page.
                keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...historyKeymap]),
                EditorView.contentAttributes.of({ tabindex: "0", "aria-label": `Text of ${name}` }),
                EditorView.updateListener.of(({ docChanged }) => {
                    if (docChanged) this.changed();
                }),
            ],
        });
    }

    private text(): string {
        return `${this.view.state.doc.toString()}\n`;
    }

    private files(): Record<string, string> {
        return { ...this.listing.files, [this.listing.name]: this.text() };
    }

    private changed(): void {
        this.share.href = `${globalThis.sensedslStudio.page}${fragmentOf({ files: this.files(), open: this.listing.name })}`;
        if (this.busy_since_ms === null) {
            void this.ask();
            return;
        }
        this.isStale = true;
        const left_ms = this.busy_since_ms + PATIENCE_MS - performance.now();
        clearTimeout(this.timer);
        this.timer = setTimeout(() => void this.ask(), Math.max(0, left_ms));
    }

    private async ask(): Promise<void> {
        clearTimeout(this.timer);
        this.busy_since_ms = performance.now();
        this.isStale = false;
        try {
            const answer = await tool.call("ask", [{ path: this.listing.name, files: this.files() }], this.topic);
            this.show(answer.diagnostics as unknown as Problem[], answer.answer as Solution | null, answer.svg);
        } catch (why) {
            // A newer one is under way.
            if (why instanceof Superseded) return;
            this.sum.textContent = why instanceof Error ? why.message : String(why);
        }
        this.busy_since_ms = null;
        if (this.isStale) void this.ask();
    }

    private show(problems: Problem[], solution: Solution | null, svg: string | null): void {
        const { view, listing } = this;
        const isOld = solution === null || svg === null;
        const sum = sumOf(problems, solution);
        this.sum.textContent = sum;
        this.sum.classList.toggle("is-wrong", problems.some((one) => one.severity === "error"));
        const own = problems.filter((one) => one.file === listing.name);
        const marks = own.map((one) => ({ ...spanIn(view.state.doc, one), severity: one.severity === "hint" ? ("hint" as const) : one.severity, message: one.message }));
        view.dispatch(setDiagnostics(view.state, marks));
        this.problems.replaceChildren(...listOf(problems, listing.name, this));
        if (solution !== null && svg !== null) {
            this.wiring.replaceChildren(tableOf(solution));
            this.drawing.draw(svg);
        }
        // The last good one stays, so that a letter that is missing does not empty the page.
        for (const one of [this.wiring, this.drawing.host]) one.classList.toggle("is-old", isOld);
        this.host.dataset["shown"] = String(Number(this.host.dataset["shown"] ?? 0) + 1);
        clearTimeout(this.saying);
        this.saying = setTimeout(() => {
            if (this.said.textContent !== sum) this.said.textContent = sum;
        }, SAY_MS);
    }

    mend(fix: Fix): void {
        const { doc } = this.view.state;
        this.view.dispatch({ changes: fix.edits.map((edit) => ({ ...spanIn(doc, edit), insert: edit.text })), userEvent: "input.tool" });
        this.view.focus();
    }

    go(problem: Problem): void {
        const { from, to } = spanIn(this.view.state.doc, problem);
        this.view.dispatch({ selection: { anchor: from, head: to }, scrollIntoView: true });
        this.view.focus();
    }

    end(): void {
        clearTimeout(this.timer);
        clearTimeout(this.saying);
        this.drawing.end();
        this.view.destroy();
        this.host.remove();
    }
}

/** Opens a listing. */
export function open(listing: Listing): Opened {
    return new Editor(listing);
}
