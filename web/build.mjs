// Builds the studio, a static site, into `target/web/studio`.
//
//     node build.mjs [--wasm PATH]
//
// Unless `--wasm` names the module, the one that `cargo xtask web` has built is taken. Each file is named in the others
// with the hash of its content, so that a browser never mixes two versions; the service worker has the list of them all.

import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { build } from "esbuild";
import { split } from "./split.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..");
const out = join(root, "target/web/studio");
const next = `${out}.next`;
const { values } = parseArgs({ options: { wasm: { type: "string" } } });
const wasm = resolve(values.wasm ?? join(root, "target/web/wasm32-unknown-unknown/web/sensedsl_wasm.wasm"));
if (!existsSync(wasm)) {
    console.error(`there is no ${wasm}: \`cargo xtask web\` builds it`);
    process.exit(1);
}
process.chdir(here);

/** What is written into projects as it is: nothing but a download needs it. */
const TEXTS = [
    "firmware-arduino/runtime",
    "firmware-c/runtime",
    "firmware-chibios/runtime",
    "firmware-embassy/src/templates",
    "host/src",
    "host-c/runtime",
    "host-cpp/runtime",
    "host-cpp/src",
    "host-matlab/runtime",
    "host-python/runtime",
    "host-rust/runtime",
    "sense-embassy/src",
    "sense-rt/src",
    "wire/src",
];

/** By name in the site: the hash of the content. */
const hashes = new Map();

function hash(bytes) {
    return createHash("sha256").update(bytes).digest("hex").slice(0, 12);
}

function write(name, bytes) {
    hashes.set(name, hash(bytes));
    writeFileSync(join(next, name), bytes);
}

/** A file of the site as the others name it. */
function named(name) {
    return `${name}?v=${hashes.get(name)}`;
}

/**
 * The page's content security policy allows no style element, as any text could be in one. CodeMirror's rules are put
 * into a sheet of the document instead, which `style-mod` does by itself only below a shadow root.
 */
const sheets = {
    name: "sheets",
    setup({ onLoad }) {
        onLoad({ filter: /style-mod\.js$/ }, ({ path }) => {
            const text = readFileSync(path, "utf8");
            const condition = "!root.head && root.adoptedStyleSheets";
            if (!text.includes(condition)) throw new Error(`style-mod has changed: there is no ${condition}`);
            return { contents: text.replace(condition, "root.adoptedStyleSheets"), loader: "js" };
        });
    },
};

async function bundle(entry, name, more = {}) {
    const found = await build({
        entryPoints: [entry],
        outfile: join(next, name),
        absWorkingDir: here,
        write: false,
        bundle: true,
        minify: true,
        target: "es2022",
        format: "iife",
        platform: "browser",
        logLevel: "warning",
        legalComments: "none",
        plugins: [sheets],
        ...more,
    });
    for (const { path, contents } of found.outputFiles) write(path.slice(next.length + 1), contents);
}

/** Projects whose robots drive in the page, with the worlds that their tests name; the first name is that of the design. */
const DRIVING = [["Line follower on its oval", "line_follower", "robot.sense", "oval.toml", "oval.svg", "aside.toml", "eight.toml", "eight.svg"]];

/** The examples, each with the first sentence of its design's comment. */
function examples() {
    const folder = join(root, "examples");
    const names = readdirSync(folder).filter((name) => name.endsWith(".sense"));
    const alone = names.map((name) => {
        const title = name.replace(".sense", "").replaceAll("_", " ");
        return example(title[0].toUpperCase() + title.slice(1), folder, [name]);
    });
    const templates = join(root, "crates/sensedsl/templates/projects");
    const driving = DRIVING.map(([title, name, ...files]) => example(title, join(templates, name), files));
    return [...alone, ...driving].sort((one, other) => (one.title < other.title ? -1 : 1));
}

function example(title, folder, names) {
    const files = Object.fromEntries(names.map((name) => [name, readFileSync(join(folder, name), "utf8")]));
    const [open] = names;
    const comment = [];
    for (const line of files[open].split("\n")) {
        if (!line.startsWith("//")) break;
        comment.push(line.replace(/^\/\/\s*/, ""));
    }
    return { title, about: comment.join(" ").split(/(?<=\.)\s/)[0] ?? "", open, files };
}

/** What is said once for all pages: the licences of what is bundled. */
function licences() {
    const packages = JSON.parse(readFileSync("package-lock.json", "utf8")).packages;
    const bundled = /node_modules\/(@codemirror\/|@lezer\/|@marijn\/|codemirror|fflate|uplot|style-mod|w3c-keyname|crelt)/;
    const texts = Object.keys(packages)
        .filter((path) => bundled.test(path) && existsSync(join(path, "LICENSE")))
        .map((path) => `${path.replace("node_modules/", "")}\n\n${readFileSync(join(path, "LICENSE"), "utf8")}`);
    return texts.join("\n\n---\n\n");
}

rmSync(next, { recursive: true, force: true });
mkdirSync(next, { recursive: true });
const { module, texts } = split(readFileSync(wasm), TEXTS.map((folder) => join(root, "crates", folder)));
write("sensedsl.wasm", module);
write("texts.bin", texts);
write("examples.json", JSON.stringify(examples()));
write("licences.txt", licences());
for (const name of readdirSync("static")) write(name, readFileSync(join("static", name)));
await bundle("src/worker.ts", "worker.js", { define: { TEXTS_URL: JSON.stringify(named("texts.bin")) } });
if (existsSync("src/live/worker.ts")) await bundle("src/live/worker.ts", "live.js");
else write("live.js", "");
const define = {
    WASM_URL: JSON.stringify(named("sensedsl.wasm")),
    EXAMPLES_URL: JSON.stringify(named("examples.json")),
    WORKER_URL: JSON.stringify(named("worker.js")),
    LIVE_WORKER_URL: JSON.stringify(named("live.js")),
};
// What only a running board needs comes when somebody wants one.
await bundle("src/live/index.ts", "run.js", { define, format: "esm", loader: { ".css": "text" } });
define.RUN_URL = JSON.stringify(named("run.js"));
await bundle("src/main.ts", "main.js", { define, loader: { ".css": "text" } });
await bundle("src/style/studio.css", "studio.css");
const page = readFileSync("index.html", "utf8").replaceAll(/\{\{(.+?)\}\}/g, (_, name) => named(name));
write("index.html", page);
const all = [...hashes].sort();
const build_hash = hash(JSON.stringify(all));
await bundle("src/service.ts", "service.js", {
    define: { BUILD: JSON.stringify(build_hash), FILES: JSON.stringify(all.map(([name]) => name)) },
});
rmSync(out, { recursive: true, force: true });
renameSync(next, out);
