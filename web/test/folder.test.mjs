// `sensedsl studio` on a folder: what is typed is written, and never over somebody else's change; boards run here, with
// the code of their controllers.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { example, launch, missing, open, program, site } from "./site.mjs";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const skip = missing({ "the program: cargo build": program() });
const skipCode = skip ?? missing({ "a C compiler as /usr/bin/cc": "/usr/bin/cc" });
let browser;

before(async () => {
    if (!skip) browser = await launch();
});

/** Servers that run; a test that fails leaves its own. */
const servers = new Set();

after(async () => {
    for (const one of servers) one.kill();
    await browser?.close();
});

/** The studio with a folder that has Fig. 2; its page, and the paths of files there. */
function begin() {
    return opened((folder) => writeFileSync(join(folder, "fig2.sense"), example("fig2")), "WheelEncoder");
}

/** The studio with a folder of files, once the text shows a word. */
async function opened(fill, word) {
    const folder = mkdtempSync(join(tmpdir(), "studio-"));
    const path = (name) => join(folder, name);
    fill(folder);
    const server = spawn(program(), ["studio", folder, "--site", site], { stdio: ["ignore", "pipe", "inherit"] });
    servers.add(server);
    const [first] = await once(server.stdout, "data");
    const shown = await open(browser, first.toString().trim(), { reducedMotion: "reduce" });
    await shown.page.locator(".cm-line", { hasText: word }).first().waitFor();
    const end = async () => {
        await shown.context.close();
        server.kill();
        rmSync(folder, { recursive: true });
    };
    return { ...shown, folder, path, server, end };
}

/** Waits until something is so. */
async function until(isRight, told) {
    for (const end = Date.now() + 30_000; Date.now() < end && !isRight(); ) await new Promise((resolve) => setTimeout(resolve, 50));
    assert.ok(isRight(), told());
}

/** Waits until a file is as it shall be. */
function written(path, isRight) {
    const text = () => (existsSync(path) ? readFileSync(path, "utf8") : "");
    return until(() => isRight(text()), text);
}

async function type(page, text) {
    await page.locator(".cm-line").first().click();
    await page.keyboard.press("Home");
    await page.keyboard.type(text);
}

test("what is typed is in the folder", { skip }, async () => {
    const { page, folder, path, wrong, end } = await begin();
    await page.getByText(`Folder ${folder.split("/").pop()}`).waitFor();
    await type(page, "// one\n");
    await page.getByText("fig2.sense saved").waitFor();
    assert.equal(readFileSync(path("fig2.sense"), "utf8"), `// one\n${example("fig2")}`);
    await type(page, "// two\n");
    await written(path("fig2.sense"), (text) => text === `// two\n// one\n${example("fig2")}`);
    // The page has a secret of the server: no service worker keeps it.
    assert.equal(await page.evaluate(() => navigator.serviceWorker.getRegistrations().then((all) => all.length)), 0);
    assert.deepEqual(wrong, []);
    await end();
});

test("a file that is renamed or deleted is so in the folder", { skip }, async () => {
    const { page, path, end } = await begin();
    await page.getByRole("tab", { name: "fig2.sense" }).focus();
    await page.keyboard.press("F2");
    await page.getByRole("dialog").getByRole("textbox").fill("robot.sense");
    await page.keyboard.press("Enter");
    await written(path("robot.sense"), (text) => text === example("fig2"));
    await until(() => !existsSync(path("fig2.sense")), () => "fig2.sense is still there");
    await page.getByRole("tab", { name: "robot.sense" }).focus();
    await page.keyboard.press("Delete");
    await page.getByRole("dialog").getByRole("button", { name: "Delete" }).click();
    await until(() => !existsSync(path("robot.sense")), () => "robot.sense is still there");
    await end();
});

for (const whose of ["mine", "theirs"]) {
    test(`a file that somebody else has changed is asked about: ${whose}`, { skip }, async () => {
        const { page, path, end } = await begin();
        const file = path("fig2.sense");
        await type(page, "// one\n");
        await page.getByText("fig2.sense saved").waitFor();
        writeFileSync(file, "// theirs\n");
        await type(page, "// two\n");
        await page.getByRole("dialog", { name: /changed on the disk/ }).waitFor();
        assert.equal(readFileSync(file, "utf8"), "// theirs\n");
        await page.getByRole("button", { name: whose === "mine" ? "Keep the text here" : "Keep the text on the disk" }).click();
        const mine = `// two\n// one\n${example("fig2")}`;
        await written(file, (text) => text === (whose === "mine" ? mine : "// theirs\n"));
        await page.locator(".cm-line", { hasText: whose === "mine" ? "// two" : "// theirs" }).waitFor();
        const shown = await page.locator(".cm-line").first().innerText();
        assert.equal(shown, whose === "mine" ? "// two" : "// theirs");
        // And the next change is written again.
        await type(page, "// three\n");
        await written(file, (text) => text.startsWith("// three\n"));
        await end();
    });
}

test("a change before the first one here is seen, too", { skip }, async () => {
    const { page, path, end } = await begin();
    writeFileSync(path("fig2.sense"), "// theirs\n");
    await type(page, "// one\n");
    await page.getByRole("dialog", { name: /changed on the disk/ }).waitFor();
    assert.equal(readFileSync(path("fig2.sense"), "utf8"), "// theirs\n");
    await end();
});

