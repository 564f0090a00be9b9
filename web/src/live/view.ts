import type { Seen } from "../../../crates/wasm/sensedsl.mjs";
import { Actuators } from "./actuators.js";
import type { LiveStudio } from "./contract.js";
import { make, mark, section } from "./dom.js";
import { RobotMaps } from "./map.js";
import { Condition, Notes, type Speaker } from "./notes.js";
import { Plots } from "./plots.js";
import { type Note, Readings } from "./readings.js";
import { Recording } from "./recording.js";
import { Table } from "./table.js";
import type { Board } from "./transport.js";
import { type Steer, World } from "./world.js";

/** How often texts are written; faster than that nobody reads. */
const WRITE_EVERY_MS = 100;
/** How often plots move where people want little motion. */
const CALM_EVERY_MS = 500;
/** How many sensors are plotted to begin with. */
const PLOTTED = 4;

const calm = matchMedia("(prefers-reduced-motion: reduce)");

/** What a view is given beside its board. */
export interface Given {
    studio: LiveStudio;
    speaker: Speaker;
    /** Holds quantities of the world, which only a simulated board has. */
    steer: Steer | null;
}

/** Everything that is shown of one board, simulated or real. */
export class View {
    readonly element: HTMLElement;
    readonly readings: Readings;
    readonly recording: Recording;
    readonly #speaker: Speaker;
    readonly #parts: { update(): void }[];
    readonly #plots: Plots;
    readonly #maps: RobotMaps;
    readonly #others: HTMLElement;
    #written_ms = 0;
    #drawn_ms = 0;

    constructor(board: Board, { studio, speaker, steer }: Given) {
        const { info } = board;
        this.#speaker = speaker;
        this.readings = new Readings(info);
        const sensors = info.devices.flatMap((one, index) => (one.direction === "sensor" ? [index] : []));
        const plotted = new Set(sensors.slice(0, PLOTTED));
        this.#plots = new Plots(this.readings, plotted);
        this.recording = new Recording(info, studio);
        this.#maps = new RobotMaps(info);
        this.#others = section("Robot", this.#maps.others);
        this.#others.hidden = true;
        const table = new Table(this.readings, plotted, () => this.#plots.choose());
        const actuators = new Actuators(this.readings, (device, value) => this.#set(board, device, value, steer === null), steer === null ? "sent:" : "the board has");
        const world = steer === null ? null : new World(this.readings, steer);
        const notes = new Notes(this.readings);
        const condition = new Condition(this.readings);
        this.#parts = [table, this.#maps, this.#plots, actuators, notes, condition, this.recording];
        if (world !== null) this.#parts.push(world);
        this.element = make(
            "div",
            { class: "live-view" },
            // A robot that drives is seen first.
            make("div", { class: "live-column" }, this.#maps.isEmpty ? null : section("Map", this.#maps.element), this.#others),
            // What is moved stands below what follows it, and beside it where there is room.
            make("div", { class: "live-column" }, section("Values", table.element, this.recording.element)),
            make("div", { class: "live-column" }, section("Plots", this.#plots.element)),
            make(
                "div",
                { class: "live-column live-controls" },
                world === null ? null : section("World", world.element),
                section("Actuators", actuators.element),
                section("Notes", notes.element),
                section("Health", condition.element),
            ),
        );
    }

    async #set(board: Board, device: string, value: string, isToBeNoted: boolean) {
        const answered = await board.set(device, value);
        if (answered.text !== null && isToBeNoted) {
            this.readings.sent(device, answered.text);
            const index = this.readings.all.findIndex((one) => one.device.name === device);
            const numbers = this.readings.all[index]?.numbers ?? [];
            this.recording.sent(this.readings.now_ms, index, numbers);
        }
        return answered;
    }

    take(seen: Seen): void {
        this.readings.take(seen);
        this.recording.take(seen);
        this.#maps.take(seen);
        for (const { level, text } of seen.notes) this.#speaker.note(level, text);
    }

    /** Adds a note of the page itself. */
    note(level: Note["level"], text: string): void {
        this.readings.note(level, text);
    }

    /** Whether what is shown is of the past, because nothing comes. */
    setStale(isStale: boolean): void {
        mark(this.element, "data-stale", isStale ? "true" : null);
    }

    setDark(isDark: boolean): void {
        this.#plots.setDark(isDark);
    }

    /** Shows what has come, once a frame. */
    frame(now_ms: number): void {
        if (now_ms - this.#written_ms >= WRITE_EVERY_MS) {
            this.#written_ms = now_ms;
            for (const part of this.#parts) part.update();
            this.#others.hidden = !this.#maps.hasOthers;
        }
        if (calm.matches && now_ms - this.#drawn_ms < CALM_EVERY_MS) return;
        this.#drawn_ms = now_ms;
        this.#maps.draw();
        this.#plots.draw();
    }

    dispose(): void {
        void this.recording.stop();
        this.#plots.dispose();
        this.element.remove();
    }
}
