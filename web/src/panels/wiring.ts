// The wiring beside the text: the picture, and why there is none.

import { Drag } from "../picture/drag";
import { Picture } from "../picture/picture";
import type { Studio } from "../studio";
import type { Conflict, Wiring } from "../talk";
import { conflictOf } from "./conflict";
import { inline } from "../language/markdown";
import { el } from "../ui/dom";
import type { View } from "../ui/tabs";

/** How long nothing is typed before a picture of a text with mistakes takes the place of the one before. */
const LATER_MS = 1000;

export class WiringView implements View {
    readonly id = "wiring";
    readonly title = "Wiring";
    readonly picture: Picture;
    private readonly drag: Drag;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private path = "";
    private readonly why = el("p", { class: "why" });
    private readonly said = el("p", { class: "said" });
    private readonly conflict = el("section", { class: "conflict", "aria-label": "Conflict", hidden: true });

    constructor(private readonly studio: Studio) {
        this.picture = new Picture({
            picked: (name, isByKey) => studio.goTo(name, !isByKey),
            drawn: (svg) => this.drag.enable(svg),
        });
        this.drag = new Drag(studio, this.picture.host, (text) => {
            this.said.textContent = text;
        });
    }

    mount(host: HTMLElement): void {
        host.append(el("div", { class: "picture-bar" }, this.why, this.said, this.picture.tools), this.conflict, this.picture.host);
        this.picture.empty(el("p", {}, "Looking for a wiring …"));
    }

    /** Shows the newest wiring. */
    take(wiring: Wiring | null, isNewest: boolean): void {
        const { studio, picture } = this;
        const error = this.firstError();
        const { path } = studio.request();
        clearTimeout(this.timer);
        // A text with a mistake may have lost a part: while one types, the picture does not lose it.
        const isLater = wiring?.svg && error !== null && !picture.isEmpty && path === this.path;
        if (isLater) this.timer = setTimeout(() => this.draw(wiring, isNewest), LATER_MS);
        else this.draw(wiring, isNewest);
        this.path = path;
        if (isLater) picture.age(true);
        picture.mark(studio.here());
        this.why.replaceChildren(...inline(error ?? ""));
        this.fight(wiring?.answer?.conflict ?? null);
    }

    private draw(wiring: Wiring | null, isNewest: boolean): void {
        const { picture } = this;
        if (wiring?.svg) picture.draw(wiring.svg, wiring.parts.map((part) => part.name));
        else if (picture.isEmpty) picture.empty(el("p", {}, this.firstError() ? "There is no wiring yet." : "Nothing to wire yet."));
        picture.age(!(wiring?.svg && wiring.is_current) && isNewest);
    }

    /** Shows problems and fixes that came after the wiring. */
    problems(): void {
        this.why.replaceChildren(...inline(this.firstError() ?? ""));
        this.fight(this.studio.wiring?.answer?.conflict ?? null);
    }

    private firstError(): string | null {
        const all = this.studio.problems.all.get(this.studio.editor.path) ?? [];
        const error = all.filter((one) => one.severity === 1).sort((one, other) => one.range.start.line - other.range.start.line)[0];
        return error ? `Line ${error.range.start.line + 1}: ${error.message.split("\n")[0]}` : null;
    }

    private fight(conflict: Conflict | null): void {
        this.conflict.hidden = conflict === null;
        // The repairs come a little later than the conflict, and the buttons stay as long as nothing changes.
        const shown = conflict ? conflictOf(this.studio, conflict) : [];
        const next = el("div", {}, ...shown);
        if (next.innerHTML === this.conflict.firstElementChild?.innerHTML) return;
        const focused = this.conflict.contains(document.activeElement) ? document.activeElement?.textContent : null;
        this.conflict.replaceChildren(next);
        if (focused) [...next.querySelectorAll("button")].find((one) => one.textContent === focused)?.focus();
    }
}
