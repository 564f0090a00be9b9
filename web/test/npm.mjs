// The npm package as somebody uses it: installed into a project of its own, asked to check, solve, generate and simulate.
//
//     cargo xtask npm && node test/npm.mjs

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { example, root } from "./site.mjs";

const SCRIPT = `
import { readFileSync } from "node:fs";
import { load } from "sensedsl";

const tool = await load(readFileSync(new URL(import.meta.resolve("sensedsl/sensedsl_wasm.wasm"))));
const request = { path: "fig2.sense", files: { "fig2.sense": readFileSync("fig2.sense", "utf8") } };
const solved = tool.report({ ...request, report: "solve" });
const project = tool.project(request);
tool.robot(request);
tool.steer("IRFront", 0, 1234);
const seen = tool.run(3000);
const last = seen.values.filter(([, device]) => device === 0).at(-1);
console.log(JSON.stringify({ cost: solved.value.cost, files: Object.keys(project.files).length, state: seen.state, last: last[2][0] }));
`;

const folder = join(root, "target/web");
const name = readdirSync(folder).find((one) => one.endsWith(".tgz"));
assert.ok(name, "there is no package: cargo xtask npm");
const scratch = mkdtempSync(join(tmpdir(), "sensedsl-npm-"));
try {
    writeFileSync(join(scratch, "package.json"), '{ "private": true, "type": "module" }');
    writeFileSync(join(scratch, "try.mjs"), SCRIPT);
    writeFileSync(join(scratch, "fig2.sense"), example("fig2"));
    execFileSync("npm", ["install", "--no-audit", "--no-fund", "--offline", join(folder, name)], { cwd: scratch, stdio: "inherit" });
    const answer = JSON.parse(execFileSync(process.execPath, ["try.mjs"], { cwd: scratch, encoding: "utf8" }));
    assert.equal(answer.cost, 5);
    assert.ok(answer.files > 50, `${answer.files} files`);
    assert.equal(answer.state, "matched");
    assert.equal(answer.last, 1234);
    console.log(`${name}: ${JSON.stringify(answer)}`);
} finally {
    rmSync(scratch, { recursive: true });
}
