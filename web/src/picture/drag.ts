// Moving a wire: from its pin to another one, by the pointer or by keys. While it is moved each pin says what the wire would
// cost there, or why it cannot be there; the tool has tried them all.

import type { Place } from "../../../crates/wasm/sensedsl.mjs";
import type { Studio } from "../studio";
import { Superseded } from "../tool";
import { announce, note } from "../ui/dom";
import { boardGroups, draw, inside, middleOf, pinsOf, wiresAt, type WireAt } from "./wires";

/** How far the pointer must move before a wire comes along, in pixels. */
const FAR_PX = 4;
/** How near the pointer must come to a pin, in units of the picture. */
const NEAR = 16;

interface Moving {
    wire: WireAt;
    from: SVGGElement;
    start: { x: number; y: number };
    layer: SVGGElement;
    line: SVGLineElement;
    /** The groups of the boards, each with its badges. */
    groups: Map<string, SVGGElement>;
    /** None until the tool has answered. */
    places: Place[] | undefined;
    answer: Promise<Place[]>;
    target: Place | undefined;
    isByKey: boolean;
    /** Where the pointer was last, if one moves the wire. */
    pointer: PointerEvent | undefined;
}

/** What the badge of a pin shows. */
function badge({ chosen, possible, more }: Place): string {
    if (chosen) return "now";
    if (!possible) return "×";
    if (more === null) return "✓";
    return more === 0 ? "±0" : more > 0 ? `+${more}` : `−${-more}`;
}

/** One place for each pin: a pin may have several signals that serve, and the cheapest is taken. */
function best(places: Place[]): Place[] {
    const rank = (one: Place) => (one.chosen ? -Infinity : one.possible ? (one.more ?? 0) : Infinity);
    const found = new Map<string, Place>();
    for (const place of places) {
        const key = `${place.board} ${place.pin}`;
        const known = found.get(key);
        if (!known || rank(place) < rank(known)) found.set(key, place);
    }
    return [...found.values()];
}

export class Drag {
    private moving: Moving | undefined;
    private pressed: { wire: WireAt; from: SVGGElement; x: number; y: number; id: number } | undefined;

    constructor(
        private readonly studio: Studio,
        private readonly host: HTMLElement,
        private readonly say: (text: string) => void,
    ) {
        host.addEventListener("pointerdown", (event) => this.press(event));
        host.addEventListener("pointermove", (event) => this.drag(event));
        host.addEventListener("pointerup", (event) => void this.release(event));
        host.addEventListener("pointercancel", () => this.end());
        host.addEventListener("keydown", (event) => this.key(event), { capture: true });
        host.addEventListener("focusout", () => {
            if (this.moving?.isByKey && !this.host.contains(document.activeElement)) this.end();
        });
    }

    get isMoving(): boolean {
        return this.moving !== undefined;
    }

    /** Makes handles of the pins that have wires, in a picture that was just drawn. */
    enable(svg: SVGSVGElement): void {
        this.end();
        const solution = this.studio.wiring?.answer;
        if (!solution) return;
        for (const [board, group] of boardGroups(svg, solution)) {
            for (const pin of pinsOf(group)) {
                const name = pin.dataset["pin"] ?? "";
                const [wire] = wiresAt(group, solution, board, name);
                if (!wire) continue;
                const { x, y } = middleOf(pin);
                pin.append(draw("circle", { cx: x, cy: y, r: 9, class: "handle" }));
                pin.classList.add("is-wired");
                pin.querySelector("text")?.setAttribute("aria-hidden", "true");
                pin.dataset["board"] = board;
                pin.setAttribute("tabindex", "0");
                pin.setAttribute("role", "button");
                pin.setAttribute("aria-label", `${name}, ${wire.role} of ${wire.part}: move the wire`);
            }
        }
    }

    /** The wire at a pin: of several parts that share it, of the one that the cursor is in. */
    private wireAt(pin: SVGGElement): WireAt | undefined {
        // A picture of another text has other wires.
        const solution = this.host.classList.contains("is-old") ? null : this.studio.wiring?.answer;
        const group = pin.parentElement as unknown as SVGGElement | null;
        if (!solution || !group) return undefined;
        const all = wiresAt(group, solution, pin.dataset["board"] ?? "", pin.dataset["pin"] ?? "");
        const here = this.studio.here();
        return all.find((one) => here.includes(one.part)) ?? all[0];
    }

    private pinOf(event: Event): SVGGElement | null {
        return event.target instanceof Element ? event.target.closest<SVGGElement>("g.is-wired") : null;
    }

