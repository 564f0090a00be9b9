// Why a part is on its pins: of the part that the cursor is in.

import type { Report } from "../../../crates/wasm/sensedsl.mjs";
import { el } from "../ui/dom";
import { printed, ReportView } from "./report";

export class Why extends ReportView {
    readonly id = "why";
    readonly title = "Why";
    private readonly select = el("select", { id: "why-part", onchange: () => this.choose() });
    private name: string | null = null;
    private isChosen = false;

    protected override head(): HTMLElement[] {
        return [el("div", { class: "choice" }, el("label", { for: "why-part" }, "Why is it on its pins?"), this.select)];
    }

    private choose(): void {
        this.name = this.select.value;
        this.isChosen = true;
        this.update();
        this.isChosen = false;
    }

    override update(): void {
        const names = (this.studio.wiring?.parts ?? []).map((part) => part.name);
        const here = this.studio.here()[0];
        if (here !== undefined && !this.isChosen) this.name = here;
        if (this.name === null || !names.includes(this.name)) this.name = names[0] ?? null;
        const options = [...this.select.options].map((one) => one.value);
        if (options.join() !== names.join()) this.select.replaceChildren(...names.map((name) => el("option", { value: name }, name)));
        if (this.name !== null) this.select.value = this.name;
        super.update();
    }

    protected question(): object | null {
        return this.name === null ? null : { name: this.name };
    }

    protected ask(): Promise<Report> {
        return this.studio.tool.call("why", [{ ...this.studio.request(), name: this.name ?? "" }], "why");
    }

    protected show({ text }: Report): HTMLElement[] {
        return [printed(text ?? "", `Why ${this.name}`)];
    }

    protected missing(): string {
        return "No part has pins yet.";
    }
}
