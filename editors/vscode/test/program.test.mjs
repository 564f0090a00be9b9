// With the program `sensedsl`, which SENSEDSL names: the server, tests, tasks, and the list of problems.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { after, afterEach, before, test } from "node:test";
import { PATIENCE, command, missing, open, openFile } from "./vscode.mjs";

const root = new URL("../../../", import.meta.url);
const read = (path) => readFileSync(new URL(path, root), "utf8");
const program = process.env.SENSEDSL;
const lacks = missing() ?? (program && existsSync(program) ? undefined : "the program: SENSEDSL names it");
const shots = process.env.SHOTS;
const options = { skip: lacks, timeout: PATIENCE.test };
const WRONG = "board B on STM32F407G_DISC1 {\n    sensor A returns uint16 { id = 1; type = analog; pin = PZ9; }\n}\n";
const BAD_WORLD = "[devices]\nNope = 3\n";
let code;
let page;

const shot = async (name) => {
    if (!shots) return;
    mkdirSync(shots, { recursive: true });
    await page.screenshot({ path: `${shots}/${name}.png` });
};

before(async () => {
    if (lacks) return;
    const robot = read("examples/line_follower.sense");
    const files = {
        "robot.sense": robot,
        "worlds/robot.toml": read("examples/worlds/line_follower.toml"),
        "strange.sense": robot,
        "strange.toml": BAD_WORLD,
        "wrong.sense": WRONG,
    };
    const theme = process.env.THEME ? { "workbench.colorTheme": process.env.THEME } : {};
    code = await open(files, { ...theme, "sensedsl.path": program });
    page = code.page;
    page.setDefaultTimeout(PATIENCE.page);
    await openFile(page, "robot.sense");
    const item = page.locator(".statusbar-item", { hasText: "SenseDSL" }).locator("[aria-label*='version']").first();
    await item.waitFor();
    assert.ok((await item.getAttribute("aria-label")).includes(program));
});

afterEach(async ({ name }) => shot(`end-${name.split(" ")[2]}`));
after(async () => code?.end());

test("the problem matcher reads what the program prints", options, () => {
    const { contributes } = JSON.parse(read("editors/vscode/package.json"));
    const [head, at] = contributes.problemMatchers[0].pattern.map(({ regexp }) => new RegExp(regexp));
    const { stderr } = spawnSync(program, ["check", "-"], { input: WRONG, encoding: "utf8" });
    const lines = stderr.split("\n");
    const first = lines.findIndex((line) => head.test(line));
    assert.deepEqual(head.exec(lines[first]).slice(1), ["error", "E0310", "B has no pin PZ9"]);
    assert.deepEqual(at.exec(lines[first + 1]).slice(2), ["2", "60"]);
    // Each diagnostic of the corpus has its place in the line below its head.
    const corpus = ["tests/corpus/ok", "tests/corpus/err"].map((path) => new URL(path, root).pathname);
    const files = execFileSync("find", [...corpus, "-name", "*.sense"], { encoding: "utf8" }).trim().split("\n").sort();
    const all = spawnSync(program, ["check", ...files], { encoding: "utf8", maxBuffer: 1 << 26 }).stderr.split("\n");
    const heads = all.flatMap((line, number) => (head.test(line) ? [number] : []));
    assert.ok(heads.length > 100);
    const lost = heads.filter((number) => !at.test(all[number + 1]));
    assert.deepEqual(lost.map((number) => all[number]), []);
});

test("worlds are tests: one agrees, one is told at its place", options, async () => {
    await page.locator(".activitybar [aria-label='Testing']").first().click();
    const row = (name) => page.locator(".test-explorer .monaco-list-row", { hasText: name }).first();
    await row("robot.sense").waitFor();
    await row("strange.sense").waitFor();
    assert.equal(await page.locator(".test-explorer .monaco-list-row", { hasText: "wrong.sense" }).count(), 0);
    await command(page, "Test: Run All Tests");
    await row("robot.sense").locator(".codicon-testing-passed-icon").waitFor();
    await row("strange.sense").locator(".codicon-testing-failed-icon").waitFor();
    await page.waitForTimeout(shots ? 1500 : 0);
    await shot("tests");
});

test("a task fills the list of problems", options, async () => {
    await page.keyboard.press("Control+P");
    await page.waitForSelector(".quick-input-widget input");
    await page.keyboard.type("task ");
    const list = page.locator(".quick-input-list .monaco-list-row");
    await list.filter({ hasText: "sensedsl" }).first().click();
    for (const name of ["generate robot.sense", "simulate robot.sense", "check wrong.sense"]) {
        await list.filter({ hasText: name }).first().waitFor();
    }
    await shot("tasks");
    await list.filter({ hasText: "check wrong.sense" }).first().click();
    // The terminal must stay in view until the task has ended.
    await page.locator(".terminal-outer-container, .terminal-wrapper").first().waitFor();
    await page.waitForTimeout(5000);
    await command(page, "Problems: Focus on Problems View");
    const problem = page.locator(".markers-panel .monaco-list-row", { hasText: "B has no pin PZ9" }).first();
    await problem.waitFor();
    assert.match(await problem.innerText(), /\[Ln 2, Col 60\]/);
    await shot("problems");
});
