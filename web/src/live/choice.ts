import { make } from "./dom.js";

/** A choice of names, which is there only if there is something to choose. */
export class Choice {
    readonly element: HTMLElement;
    readonly #select: HTMLSelectElement;
    #names: readonly (readonly [string, string])[] = [];
    /** Whether somebody has chosen what is chosen. */
    #isChosen = false;

    constructor(label: string, changed: () => void) {
        const choose = () => {
            this.#isChosen = true;
            changed();
        };
        this.#select = make("select", { change: choose });
        this.element = make("label", { hidden: true }, `${label} `, this.#select);
    }

    /** What is chosen; empty where there is nothing to choose. */
    get value(): string {
        return this.element.hidden ? "" : this.#select.value;
    }

    /**
     * Offers values with their names. What somebody has chosen stays so while it is there, and some value that was
     * offered with it; otherwise the usual one is chosen.
     */
    offer(names: readonly (readonly [string, string])[], usual = names[0]?.[0] ?? ""): void {
        this.element.hidden = names.length < 2;
        const { value } = this.#select;
        if (JSON.stringify(names) !== JSON.stringify(this.#names)) {
            const had = new Set(this.#names.map(([one]) => one).filter((one) => one !== ""));
            this.#isChosen &&= names.some(([one]) => had.has(one)) && names.some(([one]) => one === value);
            this.#names = names;
            this.#select.replaceChildren(...names.map(([one, name]) => make("option", { value: one }, name)));
        }
        this.#select.value = this.#isChosen ? value : usual;
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
