// Light or dark: what the system prefers, unless somebody has chosen.

const KEY = "sensedsl.theme";
const prefers = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set<(isDark: boolean) => void>();

function chosen(): string | null {
    try {
        return localStorage.getItem(KEY);
    } catch {
        return null;
    }
}

/** Whether the page is dark now. */
export function isDark(): boolean {
    const choice = document.documentElement.dataset["theme"];
    return choice === undefined ? prefers.matches : choice === "dark";
}

function tell(): void {
    for (const one of listeners) one(isDark());
}

/** Tells whether the page is dark, now and when it changes; returns a function that ends it. */
export function onTheme(listener: (isDark: boolean) => void): () => void {
    listeners.add(listener);
    listener(isDark());
    return () => listeners.delete(listener);
}

/** Changes between light and dark, and keeps the choice. */
export function toggleTheme(): void {
    const next = isDark() ? "light" : "dark";
    document.documentElement.dataset["theme"] = next;
    try {
        localStorage.setItem(KEY, next);
    } catch {
        // The choice lasts as long as the page.
    }
    tell();
}

const choice = chosen();
if (choice === "light" || choice === "dark") document.documentElement.dataset["theme"] = choice;
prefers.addEventListener("change", tell);
