// Tabs: one list, by mouse and by arrow keys; a panel is made when it is first shown.

import { el } from "./dom";

/** A view of the project, in a tab. */
export interface View {
    id: string;
    title: string;
    /** Makes its elements, once. */
    mount(host: HTMLElement): void;
    /** Called when it is shown, and while it is when something has changed. */
    update?(): void;
}

export class Tabs {
    private readonly buttons = new Map<string, HTMLButtonElement>();
    private readonly panels = new Map<string, HTMLElement>();
    private readonly mounted = new Set<string>();
    current = "";

    constructor(
        private readonly list: HTMLElement,
        panels: HTMLElement,
        private readonly views: View[],
    ) {
        for (const { id, title } of views) {
            const tab = el("button", { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, "aria-selected": "false", tabindex: "-1", onclick: () => this.show(id) }, title);
            const panel = el("div", { role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}`, tabindex: "0", hidden: true });
            this.buttons.set(id, tab);
            this.panels.set(id, panel);
            list.append(tab);
            panels.append(panel);
        }
        list.addEventListener("keydown", (event) => this.step(event));
    }

    private step(event: KeyboardEvent): void {
        const ids = this.views.map((view) => view.id);
        const at = ids.indexOf(this.current);
        const steps: Record<string, number> = { ArrowRight: at + 1, ArrowLeft: at - 1 + ids.length, Home: 0, End: ids.length - 1 };
        const next = steps[event.key];
        const id = next === undefined ? undefined : ids[next % ids.length];
        if (id === undefined) return;
        event.preventDefault();
        this.show(id);
        this.buttons.get(id)?.focus();
    }

    show(id: string): void {
        this.current = id;
        for (const [one, tab] of this.buttons) {
            const isShown = one === id;
            tab.setAttribute("aria-selected", String(isShown));
            tab.tabIndex = isShown ? 0 : -1;
            const panel = this.panels.get(one);
            if (panel) panel.hidden = !isShown;
            // Only in the list itself: the page does not move.
            if (isShown) this.list.scrollTo({ left: tab.offsetLeft - this.list.clientWidth / 2 + tab.offsetWidth / 2 });
        }
        const view = this.views.find((one) => one.id === id);
        const panel = this.panels.get(id);
        if (!view || !panel) return;
        if (!this.mounted.has(id)) {
            this.mounted.add(id);
            view.mount(panel);
        }
        view.update?.();
    }

    /** Tells the shown view that something has changed. */
    update(): void {
        this.views.find((one) => one.id === this.current)?.update?.();
    }
}
