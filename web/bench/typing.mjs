// How long an editor waits for the module while somebody types into a file of a hundred devices: the same file, keys and
// questions as `cargo bench -p sensedsl-tests --bench typing`, which is the peer to compare with.
//
//     cargo xtask web && node bench/typing.mjs [MODULE]

import { readFileSync } from "node:fs";
import { load } from "../../crates/wasm/sensedsl.mjs";

const MODULE = process.argv[2] ?? new URL("../../target/web/wasm32-unknown-unknown/web/sensedsl_wasm.wasm", import.meta.url);
const URI = "file:///robot/robot.sense";
const DEVICES = 100;
const KEYS = 500;

function device(number) {
    const id = number + 1;
    if (number < 20) return `returns uint16 {\n        id = ${id};\n        type = analog;\n        delay = 2 * CYCLE;\n    }`;
    if (number < 60) return `returns bool {\n        id = ${id};\n        type = digital;\n    }`;
    const address = (0x10 + number - 60).toString(16).toUpperCase();
    return `returns uint8 {\n        id = ${id};\n        type = i2c;\n        address = 0x${address};\n        register = 1;\n        length = 1;\n    }`;
}

const devices = Array.from({ length: DEVICES }, (_, number) => `    sensor S${number} ${device(number)}\n`).join("");
const text = `const CYCLE = 10 ms;\nboard Robot on NUCLEO_F767ZI {\n${devices}}\n`;
const tool = await load(readFileSync(MODULE));
let id = 0;

function ask(method, params) {
    id += 1;
    const [answer] = tool.message({ jsonrpc: "2.0", id, method, params }).slice(-1);
    if (!answer || answer.error) throw new Error(`${method}: ${JSON.stringify(answer)}`);
}

const tell = (method, params) => tool.message({ jsonrpc: "2.0", method, params });

function timed(work) {
    const began = performance.now();
    work();
    return performance.now() - began;
}

function report(what, all) {
    all.sort((one, other) => one - other);
    const at = (share) => all[Math.floor(((all.length - 1) * share) / 100)].toFixed(2);
    console.log(`${what}: median ${at(50)} ms, p99 ${at(99)} ms, most ${at(100)} ms`);
}

function change(key, range, inserted) {
    tell("textDocument/didChange", { textDocument: { uri: URI, version: key + 2 }, contentChanges: [{ range, text: inserted }] });
}

ask("initialize", { capabilities: {} });
tell("textDocument/didOpen", { textDocument: { uri: URI, languageId: "sensedsl", version: 1, text } });
report("first wiring", [timed(() => tool.settle())]);
const typed = "    sensor Extra returns uint16 { id = 200; type = analog; delay = 30 ms; pin = PA0; }\n";
const line = text.split("\n").length - 2;
const [answers, settles] = [[], []];
for (let key = 0; key < KEYS; key += 1) {
    const character = key % typed.length;
    // At the end of the line it is taken out again.
    if (character === 0 && key > 0) change(key, { start: { line, character: 0 }, end: { line: line + 1, character: 0 } }, "");
    const position = { line, character: character + 1 };
    const textDocument = { uri: URI };
    const range = { start: { line: Math.max(0, line - 60), character: 0 }, end: position };
    answers.push(
        timed(() => {
            change(key, { start: { line, character }, end: { line, character } }, typed[character]);
            ask("textDocument/completion", { textDocument, position });
            ask("textDocument/semanticTokens/range", { textDocument, range });
            ask("textDocument/inlayHint", { textDocument, range });
            ask("textDocument/documentHighlight", { textDocument, position });
        }),
    );
    if (key % 10 === 0) settles.push(timed(() => tool.settle()));
}
report("a key: the change and four answers", answers);
report("diagnostics and wiring, once nobody types", settles);
