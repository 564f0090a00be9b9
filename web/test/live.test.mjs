// The panels "Run" and "Connect" in Chromium, with the simulated board of the tool and with a board at a fake port.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";
import { board, DESIGN, fakeSerial, SCHEMA } from "./live-serial.mjs";
import { example, missing, open, shared } from "./site.mjs";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const skip = missing();
/** What is slow here is the machine. */
const PATIENCE_MS = 60_000;

const chromium = shared(skip);

/** A page with a text, at a panel. */
async function at(panel, text, { serial, ...options } = {}) {
    // Plots that move seldom leave more of a slow machine to what is tested.
    const opened = await open(chromium.browser, "about:blank", { reducedMotion: "reduce", ...options });
    const { page } = opened;
    page.setDefaultTimeout(PATIENCE_MS);
    if (serial !== undefined) await page.addInitScript(fakeSerial, serial);
    if (serial === null) await page.addInitScript(() => Object.defineProperty(navigator, "serial", { value: undefined }));
    // Tests have nobody who chooses a file.
    await page.addInitScript(() => Object.defineProperty(window, "showSaveFilePicker", { value: undefined }));
    await page.goto(chromium.server.url);
    await write(page, text);
    await page.getByRole("tab", { name: panel }).click();
    return opened;
}

async function write(page, text) {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText(text);
}

function cell(page, device, column) {
    return page.locator(`[aria-label="Table of values"] tr[data-device="${device}"] .live-${column}`);
}

/** Waits until an element has a text that fits. */
async function has(locator, wanted) {
    const end = Date.now() + PATIENCE_MS;
    let text = "";
    while (Date.now() < end) {
        text = (await locator.textContent({ timeout: PATIENCE_MS })) ?? "";
        if (wanted instanceof RegExp ? wanted.test(text) : text === wanted) return text;
        await new Promise((resolve) => setTimeout(resolve, 50));
    }
    assert.fail(`${JSON.stringify(text)} is not ${wanted}`);
}

async function start(page) {
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await page.locator(".live-view").waitFor();
}

/** The virtual time that the panel shows, in seconds. */
async function time_s(page) {
    const text = await page.locator('[aria-label="Run"] .live-clock').textContent();
    const [, minutes = "0", seconds] = /: (?:(\d+) min )?([\d.]+) s/.exec(text) ?? assert.fail(text);
    return Number(minutes) * 60 + Number(seconds);
}

/** A colour that lines of plots have, anywhere in a canvas. */
function isDrawn(page) {
    return page.evaluate(() =>
        [...document.querySelectorAll(".live-canvas canvas")].map((canvas) => {
            const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            let blue = 0;
            for (let at = 0; at < data.length; at += 4) if (data[at + 2] > data[at] + 80 && data[at + 3] > 100) blue += 1;
            return blue > 40;
        }),
    );
}

test("the car runs, and a quantity of its world is held by a slider", { skip }, async () => {
    const { context, page, wrong } = await at("Run", example("miniature_car"));
    await start(page);
    await has(cell(page, "USFront", "value"), /^\d+ cm$/);
    await has(cell(page, "IRRear", "rate"), /^1[5-7]\.\d Hz$/);
    const slider = page.getByRole("slider", { name: "USFront", exact: true });
    await slider.fill("77");
    const held = await slider.inputValue();
    await has(cell(page, "USFront", "value"), `${held} cm`);
    assert.equal(await slider.getAttribute("aria-valuetext"), `${held} cm, held`);
    // By keyboard, a step at a time.
    await slider.focus();
    await page.keyboard.press("ArrowRight");
    const next = await slider.inputValue();
    assert.notEqual(next, held);
    await has(cell(page, "USFront", "value"), `${next} cm`);
    // It stays so as time goes on, and moves again once the world has it.
    const before_s = await time_s(page);
    while ((await time_s(page)) < before_s + 3) await page.waitForTimeout(100);
    assert.equal(await cell(page, "USFront", "value").textContent(), `${next} cm`);
    const hold = page.getByRole("button", { name: "Hold USFront", exact: true });
    assert.equal(await hold.getAttribute("aria-pressed"), "true");
    await hold.click();
    assert.equal(await hold.getAttribute("aria-pressed"), "false");
    await has(cell(page, "USFront", "value"), new RegExp(`^(?!${next} cm$)\\d+ cm$`));
    await page.waitForFunction(() => document.querySelectorAll(".live-canvas canvas").length === 2);
    assert.deepEqual(await isDrawn(page), [true, true]);
    assert.deepEqual(wrong.filter(isForeign), []);
    await context.close();
});

