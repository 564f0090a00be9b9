/** The panels "Run" and "Connect": the board of the text, simulated or real. */

import uplotCss from "uplot/dist/uPlot.min.css" with { type: "text" };
import { Connect } from "./connect.js";
import type { Live, LiveStudio } from "./contract.js";
import { make } from "./dom.js";
import css from "./live.css" with { type: "text" };
import { Run } from "./run.js";

export type { Live, LiveStudio } from "./contract.js";

/** Puts both panels into an element; the first is shown. */
export function mountLive(host: HTMLElement, studio: LiveStudio): Live {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(`${uplotCss}\n${css}`);
    document.adoptedStyleSheets.push(sheet);
    const panels = { run: new Run(studio), connect: new Connect(studio) };
    const root = make("div", { class: "live" }, panels.run.element, panels.connect.element);
    host.append(root);
    let shown: keyof typeof panels = "run";
    const show = (panel: keyof typeof panels) => {
        shown = panel;
        for (const [name, one] of Object.entries(panels)) one.element.hidden = name !== panel;
        panels[panel].shown();
    };
    show("run");
    const endTheme = studio.onTheme((isDark) => {
        root.dataset.theme = isDark ? "dark" : "light";
        for (const one of Object.values(panels)) one.setDark(isDark);
    });
    const endChange = studio.onChange(() => {
        for (const one of Object.values(panels)) one.changed();
    });
    const endFrames = frames(root, (now_ms) => panels[shown].frame(now_ms));
    return {
        show,
        dispose() {
            endTheme();
            endChange();
            endFrames();
            for (const one of Object.values(panels)) one.dispose();
            root.remove();
            document.adoptedStyleSheets = document.adoptedStyleSheets.filter((one) => one !== sheet);
        },
    };
}

/** A frame that is longer than this is late. */
const LATE_MS = 24;
/** The most of the time that is taken where frames are late. */
const PART = 0.5;

/**
 * Calls a function once a frame as long as an element is to be seen, and less often where frames come late after it, so
 * that the page answers on a slow machine as well. Returns a function that ends it.
 */
function frames(element: HTMLElement, work: (now_ms: number) => void): () => void {
    let handle = 0;
    let worked_ms = -Infinity;
    let wait_ms = 0;
    let hasWorked = false;
    const next = (now_ms: number) => {
        handle = requestAnimationFrame(next);
        // What the browser did between the last frame and this one is for the most part what was asked of it there.
        if (hasWorked) wait_ms = now_ms - worked_ms > LATE_MS ? (now_ms - worked_ms) / PART : 0;
        hasWorked = now_ms - worked_ms >= wait_ms;
        if (!hasWorked) return;
        worked_ms = now_ms;
        work(now_ms);
    };
    const observer = new IntersectionObserver((entries) => {
        cancelAnimationFrame(handle);
        hasWorked = false;
        if (entries.at(-1)?.isIntersecting) handle = requestAnimationFrame(next);
    });
    observer.observe(element);
    return () => {
        observer.disconnect();
        cancelAnimationFrame(handle);
    };
}
