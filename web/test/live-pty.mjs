// Thorough: Chromium's own Web Serial and a board behind a pseudo-terminal, which `sensedsl simulate` is. A policy lets
// the test's page use ports without asking, and a mount of its own puts the pseudo-terminal where a serial port is. Needs
// Linux, root, and `unshare`:
//
//     node test/live-pty.mjs
//
// SENSEDSL names the program; without it the one that was built last is taken.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { DESIGN } from "./live-serial.mjs";
import { launch, missing, open, program, serve } from "./site.mjs";

const PORT = "/dev/ttyS0";
const POLICY = "/etc/chromium/policies/managed/sensedsl-test.json";
const PATIENCE_MS = 120_000;
const IN_ITS_MOUNT = "SENSEDSL_TEST_MOUNT";

/** Starts a simulated board; its pseudo-terminal. */
async function simulate(folder, design) {
    const path = join(folder, "robot.sense");
    writeFileSync(path, design);
    const child = spawn(program(), ["simulate", path, "--set", "Light=1234"], { stdio: ["ignore", "pipe", "pipe"] });
    let text = "";
    const found = new Promise((resolve, reject) => {
        const read = (bytes) => {
            text += bytes;
            const [, name] = /the board is at (\S+)/.exec(text) ?? [];
            if (name) resolve(name);
        };
        child.stdout.on("data", read);
        child.stderr.on("data", read);
        child.on("exit", () => reject(new Error(`the board has ended: ${text}`)));
    });
    return { name: await found, end: () => child.kill() };
}

function mount(...args) {
    const { status, stderr } = spawnSync(args[0], args.slice(1), { encoding: "utf8" });
    assert.equal(status, 0, stderr);
}

async function has(locator, wanted) {
    const end = Date.now() + PATIENCE_MS;
    let text = "";
    while (Date.now() < end) {
        text = (await locator.textContent({ timeout: PATIENCE_MS })) ?? "";
        if (wanted.test(text)) return;
        await new Promise((resolve) => setTimeout(resolve, 100));
    }
    assert.fail(`${JSON.stringify(text)} is not ${wanted}`);
}

/** What the page does with a board that is at the port. */
async function connected(page) {
    await page.getByRole("button", { name: "Connect to serial port" }).first().click();
    await has(page.locator('[aria-label="Connect"] .live-clock'), /^Connected: firmware and design agree\.$/);
    await has(page.locator('[aria-label="Table of values"] tr[data-device="Light"] .live-value'), /^1234$/);
    await has(page.locator('[aria-label="Table of values"] tr[data-device="Light"] .live-rate'), /^(19|20|21)\.\d Hz$/);
    const servo = page.locator('[data-actuator="Servo"]');
    await servo.getByRole("textbox").fill("30000");
    await page.keyboard.press("Enter");
    await has(servo.locator(".live-has"), /^sent: 30000$/);
    await has(page.locator(".live-health:visible"), /all devices are good/);
    await page.getByRole("button", { name: "Disconnect" }).click();
}

async function run() {
    const folder = mkdtempSync(join(tmpdir(), "sensedsl-"));
    const server = await serve();
    mkdirSync(dirname(POLICY), { recursive: true });
    writeFileSync(POLICY, JSON.stringify({ SerialAllowAllPortsForUrls: [new URL(server.url).origin] }));
    let board;
    let browser;
    try {
        board = await simulate(folder, DESIGN);
        mount("mount", "--bind", board.name, PORT);
        browser = await launch();
        const { page } = await open(browser, server.url, { reducedMotion: "reduce" });
        page.setDefaultTimeout(PATIENCE_MS);
        await page.locator(".cm-content").click();
        await page.keyboard.press("Control+a");
        await page.keyboard.insertText(DESIGN);
        await page.getByRole("tab", { name: "Connect" }).click();
        await connected(page);
        console.log("values, an actuator, health and closing: as they should be");
        board.end();
        // The browser may still be closing it.
        mount("umount", "--lazy", PORT);
        board = await simulate(folder, DESIGN.replace("Lamp accepts bool", "Lamp accepts uint8").replace("type = digital; }\n}", "driver = servo; }\n}"));
        mount("mount", "--bind", board.name, PORT);
        await page.getByRole("button", { name: "Connect to serial port" }).first().click();
        await has(page.locator('[aria-label="Connect"] .live-clock'), /^Other firmware: its values are ignored\.$/);
        console.log("another firmware: not believed");
        board.end();
        await page.getByText("The board is gone").first().waitFor();
        console.log("a board that goes: told");
    } finally {
        await browser?.close();
        board?.end();
        await server.close();
        rmSync(POLICY, { force: true });
        rmSync(folder, { recursive: true });
        // The mount ends with its namespace.
    }
}

const lacks = missing();
if (lacks) throw new Error(`there is no ${lacks}`);
if (process.env[IN_ITS_MOUNT]) await run();
else {
    assert.equal(process.getuid?.(), 0, "only root can mount");
    const { status } = spawnSync("unshare", ["-m", process.execPath, import.meta.filename], {
        stdio: "inherit",
        env: { ...process.env, [IN_ITS_MOUNT]: "1" },
    });
    process.exitCode = status ?? 1;
}
