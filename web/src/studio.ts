// The studio: what the parts of the page know of each other.

import type { Solution, Wiring } from "./talk";
import { blanked } from "./language/words";
import type { Editor } from "./language/editor";
import type { LanguageServer } from "./language/server";
import type { Problems } from "./language/problems";
import type { ToolWorker } from "./tool";

/** What a request to the tool is about. */
export interface Asked {
    path: string;
    files: Record<string, string>;
    board?: string;
}

/** The parts of the page, once it is there. */
export interface Studio {
    editor: Editor;
    server: LanguageServer;
    tool: ToolWorker;
    problems: Problems;
    /** The wiring that was found last, of the file that is open. */
    wiring: Wiring | null;
    /** The last wiring that there was, for what is compared with it. */
    solution: Solution | null;
    request(): Asked;
    /** Goes to the text of a part. */
    goTo(name: string, isFocused: boolean): void;
    /** The parts that the cursor is in, the innermost last. */
    here(): string[];
    /** Called when the texts have changed, or their wiring has. */
    onChange(listener: () => void): () => void;
    save(name: string, bytes: Uint8Array, type: string): void;
}

const BOARD = /\bboard\s+[A-Za-z_]/;

/** The file that a design is asked for by: the open one if it has a board, or else one that uses it, or any with a board. */
export function designOf(texts: Record<string, string>, open: string): string {
    const designs = Object.keys(texts).filter((path) => path.endsWith(".sense"));
    const has = (path: string) => BOARD.test(blanked(texts[path] ?? ""));
    if (open.endsWith(".sense") && has(open)) return open;
    const name = open.split("/").pop() ?? open;
    const user = designs.find((path) => path !== open && (texts[path] ?? "").includes(`"${name}"`) && has(path));
    return user ?? (open.endsWith(".sense") ? open : (designs.find(has) ?? designs[0] ?? open));
}
