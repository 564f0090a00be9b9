import { Banner } from "./banner.js";
import { boardNames, boardOf, Choice } from "./choice.js";
import type { LiveStudio } from "./contract.js";
import { button, make, mark, write } from "./dom.js";
import { Host, LinkedBoard } from "./linked.js";
import type { Design } from "./messages.js";
import { Speaker } from "./notes.js";
import { notChosen, SerialLink } from "./serial.js";
import { Refused } from "./transport.js";
import { View } from "./view.js";
import { missing, portName, type Serial, type SerialPort, webSerial } from "./webserial.js";

/** A link over USB has no baud rate; the browser wants one. */
const ANY_BAUD = 115_200;
const TRY_AFTER_MS = 700;
const STATES = {
    asking: "Asking who is there…",
    matched: "Connected: firmware and design agree.",
    playing: "Connected.",
    comparing: "Other firmware: comparing it with the design…",
    refused: "Other firmware: its values are ignored.",
};

/** The panel that shows a real board. */
export class Connect {
    readonly element: HTMLElement;
    readonly #studio: LiveStudio;
    readonly #speaker: Speaker;
    readonly #serial: Serial | null = webSerial();
    readonly #banner = new Banner();
    readonly #offer = new Banner();
    readonly #empty = make("div", { class: "live-empty" });
    readonly #choose: HTMLButtonElement;
    readonly #known = make("div", { class: "live-bar", role: "group", "aria-label": "Ports that this page may use" });
    readonly #disconnect: HTMLButtonElement;
    readonly #state = make("span", { class: "live-clock" });
    readonly #boards = new Choice("Board", () => void this.#again());
    #board: LinkedBoard | null = null;
    #view: View | null = null;
    #port: SerialPort | null = null;
    #isDark = false;
    #isOpen = false;
    #isBusy = false;
    /** What the board is compared with, to know whether the text is another one. */
    #running = "";
    /** The notes of another firmware. */
    #differences: string[] = [];
    #last: keyof typeof STATES | null = null;
    #timer: ReturnType<typeof setTimeout> | undefined;

    constructor(studio: LiveStudio) {
        this.#studio = studio;
        this.#speaker = new Speaker((text) => studio.announce(text));
        this.#choose = button("Connect a board…", () => void this.#ask(), { class: "live-main" });
        this.#disconnect = button("Disconnect", () => void this.#end());
        const bar = make(
            "div",
            { class: "live-bar live-toolbar", role: "group", "aria-label": "Real board" },
            this.#choose,
            this.#known,
            this.#disconnect,
            this.#boards.element,
            this.#state,
        );
        this.element = make(
            "section",
            { class: "live-panel", "aria-label": "Connect" },
            bar,
            this.#banner.element,
            this.#offer.element,
            this.#empty,
        );
        this.#fillEmpty();
        this.#serial?.addEventListener("connect", this.#list);
        this.#serial?.addEventListener("disconnect", this.#list);
        this.#show();
    }

