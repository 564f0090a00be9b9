// What the page and its workers tell each other, and the parts of the language server protocol that the page speaks.

import type { Tool } from "../../crates/wasm/sensedsl.mjs";

/** The functions of the tool that can be called in a worker; `ask` is the tool itself. */
export type Call = "ask" | "project" | "report" | "why" | "diff" | "places" | "pin" | "boards" | "parts" | "board_svg";

/** From the page to a worker. */
export type ToWorker =
    | { type: "module"; module: WebAssembly.Module }
    | { type: "language"; message: object }
    /** Notifications that change texts; a wiring is looked for after so long without another. */
    | { type: "change"; messages: object[]; change: number; wait_ms: number }
    | { type: "show"; uri: string | null }
    | { type: "call"; id: number; name: Call; args: unknown[] };

/** From a worker to the page. */
export type FromWorker =
    | { type: "ready" }
    | { type: "language"; message: object }
    | { type: "searching" }
    | { type: "settled"; messages: object[]; uri: string | null; wiring: unknown; change: number; took_ms: number }
    | { type: "answer"; id: number; value?: unknown; error?: string };

/** What calls of the tool return. */
export type Answers = {
    [Name in Exclude<Call, "ask">]: ReturnType<Tool[Name]>;
} & { ask: ReturnType<Tool> };

export interface Position {
    line: number;
    character: number;
}

export interface Range {
    start: Position;
    end: Position;
}

export interface TextEdit {
    range: Range;
    newText: string;
}

export interface WorkspaceEdit {
    changes: Record<string, TextEdit[]>;
}

export interface Problem {
    range: Range;
    severity: 1 | 2 | 3 | 4;
    code: string;
    message: string;
    relatedInformation?: { location: { uri: string; range: Range }; message: string }[];
    tags?: number[];
}

export interface CodeAction {
    title: string;
    kind: string;
    diagnostics?: Problem[];
    isPreferred?: boolean;
    edit?: WorkspaceEdit;
}

/** What `sensedsl solve --format json` prints. */
export interface Solution {
    status: string;
    cost: number | null;
    boards: { name: string; mcu: string; cost: number; devices: Wired[] }[];
    conflict?: Conflict;
}

/** A device with the pins of its wires; `chip` is the chip that it is a value of. */
export interface Wired {
    name: string;
    kind: string;
    chip?: string;
    wires: { role: string; pin: string; signal: string }[];
}

export interface Conflict {
    devices: string[];
    resources: string[];
    repairs: { action: string; device: string | null; message: string; cost: number | null; best: boolean }[];
    rules: string[];
    places: { resource: string; board: string; pin: string; line: number }[];
    minimal: boolean;
}

/** The answer to `sensedsl/wiring`. */
export interface Wiring {
    svg: string | null;
    is_current: boolean;
    answer: Solution | null;
    parts: { name: string; range: Range; selection_range: Range }[];
}
