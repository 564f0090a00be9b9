import { make, mark, shownTime, write } from "./dom.js";
import { isOverdue, rate, type Reading, type Readings, shownNumber } from "./readings.js";

interface Row {
    reading: Reading;
    row: HTMLTableRowElement;
    value: HTMLElement;
    state: HTMLElement;
    age: HTMLElement;
    rate: HTMLElement;
    missing: HTMLElement;
    range: HTMLElement;
}

const COLUMNS = [
    ["Plot", "whether the device is plotted"],
    ["Device", "its name and kind"],
    ["Value", "the last value in its unit"],
    ["State", "overdue, what the board's health says is wrong, or which limit the value is beyond"],
    ["Age", "how long ago the value came, or was set"],
    ["Rate", "values a second, over the last five seconds"],
    ["Missing", "values that did not come, by the device's cycle"],
    ["Range", "the least and the greatest value since the start"],
] as const;

/** The table of all devices with their last values. */
export class Table {
    readonly element: HTMLElement;
    readonly #rows: Row[];
    readonly #readings: Readings;

    constructor(readings: Readings, plotted: Set<number>, onPlotted: () => void) {
        this.#readings = readings;
        this.#rows = readings.all.map((reading, index) => makeRow(reading, index, plotted, onPlotted));
        const head = COLUMNS.map(([name, title]) => make("th", { scope: "col", title, class: `live-${name.toLowerCase()}` }, name));
        const table = make(
            "table",
            { class: "live-table live-devices" },
            make("caption", { class: "live-unseen" }, `Devices of ${readings.info.board}`),
            make("thead", {}, make("tr", {}, ...head)),
            make("tbody", {}, ...this.#rows.map((one) => one.row)),
        );
        // Narrow pages scroll it, by keyboard as well.
        this.element = make("div", { class: "live-scroll", tabindex: 0, role: "region", "aria-label": "Table of values" }, table);
    }

    /** Writes what has changed. */
    update(): void {
        const { now_ms, health } = this.#readings;
        for (const row of this.#rows) {
            const { reading } = row;
            const told = health?.devices.find((one) => one.name === reading.device.name);
            const [kind, state] = this.#readings.isBelieved ? stateOf(reading, now_ms, told) : ["good", ""];
            write(row.value, reading.time_ms === null ? "–" : reading.text);
            write(row.state, state);
            mark(row.row, "data-state", kind);
            write(row.age, reading.time_ms === null ? "–" : shownTime(Math.max(0, now_ms - reading.time_ms)));
            const shown = reading.device.direction === "actuator" ? "" : `${rate(reading, now_ms).toFixed(1)} Hz`;
            write(row.rate, shown);
            write(row.missing, reading.device.cycle_ms && shown !== "" ? `${reading.missed}` : "");
            write(row.range, rangeOf(reading));
        }
    }
}

function makeRow(reading: Reading, index: number, plotted: Set<number>, onPlotted: () => void): Row {
    const { device } = reading;
    const box = make("input", {
        type: "checkbox",
        "aria-label": `Plot ${device.name}`,
        change: () => {
            if (box.checked) plotted.add(index);
            else plotted.delete(index);
            onPlotted();
        },
    });
    box.checked = plotted.has(index);
    const cell = (name: string) => make("td", { class: `live-${name}` });
    const cells = {
        value: cell("value"),
        state: cell("state"),
        age: cell("age"),
        rate: cell("rate"),
        missing: cell("missing"),
        range: cell("range"),
    };
    const row = make(
        "tr",
        { "data-device": device.name, "data-direction": device.direction },
        make("td", { class: "live-plot" }, box),
        make("th", { scope: "row", title: `${device.direction}, ${device.kind}, ${device.type}` }, device.name),
        ...Object.values(cells),
    );
    return { reading, row, ...cells };
}

type Told = { status: string; causes: string } | undefined;

/** How a device is, as a kind for its colour and as words. */
function stateOf(reading: Reading, now_ms: number, told: Told): [string, string] {
    if (reading.time_ms === null && reading.device.direction === "sensor") return ["odd", "no value yet"];
    if (isOverdue(reading, now_ms)) return ["bad", withCauses("overdue", told)];
    if (told !== undefined && !["good", "never read"].includes(told.status)) return ["bad", withCauses(told.status, told)];
    const { min, max } = reading.device;
    const numbers = reading.numbers.filter((one) => one !== null);
    const unit = reading.device.unit === null ? "" : ` ${reading.device.unit}`;
    if (min !== null && numbers.some((one) => one < min)) return ["odd", `below the minimum of ${shownNumber(min)}${unit}`];
    if (max !== null && numbers.some((one) => one > max)) return ["odd", `above the maximum of ${shownNumber(max)}${unit}`];
    if (told !== undefined && told.causes !== "") return ["good", told.causes];
    return ["good", ""];
}

function withCauses(state: string, told: Told): string {
    if (told === undefined || told.causes === "") return state;
    return told.causes.includes(state) ? told.causes : `${state}: ${told.causes}`;
}

function rangeOf({ device, least, most }: Reading): string {
    if (least > most || device.is_bool) return "";
    return `${shownNumber(least)} to ${shownNumber(most)}`;
}
