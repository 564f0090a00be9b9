import { button, fresh, make, mark, shownTime, write } from "./dom.js";
import { HISTORY_MS } from "./history.js";
import { type Around, type Line, Plot } from "./plot.js";
import { type Span, summary } from "./plotdata.js";
import { elementName, type Reading, type Readings, shownNumber } from "./readings.js";
import { Window } from "./window.js";

const SPANS_S = [1, 2, 5, 10, 30, 60, 120, 300, 600];
/** A plot that goes with the time moves by a part of a pixel, but not seldom. */
const STEPS_OF_PIXEL = 4;
const STEP_MS_MAX = 250;
const COLUMNS = ["Device", "Unit", "Values", "First", "Least", "Mean", "Greatest", "Last"];

/** All plots of a board, a panel for each unit, over the same time. */
export class Plots {
    readonly element: HTMLElement;
    readonly #readings: Readings;
    readonly #chosen: Set<number>;
    readonly #window = new Window();
    readonly #panels = make("div", { class: "live-figures" });
    readonly #empty = make("p", { class: "live-hint" }, "Choose devices to plot in the first column of the table.");
    readonly #freeze: HTMLButtonElement;
    readonly #scroll: HTMLInputElement;
    readonly #span: HTMLSelectElement;
    readonly #numbers = make("tbody");
    readonly #details: HTMLDetailsElement;
    /** Tells the width without anything being laid out for it. */
    readonly #resized = new ResizeObserver((entries) => {
        this.#width = Math.floor(entries.at(-1)?.contentRect.width ?? 0);
        this.#change();
    });
    #width = 0;
    #plots: Plot[] = [];
    #isDark = false;
    /** Counts what was chosen, so that nothing is drawn twice. */
    #changes = 0;
    #drawn = "";

    constructor(readings: Readings, chosen: Set<number>) {
        this.#readings = readings;
        this.#chosen = chosen;
        this.#freeze = button("Freeze", () => this.#toggle(), {
            "aria-pressed": "false",
            title: "Freeze the plots; the table keeps updating (F)",
        });
        this.#scroll = make("input", {
            type: "range",
            "aria-label": "Scroll back",
            min: 0,
            step: 100,
            input: () => this.#scrolled(),
        });
        this.#span = this.#makeSpan();
        this.#details = this.#makeDetails();
        const keys = fresh("keys");
        this.element = make(
            "div",
            { class: "live-plots" },
            this.#makeBar(),
            make(
                "div",
                { class: "live-keyed", tabindex: 0, role: "group", "aria-label": "Plots", "aria-describedby": keys, keydown: (event: KeyboardEvent) => this.#key(event) },
                this.#panels,
            ),
            make("p", { class: "live-hint", id: keys }, "Drag over a part to see it larger, double-click to go on. Keys: ← → Home End scroll, + − zoom, F freezes."),
            this.#details,
        );
        this.#resized.observe(this.#panels);
        this.choose();
    }

    #makeBar(): HTMLElement {
        return make(
            "div",
            { class: "live-bar", role: "group", "aria-label": "Time" },
            this.#freeze,
            button("Earlier", () => this.#move(true)),
            this.#scroll,
            button("Later", () => this.#move(false)),
            button("Now", () => this.#release(), { title: "Follow the latest values (End)" }),
            make("label", {}, "Show ", this.#span),
        );
    }

    #makeSpan(): HTMLSelectElement {
        const named = (seconds: number) => (seconds < 60 ? `${seconds} s` : `${seconds / 60} min`);
        const options = SPANS_S.map((one) => make("option", { value: one }, named(one)));
        // What was dragged over is none of them.
        const other = make("option", { value: "", hidden: true }, "a part");
        const select = make("select", {
            change: () => {
                this.#window.setSpan(Number(select.value) * 1_000);
                this.#change();
            },
        }, ...options, other);
        select.value = `${this.#window.span_ms / 1_000}`;
        return select;
    }

    #makeDetails(): HTMLDetailsElement {
        const head = COLUMNS.map((name) => make("th", { scope: "col" }, name));
        const table = make("table", { class: "live-table" }, make("thead", {}, make("tr", {}, ...head)), this.#numbers);
        const scroll = make("div", { class: "live-scroll", tabindex: 0, role: "region", "aria-label": "Plotted numbers" }, table);
        return make("details", { toggle: () => this.update() }, make("summary", {}, "The plots in numbers"), scroll);
    }

    /** Makes the panels of the devices that are chosen. */
    choose(): void {
        for (const plot of this.#plots) plot.clear();
        const units = new Map<string, Line[]>();
        for (const index of [...this.#chosen].sort((a, b) => a - b)) {
            const reading = this.#readings.all[index];
            if (reading === undefined) continue;
            const unit = reading.device.is_bool ? "true or false" : (reading.device.unit ?? "");
            const lines = units.get(unit) ?? [];
            units.set(unit, lines);
            for (let element = 0; element < reading.device.elements; element += 1) lines.push({ reading, element });
        }
        const around = this.#around();
        this.#plots = [...units].map(([unit, lines]) => new Plot(unit === "" || unit === "true or false" ? null : unit, lines, around));
        this.#panels.replaceChildren(...this.#plots.map((one) => one.element));
        this.#empty.hidden = this.#plots.length > 0;
        this.#panels.append(this.#empty);
        this.#change();
    }

    #around(): Around {
        const plots = this;
        return {
            get isDark() {
                return plots.#isDark;
            },
            span: () => this.#shown(),
            onDragged: (span) => {
                this.#window.show(span);
                this.#change();
            },
            onReleased: () => this.#release(),
        };
    }

    /** Draws again in other colours. */
    setDark(isDark: boolean): void {
        this.#isDark = isDark;
        for (const plot of this.#plots) plot.clear();
        this.#change();
    }

    /** Draws what has changed. */
    draw(): void {
        // A plot of a long time moves by less than it takes to see, unless some time has passed.
        const step_ms = Math.min(this.#window.span_ms / Math.max(1, this.#width) / STEPS_OF_PIXEL, STEP_MS_MAX);
        const moved = this.#window.isHeld ? "held" : Math.floor(this.#readings.now_ms / step_ms);
        const stamp = `${moved} ${this.#changes}`;
        if (stamp === this.#drawn) return;
        this.#drawn = stamp;
        for (const plot of this.#plots) plot.draw(this.#width);
    }

    /** Writes what people read. */
    update(): void {
        const { now_ms } = this.#readings;
        const { to_ms } = this.#shown();
        mark(this.#freeze, "aria-pressed", `${this.#window.isHeld}`);
        if (document.activeElement !== this.#scroll || !this.#window.isHeld) {
            this.#scroll.min = `${Math.max(0, now_ms - HISTORY_MS)}`;
            this.#scroll.max = `${now_ms}`;
            this.#scroll.value = `${to_ms}`;
        }
        const ago_ms = now_ms - to_ms;
        mark(this.#scroll, "aria-valuetext", this.#window.isHeld ? `${shownTime(ago_ms)} ago` : "now");
        const span = `${this.#window.span_ms / 1_000}`;
        const isNamed = SPANS_S.includes(Number(span));
        if (document.activeElement !== this.#span) this.#span.value = isNamed ? span : "";
        if (this.#details.open) this.#writeNumbers();
    }

    dispose(): void {
        this.#resized.disconnect();
        for (const plot of this.#plots) plot.clear();
    }

    #shown(): Span {
        return this.#window.span(this.#readings.now_ms);
    }

    #change(): void {
        this.#changes += 1;
    }

    #toggle(): void {
        if (this.#window.isHeld) this.#window.release();
        else this.#window.hold(this.#readings.now_ms);
        this.#change();
        this.update();
    }

    #release(): void {
        this.#window.release();
        this.#change();
        this.update();
    }

    #move(isEarlier: boolean): void {
        this.#window.scroll(isEarlier, this.#readings.now_ms);
        this.#change();
        this.update();
    }

    #scrolled(): void {
        this.#window.showUntil(this.#scroll.valueAsNumber, this.#readings.now_ms);
        this.#change();
        this.update();
    }

    #zoom(isIn: boolean): void {
        this.#window.zoom(isIn);
        this.#change();
        this.update();
    }

    #key(event: KeyboardEvent): void {
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        const keys: { [key: string]: () => void } = {
            ArrowLeft: () => this.#move(true),
            ArrowRight: () => this.#move(false),
            Home: () => {
                this.#window.showUntil(0, this.#readings.now_ms);
                this.#change();
                this.update();
            },
            End: () => this.#release(),
            "+": () => this.#zoom(true),
            "=": () => this.#zoom(true),
            "-": () => this.#zoom(false),
            f: () => this.#toggle(),
        };
        const act = keys[event.key];
        if (act === undefined) return;
        event.preventDefault();
        act();
    }

    #writeNumbers(): void {
        const span = this.#shown();
        const lines = [...this.#chosen].sort((a, b) => a - b).flatMap((index) => linesOf(this.#readings.all[index]));
        if (this.#numbers.rows.length !== lines.length) {
            const cells = () => COLUMNS.map((_, column) => (column === 0 ? make("th", { scope: "row" }) : make("td")));
            this.#numbers.replaceChildren(...lines.map(() => make("tr", {}, ...cells())));
        }
        for (const [row, { reading, element }] of lines.entries()) {
            const found = summary(reading.history, element, span);
            const texts = [
                elementName(reading.device, element),
                reading.device.unit ?? "",
                `${found.count}`,
                ...[found.first, found.least, found.mean, found.most, found.last].map(shownNumber),
            ];
            const { cells } = this.#numbers.rows[row] as HTMLTableRowElement;
            for (const [column, text] of texts.entries()) write(cells[column] as Element, text);
        }
    }
}

function linesOf(reading: Reading | undefined): Line[] {
    if (reading === undefined) return [];
    return Array.from({ length: reading.device.elements }, (_, element) => ({ reading, element }));
}
