// Problems: what is wrong in the files, with the ways out of each, in the text and as a list below it.

import { setDiagnostics, type Diagnostic } from "@codemirror/lint";
import type { Editor } from "./editor";
import { inline } from "./markdown";
import { changesOf, spanOf } from "./places";
import { pathOf, type LanguageServer } from "./server";
import type { CodeAction, Problem, Range, WorkspaceEdit } from "../talk";
import { announce, button, el } from "../ui/dom";

const NAMES = { 1: "error", 2: "warning", 3: "info", 4: "hint" } as const;
const FIX_MS = 120;
const END: Range = { start: { line: 0, character: 0 }, end: { line: 1_000_000, character: 0 } };

/** Whether two problems are the same one. */
function isSame(one: Problem, other: Problem): boolean {
    return one.code === other.code && one.message === other.message && JSON.stringify(one.range) === JSON.stringify(other.range);
}

/** The problems of all files. */
export class Problems {
    readonly all = new Map<string, Problem[]>();
    private readonly fixes = new Map<string, CodeAction[]>();
    private readonly list = el("ul", { class: "problems" });
    private readonly summary = el("button", { type: "button", class: "summary", "aria-expanded": "true", "aria-controls": "problem-list", onclick: () => this.fold() });
    private listeners: (() => void)[] = [];
    private said = "";
    private showing: ReturnType<typeof setTimeout> | undefined;

    constructor(
        host: HTMLElement,
        private readonly editor: Editor,
        private readonly server: () => LanguageServer,
    ) {
        this.list.id = "problem-list";
        host.append(this.summary, this.list);
        // Where there is little room the text has it.
        if (matchMedia("(max-width: 799px)").matches) this.fold();
        this.show();
    }

    /** Calls when problems or their fixes have changed. */
    onChange(listener: () => void): void {
        this.listeners.push(listener);
    }

    /** The ways out of all problems of a file. */
    fixesOf(path: string): CodeAction[] {
        return this.fixes.get(path) ?? [];
    }

    /** Takes the problems of a file, and asks for their fixes. */
    async take(path: string, problems: Problem[]): Promise<void> {
        if (problems.length === 0) this.all.delete(path);
        else this.all.set(path, problems);
        this.keep(path);
        this.changed();
        if (problems.length === 0) return;
        // The picture comes first, and the next letter.
        await new Promise((resolve) => setTimeout(resolve, FIX_MS));
        if (this.all.get(path) !== problems) return;
        const asked = { range: END, context: { diagnostics: [], only: ["quickfix"] } };
        const fixes = await this.server().ask<CodeAction[] | null>("textDocument/codeAction", path, asked).catch(() => null);
        if (!fixes || this.all.get(path) !== problems) return;
        this.fixes.set(path, fixes);
        this.changed();
    }

    /** Keeps fixes of problems that are as they were: buttons do not come and go while one types. */
    private keep(path: string): void {
        const now = this.all.get(path) ?? [];
        const kept = this.fixesOf(path).filter((fix) => fix.diagnostics?.some((of) => now.some((one) => isSame(one, of))));
        this.fixes.set(path, kept);
    }

    /** Forgets files that are not in the project any more. */
    retain(paths: string[]): void {
        for (const path of this.all.keys()) if (!paths.includes(path)) this.all.delete(path);
        this.changed();
    }

    /** Shows what has changed, once: the picture goes first. */
    private changed(): void {
        this.showing ??= setTimeout(() => {
            this.showing = undefined;
            this.inText();
            this.show();
            for (const one of this.listeners) one();
        });
    }

    private of(path: string, problem: Problem): CodeAction[] {
        return this.fixesOf(path).filter((fix) => fix.edit && fix.diagnostics?.some((one) => isSame(one, problem)));
    }

    /** Underlines the problems of the open file. */
    inText(): void {
        const { path, view } = this.editor;
        if (!path.endsWith(".sense")) return;
        const shown = (this.all.get(path) ?? []).map((problem): Diagnostic => {
            const { from, to } = spanOf(view.state.doc, problem.range);
            return {
                from,
                to,
                severity: NAMES[problem.severity],
                source: problem.code,
                message: problem.message,
                ...(problem.tags?.includes(1) ? { markClass: "is-unused" } : {}),
                actions: this.of(path, problem).map((fix) => ({ name: fix.title, apply: () => this.apply(fix.edit, fix.title) })),
            };
        });
        view.dispatch(setDiagnostics(view.state, shown));
    }

    /** Makes the changes of a fix. */
    apply(edit: WorkspaceEdit | undefined, title: string): void {
        for (const [uri, edits] of Object.entries(edit?.changes ?? {})) {
            const path = pathOf(uri);
            const state = this.editor.state(path);
            if (state) this.editor.change(path, changesOf(state.doc, edits));
        }
        announce(`Done: ${title}`);
    }

    private fold(): void {
        const isOpen = this.summary.getAttribute("aria-expanded") === "true";
        this.summary.setAttribute("aria-expanded", String(!isOpen));
        this.list.hidden = isOpen;
    }

    private show(): void {
        const all = [...this.all].flatMap(([path, problems]) => problems.map((problem) => ({ path, problem })));
        const rank = ({ path, problem }: (typeof all)[number]) => [problem.severity, Number(path !== this.editor.path), problem.range.start.line] as const;
        all.sort((one, other) => rank(one).map((part, at) => part - (rank(other)[at] ?? 0)).find((apart) => apart !== 0) ?? 0);
        const count = (severity: number) => all.filter((one) => one.problem.severity === severity).length;
        const counts = [[count(1), "error"], [count(2), "warning"], [count(4), "hint"]] as const;
        const text = counts.filter(([number]) => number > 0).map(([number, word]) => `${number} ${word}${number === 1 ? "" : "s"}`).join(", ") || "No problems";
        this.summary.textContent = text;
        this.summary.className = `summary ${count(1) > 0 ? "is-error" : count(2) > 0 ? "is-warning" : ""}`;
        const rows = all.map(({ path, problem }) => this.row(path, problem));
        const focused = this.list.contains(document.activeElement) ? document.activeElement?.textContent : null;
        this.list.replaceChildren(...rows);
        if (focused) [...this.list.querySelectorAll("button")].find((one) => one.textContent === focused)?.focus();
        this.tell(count(1) > 0 ? text : "No errors");
    }

    /** Says how many errors there are, once the number has changed. */
    private tell(text: string): void {
        if (text !== this.said && this.said !== "") announce(text);
        this.said = text;
    }

    private row(path: string, problem: Problem): HTMLElement {
        const [first = "", ...more] = problem.message.split("\n");
        const name = NAMES[problem.severity];
        const go = () => {
            const text = this.editor.state(path)?.doc;
            if (text) this.editor.go(path, spanOf(text, problem.range));
        };
        const isOther = path !== this.editor.path;
        const place = `${isOther ? `${path}:` : "line "}${problem.range.start.line + 1}`;
        const fixes = this.of(path, problem).map((fix) => button(inline(fix.title), () => this.apply(fix.edit, fix.title), { class: "fix" }));
        return el(
            "li",
            { class: `is-${name}` },
            el("button", { type: "button", class: "link", onclick: go }, el("span", { class: "kind" }, `${name} ${problem.code}`), " ", ...inline(first), " ", el("span", { class: "place" }, place)),
            more.length > 0 && el("p", {}, ...inline(more.join("\n"))),
            fixes.length > 0 && el("div", { class: "fixes" }, ...fixes),
        );
    }
}
