// Dialogs and menus: one at a time, closed by Escape, and the focus goes back to where it was.

import { button, el } from "./dom";

/** A dialog with a title; the function closes it. */
export function dialog(title: string, ...children: HTMLElement[]): { host: HTMLDialogElement; close: () => void } {
    const close = () => host.close();
    const host = el(
        "dialog",
        { class: "dialog", "aria-labelledby": "dialog-title" },
        el("div", { class: "dialog-head" }, el("h2", { id: "dialog-title" }, title), button("×", close, { class: "quiet", "aria-label": "Close" })),
        ...children,
    );
    const before = document.activeElement;
    host.addEventListener("close", () => {
        host.remove();
        if (before instanceof HTMLElement) before.focus();
    });
    host.addEventListener("click", (event) => {
        if (event.target === host) close();
    });
    document.body.append(host);
    host.showModal();
    return { host, close };
}

/** Asks for a line of text; `check` says what is wrong with it. Null if the dialog was closed. */
export function ask(title: string, label: string, value: string, check: (text: string) => string | null = () => null): Promise<string | null> {
    return new Promise((resolve) => {
        const input = el("input", { id: "asked", type: "text", value, autocomplete: "off", spellcheck: "false", "aria-describedby": "asked-wrong" });
        const wrong = el("p", { id: "asked-wrong", class: "wrong", role: "alert" });
        let answer: string | null = null;
        const form = el(
            "form",
            {
                onsubmit: (event: SubmitEvent) => {
                    event.preventDefault();
                    const text = input.value.trim();
                    const why = text === "" ? "Write something." : check(text);
                    wrong.textContent = why ?? "";
                    if (why !== null) return;
                    answer = text;
                    close();
                },
            },
            el("label", { for: "asked" }, label),
            input,
            wrong,
            el("div", { class: "actions" }, button("Cancel", () => close()), el("button", { type: "submit", class: "main" }, "OK")),
        );
        const { host, close } = dialog(title, form);
        host.addEventListener("close", () => resolve(answer));
        input.focus();
        const dot = value.lastIndexOf(".");
        input.setSelectionRange(0, dot > 0 ? dot : value.length);
    });
}

/** Asks whether something shall be done. */
export function confirm(title: string, text: string, yes: string): Promise<boolean> {
    return new Promise((resolve) => {
        let answer = false;
        const agree = () => {
            answer = true;
            close();
        };
        const { host, close } = dialog(title, el("p", {}, text), el("div", { class: "actions" }, button("Cancel", () => close()), button(yes, agree, { class: "main" })));
        host.addEventListener("close", () => resolve(answer));
        host.querySelector<HTMLElement>(".main")?.focus();
    });
}

/** Something that a menu offers. */
export interface Choice {
    title: string;
    /** More about it, on a line of its own. */
    about?: string;
    run(): void;
}

/** A menu at a place of the window. */
export function menu(label: string, at: { x: number; y: number }, choices: Choice[]): void {
    const before = document.activeElement;
    const host = el("div", { class: "menu", role: "menu", "aria-label": label, popover: "auto" });
    for (const { title, about, run } of choices) {
        const choose = () => {
            host.hidePopover();
            run();
        };
        host.append(el("button", { type: "button", role: "menuitem", tabindex: "-1", onclick: choose }, title, about ? el("small", {}, about) : null));
    }
    const items = [...host.querySelectorAll("button")];
    host.addEventListener("keydown", (event) => {
        const now = items.indexOf(document.activeElement as HTMLButtonElement);
        const steps: Record<string, number> = { ArrowDown: now + 1, ArrowUp: now - 1 + items.length, Home: 0, End: items.length - 1 };
        const next = steps[event.key];
        if (next !== undefined) items[next % items.length]?.focus();
        if (event.key === "Tab") host.hidePopover();
        if (next !== undefined) event.preventDefault();
    });
    host.addEventListener("toggle", (event) => {
        if ((event as ToggleEvent).newState !== "closed") return;
        const isInside = host.contains(document.activeElement) || document.activeElement === document.body;
        host.remove();
        if (isInside && before instanceof HTMLElement) before.focus();
    });
    document.body.append(host);
    host.showPopover();
    const { width, height } = host.getBoundingClientRect();
    host.style.left = `${Math.max(8, Math.min(at.x, innerWidth - width - 8))}px`;
    host.style.top = `${Math.max(8, at.y + height > innerHeight - 8 ? at.y - height - 24 : at.y)}px`;
    items[0]?.focus();
}