    private press(event: PointerEvent): void {
        const from = event.button === 0 ? this.pinOf(event) : null;
        const wire = from ? this.wireAt(from) : undefined;
        if (!from || !wire) return;
        event.preventDefault();
        this.host.setPointerCapture(event.pointerId);
        this.pressed = { wire, from, x: event.clientX, y: event.clientY, id: event.pointerId };
    }

    private drag(event: PointerEvent): void {
        const { pressed } = this;
        if (!pressed) return;
        if (!this.moving) {
            if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < FAR_PX) return;
            this.begin(pressed.wire, pressed.from, false);
        }
        const { moving } = this;
        if (!moving) return;
        const own = moving.groups.get(moving.wire.board);
        if (!own) return;
        const at = inside(own, event);
        moving.line.setAttribute("x2", String(at.x));
        moving.line.setAttribute("y2", String(at.y));
        moving.pointer = event;
        this.aim(this.near(moving, event));
    }

    /** The place whose pin the pointer is at. */
    private near(moving: Moving, event: PointerEvent): Place | undefined {
        let best: Place | undefined;
        let least = NEAR;
        for (const place of moving.places ?? []) {
            const group = moving.groups.get(place.board);
            const pin = group?.querySelector<SVGGElement>(`:scope > g[data-pin="${CSS.escape(place.pin)}"]`);
            if (!group || !pin) continue;
            const at = inside(group, event);
            const { x, y } = middleOf(pin);
            const distance = Math.hypot(at.x - x, at.y - y);
            if (distance < least) [least, best] = [distance, place];
        }
        return best;
    }

    private async release(event: PointerEvent): Promise<void> {
        const { pressed, moving } = this;
        this.pressed = undefined;
        if (pressed) this.host.releasePointerCapture(pressed.id);
        if (!moving || !pressed) {
            if (pressed) this.studio.goTo(pressed.wire.part, true);
            return;
        }
        if (!moving.places) {
            // Dropped before the tool has answered: the answer is waited for.
            this.say("Asking what is possible …");
            await moving.answer.catch(() => []);
            if (this.moving !== moving) return;
            this.aim(this.near(moving, event));
        }
        await this.drop();
    }

    private key(event: KeyboardEvent): void {
        const { moving } = this;
        if (!moving?.isByKey) {
            const from = event.key === "Enter" || event.key === " " ? this.pinOf(event) : null;
            const wire = from ? this.wireAt(from) : undefined;
            if (!from || !wire) return;
            event.preventDefault();
            event.stopPropagation();
            this.begin(wire, from, true);
            return;
        }
        const steps: Record<string, number> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };
        const step = steps[event.key];
        if (step !== undefined) this.step(moving, step);
        else if (event.key === "Enter" || event.key === " ") void this.drop();
        else if (event.key === "Escape") {
            this.end();
            this.say("The wire stays.");
            announce("The wire stays.");
        } else return;
        event.preventDefault();
        event.stopPropagation();
    }

    private step(moving: Moving, by: number): void {
        const all = (moving.places ?? []).filter((one) => one.possible || one.chosen);
        if (all.length === 0) return;
        const at = all.findIndex((one) => one === moving.target);
        const next = all[(at + by + all.length) % all.length];
        this.aim(next);
        if (next) announce(`${next.pin}: ${next.verdict}`);
    }

    private begin(wire: WireAt, from: SVGGElement, isByKey: boolean): void {
        const svg = from.ownerSVGElement;
        const solution = this.studio.wiring?.answer;
        if (!svg || !solution) return;
        const groups = boardGroups(svg, solution);
        const own = groups.get(wire.board);
        if (!own) return;
        const start = middleOf(from);
        const line = draw("line", { x1: start.x, y1: start.y, x2: start.x, y2: start.y, class: "moved" });
        const layer = draw("g", { class: "layer" });
        layer.append(line);
        own.append(layer);
        const answer = this.ask(wire);
        const moving: Moving = { wire, from, start, layer, line, groups, places: undefined, answer, target: undefined, isByKey, pointer: undefined };
        this.moving = moving;
        this.host.classList.add("is-moving");
        this.say(`${wire.role} of ${wire.part}: asking what is possible …`);
        answer.then(
            (places) => {
                if (this.moving !== moving) return;
                moving.places = places;
                this.show(moving, places);
                // The pointer may be there already.
                if (moving.pointer) this.aim(this.near(moving, moving.pointer));
            },
            (why: unknown) => {
                if (this.moving !== moving || why instanceof Superseded) return;
                this.end();
                this.say(why instanceof Error ? why.message : String(why));
            },
        );
    }

    private async ask(wire: WireAt): Promise<Place[]> {
        const request = { ...this.studio.request(), name: wire.part };
        const { places, diagnostics } = await this.studio.tool.call("places", [request], "places");
        if (!places) throw new Error(diagnostics[0]?.message ?? "There is no wiring now.");
        return best(places.filter((one) => one.wire === wire.role));
    }

    /** Shows what each pin would cost. */
    private show(moving: Moving, places: Place[]): void {
        for (const place of places) {
            const group = moving.groups.get(place.board);
            const pin = group?.querySelector<SVGGElement>(`:scope > g[data-pin="${CSS.escape(place.pin)}"]`);
            if (!group || !pin) continue;
            const { x, y } = middleOf(pin);
            const kind = place.chosen ? "is-chosen" : place.possible ? ((place.more ?? 0) > 0 ? "is-dear" : "is-free") : "is-impossible";
            const made = draw("g", { class: `badge ${kind}`, "data-badge": `${place.board} ${place.pin}` });
            const text = badge(place);
            const width = 10 + 6.5 * text.length;
            const label = draw("text", { x, y: y + 3.8, "text-anchor": "middle", "font-size": 11 });
            label.textContent = text;
            const title = draw("title", {});
            title.textContent = `${place.pin}: ${place.verdict}`;
            made.append(title, draw("rect", { x: x - width / 2, y: y - 8, width, height: 16, rx: 8 }), label);
            this.layerOf(group).append(made);
        }
        const count = places.filter((one) => one.possible && !one.chosen).length;
        const how = moving.isByKey ? " Arrow keys choose, Enter moves the wire, Escape leaves it." : " Drop it on one.";
        const text = `${moving.wire.role} of ${moving.wire.part} can be on ${count} other pin${count === 1 ? "" : "s"}.${count > 0 ? how : ""}`;
        this.say(text);
        announce(text);
    }

    private layerOf(group: SVGGElement): SVGGElement {
        const known = group.querySelector<SVGGElement>(":scope > g.layer");
        if (known) return known;
        const made = draw("g", { class: "layer" });
        group.append(made);
        return made;
    }

    private aim(place: Place | undefined): void {
        const { moving } = this;
        if (!moving || moving.target === place) return;
        moving.target = place;
        for (const one of this.host.querySelectorAll(".badge.is-target")) one.classList.remove("is-target");
        if (!place) return;
        const chosen = this.host.querySelector<SVGGElement>(`[data-badge="${CSS.escape(`${place.board} ${place.pin}`)}"]`);
        chosen?.classList.add("is-target");
        if (moving.isByKey && chosen) {
            const pin = moving.groups.get(place.board)?.querySelector<SVGGElement>(`:scope > g[data-pin="${CSS.escape(place.pin)}"]`);
            const { x, y } = pin ? middleOf(pin) : moving.start;
            if (place.board === moving.wire.board) {
                moving.line.setAttribute("x2", String(x));
                moving.line.setAttribute("y2", String(y));
            }
            chosen.scrollIntoView({ block: "nearest", inline: "nearest" });
        }
        this.say(`${place.pin}: ${place.verdict}`);
    }

    private async drop(): Promise<void> {
        const { moving } = this;
        const target = moving?.target;
        this.end();
        if (!moving || !target || target.chosen) {
            this.say("The wire stays.");
            return;
        }
        const { wire } = moving;
        if (!target.possible) {
            this.say(`${target.pin}: ${target.verdict}`);
            return;
        }
        const request = this.studio.request();
        const { files, error } = await this.studio.tool
            .call("pin", [{ ...request, name: wire.part, wire: wire.role, pin: target.pin }])
            .catch((why: unknown) => ({ files: null, error: String(why) }));
        if (!files) {
            note(`The wire cannot be moved: ${error ?? "the text cannot be changed"}`, [], "drag");
            return;
        }
        // Something was typed meanwhile: that is not lost.
        if (JSON.stringify(request.files) !== JSON.stringify(this.studio.request().files)) return;
        this.studio.editor.write(files);
        const said = `${wire.role} of ${wire.part} is on ${target.pin} now.`;
        this.say(said);
        announce(said);
    }

    private end(): void {
        this.pressed = undefined;
        if (!this.moving) return;
        this.moving = undefined;
        this.host.classList.remove("is-moving");
        for (const layer of this.host.querySelectorAll("g.layer")) layer.remove();
    }
}
