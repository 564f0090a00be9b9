import type { Diagnostic } from "../../../crates/wasm/sensedsl.mjs";
import { make } from "./dom.js";

const SHOWN_MAX = 5;

/** A box above the view that says what has happened and what can be done about it. */
export class Banner {
    readonly element = make("div", { class: "live-banner", hidden: true });

    /** Shows a text, what helps, and buttons. */
    show(kind: "info" | "error", text: string, help: string, ...buttons: HTMLElement[]): void {
        this.element.replaceChildren(make("p", {}, make("strong", {}, text), help === "" ? null : ` ${help}`));
        if (buttons.length > 0) this.element.append(make("div", { class: "live-bar" }, ...buttons));
        this.#open(kind);
    }

    /** Shows why a text has no board. */
    wrong(text: string, diagnostics: readonly Diagnostic[]): void {
        const errors = diagnostics.filter((one) => one.severity === "error");
        const items = errors.slice(0, SHOWN_MAX).map((one) => make("li", {}, `${one.code}: ${one.message}`));
        const more = errors.length - items.length;
        if (errors.length === 0) items.push(make("li", {}, "It has no board with devices."));
        if (more > 0) items.push(make("li", {}, `and ${more} more`));
        this.element.replaceChildren(make("p", {}, make("strong", {}, text)), make("ul", {}, ...items));
        this.#open("error");
    }

    /** Shows a text and a list. */
    list(text: string, help: string, lines: readonly string[]): void {
        const items = lines.map((one) => make("li", {}, one));
        this.element.replaceChildren(make("p", {}, make("strong", {}, text), ` ${help}`), make("ul", {}, ...items));
        this.#open("error");
    }

    hide(): void {
        this.element.hidden = true;
        this.element.replaceChildren();
    }

    #open(kind: "info" | "error"): void {
        this.element.dataset.kind = kind;
        this.element.hidden = false;
    }
}