/** The line follower that `sensedsl new` makes, with the panel that runs it. */
async function follower() {
    const make = (folder) => execFileSync(program(), ["new", folder, "--template", "line_follower", "--quiet"]);
    const all = await opened(make, "Follow");
    const { page, path } = all;
    page.setDefaultTimeout(60_000);
    // Boards of the server: those that were asked for, and those that were ended.
    const boards = { asked: new Set(), ended: new Set() };
    page.context().on("request", (request) => {
        const name = new URL(request.url()).pathname.split("/api/boards/")[1];
        if (name) boards[request.method() === "DELETE" ? "ended" : "asked"].add(name);
    });
    await page.getByRole("tab", { name: "Run" }).click();
    return { ...all, boards, code: path("build/firmware/Robot/user/follow.c") };
}

/** How far the robot has driven, in metres, once it is so far. */
async function driven(page, least) {
    const told = page.locator(".live-map .live-told");
    const metres = async () => Number(/^Robot: ([\d.]+) m/.exec(await told.textContent())?.[1] ?? 0);
    await told.waitFor();
    for (const end = Date.now() + 60_000; Date.now() < end && (await metres()) < least; ) await page.waitForTimeout(100);
    assert.ok((await metres()) >= least, await told.textContent());
    return metres();
}

test("a robot drives with its code, and a map shows it", { skip: skipCode }, async () => {
    const { page, boards, wrong, end } = await follower();
    // The world that the first test names is chosen.
    assert.equal(await page.getByLabel("World").inputValue(), "oval.toml");
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await driven(page, 0.3);
    const drawing = page.locator(".live-map svg");
    assert.equal(await drawing.locator(".live-line").count(), 1);
    assert.equal(await drawing.locator(".live-wall").count(), 1);
    // It has begun at 1.2 m from the left, 0.3 m from the top; its path is where it has been.
    await page.waitForFunction(() => {
        const [, x, y] = /translate\(([\d.]+) ([\d.]+)\)/.exec(document.querySelector(".live-robot").getAttribute("transform"));
        return Number(x) > 1_450 && Number(y) > 280;
    });
    assert.match(await drawing.locator(".live-trail path").first().getAttribute("d"), /^M12\d\d(\.\d)? 300/);
    await page.waitForFunction(() => /2\.4 m by 1\.4 m.* Robot is 1\.[4-9]\d m from the left.*Robot: [\d.]+ m/.test(document.querySelector(".live-map svg").getAttribute("aria-label")));
    assert.equal(await page.locator('.live-notes li[data-level="error"]').count(), 0);
    assert.equal(await page.locator(".live-about").isVisible(), false);
    await page.evaluate(readFileSync(AXE, "utf8"));
    const found = await page.evaluate(async () => (await window.axe.run(document.querySelector(".live"))).violations.map((one) => one.id));
    assert.deepEqual(found, []);
    await page.getByRole("button", { name: "Stop" }).click();
    await until(() => boards.ended.size === boards.asked.size, () => `${[...boards.asked]} are not all ended: ${[...boards.ended]}`);
    assert.equal(boards.asked.size, 1);
    assert.deepEqual(wrong, []);
    await end();
});

test("code that does not compile is told by its file, and drives once it is mended", { skip: skipCode }, async () => {
    const { page, boards, code, server, end } = await follower();
    const good = readFileSync(code, "utf8");
    writeFileSync(code, `${good}\nint broken = ;\n`);
    await page.getByRole("button", { name: "Start", exact: true }).click();
    const banner = page.locator('[aria-label="Run"] .live-banner:visible');
    await banner.getByText("The code cannot run as it is.").waitFor();
    assert.match(await banner.textContent(), /E0535: .*follow\.c:\d+:\d+: error: /);
    writeFileSync(code, good);
    await page.getByRole("button", { name: "Start", exact: true }).click();
    const far = await driven(page, 0.3);
    // What runs goes on while its code is broken on the disk, and beginning again says so.
    writeFileSync(code, `${good}\nint broken = ;\n`);
    await page.getByRole("button", { name: "Restart" }).click();
    await banner.getByText("follow.c").waitFor();
    await driven(page, far + 0.02);
    writeFileSync(code, good);
    await page.getByRole("button", { name: "Restart" }).click();
    await banner.waitFor({ state: "detached" }).catch(() => banner.waitFor({ state: "hidden" }));
    await driven(page, 0.1);
    await until(() => boards.ended.size === boards.asked.size - 1, () => `${boards.ended.size} of ${boards.asked.size} are ended`);
    // A server that is gone is told of.
    server.kill();
    await banner.getByText("the server does not answer").waitFor();
    assert.equal(await page.locator(".live-view").getAttribute("data-stale"), "true");
    await end();
});

test("a controller without code is told of, and sets nothing", { skip: skipCode }, async () => {
    const { page, folder, end } = await follower();
    rmSync(join(folder, "build"), { recursive: true });
    await page.getByLabel("World").selectOption("aside.toml");
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await page.getByText("Follow has no code yet and sets nothing: sensedsl generate makes its first file.").waitFor();
    await page.waitForFunction(() => /: [1-9]\.\d s/.test(document.querySelector('[aria-label="Run"] .live-clock').textContent));
    assert.match(await page.locator(".live-map .live-told").textContent(), /^Robot: 0\.00 m/);
    await end();
});
