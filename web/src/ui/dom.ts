// Elements of the page, without markup in strings: no text of a user can become an element.

type Props = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;
type Child = Node | string | null | undefined | false;

/**
 * An element. Properties that begin with `on` are listeners, the others attributes: `true` is an empty one, `null` and
 * `false` none.
 */
export function el<Name extends keyof HTMLElementTagNameMap>(
    name: Name,
    props: Props = {},
    ...children: Child[]
): HTMLElementTagNameMap[Name] {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(props)) {
        if (typeof value === "function") made.addEventListener(key.slice(2), value as EventListener);
        else if (value === true) made.setAttribute(key, "");
        else if (value !== null && value !== undefined && value !== false) made.setAttribute(key, String(value));
    }
    made.append(...children.filter((one): one is Node | string => one !== null && one !== undefined && one !== false));
    return made;
}

/** The element of the page with that identifier. */
export function find(id: string): HTMLElement {
    const found = document.getElementById(id);
    if (!found) throw new Error(`the page has no #${id}`);
    return found;
}

/** A button with a text, or with what else is in it. */
export function button(text: string | (Node | string)[], onclick: () => void, more: Props = {}): HTMLButtonElement {
    return el("button", { type: "button", onclick, ...more }, ...(typeof text === "string" ? [text] : text));
}

let announced: ReturnType<typeof setTimeout> | undefined;

/** Says something to everybody who listens to the page with a screen reader. */
export function announce(text: string): void {
    const place = find("announcer");
    // The same text twice is said twice.
    place.textContent = "";
    clearTimeout(announced);
    announced = setTimeout(() => {
        place.textContent = text;
    }, 50);
}

/** A note in the corner, with what can be done about it; it stays until it is closed or replaced. */
export function note(text: string, actions: { title: string; run: () => void }[] = [], key = "note"): void {
    const host = find("notes");
    host.querySelector(`[data-key="${key}"]`)?.remove();
    const made = el("div", { class: "note", "data-key": key }, el("p", {}, text));
    const close = () => made.remove();
    const buttons = actions.map(({ title, run }) =>
        button(title, () => {
            close();
            run();
        }),
    );
    made.append(...buttons, button("×", close, { class: "quiet", "aria-label": "Close this note" }));
    host.append(made);
    announce(text);
    if (actions.length === 0) setTimeout(close, 6000);
}
