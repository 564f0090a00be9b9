import { fresh, make, mark, write } from "./dom.js";
import type { Answered } from "./messages.js";
import { Newest } from "./newest.js";
import { elementName, type Reading, type Readings, shownText } from "./readings.js";

/** Sets an actuator to a value as people write it. */
export type SetActuator = (device: string, value: string) => Promise<Answered>;

/** One actuator: sliders or switches, a field for exact values, and what became of them. */
class Actuator {
    readonly row: HTMLElement;
    readonly #inputs: HTMLInputElement[];
    readonly #field: HTMLInputElement;
    readonly #error: HTMLElement;
    readonly #has = make("span", { class: "live-has" });
    readonly #newest = new Newest();

    constructor(
        readonly reading: Reading,
        readonly set: SetActuator,
        readonly verb: string,
    ) {
        const { device } = reading;
        const error = fresh("error");
        this.#error = make("p", { class: "live-error", id: error, role: "alert" });
        this.#inputs = Array.from({ length: device.elements }, (_, element) => this.#makeInput(element));
        this.#field = make("input", {
            type: "text",
            "aria-label": `Value of ${device.name}${device.unit === null ? "" : ` in ${device.unit}`}`,
            "aria-describedby": error,
            autocomplete: "off",
            spellcheck: "false",
            size: 8,
            placeholder: device.is_bool ? "true or false" : (device.unit ?? "value"),
        });
        const form = make(
            "form",
            { class: "live-exact", submit: (event: SubmitEvent) => this.#submit(event) },
            this.#field,
            make("button", { type: "submit", "aria-label": `Set ${device.name}` }, "Set"),
        );
        const rows = this.#inputs.map((input, element) =>
            make("div", { class: "live-row" }, make("label", { for: input.id }, elementName(device, element)), input),
        );
        this.row = make(
            "div",
            { class: "live-actuator", role: "group", "aria-label": device.name, "data-actuator": device.name },
            ...rows,
            make("div", { class: "live-below" }, form, this.#has),
            this.#error,
        );
    }

    #makeInput(element: number): HTMLInputElement {
        const { device } = this.reading;
        const id = fresh("actuator");
        if (device.is_bool) return make("input", { type: "checkbox", role: "switch", id, change: () => this.#moved() });
        const { min, max, step } = device.slider;
        const input = make("input", { type: "range", id, min, max, step, input: () => this.#moved() });
        input.value = `${Math.min(Math.max(0, min), max)}`;
        mark(input, "aria-valuetext", shownText(device, [input.valueAsNumber]));
        mark(input, "data-element", `${element}`);
        return input;
    }

    #moved(): void {
        const { device } = this.reading;
        const words = this.#inputs.map((input) => (device.is_bool ? `${input.checked}` : input.value));
        if (!device.is_bool) {
            for (const input of this.#inputs) mark(input, "aria-valuetext", shownText(device, [input.valueAsNumber]));
        }
        this.#field.value = words.join(" ");
        this.#send(words.join(" "));
    }

    #submit(event: SubmitEvent): void {
        event.preventDefault();
        const value = this.#field.value.trim();
        if (value === "") this.#field.focus();
        else this.#send(value);
    }

    #send(value: string): void {
        const { name } = this.reading.device;
        this.#newest.run(name, async () => {
            const answered = await this.set(name, value).catch((error) => ({ error: String(error), text: null }));
            write(this.#error, answered.error === null ? "" : `Not sent: ${answered.error}`);
            mark(this.#field, "aria-invalid", answered.error === null ? null : "true");
        });
    }

    /** Shows what the board has; a slider follows it unless somebody is at it. */
    update(): void {
        const { device, numbers, text, time_ms, hardware } = this.reading;
        if (time_ms === null) {
            write(this.#has, "not set");
            return;
        }
        write(this.#has, `${this.verb} ${text}${hardware === "" ? "" : ` (${hardware})`}`);
        for (const [element, input] of this.#inputs.entries()) {
            const number = numbers[element] ?? null;
            if (number === null || document.activeElement === input) continue;
            if (device.is_bool) input.checked = number !== 0;
            else {
                input.value = `${number}`;
                mark(input, "aria-valuetext", shownText(device, [number]));
            }
        }
    }
}

/** All actuators of a board. */
export class Actuators {
    readonly element: HTMLElement;
    readonly #all: Actuator[];

    constructor(readings: Readings, set: SetActuator, verb: string) {
        const actuators = readings.all.filter((one) => one.device.direction === "actuator");
        this.#all = actuators.map((one) => new Actuator(one, set, verb));
        this.element = make("div", { class: "live-rows" }, ...this.#all.map((one) => one.row));
        if (this.#all.length === 0) this.element.append(make("p", { class: "live-hint" }, "The board has no actuators."));
    }

    update(): void {
        for (const one of this.#all) one.update();
    }
}
