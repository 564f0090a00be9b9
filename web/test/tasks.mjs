// Fifteen things that a new user does, with the number of actions that each takes; the page `docs/tasks.md` has them.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";


const PAGE = readFileSync(new URL("../../docs/tasks.md", import.meta.url), "utf8");

/** The tasks of the page with the number of actions in the column of that name, in the order of the page. */
export function counts(column) {
    const cells = (line) => line.split("|").slice(1, -1).map((cell) => cell.trim());
    const lines = PAGE.split("\n").filter((line) => line.startsWith("| "));
    const head = cells(lines[0]);
    const at = head.indexOf(column);
    assert.ok(at > 0, `the page has no column ${column}`);
    return lines.slice(2).map(cells).filter(([first]) => /^\d+$/.test(first)).map((row) => ({ task: row[1], actions: Number(row[at]) }));
}

/** Somebody at the mouse and the keyboard, whose actions are counted: a click, a drag, a key with what is held, a word that is typed. */
export class User {
    actions = 0;

    constructor(page) {
        this.page = page;
    }

    async click(locator, options) {
        this.actions += 1;
        await locator.click(options);
    }

    /** Two clicks of one go, which choose a word. */
    async choose(locator, options) {
        this.actions += 1;
        await locator.dblclick(options);
    }

    async point(locator) {
        this.actions += 1;
        await locator.hover();
    }

    async key(name) {
        this.actions += 1;
        await this.page.keyboard.press(name);
    }

    async type(text) {
        this.actions += text.trim().split(/\s+/).length;
        await this.page.keyboard.type(text, { delay: 15 });
    }

    /** Presses at one place and lets go at another. */
    async drag(from, to, meanwhile = async () => {}) {
        this.actions += 1;
        const { mouse } = this.page;
        await mouse.move(from.x, from.y);
        await mouse.down();
        await mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 4 });
        await mouse.move(to.x, to.y, { steps: 4 });
        await meanwhile();
        await mouse.up();
    }
}
