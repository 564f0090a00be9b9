// Bundles the extension into `dist/`, beside the language server as WebAssembly.
//
// `SENSEDSL_WASM` names the module; unless it does, the one that `cargo xtask web` has built is taken.

import { copyFileSync, existsSync, mkdirSync, rmSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../..");
const built = join(root, "target/web/wasm32-unknown-unknown/web/sensedsl_wasm.wasm");
const server = process.env.SENSEDSL_WASM ?? built;
if (!existsSync(server)) {
    console.error(`there is no ${server}: \`cargo xtask web\` builds it`);
    process.exit(1);
}
process.chdir(here);
rmSync("dist", { recursive: true, force: true });
mkdirSync("dist");
copyFileSync(server, "dist/server.wasm");
copyFileSync(join(root, "LICENSE-APACHE"), "dist/LICENSE-APACHE.txt");
copyFileSync(join(root, "examples/line_follower.sense"), "dist/line_follower.sense");

const all = { bundle: true, minify: true, target: "es2022", logLevel: "warning", legalComments: "linked" };
const extension = { ...all, format: "cjs", external: ["vscode"] };
await Promise.all([
    build({ ...extension, entryPoints: ["src/browser.ts"], outfile: "dist/browser.js", platform: "browser" }),
    build({ ...extension, entryPoints: ["src/node.ts"], outfile: "dist/node.js", platform: "node" }),
    build({ ...all, entryPoints: ["src/worker.ts"], outfile: "dist/worker.js", format: "iife", platform: "browser", external: ["node:*"] }),
    build({ ...all, entryPoints: ["src/view.ts"], outfile: "dist/view.js", format: "iife", platform: "browser" }),
]);
copyFileSync("src/view.css", "dist/view.css");
