// Takes the texts of generated projects out of the module: the runtimes of firmware and hosts are an eighth of what a
// first visit would fetch, and only whoever takes a project along needs them.
//
// In: the module, and the folders of those texts. Out: the module with zeros in their place, which compress to nothing,
// and one file with the texts, each with its address in the module's memory. `fill` of `sensedsl.mjs` puts them back.

import { readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";

/** Shorter ones may stand for something else as well. */
const BYTES_MIN = 400;
const DATA_SECTION = 11;
const I32_CONST = 0x41;

/** A number of the format at a place, and the place after it. */
function leb(bytes, start) {
    let value = 0;
    for (let at = start, shift = 0; ; at += 1, shift += 7) {
        value += (bytes[at] & 0x7f) * 2 ** shift;
        if (bytes[at] < 0x80) return [value, at + 1];
    }
}

/** The segments of data: where each begins in the file, where it ends, and where it is in memory. */
function segments(wasm) {
    for (let at = 8; at < wasm.length; ) {
        const id = wasm[at];
        const [length, start] = leb(wasm, at + 1);
        if (id === DATA_SECTION) return inside(wasm, start);
        at = start + length;
    }
    throw new Error("the module has no data");
}

function inside(wasm, start) {
    const found = [];
    let [count, at] = leb(wasm, start);
    for (; count > 0; count -= 1) {
        if (wasm[at] !== 0 || wasm[at + 1] !== I32_CONST) throw new Error("a segment has no fixed address");
        const [address, end] = leb(wasm, at + 2);
        const [length, from] = leb(wasm, end + 1);
        found.push({ from, to: from + length, address });
        at = from + length;
    }
    return found;
}

function below(folder) {
    return readdirSync(folder).sort().flatMap((name) => {
        const path = join(folder, name);
        return statSync(path).isDirectory() ? below(path) : [path];
    });
}

/** The module without the texts of these folders, and the texts: address, length (both little-endian) and bytes of each. */
export function split(wasm, folders) {
    const module = Buffer.from(wasm);
    const all = segments(wasm);
    const parts = [];
    for (const path of folders.flatMap(below)) {
        const text = readFileSync(path);
        const at = text.length < BYTES_MIN ? -1 : wasm.indexOf(text);
        const segment = all.find(({ from, to }) => at >= from && at + text.length <= to);
        if (segment === undefined) continue;
        module.fill(0, at, at + text.length);
        const head = Buffer.alloc(8);
        head.writeUInt32LE(segment.address + at - segment.from, 0);
        head.writeUInt32LE(text.length, 4);
        parts.push(head, text);
    }
    return { module, texts: Buffer.concat(parts) };
}
