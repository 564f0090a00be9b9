// The files of the project, as tabs above the text.

import type { Editor } from "../language/editor";
import { ask, confirm, menu } from "../ui/dialog";
import { button, el } from "../ui/dom";

/** Files that the project can have. */
export const ACCEPTED = ".sense,.csv,.toml,.svg,.txt,.json,.ioc,text/*";
const PATH = /^[A-Za-z0-9_][A-Za-z0-9_.-]*(\/[A-Za-z0-9_][A-Za-z0-9_.-]*)*$/;
const BYTES_MAX = 1_000_000;

/** What is wrong with a path; null if nothing is. */
export function wrongPath(path: string, others: string[]): string | null {
    if (others.includes(path)) return `There is a file ${path}.`;
    if (!PATH.test(path)) return "A path has letters, digits, _, - and dots, with / between folders.";
    if (!path.includes(".")) return "Use .sense for a design, or .csv for a table.";
    return null;
}

/** Files of the machine that were read, and the names of those that were not taken. */
export interface Taken {
    texts: Record<string, string>;
    /** They are no text, or too large. */
    refused: string[];
    /** They are drawings that no world has for its map. */
    unnamed: string[];
}

/** Reads text files of the machine. Drawings are taken only where a world, one of them or of those that are `there`, names them. */
export async function readFiles(files: Iterable<File>, there: Record<string, string>): Promise<Taken> {
    const texts: Record<string, string> = {};
    const refused: string[] = [];
    for (const file of files) {
        try {
            if (file.size > BYTES_MAX) throw new Error("too large");
            const text = new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
            if (text.includes("\0")) throw new Error("no text");
            texts[file.name] = text;
        } catch {
            refused.push(file.name);
        }
    }
    const worlds = Object.entries({ ...there, ...texts }).filter(([path]) => path.endsWith(".toml"));
    const unnamed = Object.keys(texts).filter((name) => name.endsWith(".svg") && !worlds.some(([, text]) => text.includes(name)));
    for (const name of unnamed) delete texts[name];
    return { texts, refused, unnamed };
}

/** Lets files of the machine be chosen. */
export function chooseFiles(): Promise<File[]> {
    return new Promise((resolve) => {
        const input = el("input", { type: "file", multiple: true, accept: ACCEPTED, hidden: true, "aria-label": "Files" });
        input.addEventListener("change", () => resolve([...(input.files ?? [])]));
        input.addEventListener("cancel", () => resolve([]));
        input.addEventListener("change", () => input.remove());
        document.body.append(input);
        input.click();
    });
}

export class FileBar {
    private readonly list = el("div", { role: "tablist", "aria-label": "Files" });

    constructor(
        host: HTMLElement,
        private readonly editor: Editor,
        private readonly upload: () => void,
        /** Whether the files are those of a folder, which has them whatever is done with the tabs. */
        private readonly isFolder: boolean,
    ) {
        const more = button("⋯", () => this.menu(more), { class: "quiet", "aria-label": "Change the list of files", "aria-haspopup": "menu" });
        host.append(this.list, more);
        this.list.addEventListener("keydown", (event) => this.step(event));
        this.list.addEventListener("dblclick", () => void this.rename());
    }

    /** Shows the files as they are. */
    update(): void {
        const hasFocus = this.list.contains(document.activeElement);
        const tabs = this.editor.paths().map((path) => {
            const isOpen = path === this.editor.path;
            return el("button", { type: "button", role: "tab", "aria-selected": String(isOpen), tabindex: isOpen ? "0" : "-1", "aria-controls": "editor", onclick: () => this.editor.open(path) }, path);
        });
        this.list.replaceChildren(...tabs);
        if (hasFocus) tabs.find((tab) => tab.tabIndex === 0)?.focus();
    }

    private step(event: KeyboardEvent): void {
        if (event.key === "F2") void this.rename();
        if (event.key === "Delete") void this.remove();
        const paths = this.editor.paths();
        const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? paths.length - 1 : 0;
        const next = paths[(paths.indexOf(this.editor.path) + by) % paths.length];
        if (by === 0 || next === undefined) return;
        event.preventDefault();
        this.editor.open(next);
    }

    private menu(at: HTMLElement): void {
        const { left, bottom } = at.getBoundingClientRect();
        const { path } = this.editor;
        menu("Files", { x: left, y: bottom + 2 }, [
            { title: "New file …", run: () => void this.add() },
            { title: "Add files of this machine …", run: this.upload },
            { title: `Rename ${path} …`, run: () => void this.rename() },
            { title: `Delete ${path} …`, run: () => void this.remove() },
        ]);
    }

    private async add(): Promise<void> {
        const path = await ask("New file", "Path", "part.sense", (text) => wrongPath(text, this.editor.paths()));
        if (path !== null) this.editor.add(path, "");
    }

    private async rename(): Promise<void> {
        const old = this.editor.path;
        const others = this.editor.paths().filter((path) => path !== old);
        const path = await ask(`Rename ${old}`, "New path; files that use it keep the old one", old, (text) => wrongPath(text, others));
        if (path !== null && path !== old) this.editor.rename(old, path);
    }

    private async remove(): Promise<void> {
        const { path } = this.editor;
        const isLast = this.editor.paths().length === 1;
        const lost = isLast ? "It is the only file: an empty one takes its place." : "";
        const where = this.isFolder ? "It is removed from the folder." : "It is not kept anywhere else.";
        if (!(await confirm(`Delete ${path}?`, `${where} ${lost}`.trim(), "Delete"))) return;
        if (isLast) this.editor.add(path === "robot.sense" ? "new.sense" : "robot.sense", "");
        this.editor.remove(path);
    }
}
