import type { RobotInfo } from "../../../crates/wasm/sensedsl.mjs";
import { Banner } from "./banner.js";
import { boardNames, boardOf, Choice } from "./choice.js";
import type { LiveStudio } from "./contract.js";
import { controllersNote } from "./controllers.js";
import { button, make, mark, shownTime, write } from "./dom.js";
import type { Design, Runner } from "./messages.js";
import { Speaker } from "./notes.js";
import { SimulatedBoard } from "./simulated.js";
import { View } from "./view.js";
import { usualWorld, worldsOf } from "./worlds.js";

const PACES = [0.1, 0.2, 0.5, 1, 2, 5, 10];
/** How long nobody must have typed before the new text is tried. */
const TRY_AFTER_MS = 700;
/** What is wrong with the code of controllers: none, not compiled, stopped at once. */
const OF_CODE = ["E0534", "E0535", "E0536"];
/** The board is this much slower than it should be when it is told. */
const LATE = 0.8;

const INTRODUCTION =
    "This simulates the board in the page: it does the firmware's work in a world that you control. Nothing is sent anywhere.";
const INTRODUCTION_SERVED =
    "This simulates the board on this computer: it does the firmware's work in a world that you control, and runs the code of its controllers.";

/** The panel that runs the design on a simulated board. */
export class Run {
    readonly element: HTMLElement;
    readonly #studio: LiveStudio;
    readonly #speaker: Speaker;
    readonly #banner = new Banner();
    /** What becomes of a text that has changed. */
    readonly #offer = new Banner();
    /** What is quietly told of the board that runs. */
    readonly #about = make("p", { class: "live-hint live-about", hidden: true });
    readonly #empty = make("div", { class: "live-empty" });
    readonly #start: HTMLButtonElement;
    readonly #pause: HTMLButtonElement;
    readonly #restart: HTMLButtonElement;
    readonly #stop: HTMLButtonElement;
    readonly #slower: HTMLButtonElement;
    readonly #faster: HTMLButtonElement;
    readonly #pace: HTMLSelectElement;
    readonly #boards = new Choice("Board", () => void this.start(this.#same()));
    readonly #worlds = new Choice("World", () => this.#isRunning && void this.start(this.#same()));
    readonly #clock = make("span", { class: "live-clock" });
    #board: SimulatedBoard | null = null;
    #view: View | null = null;
    #isDark = false;
    #isRunning = false;
    /** What runs now, to know whether the text is another one. */
    #running = "";
    /** The search for a board that somebody wants to start. */
    #search: AbortController | null = null;
    /** The search for a board of a text that has changed. */
    #trial: AbortController | null = null;
    /** The new text that can be started, with its board unless that is made anew. */
    #next: { board: SimulatedBoard | null; text: string } | null = null;
    #timer: ReturnType<typeof setTimeout> | undefined;
    #written_ms = 0;
    /** How fast the board really goes. */
    #measured: number | null = null;

