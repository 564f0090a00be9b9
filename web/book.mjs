// Builds the scripts of the documentation's site; `cargo xtask site` calls it.
//
//     node book.mjs --studio FOLDER --into FOLDER
//
// `site.js` is what each page loads; `playground/` comes when somebody wants to run a listing, with the module and the
// worker of the studio, which the site has in `studio/`.

import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({ options: { studio: { type: "string" }, into: { type: "string" } } });
const [studio, into] = [resolve(values.studio), resolve(values.into)];
process.chdir(here);

function hash(bytes) {
    return createHash("sha256").update(bytes).digest("hex").slice(0, 12);
}

/** A file of the studio as the studio itself names it, so that a browser has it once for both. */
function ofStudio(name) {
    return `${name}?v=${hash(readFileSync(join(studio, name)))}`;
}

async function bundle(entry, format, define = {}) {
    const found = await build({
        entryPoints: [entry],
        absWorkingDir: here,
        write: false,
        bundle: true,
        minify: true,
        target: "es2022",
        format,
        define,
        platform: "browser",
        logLevel: "warning",
        legalComments: "none",
        outfile: "out.js",
    });
    return found.outputFiles[0].contents;
}

mkdirSync(join(into, "playground"), { recursive: true });
const playground = await bundle("src/book/playground.ts", "esm", {
    // The playground knows where the site is only when it runs.
    WASM_URL: "globalThis.sensedslStudio.wasm",
    WORKER_URL: "globalThis.sensedslStudio.worker",
});
const style = (await bundle("src/book/playground.css", undefined)).valueOf();
writeFileSync(join(into, "playground/playground.js"), playground);
writeFileSync(join(into, "playground/playground.css"), style);
const site = await bundle("src/book/site.ts", "iife", {
    PLAYGROUND_URL: JSON.stringify(`playground/playground.js?v=${hash(playground)}`),
    PLAYGROUND_STYLE_URL: JSON.stringify(`playground/playground.css?v=${hash(style)}`),
    STUDIO_WASM_URL: JSON.stringify(ofStudio("sensedsl.wasm")),
    STUDIO_WORKER_URL: JSON.stringify(ofStudio("worker.js")),
});
writeFileSync(join(into, "site.js"), site);
