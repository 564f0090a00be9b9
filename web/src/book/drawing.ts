// The picture of a listing's wiring. It is in a shadow tree, where its rules meet no others; what it has for dark screens
// is for the dark theme of the book.

import { rulesOf, undressed } from "../picture/rules";
import { button, el } from "../ui/dom";

/** The themes of the book that are light. */
const LIGHT = ["light", "rust"];

/** By how much more room a larger picture has at least. */
const LARGER = 1.5;

function isDark(): boolean {
    return !LIGHT.some((one) => document.documentElement.classList.contains(one));
}

export class Drawing {
    private readonly size = button("Larger", () => this.resize(!this.isLarge), { "aria-pressed": "false" });
    private readonly frame = el("div", { class: "playground-picture", tabindex: "0", role: "region", "aria-label": "Picture of the wiring" });
    readonly host = el("div", { class: "playground-view", hidden: true }, this.size, this.frame);
    private isLarge = false;
    private readonly inside = el("div", { class: "playground-drawing" });
    private readonly sheets = { own: new CSSStyleSheet(), always: new CSSStyleSheet(), dark: new CSSStyleSheet() };
    private readonly watch = new MutationObserver(() => this.dress());
    private source = "";

    constructor() {
        const shadow = this.inside.attachShadow({ mode: "open" });
        this.sheets.own.replaceSync("svg { display: block; width: 100%; height: auto; }");
        shadow.adoptedStyleSheets = [this.sheets.own, this.sheets.always, this.sheets.dark];
        this.frame.append(this.inside);
        this.watch.observe(document.documentElement, { attributes: true, attributeFilter: ["class"] });
        this.dress();
    }

    private dress(): void {
        this.sheets.dark.disabled = !isDark();
    }

    draw(svg: string): void {
        if (svg === this.source) return;
        this.source = svg;
        const { text, rules } = undressed(svg);
        const { always, dark } = rulesOf(rules);
        this.sheets.always.replaceSync(always);
        this.sheets.dark.replaceSync(dark);
        const parsed = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
        for (const script of parsed.querySelectorAll("script")) script.remove();
        this.inside.shadowRoot?.replaceChildren(document.importNode(parsed, true));
        this.host.hidden = false;
        this.resize(this.isLarge);
    }

    /** As wide as the page has room, or so large that all of it can be read. */
    private resize(isLarge: boolean): void {
        this.isLarge = isLarge;
        this.size.setAttribute("aria-pressed", String(isLarge));
        const own = this.inside.shadowRoot?.querySelector("svg")?.viewBox.baseVal.width ?? 0;
        const width = Math.max(own, this.frame.clientWidth * LARGER);
        this.inside.style.width = isLarge ? `${width}px` : "";
    }

    end(): void {
        this.watch.disconnect();
    }
}
