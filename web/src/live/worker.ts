// A board in a worker of its own: the simulated one, which the page's server may run instead, or the host of a real one.
// Ending the worker frees it.

import { load, type Seen, type Tool } from "../../../crates/wasm/sensedsl.mjs";
import { type Engine, engineOf } from "./engine.js";
import { merged } from "./merge.js";
import type { Calls, FromWorker, ToWorker } from "./messages.js";
import { ServedBoard } from "./served.js";

/** How often the simulated board goes on, and how often a real one is listened to. */
const TICK_MS = 16;
const LISTEN_MS = 50;
/** The most time that steps of one tick take; the rest is for messages. */
const BUSY_MS = 12;
/** After a pause of the whole page, the board does not catch up. */
const CATCH_UP_MS = 250;
/** The most messages that the page has not taken yet; what comes then goes into the next one. */
const UNTAKEN_MAX = 2;
/** A page that takes nothing for so long is not there, and the simulated board waits for it. */
const ABSENT_MS = 5_000;
/** How long the pace is measured. */
const PACE_MS = 500;
/** A board that stands still is called once in a while: the server ends those that nobody calls. */
const ALIVE_MS = 60_000;

let tool: Promise<Tool> | null = null;
let engine: Promise<Engine> | null = null;
let timer: ReturnType<typeof setInterval> | undefined;
let isWorking = false;
let untaken = 0;
let taken_ms = 0;
let waiting: Seen | null = null;

const post = (message: FromWorker, moved: Transferable[] = []) => postMessage(message, { transfer: moved });

/** The simulated board's clock. */
const clock = { pace: 0, virtual_ms: 0, done_ms: 0, last_ms: 0 };
/** How fast it really went. */
const measured = { since_ms: 0, from_ms: 0, pace: null as number | null };

/** A real board's times begin when its host is made. */
let origin_ms = 0;

const now = () => performance.now() - origin_ms;

function tell(seen: Seen | null, pace: number | null): void {
    if (seen !== null) waiting = merged(waiting, seen);
    if (waiting === null || untaken >= UNTAKEN_MAX) return;
    if (untaken === 0) taken_ms = performance.now();
    untaken += 1;
    post({ kind: "seen", seen: waiting, pace });
    waiting = null;
}

function measure(): void {
    const passed_ms = now() - measured.since_ms;
    if (passed_ms < PACE_MS) return;
    measured.pace = (clock.done_ms - measured.from_ms) / passed_ms;
    measured.since_ms = now();
    measured.from_ms = clock.done_ms;
}

async function tick(board: Engine): Promise<void> {
    const at_ms = now();
    const passed_ms = Math.min(at_ms - clock.last_ms, CATCH_UP_MS);
    clock.last_ms = at_ms;
    if (untaken > 0 && performance.now() - taken_ms > ABSENT_MS) return;
    clock.virtual_ms += passed_ms * clock.pace;
    let seen: Seen | null = null;
    while (Math.floor(clock.virtual_ms) > clock.done_ms && now() - at_ms < BUSY_MS) {
        clock.done_ms = Math.min(Math.floor(clock.virtual_ms), clock.done_ms + board.step_ms);
        seen = merged(seen, await board.run(clock.done_ms));
    }
    // What could not be done in time is not made up for: the board is as fast as this machine can.
    clock.virtual_ms = Math.min(clock.virtual_ms, clock.done_ms + board.step_ms);
    measure();
    tell(seen, measured.pace);
}

function listen(board: Tool, bytes: Uint8Array): void {
    tell(board.feed(bytes, now()), null);
    const bytes_to_send = board.to_send(now()) as Uint8Array<ArrayBuffer>;
    if (bytes_to_send.length > 0) post({ kind: "send", bytes: bytes_to_send }, [bytes_to_send.buffer]);
}

/** Errors end the worker's work, because the tool is in an unknown state after them. */
async function guarded(work: () => void | Promise<void>): Promise<void> {
    try {
        await work();
    } catch (error) {
        clearInterval(timer);
        post({ kind: "ended", error: message(error) });
    }
}

function message(error: unknown): string {
    return String(error).replace(/^Error: /, "");
}

/** Works again and again; what takes longer than the wait is not begun twice. */
function every(wait_ms: number, work: () => void | Promise<void>): void {
    clearInterval(timer);
    timer = setInterval(() => {
        if (isWorking) return;
        isWorking = true;
        void guarded(work).finally(() => {
            isWorking = false;
        });
    }, wait_ms);
}

function setPace(board: Engine, pace: number): void {
    Object.assign(clock, { pace, last_ms: now() });
    Object.assign(measured, { since_ms: now(), from_ms: clock.done_ms, pace: null });
    if (pace > 0) every(TICK_MS, () => tick(board));
    else every(ALIVE_MS, async () => tell(await board.run(clock.done_ms), null));
}

/** What runs the board, once it is there. */
async function there<One>(one: Promise<One> | null): Promise<One> {
    if (one === null) throw new Error("the module has not come");
    return one;
}

type Handlers = { [Name in keyof Calls]: (given: Calls[Name]["given"]) => Promise<Calls[Name]["answer"]> };

const handlers: Handlers = {
    async robot(design) {
        clearInterval(timer);
        Object.assign(clock, { pace: 0, virtual_ms: 0, done_ms: 0, last_ms: now() });
        return (await there(engine)).robot(design);
    },
    async host(design) {
        clearInterval(timer);
        origin_ms = performance.now();
        return (await there(tool)).host(design);
    },
    async pace(pace) {
        setPace(await there(engine), pace);
        return null;
    },
    async steer({ device, element, shown }) {
        await (await there(engine)).steer(device, element, shown);
        return null;
    },
    async set({ device, value }) {
        return (await there(engine)).set(device, value);
    },
    async opened() {
        const board = await there(tool);
        board.opened(now());
        every(LISTEN_MS, () => listen(board, new Uint8Array()));
        await guarded(() => listen(board, new Uint8Array()));
        return null;
    },
};

async function call<Name extends keyof Calls>(id: number, name: Name, given: Calls[Name]["given"]): Promise<void> {
    try {
        post({ kind: "answer", id, answer: await handlers[name](given) });
    } catch (error) {
        post({ kind: "refused", id, error: message(error) });
    }
}

addEventListener("message", async ({ data }: MessageEvent<ToWorker>) => {
    switch (data.kind) {
        case "module":
            tool = load(data.module);
            engine = tool.then(engineOf);
            // Whoever calls is told why it could not be loaded.
            engine.catch(() => {});
            break;
        case "server":
            engine = Promise.resolve(new ServedBoard(data.served));
            break;
        case "call":
            await call(data.id, data.name, data.given);
            break;
        case "bytes": {
            const board = await tool;
            if (board != null) await guarded(() => listen(board, data.bytes));
            break;
        }
        case "taken":
            untaken -= 1;
            taken_ms = performance.now();
            break;
    }
});
