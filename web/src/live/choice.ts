import { make } from "./dom.js";

/** A choice of names, which is there only if there is something to choose. */
export class Choice {
    readonly element: HTMLElement;
    readonly #select: HTMLSelectElement;
    #names: readonly (readonly [string, string])[] = [];

    constructor(label: string, changed: () => void) {
        this.#select = make("select", { change: changed });
        this.element = make("label", { hidden: true }, `${label} `, this.#select);
    }

    /** What is chosen; empty where there is nothing to choose. */
    get value(): string {
        return this.element.hidden ? "" : this.#select.value;
    }

    /** Offers values with their names; what was chosen stays so if it is still there. */
    offer(names: readonly (readonly [string, string])[]): void {
        this.element.hidden = names.length < 2;
        if (JSON.stringify(names) === JSON.stringify(this.#names)) return;
        this.#names = names;
        const { value } = this.#select;
        this.#select.replaceChildren(...names.map(([one, name]) => make("option", { value: one }, name)));
        this.#select.value = names.some(([one]) => one === value) ? value : (names[0]?.[0] ?? "");
    }
}

/** The boards of a design as values and names. */
export function boardNames(boards: readonly string[]): (readonly [string, string])[] {
    return boards.map((one) => [one, one]);
}

/** A name that was chosen, if the design still has it: another text has other boards. */
export function boardOf(files: Record<string, string>, name: string): string | undefined {
    // Names are letters, digits and underscores.
    const word = new RegExp(`\\b${name}\\b`);
    return name !== "" && Object.values(files).some((text) => word.test(text)) ? name : undefined;
}
