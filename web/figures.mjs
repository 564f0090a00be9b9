// What the studio weighs and how long it takes: bytes that a first visit fetches (compressed as a server of files would,
// by Brotli), from opening the page to its first picture, from a letter to the picture of a car.
//
//     cargo xtask studio && node figures.mjs
//
// Fails if the first visit fetches 2 MB or more. Times are printed only: they are those of this machine.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";
import { example, launch, missing, open, serve, site, write } from "./test/site.mjs";

const FIRST_VISIT_BYTES_MAX = 2_000_000;
const lacks = missing();
if (lacks) throw new Error(`there is no ${lacks}`);

function compressed(name) {
    const params = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24 };
    return brotliCompressSync(readFileSync(join(site, name)), { params }).length;
}

const median = (all) => [...all].sort((one, other) => one - other)[Math.floor(all.length / 2)];
const browser = await launch();
const asked = new Set();
const server = await serve({
    answer: (_, __, path) => {
        asked.add(path === "/" ? "index.html" : path.slice(1));
        return false;
    },
});
const started_ms = [];
let first;
for (let round = 0; round < 5; round += 1) {
    const { page, context } = await open(browser, server.url, { serviceWorkers: "block" });
    await page.locator(".picture:not(.is-old) [data-part]").first().waitFor();
    started_ms.push(await page.evaluate(() => performance.now()));
    first ??= [...asked].filter((name) => !name.startsWith("favicon"));
    await context.close();
}
const sizes = first.map((name) => [name, compressed(name)]);
const bytes = sizes.reduce((sum, [, size]) => sum + size, 0);
for (const [name, size] of sizes) console.log(`${String(size).padStart(9)} ${name}`);
console.log(`${String(bytes).padStart(9)} bytes on a first visit`);
console.log(`from opening to the first picture: median ${Math.round(median(started_ms))} ms of ${started_ms.length}`);

const { page } = await open(browser, server.url, { serviceWorkers: "block" });
await page.locator(".picture:not(.is-old) [data-part]").first().waitFor();
await write(page, example("miniature_car"));
await page.waitForFunction(() => document.querySelectorAll(".picture [data-part]").length === 13);
await page.locator(".cm-line", { hasText: "delay = 60 ms" }).first().click();
await page.keyboard.press("End");
await page.waitForTimeout(1000);
await page.evaluate(() => performance.clearMeasures());
for (let time = 0; time < 40; time += 1) {
    await page.keyboard.press(time % 2 === 0 ? "Space" : "Backspace");
    await page.waitForFunction((count) => performance.getEntriesByName("typing to picture").length > count, time);
    await page.waitForTimeout(100);
}
const typed_ms = await page.evaluate(() => performance.getEntriesByName("typing to picture").map((one) => one.duration));
console.log(`from a letter to the picture of the car: median ${median(typed_ms).toFixed(1)} ms of ${typed_ms.length}`);
await browser.close();
await server.close();
if (bytes >= FIRST_VISIT_BYTES_MAX) throw new Error(`a first visit fetches ${bytes} bytes`);