    constructor(studio: LiveStudio) {
        this.#studio = studio;
        this.#speaker = new Speaker((text) => studio.announce(text));
        this.#start = button("Start", () => void this.start(), { class: "live-main" });
        this.#pause = button("Pause", () => void this.#togglePause());
        this.#restart = button("Restart", () => void this.start(this.#same()), { title: "From time zero, in a fresh world" });
        this.#stop = button("Stop", () => this.#end());
        this.#slower = button("Slower", () => this.#step(-1));
        this.#faster = button("Faster", () => this.#step(1));
        const paces = PACES.map((one) => make("option", { value: one }, `${one}×`));
        this.#pace = make("select", { "aria-label": "Speed", change: () => this.#setPace() }, ...paces);
        this.#pace.value = "1";
        const bar = make(
            "div",
            { class: "live-bar live-toolbar", role: "group", "aria-label": "Simulated board" },
            this.#start,
            this.#pause,
            this.#restart,
            this.#stop,
            this.#slower,
            this.#pace,
            this.#faster,
            this.#boards.element,
            this.#worlds.element,
            this.#clock,
        );
        this.element = make("section", { class: "live-panel", "aria-label": "Run" }, bar, this.#banner.element, this.#offer.element, this.#about, this.#empty);
        this.#empty.append(make("p", {}, studio.token === null ? INTRODUCTION : INTRODUCTION_SERVED), make("p", {}, "Start it to see what the sensors report and to set actuators."));
        this.#show();
    }

    /** It is to be seen now. */
    shown(): void {
        this.#offerWorlds();
    }

    /** Starts a board from time zero: that of the text as it is now, unless another design is given. */
    async start(design = this.#design()): Promise<void> {
        const text = JSON.stringify(design);
        const next = this.#takeNext();
        if (next?.board && next.text === text) return this.#run(next.board, text);
        await next?.board?.stop();
        const search = this.#begin();
        mark(this.#start, "aria-busy", "true");
        write(this.#clock, this.#studio.token === null ? "Looking for a wiring…" : "Making the board ready…");
        try {
            const { board, diagnostics } = await SimulatedBoard.of(design, await this.#runner(), search.signal);
            if (search.signal.aborted) return void board?.stop();
            if (board === null) {
                const errors = diagnostics.filter((one) => one.severity === "error");
                const isCode = errors.length > 0 && errors.every((one) => OF_CODE.includes(one.code));
                const text = `The ${isCode ? "code" : "text"} cannot run as it is.`;
                this.#banner.wrong(text, diagnostics);
                this.#speaker.say(text);
            } else await this.#run(board, text);
        } catch (error) {
            if (!search.signal.aborted) this.#banner.show("error", `The board cannot be started: ${message(error)}`, "");
        } finally {
            if (this.#search === search) {
                this.#search = null;
                mark(this.#start, "aria-busy", null);
                this.#writeClock();
                // The text may have changed meanwhile.
                this.changed();
            }
        }
    }

    /** What runs the next board: the page's server where it has one, which can compile code. */
    async #runner(): Promise<Runner> {
        const { token } = this.#studio;
        if (token === null) return { kind: "module", module: await this.#studio.module() };
        return { kind: "server", served: { token, board: crypto.randomUUID() } };
    }

    /** The text has changed: what runs goes on, and the new text is offered once it has a wiring. */
    changed(): void {
        this.#offerWorlds();
        clearTimeout(this.#timer);
        if (!this.#isRunning) return;
        this.#timer = setTimeout(() => void this.#tryNext(), TRY_AFTER_MS);
    }

    frame(now_ms: number): void {
        this.#view?.frame(now_ms);
        if (now_ms - this.#written_ms < 100) return;
        this.#written_ms = now_ms;
        this.#writeClock();
    }

    setDark(isDark: boolean): void {
        this.#isDark = isDark;
        this.#view?.setDark(isDark);
    }

    dispose(): void {
        clearTimeout(this.#timer);
        this.#end();
        this.element.remove();
    }

    #design(): Design {
        this.#offerWorlds();
        const { path, files, board } = this.#studio.request();
        return this.#chosen({ path, files, ...(board === undefined ? {} : { board }) });
    }

    /** What runs, however the text has changed since. */
    #same(): Design {
        const { path, files, board, world } = JSON.parse(this.#running) as Design;
        const same = this.#chosen({ path, files, ...(board === undefined ? {} : { board }) });
        // A world that has come since is not one of its files.
        const isNew = this.#worlds.value !== "" && same.world === undefined;
        return isNew && world !== undefined ? { ...same, world } : same;
    }

    /** A design with the board and the world that are chosen. */
    #chosen(design: Design): Design {
        const name = boardOf(design.files, this.#boards.value);
        const world = this.#worlds.value;
        const hasWorld = design.files[world] !== undefined;
        return { ...design, ...(name === undefined ? {} : { name }), ...(hasWorld ? { world } : {}) };
    }

    #offerWorlds(): void {
        const { path, files } = this.#studio.request();
        const names = worldsOf(files).map((one) => [one, one] as const);
        this.#worlds.offer([["", "the usual"], ...names], usualWorld(path, files));
    }

    #begin(): AbortController {
        this.#search?.abort();
        this.#trial?.abort();
        this.#search = new AbortController();
        return this.#search;
    }

    #takeNext(): { board: SimulatedBoard | null; text: string } | null {
        const next = this.#next;
        this.#next = null;
        return next;
    }

    async #run(board: SimulatedBoard, text: string): Promise<void> {
        this.#release();
        this.#board = board;
        this.#running = text;
        this.#isRunning = true;
        const view = new View(board, {
            studio: this.#studio,
            speaker: this.#speaker,
            steer: (device, element, shown) => board.steer(device, element, shown),
        });
        this.#view = view;
        view.setDark(this.#isDark);
        board.onSeen = (seen, pace) => {
            view.take(seen);
            this.#measured = pace;
        };
        board.onClosed = ({ text: why, help }) => {
            this.#isRunning = false;
            view.setStale(true);
            this.#offer.hide();
            this.#banner.show("error", why, help);
            this.#speaker.say(why);
            this.#show();
        };
        this.#boards.offer(boardNames(board.info.boards));
        if (this.#offer.element.contains(document.activeElement)) this.#restart.focus();
        for (const one of [this.#banner, this.#offer]) one.hide();
        this.#tellAbout(board.info);
        this.element.append(view.element);
        await board.setPace(Number(this.#pace.value));
        await board.start();
        this.#show();
        this.#speaker.say(`${board.info.board} runs.`);
        // The text may be another one by now.
        this.changed();
    }

    #tellAbout(info: RobotInfo): void {
        const parts = controllersNote(info, this.#studio.token !== null);
        this.#about.replaceChildren(...parts.map((text, at) => (at % 2 === 0 ? text : make("code", {}, text))));
        this.#about.hidden = parts.length === 0;
    }

    #release(): void {
        void this.#board?.stop();
        this.#about.hidden = true;
        this.#view?.dispose();
        this.#board = null;
        this.#view = null;
        this.#isRunning = false;
        this.#measured = null;
    }

    #end(): void {
        this.#release();
        void this.#takeNext()?.board?.stop();
        for (const one of [this.#search, this.#trial]) one?.abort();
        for (const one of [this.#banner, this.#offer]) one.hide();
        this.#show();
        this.#start.focus();
    }

    async #togglePause(): Promise<void> {
        const board = this.#board;
        if (board === null) return;
        await board.pause(!board.isPaused);
        this.#show();
        this.#speaker.say(board.isPaused ? "Paused." : "Goes on.");
    }

    #step(by: number): void {
        const at = PACES.indexOf(Number(this.#pace.value)) + by;
        const pace = PACES[at];
        if (pace === undefined) return;
        this.#pace.value = `${pace}`;
        this.#setPace();
        this.#speaker.say(`Speed ${pace}.`);
    }

    #setPace(): void {
        const pace = Number(this.#pace.value);
        this.#slower.disabled = pace === PACES[0];
        this.#faster.disabled = pace === PACES.at(-1);
        // A board that has ended has told so.
        this.#board?.setPace(pace).catch(() => {});
    }

    async #tryNext(): Promise<void> {
        // A board that is being started looks again once it runs.
        if (!this.#isRunning || this.#search !== null) return;
        const design = this.#design();
        const text = JSON.stringify(design);
        if (this.#next?.text === text) return;
        const old = this.#takeNext();
        await old?.board?.stop();
        if (text === this.#running) {
            this.#trial?.abort();
            this.#offer.hide();
            return;
        }
        this.#trial?.abort();
        const trial = new AbortController();
        this.#trial = trial;
        try {
            const { board } = await SimulatedBoard.of(design, await this.#runner(), trial.signal);
            if (trial.signal.aborted) return void board?.stop();
            if (board === null) {
                this.#offer.show("info", "The text has changed and cannot run yet.", "The board keeps running the previous text.");
                return;
            }
            // Its code may be another one by the time that somebody starts it.
            const isKept = !board.info.has_code;
            if (!isKept) await board.stop();
            this.#next = { board: isKept ? board : null, text };
            const again = button("Start again with the new text", () => void this.start(), { class: "live-main" });
            this.#offer.show("info", "The text has changed.", "The board keeps running the previous text.", again);
        } catch {
            // A search that was ended, or a tool that has failed: what runs is not concerned.
        } finally {
            if (this.#trial === trial) this.#trial = null;
        }
    }

    #show(): void {
        const has = this.#board !== null;
        const isPaused = this.#board?.isPaused ?? false;
        const isAtStart = document.activeElement === this.#start;
        this.#empty.hidden = has;
        this.#start.hidden = has;
        for (const one of [this.#pause, this.#restart, this.#stop]) one.hidden = !has;
        this.#pause.disabled = !this.#isRunning;
        // Somebody at the keyboard goes on from here.
        if (has && isAtStart) this.#pause.focus();
        write(this.#pause, isPaused ? "Go on" : "Pause");
        mark(this.element, "data-running", `${this.#isRunning && !isPaused}`);
        this.#writeClock();
    }

    #writeClock(): void {
        if (this.#search !== null && this.#view === null) return;
        if (this.#view === null || this.#board === null) return write(this.#clock, "");
        const time = shownTime(this.#view.readings.now_ms);
        const { isPaused, pace } = this.#board;
        const isLate = this.#measured !== null && this.#measured < pace * LATE && !isPaused;
        const told = isLate ? `, ${this.#measured?.toFixed(1)}×: as fast as this machine can` : "";
        write(this.#clock, `${this.#board.info.board}: ${time}${isPaused ? ", paused" : told}`);
    }
}

function message(error: unknown): string {
    return error instanceof Error ? error.message : String(error);
}
