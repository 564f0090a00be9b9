// Reports: what the tool says of a wiring, asked for again when the text has changed; the last one stays, dimmed, until then.

import type { Report } from "../../../crates/wasm/sensedsl.mjs";
import type { Studio } from "../studio";
import { Superseded } from "../tool";
import { el } from "../ui/dom";
import type { View } from "../ui/tabs";

const WAIT_MS = 250;

/** A view that shows an answer of the tool. */
export abstract class ReportView implements View {
    abstract readonly id: string;
    abstract readonly title: string;
    protected readonly body = el("div", { class: "report", "aria-live": "off" });
    private shown: string | null = null;
    private timer: ReturnType<typeof setTimeout> | undefined;

    constructor(protected readonly studio: Studio) {}

    mount(host: HTMLElement): void {
        host.append(...this.head(), this.body);
    }

    /** What stands above the answer. */
    protected head(): HTMLElement[] {
        return [];
    }

    /** What is asked besides the texts; null if there is nothing to ask, which `missing` explains. */
    protected abstract question(): object | null;
    protected abstract ask(): Promise<Report>;
    protected abstract show(report: Report): HTMLElement[];
    protected abstract missing(): string;

    update(): void {
        const question = this.question();
        const key = question === null ? null : JSON.stringify([this.studio.request(), question]);
        if (key === null) {
            this.shown = null;
            this.body.replaceChildren(empty(this.missing()));
            return;
        }
        if (key === this.shown) return;
        this.body.classList.toggle("is-old", this.shown !== null);
        this.shown = key;
        if (this.body.childElementCount === 0) this.body.replaceChildren(empty("Asking …"));
        clearTimeout(this.timer);
        this.timer = setTimeout(() => void this.refresh(key), WAIT_MS);
    }

    private async refresh(key: string): Promise<void> {
        try {
            const report = await this.ask();
            if (key !== this.shown) return;
            const error = report.diagnostics.find((one) => one.severity === "error");
            if (report.text === null && report.value === null) this.fail(error?.message ?? this.missing());
            else this.body.replaceChildren(...this.show(report));
        } catch (why) {
            if (why instanceof Superseded || key !== this.shown) return;
            this.fail(why instanceof Error ? why.message : String(why));
        }
        this.body.classList.remove("is-old");
    }

    private fail(why: string): void {
        this.body.replaceChildren(empty(why));
    }
}

/** What stands where there is nothing to show. */
export function empty(text: string): HTMLElement {
    return el("div", { class: "empty" }, el("p", {}, text));
}

/** A table; numbers are to the right. */
export function table(caption: string, head: string[], rows: (string | number | null)[][]): HTMLElement {
    const cell = (one: string | number | null) => el("td", typeof one === "number" ? { class: "number" } : {}, one === null ? "" : String(one));
    return el(
        "div",
        { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
        el(
            "table",
            {},
            el("caption", { class: "unseen" }, caption),
            el("thead", {}, el("tr", {}, ...head.map((one) => el("th", { scope: "col" }, one)))),
            el("tbody", {}, ...rows.map((row) => el("tr", {}, ...row.map(cell)))),
        ),
    );
}

/** The text as the command line prints it. */
export function printed(text: string, label: string): HTMLElement {
    return el("pre", { class: "printed", tabindex: "0", role: "region", "aria-label": label }, text);
}