/** Requests to other hosts, and errors of scripts. */
function isForeign(text) {
    return /^(request|error)/.test(text) && text !== `request to ${new URL(chromium.server.url).host}`;
}

test("time stops, goes faster and slower, and begins again", { skip }, async () => {
    const { context, page } = await at("Run", example("fig2"));
    await start(page);
    // Somebody at the keyboard goes on from where he was.
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Pause");
    await has(cell(page, "IRFront", "value"), /^\d+$/);
    await page.keyboard.press("Enter");
    await page.getByRole("button", { name: "Go on" }).waitFor();
    await page.waitForTimeout(300);
    const paused_s = await time_s(page);
    await page.waitForTimeout(600);
    assert.equal(await time_s(page), paused_s);
    await page.getByRole("button", { name: "Go on" }).click();
    const gained_s = async (pace) => {
        await page.getByLabel("Speed").selectOption(pace);
        await page.waitForTimeout(500);
        const [from_s, from] = [await time_s(page), Date.now()];
        await page.waitForTimeout(2_000);
        return ((await time_s(page)) - from_s) / ((Date.now() - from) / 1_000);
    };
    assert.ok((await gained_s("0.1")) < 0.3);
    const fast = await gained_s("10");
    assert.ok(fast > 1.5 && fast < 13, `${fast}`);
    await page.getByRole("button", { name: "Restart" }).click();
    await page.getByLabel("Speed").selectOption("0.1");
    await page.waitForFunction(() => /: [0-4]\.\d s/.test(document.querySelector('[aria-label="Run"] .live-clock').textContent));
    await page.getByRole("button", { name: "Stop" }).click();
    await page.getByRole("button", { name: "Start", exact: true }).waitFor();
    assert.equal(await page.locator(".live-view").count(), 0);
    await context.close();
});

test("an actuator is set, and the board has it", { skip }, async () => {
    const { context, page } = await at("Run", DESIGN);
    await start(page);
    const servo = page.locator('[data-actuator="Servo"]');
    await servo.getByRole("textbox").fill("30000");
    await page.keyboard.press("Enter");
    await has(servo.locator(".live-has"), /^the board has 30000 \(\d+ us of \d+ us\)$/);
    await servo.getByRole("textbox").fill("70000");
    await servo.getByRole("button", { name: "Set Servo" }).click();
    await has(servo.locator(".live-error"), /^Not sent: .*70000/);
    await has(servo.locator(".live-has"), /^the board has 30000/);
    const slider = servo.getByRole("slider");
    await slider.focus();
    await page.keyboard.press("Home");
    await has(servo.locator(".live-has"), /^the board has 0 /);
    await has(servo.locator(".live-error"), "");
    const lamp = page.locator('[data-actuator="Lamp"]');
    await lamp.getByRole("switch").check();
    await has(lamp.locator(".live-has"), "the board has true (high)");
    await has(cell(page, "Lamp", "value"), "true");
    await context.close();
});

