// A conflict: who fights for what, and the ways out, each of which was tried before it is offered.

import type { Studio } from "../studio";
import type { CodeAction, Conflict } from "../talk";
import { inline } from "../language/markdown";
import { button, el } from "../ui/dom";

const NO_WIRING = "E0401";

function listed(names: string[]): string {
    const last = names.at(-1) ?? "";
    return names.length < 2 ? last : `${names.slice(0, -1).join(", ")} and ${last}`;
}

/** The repairs of the conflict that are edits. */
function repairs(studio: Studio): CodeAction[] {
    const all = [...studio.problems.all.keys()].flatMap((path) => studio.problems.fixesOf(path));
    return all.filter((fix) => fix.edit && fix.diagnostics?.some((one) => one.code === NO_WIRING));
}

/** Makes the changes of a repair as it is now: the text may have changed since the button was made. */
function repair(studio: Studio, title: string): void {
    const now = repairs(studio).find((one) => one.title === title);
    if (now) studio.problems.apply(now.edit, title);
}

/** The pins that are fought for, with what holds them. */
function contested({ places, resources }: Conflict): HTMLElement | null {
    if (places.length === 0) return resources.length > 0 ? el("p", {}, `They fight for ${listed(resources)}.`) : null;
    const byResource = new Map<string, Set<string>>();
    for (const { resource, board, pin } of places) {
        const pins = byResource.get(resource) ?? new Set();
        byResource.set(resource, pins.add(pin === resource ? `on ${board}` : `${pin} on ${board}`));
    }
    const rows = [...byResource].map(([resource, pins]) => el("li", {}, el("strong", {}, resource), ` ${[...pins].join(", ")}`));
    return el("div", {}, el("h3", {}, "They fight for"), el("ul", {}, ...rows));
}

/** The conflict as elements. */
export function conflictOf(studio: Studio, conflict: Conflict): HTMLElement[] {
    const { devices, rules } = conflict;
    const fighters = devices.map((name) => button(name, () => studio.goTo(name, true), { class: "fighter", title: `Go to the text of ${name}` }));
    const offered = repairs(studio);
    const isBest = (title: string) =>
        conflict.repairs.some((one) => one.best && one.action !== "drop" && one.message.toLowerCase() === title.toLowerCase());
    const buttons = offered.map((fix) =>
        el("li", {}, button(inline(fix.title), () => repair(studio, fix.title), { class: isBest(fix.title) ? "fix main" : "fix" })),
    );
    // Repairs that are no edit of the text are said all the same.
    const told = conflict.repairs.filter((one) => !offered.some((fix) => fix.title.toLowerCase() === one.message.toLowerCase()));
    return [
        el("h2", {}, devices.length === 1 ? "This cannot be wired" : "These cannot be wired together"),
        el("div", { class: "fighters" }, ...fighters),
        ...[contested(conflict)].filter((one) => one !== null),
        ...(rules.length > 0 ? [el("div", {}, el("h3", {}, "Because of"), el("ul", {}, ...rules.map((rule) => el("li", {}, ...inline(rule)))))] : []),
        ...(conflict.minimal ? [] : [el("p", {}, "There was no time to find the smallest such group.")]),
        el("h3", {}, "Ways out"),
        ...(buttons.length > 0 ? [el("ul", { class: "repairs" }, ...buttons)] : []),
        ...(told.length > 0 && buttons.length === 0 ? [el("ul", {}, ...told.map((one) => el("li", {}, ...inline(one.message))))] : []),
        ...(conflict.repairs.length === 0 ? [el("p", {}, "No single change helps: remove one of them, or use another board.")] : []),
    ];
}
