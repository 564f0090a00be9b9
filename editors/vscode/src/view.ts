// Runs in the view of the wiring: draws the picture, marks what the cursor is in, tells what is clicked.

import type { ToEditor, ToView } from "./talk";

declare function acquireVsCodeApi(): {
    postMessage(message: ToEditor): void;
    getState(): { uri?: string; zoom?: number } | undefined;
    setState(state: { uri?: string; zoom?: number }): void;
};

const STEP = 1.25;
const ZOOM_MIN = 0.2;
const ZOOM_MAX = 5;

const editor = acquireVsCodeApi();
const find = (id: string) => document.getElementById(id) as HTMLElement;
const picture = find("picture");
const why = find("why");
let state = editor.getState() ?? {};
let drawn: string | null = null;
let names: string[] = [];
const sheets = { always: new CSSStyleSheet(), dark: new CSSStyleSheet() };

function isDark(): boolean {
    const of = document.body.classList;
    return of.contains("vscode-dark") || (of.contains("vscode-high-contrast") && !of.contains("vscode-high-contrast-light"));
}

/** Takes the picture's own rules: what it has for dark screens is for dark themes here. */
function dress(css: string): void {
    const all = new CSSStyleSheet();
    all.replaceSync(css);
    const texts = { always: "", dark: "" };
    for (const rule of all.cssRules) {
        if (rule instanceof CSSMediaRule) texts.dark += [...rule.cssRules].map((one) => one.cssText).join("\n");
        else texts.always += rule.cssText;
    }
    sheets.always.replaceSync(texts.always);
    sheets.dark.replaceSync(texts.dark);
}

function theme(): void {
    document.adoptedStyleSheets = isDark() ? [sheets.always, sheets.dark] : [sheets.always];
}

function partsOf(element: Element): string[] {
    const box = element.getAttribute("data-part");
    return box === null ? (element.getAttribute("data-parts") ?? "").split(/[ ,]+/).filter(Boolean) : [box];
}

function draw(svg: string): void {
    if (svg === drawn) return;
    drawn = svg;
    const parsed = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
    const style = parsed.querySelector("style");
    dress(style?.textContent ?? "");
    style?.remove();
    for (const script of parsed.querySelectorAll("script")) script.remove();
    for (const wire of parsed.querySelectorAll("[data-parts]")) {
        const hit = wire.cloneNode() as Element;
        hit.setAttribute("class", "hit");
        wire.before(hit);
    }
    picture.replaceChildren(document.importNode(parsed, true));
    resize();
}

/** Makes buttons of what stands in the text. */
function enable(known: string[]): void {
    for (const element of picture.querySelectorAll("[data-part], [data-parts]")) {
        element.classList.toggle("is-known", partsOf(element).some((name) => known.includes(name)));
    }
    for (const box of picture.querySelectorAll("[data-part].is-known")) {
        box.setAttribute("tabindex", "0");
        box.setAttribute("role", "button");
        box.setAttribute("aria-label", `${box.getAttribute("data-part")}: go to its text`);
    }
}

/** Makes room for the picture: as wide as the view, or as large as was asked for. */
function resize(): void {
    const svg = picture.querySelector("svg");
    if (!svg) return;
    const width = svg.viewBox.baseVal.width;
    const isFit = state.zoom === undefined;
    svg.removeAttribute("height");
    svg.setAttribute("width", isFit ? "100%" : String(width * (state.zoom ?? 1)));
    find("fit").setAttribute("aria-pressed", String(isFit));
}

function zoom(by: number): void {
    const svg = picture.querySelector("svg");
    if (!svg) return;
    const now = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
    keep({ zoom: Math.min(ZOOM_MAX, Math.max(ZOOM_MIN, now * by)) });
    resize();
}

function keep(more: typeof state): void {
    state = { ...state, ...more };
    editor.setState(state);
}

/** Marks the boxes and wires of the parts that the cursor is in. */
function mark(): void {
    const svg = picture.querySelector("svg");
    let isAny = false;
    for (const element of svg?.querySelectorAll("[data-part], [data-parts]") ?? []) {
        const isMarked = partsOf(element).some((name) => names.includes(name));
        element.classList.toggle("is-marked", isMarked);
        isAny ||= isMarked;
    }
    svg?.classList.toggle("has-marked", isAny);
}

function take(message: ToView): void {
    if (message.type === "cursor") {
        names = message.names;
        mark();
        return;
    }
    const { svg, isCurrent, uri, name } = message;
    const isSame = state.uri === uri;
    keep({ uri });
    if (svg !== null) {
        draw(svg);
        enable(message.parts);
        mark();
    } else if (!isSame || drawn === null) {
        drawn = null;
        const empty = document.createElement("p");
        empty.id = "empty";
        empty.textContent = message.why ? `There is no wiring of ${name} yet.` : "Looking for a wiring …";
        picture.replaceChildren(empty);
    }
    document.body.classList.toggle("is-old", drawn !== null && (svg === null || !isCurrent));
    document.body.classList.toggle("is-wrong", message.why !== null);
    why.textContent = message.why?.split("\n")[0] ?? "";
    why.title = message.why ?? "";
}

function pick(target: EventTarget | null, isByKey: boolean): boolean {
    const element = target instanceof Element ? target.closest(".is-known") : null;
    if (!element) return false;
    const of = partsOf(element);
    // A wire of several parts goes from one of them to the next.
    const next = (of.findIndex((name) => names.includes(name)) + 1) % of.length;
    const name = of[next];
    if (name !== undefined) editor.postMessage({ type: "pick", name, isByKey });
    return true;
}

picture.addEventListener("click", (event) => pick(event.target, false));
picture.addEventListener("keydown", (event) => {
    if ((event.key === "Enter" || event.key === " ") && pick(event.target, true)) event.preventDefault();
});
picture.addEventListener(
    "wheel",
    (event) => {
        if (!event.ctrlKey) return;
        event.preventDefault();
        zoom(event.deltaY < 0 ? STEP : 1 / STEP);
    },
    { passive: false },
);
find("less").addEventListener("click", () => zoom(1 / STEP));
find("more").addEventListener("click", () => zoom(STEP));
find("fit").addEventListener("click", () => {
    keep({ zoom: undefined });
    resize();
});
new MutationObserver(theme).observe(document.body, { attributeFilter: ["class"] });
window.addEventListener("message", (event: MessageEvent<ToView>) => take(event.data));
theme();
editor.postMessage({ type: "ready" });
