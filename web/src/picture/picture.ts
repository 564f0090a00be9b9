// The picture of the wiring: draws it, marks what the cursor is in, tells what is clicked.

import { el } from "../ui/dom";
import { onTheme } from "../ui/theme";
import { rulesOf, undressed } from "./rules";

const STEP = 1.25;
const ZOOM_MIN = 0.2;
const ZOOM_MAX = 5;

/** What happens in the picture. */
export interface PictureListener {
    /** A part was chosen; `isByKey`: by the keyboard, which stays in the picture. */
    picked(name: string, isByKey: boolean): void;
    /** Another picture was drawn. */
    drawn(svg: SVGSVGElement): void;
}

/** The parts that an element of the picture belongs to. */
export function partsOf(element: Element): string[] {
    const box = element.getAttribute("data-part");
    return box === null ? (element.getAttribute("data-parts") ?? "").split(/[ ,]+/).filter(Boolean) : [box];
}

export class Picture {
    readonly host = el("div", { class: "picture", tabindex: "-1" });
    private readonly sheets = { always: new CSSStyleSheet(), dark: new CSSStyleSheet() };
    private source: string | null = null;
    private names: string[] = [];
    private zoomed: number | undefined;
    private fit = el("button", { type: "button", title: "As wide as the view", "aria-pressed": "true", onclick: () => this.resize(undefined) }, "Fit");
    readonly tools = el(
        "div",
        { class: "zoom", role: "group", "aria-label": "Size of the picture" },
        el("button", { type: "button", "aria-label": "Smaller", title: "Smaller", onclick: () => this.zoom(1 / STEP) }, "−"),
        this.fit,
        el("button", { type: "button", "aria-label": "Larger", title: "Larger", onclick: () => this.zoom(STEP) }, "+"),
    );

    constructor(private readonly listener: PictureListener) {
        document.adoptedStyleSheets.push(this.sheets.always, this.sheets.dark);
        onTheme((isDark) => {
            this.sheets.dark.disabled = !isDark;
        });
        this.host.addEventListener("click", (event) => this.pick(event.target, false));
        this.host.addEventListener("keydown", (event) => {
            const isOurs = event.key === "Enter" || event.key === " ";
            if (isOurs && this.pick(event.target, true)) event.preventDefault();
        });
        this.host.addEventListener(
            "wheel",
            (event) => {
                if (!event.ctrlKey) return;
                event.preventDefault();
                this.zoom(event.deltaY < 0 ? STEP : 1 / STEP);
            },
            { passive: false },
        );
    }

    get svg(): SVGSVGElement | null {
        return this.host.querySelector<SVGSVGElement>(":scope > svg");
    }

    /** Draws a picture; `known` are the parts that stand in the text. */
    draw(svg: string, known: string[]): void {
        if (svg !== this.source) {
            this.source = svg;
            this.replace(svg);
        }
        this.enable(known);
        this.mark(this.names);
    }

    /** Says that the picture is not of the text as it is. */
    age(isOld: boolean): void {
        this.host.classList.toggle("is-old", isOld && this.source !== null);
    }

    get isEmpty(): boolean {
        return this.source === null;
    }

    /** Shows something else where there is no picture. */
    empty(...instead: HTMLElement[]): void {
        this.source = null;
        this.host.replaceChildren(el("div", { class: "empty" }, ...instead));
    }

    private replace(svg: string): void {
        // Already a parser refuses a style element, by the policy of the page.
        const { text, rules } = undressed(svg);
        const parsed = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
        this.dress(rules);
        for (const script of parsed.querySelectorAll("script")) script.remove();
        for (const wire of parsed.querySelectorAll("path[data-parts]")) {
            const hit = wire.cloneNode() as Element;
            hit.setAttribute("class", "hit");
            wire.before(hit);
        }
        const drawn = document.importNode(parsed, true) as unknown as SVGSVGElement;
        // It has buttons inside, which an image cannot have.
        drawn.setAttribute("role", "group");
        drawn.setAttribute("aria-label", "Wiring");
        drawn.querySelector(":scope > title")?.remove();
        this.host.replaceChildren(drawn);
        this.resize(this.zoomed);
        this.listener.drawn(drawn);
    }

    /** Takes the picture's own rules: what it has for dark screens is for the dark theme here. */
    private dress(css: string): void {
        const texts = rulesOf(css);
        this.sheets.always.replaceSync(texts.always);
        this.sheets.dark.replaceSync(texts.dark);
    }

    /** Makes buttons of what stands in the text. */
    private enable(known: string[]): void {
        for (const element of this.host.querySelectorAll("[data-part], [data-parts]")) {
            element.classList.toggle("is-known", partsOf(element).some((name) => known.includes(name)));
        }
        for (const box of this.host.querySelectorAll("[data-part].is-known")) {
            box.setAttribute("tabindex", "0");
            box.setAttribute("role", "button");
            box.setAttribute("aria-description", "Go to its text");
        }
    }

    private resize(zoomed: number | undefined): void {
        this.zoomed = zoomed;
        this.fit.setAttribute("aria-pressed", String(zoomed === undefined));
        const { svg } = this;
        if (!svg) return;
        svg.removeAttribute("height");
        svg.setAttribute("width", zoomed === undefined ? "100%" : String(svg.viewBox.baseVal.width * zoomed));
    }

    private zoom(by: number): void {
        const { svg } = this;
        if (!svg) return;
        const now = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
        this.resize(Math.min(ZOOM_MAX, Math.max(ZOOM_MIN, now * by)));
    }

    /** Marks the boxes and wires of the parts that the cursor is in. */
    mark(names: string[]): void {
        this.names = names;
        const { svg } = this;
        if (!svg) return;
        let isAny = false;
        for (const element of svg.querySelectorAll("[data-part], [data-parts]")) {
            const isMarked = partsOf(element).some((name) => names.includes(name));
            element.classList.toggle("is-marked", isMarked);
            isAny ||= isMarked;
        }
        svg.classList.toggle("has-marked", isAny);
    }

    private pick(target: EventTarget | null, isByKey: boolean): boolean {
        const element = target instanceof Element ? target.closest(".is-known") : null;
        if (!element) return false;
        const of = partsOf(element);
        // A wire of several parts goes from one of them to the next.
        const name = of[(of.findIndex((one) => this.names.includes(one)) + 1) % of.length];
        if (name !== undefined) this.listener.picked(name, isByKey);
        return true;
    }
}
