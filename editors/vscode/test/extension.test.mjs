// The extension in VS Code: mistakes, hover, the wiring beside the text; with its own server.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { PATIENCE, command, missing, open, openFile, wiringView } from "./vscode.mjs";

const ROBOT = readFileSync(new URL("../../../examples/line_follower.sense", import.meta.url), "utf8");
const lacks = missing();
const shots = process.env.SHOTS;
const options = { skip: lacks, timeout: PATIENCE.test };
/** Whether the extension runs in the browser, and not in Node. */
const isWeb = process.env.SENSEDSL_HOST === "web";
let code;
let page;

const shot = async (name) => {
    if (!shots) return;
    mkdirSync(shots, { recursive: true });
    await page.screenshot({ path: `${shots}/${name}.png` });
};

before(async () => {
    if (lacks) return;
    const theme = process.env.THEME ? { "workbench.colorTheme": process.env.THEME } : {};
    const host = isWeb ? { "remote.extensionKind": { "sensedsl.sensedsl": ["web"] } } : {};
    code = await open({ "robot.sense": ROBOT }, { ...theme, ...host });
    page = code.page;
    page.setDefaultTimeout(PATIENCE.page);
    await openFile(page, "robot.sense");
});

/** Types something behind a word of the text. */
async function typeAfter(word, text) {
    await page.locator(".view-line span", { hasText: new RegExp(`^${word}$`) }).first().click();
    await page.keyboard.press("Control+ArrowLeft");
    await page.keyboard.press("Control+ArrowRight");
    await page.keyboard.type(text);
    // What is offered to complete it must not be taken.
    await page.keyboard.press("Escape");
}

after(async () => code?.end());

test("the status bar tells which server runs", options, async () => {
    const item = page.locator(".statusbar-item", { hasText: "SenseDSL" });
    await item.first().waitFor();
    const label = item.first().locator("[aria-label*='version']").first();
    await label.waitFor();
    const expected = isWeb ? "language server of the extension, in the browser, version" : "language server of the extension, version";
    assert.ok((await label.getAttribute("aria-label")).includes(expected));
    await shot("server");
});

test("the wiring is shown beside the text", options, async () => {
    await command(page, "SenseDSL: Show wiring");
    const view = await wiringView(page);
    await view.locator("svg [data-part='Motors']").waitFor();
    await shot("wiring");
});

test("a click on a box goes to its text, and marks its wires", options, async () => {
    const view = await wiringView(page);
    await view.locator("svg [data-part='Wheels']").click();
    const at = readFileSync(`${code.folder}/robot.sense`, "utf8").split("\n").findIndex((line) => line.includes("Wheels")) + 1;
    await page.locator(".statusbar-item", { hasText: `Ln ${at},` }).waitFor();
    assert.equal(await view.locator("path.sd-wire.is-marked[data-parts='Wheels']").count(), 4);
    assert.equal(await view.locator("path.sd-wire.is-marked[data-parts='Line']").count(), 0);
    await shot("picked");
    await view.locator("svg [data-part='Line']").focus();
    await page.keyboard.press("Enter");
    await view.locator("path.sd-wire.is-marked[data-parts='Line']").first().waitFor({ state: "attached" });
});

test("a word is explained", options, async () => {
    await page.locator(".view-line span", { hasText: /^encoder$/ }).first().hover();
    await page.locator(".monaco-hover:not(.hidden) .hover-contents").first().waitFor();
    await shot("hover");
    await page.mouse.move(5, 5);
});

test("a code lens opens its text", options, async () => {
    await page.locator(".codelens-decoration a", { hasText: "room left" }).first().click();
    await page.locator(".tab", { hasText: "Room left on Follower" }).waitFor();
    await page.waitForTimeout(shots ? 4000 : 0);
    await shot("room");
    await page.locator(".tab", { hasText: "Room left on Follower" }).click({ button: "middle" });
});

test("a mistake is underlined, told above the picture, and its part left out", options, async () => {
    // A view is hidden while another one is in its place.
    await page.locator(".tab", { hasText: "Wiring of robot.sense" }).click();
    const view = await wiringView(page);
    await typeAfter("encoder", "x");
    await page.waitForSelector(".squiggly-error");
    await view.locator("body.is-wrong:not(.is-old)").waitFor();
    assert.match(await view.locator("#why").innerText(), /encoderx/);
    await view.locator("[data-part='Wheels']").waitFor({ state: "detached" });
    await shot("mistake");
    await page.keyboard.press("Backspace");
    await view.locator("body:not(.is-wrong) [data-part='Wheels']").waitFor();
    await page.locator(".squiggly-error").waitFor({ state: "detached" });
});

test("where nothing can be wired, the last wiring stays, pale", options, async () => {
    const view = await wiringView(page);
    await typeAfter("NUCLEO_F446RE", "XYZ");
    await view.locator("body.is-old.is-wrong [data-part='Wheels']").waitFor();
    await shot("old");
    for (let left = 3; left > 0; left -= 1) await page.keyboard.press("Backspace");
    await view.locator("body:not(.is-old):not(.is-wrong) [data-part='Wheels']").waitFor();
});

test("an example is opened", options, async () => {
    await command(page, "SenseDSL: Open an example");
    await page.locator(".tab", { hasText: "Untitled" }).first().waitFor();
});

test("nothing is asked of another host", options, () => {
    assert.deepEqual([...code.outside], []);
});
