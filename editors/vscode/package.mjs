// Packs `dist/` and the rest into `sensedsl-VERSION.vsix`, the same bytes from the same files.

import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";

process.chdir(dirname(fileURLToPath(import.meta.url)));
const { version } = JSON.parse(readFileSync("package.json", "utf8"));
const vsix = `sensedsl-${version}.vsix`;
// Entries of the archive have the time that this names, not that of the files.
const env = { SOURCE_DATE_EPOCH: "315619200", ...process.env };
const vsce = ["node_modules/@vscode/vsce/vsce", "package", "--no-dependencies", "--allow-missing-repository", "--no-rewrite-relative-links", "--out", vsix];
execFileSync(process.execPath, vsce, { env, stdio: ["ignore", "inherit", "inherit"] });