    #fillEmpty(): void {
        if (this.#serial === null) {
            const { text, help } = missing();
            this.#empty.append(make("p", {}, make("strong", {}, text)), make("p", {}, help));
            this.#empty.append(make("p", {}, "“Run” shows the same of a simulated board, in every browser."));
            return;
        }
        this.#empty.append(
            make("p", {}, "A board with the generated firmware reports here what it measures, and takes what you set."),
            make("p", {}, "Plug it in, connect it, and choose its port. What it sends stays in this page."),
        );
    }

    /** It is to be seen now. */
    shown(): void {
        this.#list();
    }

    /** The text has changed: the link goes on with the text before until somebody wants the new one. */
    changed(): void {
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => this.#compare(), TRY_AFTER_MS);
    }

    frame(now_ms: number): void {
        this.#view?.frame(now_ms);
    }

    setDark(isDark: boolean): void {
        this.#isDark = isDark;
        this.#view?.setDark(isDark);
    }

    dispose(): void {
        clearTimeout(this.#timer);
        this.#serial?.removeEventListener("connect", this.#list);
        this.#serial?.removeEventListener("disconnect", this.#list);
        void this.#release();
        this.element.remove();
    }

    #design(): Design {
        const { path, files, board } = this.#studio.request();
        const design: Design = { path, files };
        if (board !== undefined) design.board = board;
        const name = boardOf(files, this.#boards.value);
        if (name !== undefined) design.name = name;
        return design;
    }

    #compare(): void {
        if (this.#board === null) return;
        if (JSON.stringify(this.#design()) === this.#running) return this.#offer.hide();
        const again = button("Connect again with the new text", () => void this.#again(), { class: "live-main" });
        this.#offer.show("info", "The text has changed.", "The board is still read with the previous text.", again);
    }

    /** Ports that this page may use without asking. */
    readonly #list = async (): Promise<void> => {
        const ports = (await this.#serial?.getPorts().catch(() => [])) ?? [];
        const buttons = ports.map((port) => button(`Connect to ${portName(port)}`, () => void this.#connect(port)));
        const had = this.#known.contains(document.activeElement);
        this.#known.replaceChildren(...buttons);
        if (had) (buttons[0] ?? this.#choose).focus();
        this.#show();
    };

    async #ask(): Promise<void> {
        if (this.#serial === null) return;
        let port: SerialPort;
        try {
            port = await this.#serial.requestPort();
        } catch (error) {
            return this.#refuse(notChosen(error));
        }
        await this.#connect(port);
    }

    async #again(): Promise<void> {
        const port = this.#port;
        if (port === null) return;
        await this.#release();
        await this.#connect(port);
    }

    async #connect(port: SerialPort): Promise<void> {
        const serial = this.#serial;
        if (serial === null || this.#isBusy) return;
        this.#isBusy = true;
        this.#banner.hide();
        this.#offer.hide();
        this.#show("Looking for a wiring…");
        try {
            const design = this.#design();
            const { host, diagnostics } = await Host.of(design, await this.#studio.module());
            if (host === null) {
                this.#banner.wrong("The text has no wired board to compare with.", diagnostics);
                this.#speaker.say("The text has no wired board to compare with.");
                return;
            }
            this.#port = port;
            this.#running = JSON.stringify(design);
            await this.#open(new LinkedBoard(host, new SerialLink(serial, port, host.info.baud ?? ANY_BAUD)));
        } catch (error) {
            const refused = error instanceof Refused ? error : new Refused(`Cannot connect: ${error}`, "");
            await this.#release();
            this.#refuse(refused);
        } finally {
            this.#isBusy = false;
            this.#show();
        }
    }

    async #open(board: LinkedBoard): Promise<void> {
        const view = new View(board, { studio: this.#studio, speaker: this.#speaker, steer: null });
        this.#board = board;
        this.#view = view;
        this.#differences = [];
        this.#last = null;
        view.setDark(this.#isDark);
        board.onSeen = (seen) => {
            view.take(seen);
            const errors = seen.notes.filter((one) => one.level === "error");
            this.#differences.push(...errors.map((one) => one.text));
            if (seen.state !== this.#last || errors.length > 0) this.#became(seen.state);
        };
        board.onOpened = () => {
            this.#isOpen = true;
            this.#last = null;
            this.#differences = [];
            this.#banner.hide();
            view.setStale(false);
            this.#show();
        };
        board.onClosed = ({ text, help, isWaiting }) => {
            this.#isOpen = false;
            view.setStale(true);
            view.note("warning", text);
            const choose = button("Choose another port…", () => void this.#chooseOther());
            this.#banner.show("error", text, help, ...(isWaiting ? [choose] : []));
            this.#speaker.say(text);
            this.#show();
        };
        this.#boards.offer(boardNames(board.info.boards));
        await board.start();
        this.element.append(view.element);
        this.#speaker.say("The port is open.");
    }

    async #chooseOther(): Promise<void> {
        if (this.#serial === null) return;
        try {
            const port = await this.#serial.requestPort();
            await this.#release();
            await this.#connect(port);
        } catch (error) {
            this.#speaker.say(notChosen(error).message);
        }
    }

    #became(state: keyof typeof STATES): void {
        const isNew = state !== this.#last;
        this.#last = state;
        this.#show();
        if (isNew && state !== "asking") this.#speaker.say(STATES[state]);
        if (state === "refused" && this.#differences.length > 0) {
            const [head = "", ...rest] = this.#differences;
            const text = head.charAt(0).toUpperCase() + head.slice(1);
            this.#banner.list(text.endsWith(".") ? text : `${text}.`, rest.length > 0 ? "They differ in:" : "", rest);
        } else if (state === "matched") this.#banner.hide();
    }

    #refuse({ message, help }: Refused): void {
        this.#banner.show("error", message, help);
        this.#speaker.say(`${message} ${help}`);
    }

    async #release(): Promise<void> {
        const board = this.#board;
        this.#board = null;
        this.#view?.dispose();
        this.#view = null;
        this.#isOpen = false;
        await board?.stop();
    }

    async #end(): Promise<void> {
        await this.#release();
        this.#banner.hide();
        this.#offer.hide();
        await this.#list();
        this.#choose.focus();
        this.#speaker.say("Disconnected.");
    }

    #show(state?: string): void {
        const has = this.#board !== null;
        const isAtStart = this.#known.contains(document.activeElement) || document.activeElement === this.#choose;
        this.#empty.hidden = has;
        this.#choose.hidden = has || this.#serial === null;
        this.#known.hidden = has || this.#known.childElementCount === 0;
        this.#disconnect.hidden = !has;
        // Somebody at the keyboard goes on from here.
        if (has && isAtStart) this.#disconnect.focus();
        mark(this.#choose, "aria-busy", this.#isBusy ? "true" : null);
        mark(this.element, "data-state", has ? (this.#isOpen ? (this.#last ?? "asking") : "gone") : "none");
        const told = !has ? "" : this.#isOpen ? STATES[this.#last ?? "asking"] : "Waiting for the board to come back…";
        write(this.#state, state ?? told);
    }
}