test("a text that has changed is offered, and never started silently", { skip }, async () => {
    const { context, page } = await at("Run", DESIGN);
    await start(page);
    await has(cell(page, "Light", "value"), /^\d+$/);
    await write(page, DESIGN.replace("STM32F4DiscoveryBoard", "NoSuchBoard"));
    await page.getByText("The text has changed and cannot run yet.").waitFor();
    await write(page, DESIGN.replace("Light", "Lumen"));
    const again = page.getByRole("button", { name: "Start again with the new text" });
    await again.waitFor();
    assert.equal(await cell(page, "Lumen", "value").count(), 0);
    const before_s = await time_s(page);
    await page.waitForTimeout(500);
    assert.ok((await time_s(page)) > before_s);
    // Beginning again is not beginning with another text.
    await page.getByRole("button", { name: "Restart" }).click();
    await has(cell(page, "Light", "value"), /^\d+$/);
    await again.waitFor();
    await again.click();
    await has(cell(page, "Lumen", "value"), /^\d+$/);
    assert.equal(await cell(page, "Light", "value").count(), 0);
    // The text of before is not the one that runs.
    await write(page, DESIGN);
    await again.waitFor();
    await write(page, DESIGN.replace("Light", "Lumen"));
    await again.waitFor({ state: "detached" });
    await context.close();
});

test("a text that cannot run says why", { skip }, async () => {
    const { context, page } = await at("Run", DESIGN.replace("type = analog", "type = analog; pin = PX1"));
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await page.getByText("The text cannot run as it is.").first().waitFor();
    assert.match(await page.locator('[aria-label="Run"] .live-banner:visible').textContent(), /E\d{4}: /);
    assert.equal(await page.locator(".live-view").count(), 0);
    await context.close();
});

test("plots are frozen, enlarged by dragging, scrolled, and told in numbers", { skip }, async () => {
    const { context, page } = await at("Run", example("fig2"));
    await start(page);
    await page.getByLabel("Speed").selectOption("10");
    while ((await time_s(page)) < 40) await page.waitForTimeout(200);
    const freeze = page.getByRole("button", { name: "Freeze" });
    await freeze.click();
    assert.equal(await freeze.getAttribute("aria-pressed"), "true");
    await page.getByText("The plots in numbers").click();
    const row = page.locator('[aria-label="Plotted numbers"] tbody tr').first();
    await has(row.locator("th"), "IRFront");
    const count = async () => Number(await row.locator("td").nth(1).textContent());
    while ((await count()) === 0) await page.waitForTimeout(100);
    const all = await count();
    await page.waitForTimeout(600);
    assert.equal(await count(), all);
    const canvas = page.locator(".live-canvas .u-over").first();
    await canvas.scrollIntoViewIfNeeded();
    const box = await canvas.boundingBox();
    const y = box.y + box.height / 2;
    await page.mouse.move(box.x + box.width * 0.25, y);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.5, y, { steps: 4 });
    await page.mouse.up();
    await page.waitForFunction((all) => {
        const shown = Number(document.querySelector('[aria-label="Plotted numbers"] tbody td:nth-of-type(2)').textContent);
        return shown > all * 0.2 && shown < all * 0.3;
    }, all);
    const scroll = page.getByRole("slider", { name: "Scroll back" });
    assert.match(await scroll.getAttribute("aria-valuetext"), / ago$/);
    await page.locator('[role="group"][aria-label="Plots"]').focus();
    await page.keyboard.press("Home");
    await page.waitForFunction(() => Number(document.querySelector('[aria-label="Scroll back"]').value) < 20_000);
    await page.keyboard.press("End");
    assert.equal(await freeze.getAttribute("aria-pressed"), "false");
    assert.equal(await scroll.getAttribute("aria-valuetext"), "now");
    await context.close();
});

