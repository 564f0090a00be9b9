// The pictures of `docs/studio.md`: the studio at three widths, light and dark. `node pictures.mjs` writes them, or those
// that are named, after `node build.mjs`; look at each before it is kept.

import { join } from "node:path";
import { example, launch, missing, open, root, serve, write } from "./test/site.mjs";

const FIGHT = example("fig2").replace("id = 17;", "id = 17;\n        pin = PA1;").replace("id = 18;", "id = 18;\n        pin = PA1;");

/** Waits for the picture of the text as it is. */
async function wired(page) {
    await page.waitForTimeout(300);
    await page.locator(".picture:not(.is-old) [data-part]").first().waitFor();
    await page.locator(".is-searching").waitFor({ state: "detached" });
}

async function run(page) {
    await page.getByRole("tab", { name: "Run", exact: true }).click();
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await page.waitForTimeout(8_000);
}

/** The example that drives, once it has been around most of its oval. */
async function drive(page) {
    await page.getByRole("button", { name: "Examples" }).click();
    await page.getByRole("button", { name: /^Line follower on its oval/ }).click();
    await wired(page);
    await page.getByRole("button", { name: "Close this note" }).click();
    await page.getByRole("tab", { name: "Run", exact: true }).click();
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await page.getByText(/^Robot: 3\.[4-9]\d m/).waitFor({ timeout: 120_000 });
    await page.getByRole("button", { name: "Pause" }).click();
}

async function conflict(page) {
    await page.getByRole("region", { name: "Conflict" }).getByRole("button").nth(2).waitFor();
    await page.waitForTimeout(500);
}

/** File, width, height, theme, text, and what is done with it. */
const PICTURES = [
    ["studio-light", 1400, 820, "light", example("miniature_car"), wired],
    ["studio-dark", 1400, 820, "dark", example("line_follower"), wired],
    ["studio-run", 1400, 820, "light", example("miniature_car"), run],
    ["studio-drives", 1400, 820, "light", "", drive],
    ["studio-800-light", 800, 900, "light", FIGHT, conflict],
    ["studio-800-dark", 800, 900, "dark", example("miniature_car"), run],
    ["studio-360-light", 360, 740, "light", example("fig2"), wired],
    ["studio-360-dark", 360, 740, "dark", example("fig2"), run],
];

const lacks = missing();
if (lacks) throw new Error(`there is no ${lacks}`);
const browser = await launch();
const server = await serve();
const wanted = process.argv.slice(2);
for (const [name, width, height, colorScheme, text, then] of PICTURES) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    const { page, context } = await open(browser, server.url, { viewport: { width, height }, colorScheme });
    await wired(page);
    if (text !== "") await write(page, text);
    await page.locator(".cm-content").press("Control+Home");
    await then(page);
    await page.waitForTimeout(1_000);
    await page.screenshot({ path: join(root, "docs/pictures", `${name}.png`) });
    await context.close();
}
await browser.close();
await server.close();
