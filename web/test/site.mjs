// For tests: the built site from a server of its own, and Chromium with it.

import { existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { dirname, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before } from "node:test";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));
export const root = join(here, "../..");
export const site = process.env.SENSEDSL_STUDIO ?? join(root, "target/web/studio");
const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const TYPES = {
    ".css": "text/css", ".html": "text/html", ".js": "text/javascript", ".json": "application/json", ".svg": "image/svg+xml",
    ".txt": "text/plain", ".wasm": "application/wasm", ".webmanifest": "application/manifest+json", ".woff2": "font/woff2",
};

/** What is missing of what these tests need; nothing if all is there. Where all is required, a test without it fails. */
export function missing(needs = {}) {
    const all = { "the studio: node build.mjs": join(site, "index.html"), [`Chromium as ${CHROMIUM}`]: CHROMIUM, ...needs };
    const lacks = Object.keys(all).find((what) => !all[what] || !existsSync(all[what]));
    if (lacks && process.env.SENSEDSL_REQUIRE_TOOLS) throw new Error(`missing: ${lacks}`);
    return lacks;
}

/** The program: the one that SENSEDSL names, or else the one that was built last. */
export function program() {
    if (process.env.SENSEDSL) return process.env.SENSEDSL;
    const all = ["dist", "release", "debug"].map((profile) => join(root, "target", profile, "sensedsl")).filter(existsSync);
    return all.sort((one, other) => statSync(other).mtimeMs - statSync(one).mtimeMs)[0];
}

/** The text of an example. */
export function example(name) {
    return readFileSync(join(root, "examples", `${name}.sense`), "utf8");
}

/** Serves the studio, or another folder; `answer` may answer a request itself, and change a file on its way. */
export async function serve({ folder = site, answer = () => false, change = (_, bytes) => bytes } = {}) {
    const server = createServer((request, response) => {
        void (async () => {
            const { pathname } = new URL(request.url, "http://localhost");
            if (await answer(request, response, pathname)) return;
            const name = decodeURIComponent(pathname.replace(/\/$/, "/index.html").slice(1));
            const path = join(folder, name);
            if (!path.startsWith(folder) || !existsSync(path)) {
                response.writeHead(404).end();
                return;
            }
            response.setHeader("content-type", TYPES[extname(path)] ?? "application/octet-stream");
            response.end(change(name, readFileSync(path)));
        })();
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    return {
        url: `http://127.0.0.1:${server.address().port}/`,
        close: () =>
            new Promise((resolve) => {
                server.close(resolve);
                server.closeAllConnections();
            }),
    };
}

/** Chromium, which asks nobody for anything by itself. */
export function launch() {
    const args = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"];
    return chromium.launch({ executablePath: CHROMIUM, args });
}

/** A page of the site. `wrong` collects requests to other hosts, errors, and what the content security policy refused. */
export async function open(browser, url, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1400, height: 820 }, acceptDownloads: true, ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(Number(process.env.SENSEDSL_TEST_MS ?? 30_000));
    const wrong = [];
    const { origin } = new URL(url);
    context.on("request", (request) => {
        const asked = new URL(request.url());
        if (/^(https?|wss?):$/.test(asked.protocol) && asked.origin !== origin) wrong.push(`request to ${asked.host}`);
    });
    page.on("pageerror", (error) => wrong.push(`error: ${error.message}`));
    page.on("console", (message) => {
        if (message.type() === "error") wrong.push(`console: ${message.text()}`);
    });
    await page.goto(url);
    return { context, page, wrong };
}

/** Puts a text in place of that of the open file. */
export async function write(page, text) {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+a");
    await paste(page, text);
}

/** Pastes a text at the cursor. */
export async function paste(page, text) {
    await page.locator(".cm-content").evaluate((content, text) => {
        const clipboardData = new DataTransfer();
        clipboardData.setData("text/plain", text);
        content.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
    }, text);
}

/** Chromium and a server of the site for all tests of a file, unless they are skipped. */
export function shared(skip) {
    const all = {};
    before(async () => {
        if (skip) return;
        all.browser = await launch();
        all.server = await serve();
    });
    after(async () => {
        await all.browser?.close();
        await all.server?.close();
    });
    return all;
}
