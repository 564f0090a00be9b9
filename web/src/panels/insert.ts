// Where a part goes in a text, and where a board is named.

import { blanked } from "../language/words";

interface Block {
    /** Of its first letter, of the brace that opens it, and of the one that closes it. */
    start: number;
    open: number;
    close: number;
    header: string;
}

/** The blocks of boards. */
export function boards(text: string): Block[] {
    const plain = blanked(text);
    const found: Block[] = [];
    for (const match of plain.matchAll(/\bboard\s+[A-Za-z_][^{};]*\{/g)) {
        const open = match.index + match[0].length - 1;
        let depth = 0;
        let close = open;
        for (; close < plain.length; close += 1) {
            if (plain[close] === "{") depth += 1;
            if (plain[close] === "}") depth -= 1;
            if (depth === 0) break;
        }
        found.push({ start: match.index, open, close, header: text.slice(match.index, open) });
    }
    return found;
}

/** The board that the cursor is in, or else the last one before it, or the first. */
function nearest(all: Block[], at: number): Block | undefined {
    return all.find((one) => one.start <= at && at <= one.close) ?? all.filter((one) => one.close < at).at(-1) ?? all[0];
}

/** The lowest identifier that no device has. */
function freeId(text: string): number {
    const taken = new Set([...blanked(text).matchAll(/\bid\s*=\s*(\d+)/g)].map((one) => Number(one[1])));
    let id = 1;
    while (taken.has(id)) id += 1;
    return id;
}

/** The start of the first line below what the cursor is in, directly inside the block. */
function placeIn(text: string, { open, close }: Block, at: number): number {
    const plain = blanked(text);
    if (at <= open || at > close) return lineStart(text, close);
    let depth = 0;
    for (let place = open; place < at; place += 1) {
        if (plain[place] === "{") depth += 1;
        if (plain[place] === "}") depth -= 1;
    }
    let place = at;
    while (depth > 1 && place < close) {
        if (plain[place] === "{") depth += 1;
        if (plain[place] === "}") depth -= 1;
        place += 1;
    }
    const end = text.indexOf("\n", place);
    return end < 0 || end >= close ? lineStart(text, close) : end + 1;
}

/** The start of the line of a closing brace, or the brace itself if something else is before it. */
function lineStart(text: string, close: number): number {
    const start = text.lastIndexOf("\n", close - 1) + 1;
    return text.slice(start, close).trim() === "" ? start : close;
}

/** A part as it goes into a text: where, what, and the name in it that is selected, from the start of what is put in. */
export function insertion(text: string, at: number, snippet: string): { from: number; insert: string; select: { from: number; to: number } } {
    const block = nearest(boards(text), at);
    // A snippet may have places of an editor: their defaults are what is written.
    const plain = snippet.replace(/\$\{\d+:([^}]*)\}/g, "$1").replace(/\$\{?\d+\}?/g, "");
    let id = freeId(text);
    const known = new Set([...text.matchAll(/\b(?:sensor|actuator|chip)\s+([A-Za-z_][A-Za-z0-9_]*)/g)].map((one) => one[1]));
    const named = plain
        .replace(/\bid\s*=\s*\d+/g, () => `id = ${id++}`)
        .replace(/\b(sensor|actuator|chip)(\s+)([A-Za-z_][A-Za-z0-9_]*)/g, (_, word: string, blank: string, name: string) => {
            let free = name;
            for (let number = 2; known.has(free); number += 1) free = `${name}${number}`;
            known.add(free);
            return `${word}${blank}${free}`;
        });
    const lines = named.trim().split("\n");
    if (!block) {
        const insert = `${text === "" || text.endsWith("\n") ? "" : "\n"}board Robot on STM32F4DiscoveryBoard {\n${lines.map((line) => `    ${line}`).join("\n")}\n}\n`;
        return { from: text.length, insert, select: nameIn(insert) };
    }
    const from = placeIn(text, block, at);
    const isLine = from === 0 || text[from - 1] === "\n";
    const indented = lines.map((line) => (line === "" ? "" : `    ${line}`)).join("\n");
    const insert = isLine ? `${indented}\n` : `\n${indented}\n`;
    return { from, insert, select: nameIn(insert) };
}

function nameIn(text: string): { from: number; to: number } {
    const found = /\b(?:sensor|actuator|chip)\s+/.exec(text);
    const from = found ? found.index + found[0].length : 0;
    const name = /^[A-Za-z0-9_]*/.exec(text.slice(from))?.[0] ?? "";
    return { from, to: from + name.length };
}

/** The change that puts the board of the cursor onto another one. */
export function boardChange(text: string, at: number, board: string): { from: number; to: number; insert: string } {
    // As a word of the language it has no hyphens.
    const name = board.replaceAll("-", "_");
    const block = nearest(boards(text), at);
    if (!block) return { from: text.length, to: text.length, insert: `board Robot on ${name} {\n}\n` };
    const on = /\bon\s+("[^"]*"|[A-Za-z_][A-Za-z0-9_-]*)/.exec(block.header);
    if (on) {
        const from = block.start + on.index + on[0].length - (on[1]?.length ?? 0);
        return { from, to: from + (on[1]?.length ?? 0), insert: name };
    }
    const end = block.start + block.header.trimEnd().length;
    return { from: end, to: end, insert: ` on ${name}` };
}
