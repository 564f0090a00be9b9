// The wires of a picture: which one is at a pin, and where the pins are.

import type { Solution } from "../talk";
import { partsOf } from "./picture";

const NAMESPACE = "http://www.w3.org/2000/svg";

/** A wire at a pin: of a part, for a role. */
export interface WireAt {
    board: string;
    pin: string;
    part: string;
    role: string;
}

/** An element of the picture's own kind. */
export function draw<Name extends keyof SVGElementTagNameMap>(name: Name, props: Record<string, string | number>): SVGElementTagNameMap[Name] {
    const made = document.createElementNS(NAMESPACE, name);
    for (const [key, value] of Object.entries(props)) made.setAttribute(key, String(value));
    return made;
}

/** The groups of the boards, by name: they are drawn in the order of the answer. */
export function boardGroups(svg: SVGSVGElement, solution: Solution): Map<string, SVGGElement> {
    const groups = [...svg.querySelectorAll<SVGGElement>(":scope > g[transform]")].filter((group) => group.querySelector(":scope > g[data-pin]"));
    return new Map(solution.boards.flatMap(({ name }, at) => (groups[at] ? [[name, groups[at]]] : [])));
}

/** The wires at a pin of a board; those of a bus belong to several parts. */
export function wiresAt(group: SVGGElement, solution: Solution, board: string, pin: string): WireAt[] {
    const paths = [...group.querySelectorAll(`:scope > path[data-pin="${CSS.escape(pin)}"]:not(.hit)`)];
    const parts = new Set(paths.flatMap(partsOf));
    const of = solution.boards.find((one) => one.name === board);
    const found: WireAt[] = [];
    for (const device of of?.devices ?? []) {
        const part = device.chip ?? device.name;
        const wire = device.wires.find((one) => one.pin === pin);
        if (!wire || !parts.has(part) || found.some((one) => one.part === part)) continue;
        found.push({ board, pin, part, role: wire.role });
    }
    return found;
}

/** The middle of a pin, in the units of its board. */
export function middleOf(pin: SVGGElement): { x: number; y: number } {
    const mark = pin.querySelector("circle, rect, path, polygon");
    const circle = mark instanceof SVGCircleElement ? mark : null;
    if (circle) return { x: circle.cx.baseVal.value, y: circle.cy.baseVal.value };
    const box = (mark as SVGGraphicsElement | null)?.getBBox();
    return box ? { x: box.x + box.width / 2, y: box.y + box.height / 2 } : { x: 0, y: 0 };
}

/** The pins of a board. */
export function pinsOf(group: SVGGElement): SVGGElement[] {
    return [...group.querySelectorAll<SVGGElement>(":scope > g[data-pin]")];
}

/** A point of the window in the units of a group. */
export function inside(group: SVGGElement, event: { clientX: number; clientY: number }): { x: number; y: number } {
    const matrix = group.getScreenCTM()?.inverse();
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
    return { x, y };
}
