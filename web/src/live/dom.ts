/** Makes elements of the panels. */

type Made = { [key: string]: string | number | boolean | ((event: never) => void) | undefined };
type Child = Node | string | null;

/**
 * An element with attributes and children. What is a function becomes a listener; true is an attribute without a value,
 * and false or undefined is none.
 */
export function make<Tag extends keyof HTMLElementTagNameMap>(
    tag: Tag,
    attributes: Made = {},
    ...children: Child[]
): HTMLElementTagNameMap[Tag] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") element.addEventListener(name, value as EventListener);
        else if (value === true) element.setAttribute(name, "");
        else if (value !== false && value !== undefined) element.setAttribute(name, `${value}`);
    }
    element.append(...children.filter((one) => one !== null));
    return element;
}

/** A shape of a drawing, with attributes and shapes inside. */
export function shape(tag: string, attributes: { [key: string]: string | number } = {}, ...children: Node[]): SVGElement {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, `${value}`);
    element.append(...children);
    return element;
}

/** A button that does something. */
export function button(label: string, click: () => void, attributes: Made = {}): HTMLButtonElement {
    return make("button", { type: "button", click, ...attributes }, label);
}

/** Writes a text only where it is another one, so that nothing is laid out or read out in vain. */
export function write(element: Element, text: string): void {
    if (element.textContent !== text) element.textContent = text;
}

/** Sets an attribute only where it is another one; null takes it away. */
export function mark(element: Element, name: string, value: string | null): void {
    if (element.getAttribute(name) === value) return;
    if (value === null) element.removeAttribute(name);
    else element.setAttribute(name, value);
}

let last = 0;
/** A name for an element that no other has. */
export function fresh(stem: string): string {
    last += 1;
    return `live-${stem}-${last}`;
}

/** A part of a panel with a heading. */
export function section(title: string, ...children: Child[]): HTMLElement {
    const id = fresh("part");
    return make("section", { class: "live-part", "aria-labelledby": id }, make("h2", { id }, title), ...children);
}

/** Time for people: seconds with a digit, or minutes and seconds. */
export function shownTime(time_ms: number): string {
    const seconds = time_ms / 1_000;
    if (Math.abs(seconds) < 60) return `${seconds.toFixed(1)} s`;
    const minutes = Math.floor(seconds / 60);
    return `${minutes} min ${Math.floor(seconds - minutes * 60)} s`;
}
