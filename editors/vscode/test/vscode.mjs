// VS Code in a browser, for tests: code-server with the extension, and Chromium with it.

import { spawn, execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));
const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const modules = join(here, "code-server/node_modules");
const node = join(modules, "node/bin/node");

/** Milliseconds that a page and a test may take: on a busy machine everything comes, and late. */
export const PATIENCE = { page: 120_000, test: 400_000 };

/** What `found` gives, asked until it gives something or a page has taken its time; `complaint` is said then. */
export async function eventually(complaint, found) {
    for (const end = Date.now() + PATIENCE.page; Date.now() < end; ) {
        const it = await found();
        if (it) return it;
        await new Promise((resolve) => setTimeout(resolve, 200));
    }
    throw new Error(complaint);
}

/** What is missing of what these tests need; nothing if all is there. */
export function missing() {
    if (!existsSync(node)) return "VS Code: sh test/code-server/install.sh";
    if (!existsSync(CHROMIUM)) return `Chromium: there is no ${CHROMIUM}`;
    if (!vsix()) return "the extension: npm run build && npm run package";
    return undefined;
}

function vsix() {
    const found = readdirSync(join(here, "..")).find((name) => name.endsWith(".vsix"));
    return found && join(here, "..", found);
}

function freePort() {
    return new Promise((resolve) => {
        const server = createServer().listen(0, "127.0.0.1", () => {
            const { port } = server.address();
            server.close(() => resolve(port));
        });
    });
}

const SETTINGS = {
    "security.workspace.trust.enabled": false,
    "workbench.startupEditor": "none",
    "telemetry.telemetryLevel": "off",
    "extensions.autoCheckUpdates": false,
    "update.mode": "none",
    "chat.disableAIFeatures": true,
    "editor.minimap.enabled": false,
    "files.autoSave": "off",
    "window.menuBarVisibility": "hidden",
    "workbench.secondarySideBar.defaultVisibility": "hidden",
    "git.enabled": false,
};

/** Starts VS Code on a folder with these files; `end` ends it. */
export async function open(files, settings = {}) {
    const scratch = mkdtempSync(join(tmpdir(), "sensedsl-vscode-"));
    const folder = join(scratch, "robot");
    const data = join(scratch, "data");
    for (const [name, text] of Object.entries(files)) {
        mkdirSync(dirname(join(folder, name)), { recursive: true });
        writeFileSync(join(folder, name), text);
    }
    // What is a machine's own comes from the second one.
    for (const whose of ["User", "Machine"]) {
        mkdirSync(join(data, whose), { recursive: true });
        writeFileSync(join(data, whose, "settings.json"), JSON.stringify({ ...SETTINGS, ...settings }));
    }
    const env = { ...process.env, HOME: scratch };
    const common = [join(modules, "code-server"), "--user-data-dir", data, "--extensions-dir", join(scratch, "extensions")];
    execFileSync(node, [...common, "--install-extension", vsix()], { env, stdio: ["ignore", "ignore", "inherit"] });
    const port = await freePort();
    const quiet = ["--auth", "none", "--disable-telemetry", "--disable-update-check", "--disable-workspace-trust"];
    const server = spawn(node, [...common, ...quiet, "--bind-addr", `127.0.0.1:${port}`, folder], { env, stdio: "ignore", detached: true });
    const args = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"];
    const browser = await chromium.launch({ executablePath: CHROMIUM, args });
    const page = await browser.newPage({ viewport: { width: 1400, height: 820 } });
    const outside = new Set();
    page.on("request", (request) => {
        const { protocol, hostname } = new URL(request.url());
        const isNear = ["127.0.0.1", "localhost"].includes(hostname) || !/^(https?|wss?):$/.test(protocol);
        // VS Code's own name for resources of views: a worker of the page answers, and nothing leaves it.
        if (!isNear && !hostname.endsWith(".vscode-resource.vscode-cdn.net")) outside.add(hostname);
    });
    const end = async () => {
        await browser.close();
        try {
            process.kill(-server.pid);
        } catch {
            // It has ended.
        }
        await forgotten(scratch);
    };
    try {
        await visit(page, `http://127.0.0.1:${port}/`);
    } catch (error) {
        await end();
        throw error;
    }
    return { page, outside, folder, end };
}

/** Removes a folder into which processes that were just ended still write: shells of terminals, for example. */
async function forgotten(folder) {
    for (let left = 40; left > 0; left -= 1) {
        try {
            rmSync(folder, { recursive: true, force: true });
            return;
        } catch {
            await new Promise((resolve) => setTimeout(resolve, 250));
        }
    }
}

async function visit(page, url) {
    for (let left = 60; ; left -= 1) {
        try {
            await page.goto(url);
            break;
        } catch (error) {
            if (left === 0) throw error;
            await page.waitForTimeout(500);
        }
    }
    await page.waitForSelector(".monaco-workbench", { timeout: PATIENCE.page });
}

/** Opens the field above the text by its key, which is lost if a view beside the text is made just then. */
async function openField(page, key) {
    const field = page.locator(".quick-input-widget input");
    await eventually(`${key} opens no field`, async () => {
        await page.keyboard.press(key);
        return field.waitFor({ timeout: 5_000 }).then(() => true, () => false);
    });
}

/** Waits until Enter takes the entry with this text: until then it takes another one of a list that is not filtered yet. */
export function chosen(page, text) {
    return page.locator(".quick-input-list .monaco-list-row.focused", { hasText: text }).waitFor();
}

/** Opens a file of the folder. */
export async function openFile(page, name) {
    await openField(page, "Control+P");
    await page.keyboard.type(name);
    await chosen(page, name);
    await page.keyboard.press("Enter");
    await page.locator(".tab.active", { hasText: name }).waitFor();
    await page.waitForSelector(".editor-instance .view-line");
}

/** Runs a command by its name. */
export async function command(page, name) {
    await openField(page, "F1");
    await page.keyboard.type(name);
    await page.locator(`.quick-input-list .monaco-list-row[aria-label^="${name}"]`).first().click();
}

/** The view of the wiring, which is a frame in a frame. */
export function wiringView(page) {
    return eventually("there is no view of the wiring", async () => {
        for (const frame of page.frames()) {
            // A frame may go while it is looked at.
            const found = await frame.$("#picture").catch(() => null);
            if (found && (await found.isVisible().catch(() => false))) return frame;
        }
        return undefined;
    });
}
