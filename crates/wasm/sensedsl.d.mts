/** Texts by path: the file that is asked for, those that it uses, tables. */
export interface Request {
    path: string;
    files: Record<string, string>;
    /** What `--board` and `--target` are on the command line. */
    board?: string;
    target?: string;
}

/** What `sensedsl check --format json` prints of each. */
export interface Diagnostic {
    severity: "error" | "warning" | "hint";
    code: string;
    message: string;
    [more: string]: unknown;
}

/** What `load` returns: a function from request to answer, with everything else beside it. */
export interface Tool {
    /** Check, solve, draw. */
    (request: Request): {
        diagnostics: Diagnostic[];
        /** What `sensedsl solve --format json` prints; null where nothing can be wired. */
        answer: object | null;
        svg: string | null;
        left_out: string[];
    };
    /** The same from text to text: requests, calls with `do`, messages of the language server. */
    raw: { answer(request: string): string; call(call: string): string; message(message: string): string; settle(): string };

    /** Gives the language server a message, and returns its messages. */
    message(message: object): object[];
    /** Lets the language server look for wirings, once no message waits. */
    settle(): object[];

    /** All files that `sensedsl generate` writes, by path; null if there are errors. `hosts`: names as `--host` takes them, all if left out. */
    project(request: Request & { hosts?: string[]; without?: ("firmware" | "host")[] }): { diagnostics: Diagnostic[]; files: Record<string, string> | null };
    /** A report of a wiring as the command line prints it: `text` for people (HTML for "sheet"), `value` as `--format json` (null for "sheet"). */
    report(request: Request & { report: "sheet" | "capacity" | "timing" | "solve" }): Report;
    /** `sensedsl explain wiring FILE NAME`. */
    why(request: Request & { name: string }): Report;
    /** `sensedsl diff`: from an earlier `answer` to the wiring of this text. */
    diff(request: Request & { old: object }): Report;
    /** Each pin that a device's or chip's wires could have, with what it would cost. */
    places(request: Request & { name: string }): { diagnostics: Diagnostic[]; places: Place[] | null };
    /** The text with the wire on that pin; `files` has the changed texts, null if the tool cannot write it (`error` says why). */
    pin(request: Request & { name: string; wire: string; pin: string }): { files: Record<string, string> | null; error: string | null };
    /** Built-in boards, and parts with drivers, for a palette. */
    boards(): {
        /** As `on NAME` takes it, once `-` is written as `_`. */
        name: string;
        mcu: string;
        family: string;
        package: string | null;
        pins: number;
        free: number;
        link: string;
        firmware: string[];
        keywords: string;
    }[];
    parts(): {
        name: string;
        title: string;
        about: string;
        field: string;
        kind: string;
        quantities: string[];
        aliases: string[];
        /** The part as it is written into a board's block. */
        snippet: string;
        /** The part's page, in Markdown. */
        page: string;
    }[];
    /** The picture of a built-in board that nothing is wired to. */
    board_svg(name: string): string | null;

    /** Starts a simulated board of the design: the one of that name, or the first. Its world is `world`, the path of one of the files (TOML; what it names is looked for beside it), or the usual one. */
    robot(request: Request & { name?: string; world?: string }): { diagnostics: Diagnostic[]; robot: RobotInfo | null };
    /** Runs the simulated board up to a virtual time, and returns what its host sees. */
    run(until_ms: number): Seen;
    /** Holds a quantity of the world (an element of a sensor) at a shown value; null lets the world have it again. */
    steer(device: string, element: number, shown: number | null): null | { error: string };

    /** A host for a real board of the design: the same events from the bytes of a link. */
    host(request: Request & { name?: string }): { diagnostics: Diagnostic[]; robot: RobotInfo | null };
    /** A link was opened, or opened again: the host asks who is there. */
    opened(now_ms: number): void;
    /** Bytes that came from the board, and the time; also to be called without bytes every 50 ms. */
    feed(bytes: Uint8Array, now_ms: number): Seen;
    /** Bytes to send to the board now. */
    to_send(now_ms: number): Uint8Array;

    /** Sets an actuator, for `robot` and for `host` alike: a shown value as people type it (`45 deg`). `error` says why not; `text` is what was sent. */
    set(device: string, value: string): { error: string | null; text: string | null };

    /** Puts back what `web/split.mjs` has taken out of the module; `project` needs it. */
    fill(texts: Uint8Array): void;
}

export interface Report { diagnostics: Diagnostic[]; text: string | null; value: unknown }

export interface Place {
    wire: string; board: string; pin: string; signal: string; chosen: boolean; possible: boolean;
    /** "chosen", "costs 3 more in all", "no wiring: the others need it", … */
    verdict: string;
    /** What the whole wiring costs more (or less) with it; null where it is not a matter of cost. */
    more: number | null;
}

export interface RobotInfo {
    board: string;
    /** Boards of the design, for a choice. */
    boards: string[];
    hash: string;
    baud: number | null;
    /** Its controllers by name. */
    controllers: string[];
    /** Of the simulated board: whether their code runs, for which it takes a compiler (`sensedsl studio` has one). */
    has_code?: boolean;
    /** Of the simulated board: the controllers that blocks of the world stand in for. */
    stand_ins?: string[];
    /** Of the simulated board: the maps that robots of its world drive on, in metres. */
    maps?: {
        /** The robot's name. */
        name: string;
        /** Width and height. The top left corner is at 0, 0; x goes to the right and y upwards, so that what is on the map has a negative y. */
        size: [number, number];
        /** The robot's radius. */
        body: number;
        /** Lines on the floor, and walls. A piece is from x, y to x, y. */
        strokes: { pieces: [number, number, number, number][]; width: number; is_wall: boolean }[];
    }[];
    devices: {
        name: string; id: number; direction: "sensor" | "actuator"; kind: string; type: string;
        /** Elements of its value; 1 for a plain number. */
        elements: number;
        is_bool: boolean;
        unit: string | null;
        /** In shown units; null where unbounded. For sliders use `slider`, always finite. */
        min: number | null; max: number | null;
        slider: { min: number; max: number; step: number };
        cycle_ms: number | null;
    }[];
}

/** What a host has seen since the last call. */
export interface Seen {
    now_ms: number;
    state: "asking" | "matched" | "playing" | "comparing" | "refused";
    /** [time in ms, index of the device, shown numbers, text such as "37.98 cm", what the board sent] */
    values: [number, number, (number | null)[], string, (number | boolean | null)[]][];
    /** For people: "the board is Rover, hash …", "Light has not reported for 1.2 s", differences of another firmware, … */
    notes: { level: "info" | "warning" | "error"; text: string }[];
    /** What the board last told of its health; null if nothing new. */
    health: { uptime_s: number; reset_cause: string; devices: { name: string; status: string; causes: string }[]; [more: string]: unknown } | null;
    counts: { bytes: number; frames: number; dropped_bytes: number; withheld: number; lost: number };
    /** Of the simulated board: [index of an actuator, shown numbers, what its wires do (such as "1500 us of 20 ms")]. */
    outputs?: [number, number[], string][];
    /** Of the simulated board, for each map: where the robot was (x, y), and where it looked (x, y). */
    poses?: [number, number, number, number][][];
    /** Of the simulated board: what its robots have come to so far, such as "Robot: 1.59 m, at most 3.4 mm off the line". */
    figures?: string[];
}

/** Loads the module, or takes one that another worker has compiled. */
export function load(wasm: BufferSource | WebAssembly.Module | Promise<BufferSource | WebAssembly.Module>): Promise<Tool>;
