// The divider between text and views: by mouse, and by arrow keys.

const LEAST = 20;
const MOST = 80;
const STEP = 2;
const KEY = "sensedsl.width";

/** Lets the divider set the width of the text, in per cent of the page. */
export function mountDivider(divider: HTMLElement): void {
    const set = (percent: number) => {
        const width = Math.min(MOST, Math.max(LEAST, percent));
        document.documentElement.style.setProperty("--text-width", `${width}%`);
        divider.setAttribute("aria-valuenow", String(Math.round(width)));
        try {
            localStorage.setItem(KEY, String(width));
        } catch {
            // It lasts as long as the page.
        }
    };
    const now = () => Number(divider.getAttribute("aria-valuenow"));
    try {
        const kept = Number(localStorage.getItem(KEY));
        if (kept > 0) set(kept);
    } catch {
        // As wide as it is.
    }
    divider.addEventListener("keydown", (event) => {
        const steps: Record<string, number> = { ArrowLeft: now() - STEP, ArrowRight: now() + STEP, Home: LEAST, End: MOST };
        const next = steps[event.key];
        if (next === undefined) return;
        event.preventDefault();
        set(next);
    });
    divider.addEventListener("pointerdown", (event) => {
        divider.setPointerCapture(event.pointerId);
        event.preventDefault();
    });
    divider.addEventListener("pointermove", (event) => {
        if (divider.hasPointerCapture(event.pointerId)) set((event.clientX / innerWidth) * 100);
    });
}