test("a real board's values come, its actuators are set, and it is asked how it is", { skip }, async () => {
    const { context, page, wrong } = await at("Connect", DESIGN, { serial: board() });
    await page.getByRole("button", { name: "Connect a board…" }).click();
    await has(page.locator('[aria-label="Connect"] .live-clock'), "Connected: firmware and design agree.");
    await has(cell(page, "Light", "value"), "1000");
    await page.evaluate(() => (window.board.light = 4_094));
    await has(cell(page, "Light", "value"), "4094");
    await has(cell(page, "Bumper", "state"), "failed: 3 timed out");
    await has(page.locator(".live-health:visible"), /Started by.*watchdog/);
    const servo = page.locator('[data-actuator="Servo"]');
    await servo.getByRole("textbox").fill("513");
    await page.keyboard.press("Enter");
    await has(servo.locator(".live-has"), "sent: 513");
    await page.waitForFunction(() => window.board.received.some((one) => one.join() === "3,2,1"));
    assert.equal(await page.getByRole("button", { name: "Hold Light" }).count(), 0);
    // Again every five seconds.
    await page.waitForFunction(() => window.board.asked >= 2);
    await page.getByRole("button", { name: "Disconnect" }).click();
    await page.getByRole("button", { name: "Connect to USB 0483:5740" }).click();
    await has(page.locator('[aria-label="Connect"] .live-clock'), "Connected: firmware and design agree.");
    assert.equal(await page.evaluate(() => window.board.opened), 2);
    assert.deepEqual(wrong.filter(isForeign), []);
    await context.close();
});

for (const isSame of [true, false]) {
    test(`a board that is pulled is waited for, and comes back as ${isSame ? "the same" : "another"} port`, { skip }, async () => {
        const { context, page } = await at("Connect", DESIGN, { serial: board() });
        await page.getByRole("button", { name: "Connect a board…" }).click();
        await has(cell(page, "Light", "value"), "1000");
        const servo = page.locator('[data-actuator="Servo"]');
        await servo.getByRole("textbox").fill("513");
        await page.keyboard.press("Enter");
        await has(servo.locator(".live-has"), "sent: 513");
        await page.evaluate(() => window.board.pull());
        await page.getByText("The board is gone").first().waitFor();
        await has(page.locator('[aria-label="Connect"] .live-clock'), "Waiting for the board to come back…");
        // The last values stay, as those of the past.
        assert.equal(await cell(page, "Light", "value").textContent(), "1000");
        assert.equal(await page.locator(".live-view").getAttribute("data-stale"), "true");
        await page.evaluate((isSame) => {
            window.board.received.length = 0;
            window.board.light = 2_000;
            window.board.plug(isSame);
        }, isSame);
        await has(cell(page, "Light", "value"), "2000");
        assert.equal(await page.locator(".live-view").getAttribute("data-stale"), null);
        // What was set is set again.
        await page.waitForFunction(() => window.board.received.some((one) => one.join() === "3,2,1"));
        await context.close();
    });
}

test("another firmware is not believed, and the differences are named", { skip }, async () => {
    const schema = SCHEMA.replace("1 sensor Light uint16", "1 sensor Light uint32").replace("4 actuator Lamp bool\n", "");
    const { context, page } = await at("Connect", DESIGN, { serial: board({ schema }) });
    await page.getByRole("button", { name: "Connect a board…" }).click();
    const banner = page.locator('[aria-label="Connect"] .live-banner:visible');
    await has(banner, /other firmware.*Light: .*uint32.*uint16/);
    assert.match(await banner.textContent(), /Lamp: not on the board/);
    await has(page.locator('[aria-label="Connect"] .live-clock'), "Other firmware: its values are ignored.");
    assert.equal(await cell(page, "Light", "value").textContent(), "–");
    await context.close();
});

test("why there is no port", { skip }, async () => {
    const cases = [
        [{ serial: null }, /This browser cannot use serial ports/],
        [{ serial: board({ refused: "NotFoundError" }) }, /No port was chosen\./],
        [{ serial: board({ refused: "SecurityError" }) }, /does not let this page use serial ports/],
        [{ serial: board({ busy: "NetworkError" }) }, /The port cannot be opened\. Close other programs/],
    ];
    for (const [options, wanted] of cases) {
        const { context, page } = await at("Connect", DESIGN, options);
        const connect = page.getByRole("button", { name: "Connect a board…" });
        if (options.serial !== null) await connect.click();
        await has(page.locator('[aria-label="Connect"]'), wanted);
        if (options.serial !== null) assert.equal(await connect.isVisible(), true);
        await context.close();
    }
});

