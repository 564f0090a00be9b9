// The tasks of `docs/tasks.md` in VS Code, with the program that SENSEDSL names: each is done, and takes as many actions as
// the page says.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { delimiter, dirname } from "node:path";
import { after, before, test } from "node:test";
import { counts, User } from "../../../web/test/tasks.mjs";
import { PATIENCE, chosen, command, eventually, missing, open, openFile } from "./vscode.mjs";

const FIG2 = readFileSync(new URL("../../../examples/fig2.sense", import.meta.url), "utf8");
const FIGHT = FIG2.replace("id = 17;", "id = 17; pin = PA1;").replace("id = 18;", "id = 18; pin = PA1;");
const program = process.env.SENSEDSL;
const lacks = missing() ?? (program && existsSync(program) ? undefined : "the program: SENSEDSL names it");
const options = { skip: lacks, timeout: PATIENCE.test };
const TEXTS = { "fig2.sense": FIG2, "fight.sense": FIGHT, "mistake.sense": FIG2.replace("type = icu", "type = icuu") };
let code;
let page;

before(async () => {
    if (lacks) return;
    // What a terminal prints is in the page if it is not drawn.
    const terminal = {
        "terminal.integrated.env.linux": { PATH: `${dirname(program)}${delimiter}${process.env.PATH}` },
        "terminal.integrated.gpuAcceleration": "off",
    };
    code = await open(TEXTS, { "sensedsl.path": program, ...terminal });
    page = code.page;
    page.setDefaultTimeout(PATIENCE.page);
});

after(async () => code?.end());

const line = (text) => page.locator(".view-line", { hasText: text }).first();
const word = (text) => page.locator(".view-line span", { hasText: new RegExp(`^${text}$`) }).first();
const suggestion = (text) => page.locator(".suggest-widget.visible .monaco-list-row.focused", { hasText: text }).first();
const hover = (text) => page.locator(".monaco-hover:not(.hidden) .hover-contents", { hasText: text }).first();
const isRight = () => page.locator(".squiggly-error").first().waitFor({ state: "detached" });
const printed = (text) => page.locator(".terminal-wrapper.active .xterm-rows", { hasText: text }).first().waitFor();

/** Waits for a text in a page beside the text, which is a frame in a frame. */
function inPreview(text) {
    return eventually(`nothing tells ${text}`, async () => {
        for (const frame of page.frames()) {
            const shown = await frame.locator("pre").first().innerText({ timeout: 100 }).catch(() => "");
            if (text.test(shown)) return true;
        }
        return false;
    });
}

async function newLineBelow(user, text) {
    await user.click(line(text));
    await user.key("End");
    await user.key("Enter");
}

async function inTerminal(user, text) {
    await user.key("Control+Shift+Backquote");
    await page.locator(".terminal-wrapper.active .xterm-rows", { hasText: /[$#]/ }).first().waitFor();
    await user.type(text);
    await user.key("Enter");
}

async function fixed(user) {
    await page.locator(".squiggly-error").first().waitFor();
    await user.key("F8");
    await user.key("Control+.");
    // Beside other work the first time is lost now and then; whoever sees no list asks again.
    const offered = page.locator(".action-widget .monaco-list-row").first();
    for (let left = 10; left > 0 && !(await offered.waitFor({ timeout: 5_000 }).then(() => true, () => false)); left -= 1) {
        await page.keyboard.press("Control+.");
    }
    await offered.waitFor();
    await user.key("Enter");
    await isRight();
}

async function generated(user) {
    await user.key("Control+Shift+B");
    await page.locator(".quick-input-list .monaco-list-row", { hasText: "generate fig2.sense" }).first().waitFor();
    await user.type("generate");
    await chosen(page, "generate fig2.sense");
    await user.key("Enter");
    await eventually("nothing was generated", () => existsSync(`${code.folder}/build/wiring.html`));
}

/** In the order of the page: what is done, with the file that is open if it is not Fig. 2. */
const TASKS = [
    async (user) => {
        await newLineBelow(user, "board");
        await user.type("ana");
        await suggestion("sensor analog").waitFor();
        await user.key("Enter");
        await user.type("Light");
        await line("sensor Light").waitFor();
        await page.keyboard.press("Escape");
        await isRight();
    },
    async (user) => {
        await newLineBelow(user, "board");
        await user.type("lm75");
        await suggestion("lm75").waitFor();
        await user.key("Enter");
        await line("driver = lm75").waitFor();
        await isRight();
    },
    async (user) => {
        await newLineBelow(user, "id = 17");
        await user.type("pin");
        await suggestion("pin").waitFor();
        await user.key("Enter");
        await user.type("PA2");
        await line("pin = PA2").waitFor();
        await page.keyboard.press("Escape");
        await isRight();
    },
    async (user) => {
        await user.point(word("WheelEncoder"));
        await hover(/PB4/).waitFor();
    },
    Object.assign((user) => fixed(user), { file: "fight.sense" }),
    Object.assign((user) => fixed(user), { file: "mistake.sense" }),
    async (user) => {
        await user.choose(word("WheelEncoder"));
        await user.key("F2");
        await page.locator(".rename-box input").waitFor();
        await user.type("Wheel");
        await user.key("Enter");
        await line("sensor Wheel ").waitFor();
    },
    async (user) => {
        await user.choose(word("60"));
        await user.type("20");
        await line("delay = 20").waitFor();
    },
    async (user) => {
        await user.choose(word("STM32F4DiscoveryBoard"));
        await user.type("NUCLEO_F401RE");
        await page.keyboard.press("Escape");
        await isRight();
        await page.locator(".codelens-decoration", { hasText: "4 devices" }).first().waitFor();
    },
    async (user) => {
        await user.click(page.locator(".codelens-decoration a", { hasText: "explain" }).first());
        await page.locator(".tab", { hasText: "Why IRFront" }).waitFor();
        await inPreview(/costs least/);
    },
    async (user) => {
        // The lens of the first line is above it.
        user.actions += 1;
        await word("board").hover();
        await page.mouse.wheel(0, -200);
        await user.click(page.locator(".codelens-decoration a", { hasText: "room left" }).first());
        await page.locator(".tab", { hasText: "Room left" }).waitFor();
    },
    async (user) => {
        await inTerminal(user, "sensedsl explain timing fig2.sense");
        await printed(/ADC|conversions|I2C/);
    },
    generated,
    async (user) => {
        await generated(user);
        await user.key("Control+P");
        await user.type("wiring.md");
        await chosen(page, "wiring.md");
        await user.key("Enter");
        await page.locator(".tab", { hasText: "wiring.md" }).waitFor();
    },
    async (user) => {
        await inTerminal(user, "sensedsl monitor simulate fig2.sense");
        await printed(/USRear/);
        await page.keyboard.press("q");
    },
];

const rows = lacks ? [] : counts("VS Code");

test("the page has these tasks", options, () => assert.equal(rows.length, TASKS.length));

for (const [at, { task, actions }] of rows.entries()) {
    test(`task ${at + 1}: ${task}`, options, async () => {
        const steps = TASKS[at];
        const user = new User(page);
        try {
            await openFile(page, steps.file ?? "fig2.sense");
            if (!steps.file) await page.locator(".codelens-decoration").first().waitFor();
            await steps(user);
        } finally {
            if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/task-${at + 1}.png` });
            await page.keyboard.press("Escape");
            await command(page, "View: Revert and Close Editor");
            await command(page, "View: Close All Editors");
        }
        assert.equal(user.actions, actions, `it takes ${user.actions} actions`);
    });
}
