// The tasks of `docs/tasks.md` in the studio: each is done, and takes as many actions as the page says.

import assert from "node:assert/strict";
import { test } from "node:test";
import { example, missing, open, shared, write } from "./site.mjs";
import { counts, User } from "./tasks.mjs";

const skip = missing();
const FIG2 = example("fig2");
const FIGHT = FIG2.replace("id = 17;", "id = 17; pin = PA1;").replace("id = 18;", "id = 18; pin = PA1;");

const chromium = shared(skip);

const tab = (page, name) => page.getByRole("tab", { name, exact: true });
const panel = (page) => page.locator("#view-panels > :not([hidden])");
const card = (page, name) => page.locator("#panel-parts .card", { hasText: name }).first();
const box = (page, name) => page.locator(`.picture:not(.is-old) [data-part="${name}"]`);
const line = (page, text) => page.locator(".cm-line", { hasText: text }).first();

async function middleOf(page, pin) {
    const { x, y, width, height } = await page.locator(`.picture g[data-pin="${pin}"] circle`).first().boundingBox();
    return { x: x + width / 2, y: y + height / 2 };
}

/** Where a text begins, in its line. */
function placeOf(page, text) {
    return page.evaluate((text) => {
        const line = [...document.querySelectorAll(".cm-line")].find((one) => one.innerText.includes(text));
        const walker = document.createTreeWalker(line, NodeFilter.SHOW_TEXT);
        for (let node = walker.nextNode(), left = line.textContent.indexOf(text); node; node = walker.nextNode()) {
            if (left < node.length) {
                const range = document.createRange();
                range.setStart(node, left);
                range.setEnd(node, left + 1);
                const [at, of] = [range.getBoundingClientRect(), line.getBoundingClientRect()];
                return { x: at.x - of.x + 3, y: at.y - of.y + at.height / 2 };
            }
            left -= node.length;
        }
    }, text);
}

async function fromLibrary(page, user, words) {
    await user.click(tab(page, "Parts"));
    await user.click(page.getByLabel("Search"));
    await user.type(words);
}

/** In the order of the page: a text that is not Fig. 2, and what is done with it. */
const TASKS = [
    async (page, user) => {
        await fromLibrary(page, user, "analog");
        await user.click(card(page, "Any analog sensor"));
        await user.type("Light");
        await tab(page, "Wiring").click();
        await box(page, "Light").waitFor();
    },
    async (page, user) => {
        await fromLibrary(page, user, "lm75");
        await user.click(card(page, "LM75"));
        await tab(page, "Wiring").click();
        await box(page, "Lm75").waitFor();
    },
    async (page, user) => {
        await user.drag(await middleOf(page, "PB0"), await middleOf(page, "PA2"), () => page.locator('.badge.is-target[data-badge$=" PA2"]').waitFor());
        await page.waitForFunction(() => document.querySelector('.picture path[data-pin="PA2"][data-parts="IRFront"]'));
    },
    async (page, user) => {
        await page.locator('.picture g.is-wired[data-pin="PB4"]').focus();
        await user.key("Enter");
        await page.locator(".badge").nth(3).waitFor();
        assert.match(await page.locator(".badge text").first().textContent(), /\d/);
        await user.key("Escape");
    },
    Object.assign(
        async (page, user) => {
            const repair = page.getByRole("region", { name: "Conflict" }).getByRole("button", { name: "Remove the fixed pins or place of IRFrontRight" });
        await user.click(repair);
            await box(page, "IRFrontRight").waitFor();
        },
        { text: FIGHT },
    ),
    Object.assign(
        async (page, user) => {
            await user.click(page.locator("#problems .fixes button").first());
            await box(page, "WheelEncoder").waitFor();
        },
        { text: FIG2.replace("type = icu", "type = icuu") },
    ),
    async (page, user) => {
        await user.choose(line(page, "WheelEncoder").getByText("WheelEncoder"));
        await user.key("F2");
        await page.getByLabel("New name").waitFor();
        await page.keyboard.press("Control+a");
        await user.type("Wheel");
        await user.key("Enter");
        await box(page, "Wheel").waitFor();
    },
    async (page, user) => {
        await user.choose(line(page, "delay = 60"), { position: await placeOf(page, "60") });
        await user.type("20");
        await line(page, "delay = 20").waitFor();
    },
    async (page, user) => {
        await user.click(tab(page, "Parts"));
        // A list of a browser is opened and chosen from.
        user.actions += 2;
        await page.getByLabel("What").selectOption("boards");
        await user.click(page.getByLabel("Search"));
        await user.type("nucleo f401");
        await user.click(page.getByRole("button", { name: /^Use / }).first());
        await line(page, /board \S+ on \w*F401/).waitFor();
    },
    async (page, user) => {
        await user.click(box(page, "USRear"));
        await user.click(tab(page, "Why"));
        await panel(page).getByText(/costs least/).first().waitFor();
    },
    async (page, user) => {
        await user.click(tab(page, "Reports"));
        await user.click(page.getByLabel("Room left"));
        await panel(page).getByRole("cell", { name: "icu", exact: true }).waitFor();
    },
    async (page, user) => {
        await user.click(tab(page, "Reports"));
        await user.click(page.getByLabel("Timing"));
        await panel(page).getByText(/conv/).first().waitFor();
    },
    async (page, user) => {
        await user.click(page.getByRole("button", { name: "Download" }));
        const [download] = await Promise.all([page.waitForEvent("download"), user.click(page.getByRole("menuitem", { name: /Project as .zip/ }))]);
        assert.equal(download.suggestedFilename(), "fig2.zip");
    },
    async (page, user) => {
        await user.click(tab(page, "Sheet"));
        await page.frameLocator("iframe.sheet").getByText("IRFrontRight").first().waitFor();
    },
    async (page, user) => {
        await user.click(tab(page, "Run"));
        await user.click(page.getByRole("button", { name: "Start", exact: true }));
        const slider = page.getByRole("slider", { name: "USRear", exact: true });
        await slider.waitFor();
        const { x, y, width, height } = await slider.boundingBox();
        await user.drag({ x: x + 4, y: y + height / 2 }, { x: x + width / 2, y: y + height / 2 });
        const held = await slider.inputValue();
        await page.locator('tr[data-device="USRear"] .live-value', { hasText: new RegExp(`^${held}\\b`) }).waitFor();
    },
];

const rows = skip ? [] : counts("studio");

test("the page has these tasks", { skip }, () => assert.equal(rows.length, TASKS.length));

for (const [at, { task, actions }] of rows.entries()) {
    test(`task ${at + 1}: ${task}`, { skip }, async () => {
        const { page, context, wrong } = await open(chromium.browser, chromium.server.url, { reducedMotion: "reduce" });
        await box(page, "USRear").waitFor();
        const steps = TASKS[at];
        if (steps.text !== undefined) await write(page, steps.text);
        const user = new User(page);
        await steps(page, user);
        assert.equal(user.actions, actions, `it takes ${user.actions} actions`);
        assert.deepEqual(wrong, []);
        await context.close();
    });
}