test("what comes is recorded to a file", { skip }, async () => {
    const { context, page } = await at("Connect", DESIGN, { serial: board() });
    await page.getByRole("button", { name: "Connect a board…" }).click();
    await has(cell(page, "Light", "value"), "1000");
    await page.getByRole("button", { name: "Record", exact: true }).click();
    await has(page.locator('[aria-label="Record"] .live-hint'), /^[1-9]\d+ values/);
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Stop recording" }).click()]);
    assert.match(download.suggestedFilename(), /^Rover-\d{4}-\d\d-\d\d-\d{6}\.ndjson$/);
    const lines = readFileSync(await download.path(), "utf8").trimEnd().split("\n").map((line) => JSON.parse(line));
    assert.ok(lines.length > 10);
    const { time_s, ...first } = lines.find((one) => one.device === "Light");
    assert.deepEqual(first, { board: "Rover", device: "Light", raw: 1_000, value: 1_000, unit: null });
    assert.ok(time_s > 0 && lines.every((one, at) => at === 0 || one.time_s >= lines[at - 1].time_s));
    await context.close();
});

for (const [colorScheme, width] of [["light", 1400], ["dark", 360]]) {
    test(`an example has a robot that drives on its map: ${colorScheme}, ${width} pixels`, { skip }, async () => {
        const { context, page, wrong } = await at("Run", example("fig2"), { colorScheme, viewport: { width, height: 800 } });
        await page.getByRole("button", { name: "Examples" }).click();
        await page.getByRole("button", { name: /^Line follower on its oval/ }).click();
        await page.getByRole("tab", { name: "oval.svg" }).waitFor();
        assert.equal(await page.getByLabel("World").inputValue(), "oval.toml");
        await start(page);
        await has(page.locator(".live-about"), /^Follow is run by the world’s PID\.$/);
        await has(page.locator(".live-map .live-told"), /^Robot: (0\.[1-9]|[1-9]\.)\d+ m, at most [\d.]+ mm off the line, at least \d+ mm from walls$/);
        const drawing = page.locator(".live-map svg");
        await page.waitForFunction(() => /translate\(1[3-9]\d\d/.test(document.querySelector(".live-robot").getAttribute("transform")));
        assert.equal(await drawing.locator(".live-line, .live-wall").count(), 2);
        // It has its own proportions, and is as wide as there is room.
        const box = await drawing.boundingBox();
        assert.ok(Math.abs(box.width / box.height - 2_400 / 1_400) < 0.02, JSON.stringify(box));
        const room = await page.locator(".live-maps").evaluate((one) => one.clientWidth);
        assert.ok(Math.abs(box.width - Math.min(room, 460 * (2_400 / 1_400))) < 2, `${box.width} of ${room}`);
        await page.evaluate(readFileSync(AXE, "utf8"));
        const found = await page.evaluate(async () => (await window.axe.run(document.querySelector(".live"))).violations.map((one) => one.id));
        assert.deepEqual(found, []);
        assert.deepEqual(wrong.filter(isForeign), []);
        await context.close();
    });

    test(`anybody can use the panels: ${colorScheme}, ${width} pixels`, { skip }, async () => {
        const { context, page } = await at("Run", example("all_kinds"), { colorScheme, viewport: { width, height: 800 } });
        await start(page);
        await has(cell(page, "Distance", "value"), /^\d+$/);
        await page.evaluate(readFileSync(AXE, "utf8"));
        const found = await page.evaluate(async () => {
            const { violations } = await window.axe.run(document.querySelector(".live"));
            return violations.map(({ id, nodes }) => `${id}: ${nodes.map((one) => one.html).slice(0, 3).join(" ")}`);
        });
        assert.deepEqual(found, []);
        const wide = await page.evaluate(() => {
            const own = document.querySelector(".live").getBoundingClientRect();
            const all = [...document.querySelectorAll(".live *")].filter((one) => !one.closest(".live-scroll, .live-canvas") && one.checkVisibility());
            return all.filter((one) => one.getBoundingClientRect().right > own.right + 1).map((one) => one.outerHTML.slice(0, 80));
        });
        assert.deepEqual(wide, []);
        await context.close();
    });
}
