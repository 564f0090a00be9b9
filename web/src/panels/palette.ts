// Parts and boards: searched for, and put into the text.

import type { Tool } from "../../../crates/wasm/sensedsl.mjs";
import type { Studio } from "../studio";
import { designOf } from "../studio";
import { ToolWorker } from "../tool";
import { announce, button, el } from "../ui/dom";
import { dialog } from "../ui/dialog";
import type { View } from "../ui/tabs";
import { boardChange, insertion } from "./insert";

type Part = ReturnType<Tool["parts"]>[number];
type Board = ReturnType<Tool["boards"]>[number];

const SHOWN_MAX = 60;

/** Whether every word of a query is in a text. */
function fits(text: string, query: string): boolean {
    const lower = text.toLowerCase();
    return query.toLowerCase().split(/\s+/).every((word) => lower.includes(word));
}

export class Palette implements View {
    readonly id = "parts";
    readonly title = "Parts";
    private isLoading = false;
    private parts: Part[] | undefined;
    private boards: Board[] | undefined;
    private readonly search = el("input", { type: "search", id: "palette-search", placeholder: "distance, bme280, motor …", oninput: () => this.list() });
    private readonly what = el("select", { id: "palette-what", onchange: () => this.choose() }, el("option", { value: "parts" }, "Parts"), el("option", { value: "boards" }, "Boards"));
    private readonly found = el("p", { class: "found", role: "status" });
    private readonly rows = el("ul", { class: "cards" });

    constructor(private readonly studio: Studio) {}

    mount(host: HTMLElement): void {
        host.append(
            el(
                "div",
                { class: "choice" },
                el("label", { for: "palette-what", class: "unseen" }, "What"),
                this.what,
                el("label", { for: "palette-search", class: "unseen" }, "Search"),
                this.search,
            ),
            this.found,
            this.rows,
        );
        this.found.textContent = "Looking …";
        void this.load("parts");
    }

    /** Reads a list of the library, in a worker of its own: the list of boards takes seconds, and nothing waits for it. */
    private async load(what: "parts" | "boards"): Promise<void> {
        const tool = new ToolWorker();
        try {
            if (what === "parts") this.parts = await tool.call("parts", []);
            else this.boards = await tool.call("boards", []);
            this.list();
        } catch (why) {
            this.found.textContent = `The library could not be read: ${why instanceof Error ? why.message : String(why)}`;
        }
        tool.end();
    }

    private choose(): void {
        const isMissing = this.what.value === "boards" && this.boards === undefined;
        if (isMissing && !this.isLoading) {
            this.isLoading = true;
            void this.load("boards");
        }
        this.list();
    }

    private list(): void {
        const query = this.search.value.trim();
        const isParts = this.what.value === "parts";
        if ((isParts ? this.parts : this.boards) === undefined) {
            this.found.textContent = "Looking …";
            this.rows.replaceChildren();
            return;
        }
        const all = isParts ? this.partRows(query) : this.boardRows(query);
        this.found.textContent = all.length === 0 ? `Nothing fits “${query}”.` : `${all.length} ${isParts ? "part" : "board"}${all.length === 1 ? "" : "s"}${all.length > SHOWN_MAX ? `, the first ${SHOWN_MAX} are shown` : ""}`;
        this.rows.replaceChildren(...all.slice(0, SHOWN_MAX).map((make) => make()));
    }

    private partRows(query: string): (() => HTMLElement)[] {
        const fitting = (this.parts ?? []).filter((part) => fits([part.name, part.title, part.kind, ...part.quantities, ...part.aliases].join(" "), query));
        return fitting.map((part) => () => {
            const about = [part.kind, part.quantities.join(", ")].filter(Boolean).join(" · ");
            return el("li", {}, el("button", { type: "button", class: "card", "aria-description": "Put it into the text", onclick: () => this.insert(part) }, el("strong", {}, part.title || part.name), el("span", {}, `${part.name} · ${about}`)));
        });
    }

    private boardRows(query: string): (() => HTMLElement)[] {
        const fitting = (this.boards ?? []).filter((board) => fits([board.name, board.mcu, board.family, board.package ?? "", board.keywords, ...board.firmware].join(" "), query));
        return fitting.map((board) => () =>
            el(
                "li",
                { class: "card-of-two" },
                el("div", {}, el("strong", {}, board.name), el("span", {}, `${[board.mcu, `${board.free} of ${board.pins} pins free`, board.link, board.firmware.join(", ") || "pins only, no firmware"].filter(Boolean).join(" · ")}`)),
                el("div", { class: "actions" }, button("Use", () => this.use(board), { "aria-label": `Use ${board.name}` }), button("Look", () => void this.look(board), { "aria-label": `Look at ${board.name}` })),
            ),
        );
    }

    private async look(board: Board): Promise<void> {
        const svg = await this.studio.tool.call("board_svg", [board.name]).catch(() => null);
        if (svg === null) return;
        const url = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
        const { host } = dialog(board.name, el("img", { src: url, alt: `${board.name} and its pins`, class: "board-picture" }));
        host.addEventListener("close", () => URL.revokeObjectURL(url));
    }

    private insert(part: Part): void {
        const { editor } = this.studio;
        const path = designOf(editor.texts(), editor.path);
        editor.open(path);
        const { doc, selection } = editor.view.state;
        const { from, insert, select } = insertion(doc.toString(), selection.main.head, part.snippet);
        editor.view.dispatch({ changes: { from, insert }, selection: { anchor: from + select.from, head: from + select.to }, scrollIntoView: true, userEvent: "input.tool" });
        editor.view.focus();
        announce(`${part.title || part.name} is in the text.`);
    }

    private use(board: Board): void {
        const { editor } = this.studio;
        const path = designOf(editor.texts(), editor.path);
        const doc = editor.state(path)?.doc;
        if (!doc) return;
        editor.open(path);
        editor.change(path, boardChange(doc.toString(), editor.view.state.selection.main.head, board.name));
        announce(`The board is now ${board.name}.`);
    }
}
