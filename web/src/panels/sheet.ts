// The wiring sheet: to print, and to tick off at the bench.

import type { Report } from "../../../crates/wasm/sensedsl.mjs";
import { button, el } from "../ui/dom";
import { undressed } from "../picture/rules";
import { nameOf } from "../project/commands";
import { ReportView } from "./report";

export class Sheet extends ReportView {
    readonly id = "sheet";
    readonly title = "Sheet";
    private frame: HTMLIFrameElement | undefined;
    private text: string | null = null;

    protected override head(): HTMLElement[] {
        const print = () => this.frame?.contentWindow?.print();
        const keep = () => {
            const name = `${nameOf(this.studio.request().path)}.html`;
            if (this.text !== null) this.studio.save(name, new TextEncoder().encode(this.text), "text/html");
        };
        return [el("div", { class: "choice" }, button("Print", print, { class: "main" }), button("Download", keep))];
    }

    protected question(): object {
        return {};
    }

    protected ask(): Promise<Report> {
        return this.studio.tool.call("report", [{ ...this.studio.request(), report: "sheet" }], "sheet");
    }

    protected show({ text }: Report): HTMLElement[] {
        this.text = text;
        // No script of it runs, and its rules, which the page's policy does not let in as elements, are given as sheets.
        const { text: body, rules } = undressed(text ?? "");
        const parsed = new DOMParser().parseFromString(body, "text/html");
        const frame = el("iframe", { class: "sheet", sandbox: "allow-same-origin allow-modals", title: "Wiring sheet" });
        const fill = () => {
            const inside = frame.contentDocument;
            const view = frame.contentWindow as (Window & typeof globalThis) | null;
            if (!inside || !view) return;
            const sheet = new view.CSSStyleSheet();
            sheet.replaceSync(rules);
            inside.replaceChild(inside.adoptNode(parsed.documentElement), inside.documentElement);
            inside.adoptedStyleSheets = [sheet];
        };
        this.frame = frame;
        queueMicrotask(fill);
        return [frame];
    }

    protected missing(): string {
        return "There is no wiring to print yet.";
    }
}
