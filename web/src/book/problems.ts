// What the tool says of a text, as a list: where it is, what is wrong, and the way out.

import type { Text } from "@codemirror/state";
import { inline } from "../language/markdown";
import { button, el } from "../ui/dom";

interface Place {
    line: number;
    column: number;
}

/** A way out as changes of the text. */
export interface Fix {
    title: string;
    edits: { text: string; file: string; start: Place; end: Place }[];
}

/** A diagnostic as `sensedsl check --format json` prints it. */
export interface Problem {
    severity: "error" | "warning" | "hint";
    code: string;
    message: string;
    file?: string;
    start?: Place;
    end?: Place;
    help?: string;
    fix?: Fix;
    fixes?: Fix[];
}

function offset(doc: Text, { line, column }: Place): number {
    if (line > doc.lines) return doc.length;
    const of = doc.line(Math.max(1, line));
    // The tool counts letters, the editor the units of UTF-16.
    const letters = [...of.text].slice(0, column - 1).join("");
    return Math.min(of.to, of.from + letters.length);
}

/** Where a problem is in the text. */
export function spanIn(doc: Text, { start, end }: { start?: Place; end?: Place }): { from: number; to: number } {
    const from = start ? offset(doc, start) : 0;
    return { from, to: end ? Math.max(from, offset(doc, end)) : from };
}

/** What the list does with the text. */
export interface Hands {
    go(problem: Problem): void;
    mend(fix: Fix): void;
}

/** The problems, those of other files with their names. */
export function listOf(problems: Problem[], name: string, hands: Hands): HTMLElement[] {
    if (problems.length === 0) return [];
    const items = problems.map((problem) => {
        const { severity, code, message, file, start, help } = problem;
        const fixes = [...(problem.fix ? [problem.fix] : []), ...(problem.fixes ?? [])].filter((fix) => fix.edits.every((edit) => edit.file === name));
        const isHere = file === name && start !== undefined;
        const to = `${globalThis.sensedslStudio.diagnostics}#${code}`;
        const place = isHere ? button(`Line ${start.line}`, () => hands.go(problem), { class: "place" }) : file && start ? el("span", {}, `${file}:${start.line}`) : null;
        return el(
            "li",
            { class: `is-${severity}` },
            el("p", {}, place, place ? " " : null, el("strong", {}, severity), " ", el("a", { href: to, target: "_blank" }, code), ": ", ...inline(message)),
            help ? el("p", { class: "help" }, ...inline(help)) : null,
            fixes.length > 0 ? el("p", { class: "fixes" }, ...fixes.map((fix) => button(inline(fix.title), () => hands.mend(fix)))) : null,
        );
    });
    return [el("ul", { "aria-label": "Problems" }, ...items)];
}
