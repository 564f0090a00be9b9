// What every page of the documentation has: the button of a listing that can be run, and what mdBook's own script leaves
// undone. The playground itself comes when somebody wants it.

import { button } from "../ui/dom";
import type { Opened, Playground } from "./playground";

/** Names of files with the hash of their content; `book.mjs` puts them in. */
declare const PLAYGROUND_URL: string;
declare const PLAYGROUND_STYLE_URL: string;
declare const STUDIO_WASM_URL: string;
declare const STUDIO_WORKER_URL: string;

const script = document.currentScript as HTMLScriptElement;
const root = new URL(".", script.src);
const at = (path: string) => new URL(path, root).href;

/** The name of a listing that the page gives none. */
const UNNAMED = "robot.sense";

function textOf(listing: Element): string {
    return listing.querySelector("code")?.textContent ?? "";
}

/** Texts that the page names as files: those before a listing, then those after it. */
function files(listing: Element): Record<string, string> {
    const all: Record<string, string> = {};
    for (const other of document.querySelectorAll("pre[data-file]")) {
        const name = other.getAttribute("data-file") ?? "";
        const isBefore = Boolean(listing.compareDocumentPosition(other) & Node.DOCUMENT_POSITION_PRECEDING);
        if (other !== listing && (isBefore || !(name in all))) all[name] = textOf(other);
    }
    return all;
}

let loaded: Promise<Playground> | undefined;

/** The playground; it is fetched once. */
function playground(): Promise<Playground> {
    loaded ??= (async () => {
        globalThis.sensedslStudio = { wasm: at(`studio/${STUDIO_WASM_URL}`), worker: at(`studio/${STUDIO_WORKER_URL}`), page: at("studio/"), diagnostics: at("diagnostics.html") };
        const style = Object.assign(document.createElement("link"), { rel: "stylesheet", href: at(PLAYGROUND_STYLE_URL) });
        const dressed = new Promise((resolve) => style.addEventListener("load", resolve));
        document.head.append(style);
        const [found] = await Promise.all([import(at(PLAYGROUND_URL)) as Promise<Playground>, dressed]);
        return found;
    })();
    loaded.catch(() => {
        loaded = undefined;
    });
    return loaded;
}

/** Puts the button below a listing. */
function offer(listing: HTMLElement): void {
    const name = listing.dataset["file"] ?? UNNAMED;
    let opened: Opened | undefined;
    const close = () => {
        opened?.end();
        opened = undefined;
        listing.hidden = false;
        bar.hidden = false;
        start.focus();
    };
    const run = async () => {
        start.disabled = true;
        start.textContent = "Loading …";
        try {
            const { open } = await playground();
            opened = open({ name, text: textOf(listing), files: files(listing), after: bar, close });
            listing.hidden = true;
            bar.hidden = true;
            said.textContent = "";
        } catch (why) {
            const isFile = location.protocol === "file:";
            said.textContent = isFile ? "A browser runs this only from a server." : `It did not load: ${String(why)}`;
        }
        start.disabled = false;
        start.textContent = "Try it";
    };
    const start = button("Try it", () => void run(), { class: "try", "aria-label": `Try it: edit ${name} and see its wiring` });
    const said = document.createElement("span");
    said.setAttribute("role", "status");
    const bar = document.createElement("div");
    bar.className = "try-bar";
    bar.append(start, said);
    // mdBook has put its own buttons and the listing into one element, if it has.
    listing.after(bar);
}

/** What does not fit is scrolled, by keyboard as well. */
function reach(): void {
    for (const one of document.querySelectorAll<HTMLElement>(".table-wrapper, pre > code")) {
        const isWide = one.scrollWidth > one.clientWidth;
        if (isWide) one.tabIndex = 0;
        else one.removeAttribute("tabindex");
    }
}

/** The list of pages: mdBook switches it by a label, for which this site has a button. */
function enableList(): void {
    const toggle = document.getElementById("mdbook-sidebar-toggle");
    toggle?.addEventListener("click", () => document.getElementById("mdbook-sidebar-toggle-anchor")?.click());
}

enableList();
for (const listing of document.querySelectorAll<HTMLElement>("pre[data-run]")) offer(listing);
reach();
addEventListener("resize", reach);
