// `sensedsl studio` on a folder: what is typed is written, and never over somebody else's change.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { example, launch, missing, open, program, site } from "./site.mjs";

const skip = missing({ "the program: cargo build": program() });
let browser;

before(async () => {
    if (!skip) browser = await launch();
});

after(() => browser?.close());

/** The studio with a folder that has Fig. 2; its page, and the paths of files there. */
async function begin() {
    const folder = mkdtempSync(join(tmpdir(), "studio-"));
    const path = (name) => join(folder, name);
    writeFileSync(path("fig2.sense"), example("fig2"));
    const server = spawn(program(), ["studio", folder, "--site", site], { stdio: ["ignore", "pipe", "inherit"] });
    const [first] = await once(server.stdout, "data");
    const opened = await open(browser, first.toString().trim());
    await opened.page.locator(".cm-line", { hasText: "WheelEncoder" }).waitFor();
    const end = async () => {
        await opened.context.close();
        server.kill();
        rmSync(folder, { recursive: true });
    };
    return { ...opened, folder, path, end };
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
