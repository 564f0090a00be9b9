import uPlot from "uplot";
import { colour, ink, style } from "./colours.js";
import { make, mark, write } from "./dom.js";
import { Columns, type Plotted, type Span } from "./plotdata.js";
import { elementName, type Reading, shownNumber } from "./readings.js";

const HEIGHT = 160;
const AXIS_WIDTH = 58;
const FONT = "12px system-ui, sans-serif";
/** A shorter drag is a click. */
const DRAG_PIXELS = 5;

/** A line of a plot. */
export interface Line {
    reading: Reading;
    element: number;
}

/** What a plot asks for and tells. */
export interface Around {
    isDark: boolean;
    /** What is shown. */
    span(): Span;
    /** Shows a part that somebody has dragged over. */
    onDragged(span: Span): void;
    /** Goes with the time again. */
    onReleased(): void;
}

interface Key {
    line: Line;
    swatch: HTMLElement;
    value: HTMLElement;
}

/** One panel: the lines of one unit. */
export class Plot {
    readonly element: HTMLElement;
    readonly #keys: Key[];
    readonly #around: Around;
    readonly #unit: string | null;
    readonly #holder = make("div", { class: "live-canvas", role: "img" });
    #plot: uPlot | null = null;
    #width = 0;
    #index: number | null = null;

    constructor(unit: string | null, lines: Line[], around: Around) {
        this.#unit = unit;
        this.#around = around;
        this.#keys = lines.map((line) => ({
            line,
            swatch: make("span", { class: "live-swatch", "aria-hidden": "true" }),
            value: make("span", { class: "live-number" }),
        }));
        const items = this.#keys.map(({ line, swatch, value }) =>
            make("li", {}, swatch, `${elementName(line.reading.device, line.element)} `, value),
        );
        const title = make("figcaption", {}, unit === null ? "" : `in ${unit}`);
        this.element = make("figure", { class: "live-figure" }, title, make("ul", { class: "live-key" }, ...items), this.#holder);
        const names = lines.map((one) => elementName(one.reading.device, one.element)).join(", ");
        mark(this.#holder, "aria-label", `Plot of ${names}${unit === null ? "" : ` in ${unit}`}. The table below has its numbers.`);
    }

    /** Draws what is to be seen now, so many pixels wide. */
    draw(width: number): void {
        if (width === 0) return;
        if (this.#plot === null) this.#plot = this.#make(width);
        else if (width !== this.#width) this.#plot.setSize({ width, height: HEIGHT });
        this.#width = width;
        const columns = new Columns(this.#around.span(), Math.max(50, width - AXIS_WIDTH));
        const all: (number[] | Plotted[])[] = [columns.times_s()];
        for (const { line } of this.#keys) {
            const { history, device } = line.reading;
            if (device.direction === "sensor") all.push(columns.measured(history, line.element, device.cycle_ms));
            else all.push(columns.held(history, line.element));
        }
        this.#plot.setData(all as uPlot.AlignedData, true);
        this.#writeKey();
    }

    /** Frees it, to be made again with other colours. */
    clear(): void {
        this.#plot?.destroy();
        this.#plot = null;
    }

    #make(width: number): uPlot {
        const { isDark } = this.#around;
        const { text, grid } = ink(isDark);
        for (const [index, { swatch }] of this.#keys.entries()) {
            swatch.style.borderTopColor = colour(index, isDark);
            swatch.style.borderTopStyle = style(index).border;
        }
        const axis = { stroke: text, font: FONT, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 } };
        const options: uPlot.Options = {
            width,
            height: HEIGHT,
            legend: { show: false },
            scales: { x: { time: false, range: () => this.#range() }, y: { range: (_, low, high) => spread(low, high) } },
            axes: [
                { ...axis, size: 30, values: (_, all) => all.map((one) => `${shownNumber(Math.round(one * 1e6) / 1e6)} s`) },
                { ...axis, size: AXIS_WIDTH, values: (_, all) => all.map((one) => this.#tick(one)) },
            ],
            series: [{}, ...this.#keys.map(({ line }, index) => lineOptions(line, colour(index, isDark), style(index).dashes))],
            cursor: this.#cursor(),
            hooks: {
                setSelect: [(plot) => this.#dragged(plot)],
                setCursor: [(plot) => this.#pointed(plot)],
            },
        };
        return new uPlot(options, [[], ...this.#keys.map(() => [])], this.#holder);
    }

    #cursor(): uPlot.Cursor {
        const isMove = (type: string) => type === "mousemove" || type === "mouseleave";
        return {
            y: false,
            drag: { x: true, y: false, setScale: false },
            // All panels show the same time.
            sync: { key: "live", filters: { pub: isMove } },
            bind: {
                dblclick: () => () => {
                    this.#around.onReleased();
                    return null;
                },
            },
        };
    }

    #range(): [number, number] {
        const { from_ms, to_ms } = this.#around.span();
        return [from_ms / 1_000, to_ms / 1_000];
    }

    #tick(value: number): string {
        const isBool = this.#unit === null && this.#keys.every(({ line }) => line.reading.device.is_bool);
        if (!isBool) return shownNumber(Math.round(value * 1e9) / 1e9);
        return value === 0 ? "false" : value === 1 ? "true" : "";
    }

    #dragged(plot: uPlot): void {
        const { left, width } = plot.select;
        if (width < DRAG_PIXELS) return;
        const from_ms = plot.posToVal(left, "x") * 1_000;
        const to_ms = plot.posToVal(left + width, "x") * 1_000;
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        this.#around.onDragged({ from_ms, to_ms });
    }

    #pointed(plot: uPlot): void {
        this.#index = plot.cursor.idx ?? null;
        this.#writeKey();
    }

    /** The values where somebody points, or else the last ones. */
    #writeKey(): void {
        for (const [index, { line, value }] of this.#keys.entries()) {
            const column = this.#plot?.data[index + 1];
            const number = this.#index === null || column === undefined ? null : nearest(column, this.#index);
            const shown = this.#index === null ? (line.reading.numbers[line.element] ?? null) : number;
            write(value, line.reading.device.is_bool && shown !== null ? (shown === 0 ? "false" : "true") : shownNumber(shown));
        }
    }
}

/** The last number at or before a slot. */
function nearest(column: ArrayLike<Plotted>, index: number): number | null {
    for (let at = index; at >= 0; at -= 1) {
        const value = column[at];
        if (value !== undefined) return value;
    }
    return null;
}

/** The ends of an axis: a little more than the values, and something where they are all alike. */
function spread(low: number | null, high: number | null): [number, number] {
    if (low === null || high === null) return [0, 1];
    const more = low === high ? Math.max(Math.abs(low) / 10, 1e-9) : (high - low) / 12;
    return low === 0 && high === 0 ? [-1, 1] : [low - more, high + more];
}

function lineOptions({ reading }: Line, stroke: string, dash: number[]): uPlot.Series {
    const { device } = reading;
    const isStepped = device.is_bool || device.direction === "actuator";
    const stepped = uPlot.paths.stepped?.({ align: 1 });
    return {
        stroke,
        dash,
        width: 1.5,
        points: { show: false },
        ...(isStepped && stepped !== undefined ? { paths: stepped } : {}),
    };
}
