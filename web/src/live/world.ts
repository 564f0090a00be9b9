import { button, fresh, make, mark, write } from "./dom.js";
import { Newest } from "./newest.js";
import { type Device, elementName, type Reading, type Readings, shownText } from "./readings.js";

/** Holds an element of a sensor at a value, or lets the world have it again. */
export type Steer = (device: string, element: number, shown: number | null) => Promise<void>;

/** One quantity of the world. */
class Quantity {
    readonly row: HTMLElement;
    readonly #input: HTMLInputElement;
    readonly #output = make("output", { class: "live-number" });
    readonly #toggle: HTMLButtonElement;
    readonly #device: Device;
    #isHeld = false;

    constructor(
        readonly reading: Reading,
        readonly element: number,
        readonly steer: (shown: number | null) => void,
    ) {
        const { device } = reading;
        this.#device = device;
        const name = elementName(device, element);
        const id = fresh("quantity");
        this.#input = device.is_bool ? this.#makeSwitch(id) : this.#makeSlider(id);
        this.#toggle = button("Hold", () => this.#hold(!this.#isHeld), {
            "aria-pressed": "false",
            "aria-label": `Hold ${name}`,
            title: "Holds the value at the slider; otherwise the simulated world moves it",
        });
        this.row = make(
            "div",
            { class: `live-row${device.is_bool ? " live-switch" : ""}`, "data-quantity": name },
            make("label", { for: id }, name),
            this.#input,
            this.#output,
            this.#toggle,
        );
    }

    #makeSlider(id: string): HTMLInputElement {
        const { min, max, step } = this.#device.slider;
        const input = make("input", { type: "range", id, min, max, step, input: () => this.#moved() });
        return input;
    }

    #makeSwitch(id: string): HTMLInputElement {
        return make("input", { type: "checkbox", role: "switch", id, change: () => this.#moved() });
    }

    get #shown(): number {
        return this.#device.is_bool ? Number(this.#input.checked) : this.#input.valueAsNumber;
    }

    #moved(): void {
        this.#isHeld = true;
        this.steer(this.#shown);
        this.#tell(shownText(this.#device, [this.#shown]));
    }

    #hold(isHeld: boolean): void {
        this.#isHeld = isHeld;
        this.steer(isHeld ? this.#shown : null);
        this.update();
    }

    #tell(text: string): void {
        write(this.#output, text);
        mark(this.#toggle, "aria-pressed", `${this.#isHeld}`);
        mark(this.row, "data-held", `${this.#isHeld}`);
        if (!this.#device.is_bool) mark(this.#input, "aria-valuetext", this.#isHeld ? `${text}, held` : text);
    }

    /** Follows the world unless it is held. Somebody who is at the slider is not disturbed. */
    update(): void {
        const number = this.reading.numbers[this.element] ?? null;
        const isMine = this.#isHeld || document.activeElement === this.#input;
        if (!isMine && number !== null) {
            if (this.#device.is_bool) this.#input.checked = number !== 0;
            else this.#input.value = `${number}`;
        }
        const shown = this.#isHeld ? this.#shown : number;
        this.#tell(shownText(this.#device, [shown]));
    }

    release(): void {
        if (this.#isHeld) this.#hold(false);
    }
}

/** The world as sliders: a row for each element of each sensor. */
export class World {
    readonly element: HTMLElement;
    readonly #quantities: Quantity[];
    readonly #newest = new Newest();

    constructor(readings: Readings, steer: Steer) {
        const sensors = readings.all.filter((one) => one.device.direction === "sensor");
        const of = (reading: Reading) =>
            Array.from({ length: reading.device.elements }, (_, element) => {
                const key = `${reading.device.name} ${element}`;
                const put = (shown: number | null) =>
                    this.#newest.run(key, () => steer(reading.device.name, element, shown));
                return new Quantity(reading, element, put);
            });
        this.#quantities = sensors.flatMap(of);
        this.element = make("div", { class: "live-rows" }, ...this.#quantities.map((one) => one.row));
        if (this.#quantities.length === 0) this.element.append(make("p", { class: "live-hint" }, "The board has no sensors."));
        else this.element.append(button("Let the world have all", () => this.#release(), { class: "live-small" }));
    }

    #release(): void {
        for (const one of this.#quantities) one.release();
    }

    update(): void {
        for (const one of this.#quantities) one.update();
    }
}
