import type { RobotInfo, Seen } from "../../../crates/wasm/sensedsl.mjs";
import { make, mark, shape, write } from "./dom.js";
import { directionName, scaleLength, shownLength, Trail } from "./trail.js";

type MapInfo = NonNullable<RobotInfo["maps"]>[number];
type Pose = NonNullable<Seen["poses"]>[number][number];

/** The unit of the drawing. */
const MM = 1_000;
/** The greatest height of a map on the page, in pixels. */
const HEIGHT_MAX = 460;
/** Parts of the map's larger side: a robot is drawn no smaller, and points of its path are no closer. */
const BODY_MIN = 1 / 70;
const STEP = 1 / 400;
/** The scale's most, as a part of the map's width. */
const SCALE_MAX = 0.3;
/** How often what a screen reader would say is written. */
const NAME_EVERY_MS = 1_000;

/** The map that a robot drives on, from above. */
class RobotMap {
    readonly element: HTMLElement;
    readonly name: string;
    readonly #info: MapInfo;
    readonly #drawing: SVGElement;
    readonly #robot: SVGElement;
    readonly #trail: Trail;
    readonly #pieces = shape("g", { class: "live-trail" });
    readonly #told = make("p", { class: "live-told", hidden: true });
    #pose: Pose | null = null;
    #hasMoved = false;
    #named_ms = -Infinity;

    constructor(info: MapInfo, isOnly: boolean) {
        this.#info = info;
        this.name = info.name;
        const [width, height] = info.size.map((metres) => metres * MM) as [number, number];
        const larger = Math.max(width, height);
        this.#trail = new Trail(larger * STEP);
        this.#robot = robotShape(Math.max(info.body * MM, larger * BODY_MIN));
        this.#drawing = shape(
            "svg",
            { viewBox: `0 0 ${width} ${height}`, role: "img" },
            ...info.strokes.map(strokeShape),
            this.#pieces,
            this.#robot,
        );
        this.element = make("figure", { class: "live-map" }, this.#drawing, this.#legend(), this.#told);
        if (!isOnly) this.element.prepend(make("figcaption", {}, info.name));
        // As high as it may be at most, with its own proportions.
        this.element.style.maxWidth = `${Math.round((HEIGHT_MAX * width) / height)}px`;
        this.#writeName();
    }

    /** A scale, and what the colours stand for. */
    #legend(): HTMLElement {
        const [width] = this.#info.size;
        const metres = scaleLength(width * SCALE_MAX);
        const bar = make("span", { class: "live-scale", "aria-hidden": "true" });
        bar.style.width = `${(metres / width) * 100}%`;
        const length = make("span", { class: "live-length", "aria-hidden": "true" }, shownLength(metres));
        return make("div", { class: "live-legend" }, bar, length, key(this.#info));
    }

    take(poses: readonly Pose[]): void {
        for (const pose of poses) {
            this.#hasMoved = true;
            this.#pose = pose;
            this.#trail.push(pose[0] * MM, -pose[1] * MM);
        }
    }

    draw(): void {
        if (!this.#hasMoved || this.#pose === null) return;
        this.#hasMoved = false;
        const [x, y, look_x, look_y] = this.#pose;
        const degrees = (Math.atan2(-look_y, look_x) * 180) / Math.PI;
        mark(this.#robot, "transform", `translate(${(x * MM).toFixed(1)} ${(-y * MM).toFixed(1)}) rotate(${degrees.toFixed(1)})`);
        const { pieces } = this.#trail;
        while (this.#pieces.childElementCount < pieces.length) this.#pieces.append(shape("path"));
        for (const [index, piece] of pieces.entries()) {
            const path = this.#pieces.children[index] as Element;
            mark(path, "d", piece.path);
            mark(path, "opacity", this.#trail.opacity(index).toFixed(2));
        }
    }

    update(figures: readonly string[]): void {
        const text = figures.join("\n");
        write(this.#told, text);
        this.#told.hidden = text === "";
        if (performance.now() - this.#named_ms >= NAME_EVERY_MS) this.#writeName();
    }

    #writeName(): void {
        this.#named_ms = performance.now();
        const { name, size, strokes } = this.#info;
        const walls = strokes.some((one) => one.is_wall) ? " with walls" : "";
        const parts = [`Map${walls}, ${size.map(shownLength).join(" by ")}, seen from above.`];
        if (this.#pose !== null) {
            const [x, y, look_x, look_y] = this.#pose;
            parts.push(`${name} is ${x.toFixed(2)} m from the left and ${(-y).toFixed(2)} m from the top, and faces ${directionName(look_x, look_y)}.`);
        }
        const told = this.#told.textContent;
        if (told) parts.push(`${told}.`);
        mark(this.#drawing, "aria-label", parts.join(" "));
    }
}

/** A robot at the origin that looks to the right. */
function robotShape(radius: number): SVGElement {
    const [back, nose, side] = [0.3, 0.86, 0.45].map((part) => (radius * part).toFixed(1));
    return shape(
        "g",
        { class: "live-robot" },
        shape("circle", { r: radius.toFixed(1) }),
        shape("path", { d: `M${nose} 0L-${back} ${side}L-${back} -${side}Z` }),
    );
}

function strokeShape({ pieces, width, is_wall }: MapInfo["strokes"][number]): SVGElement {
    let path = "";
    let last = "";
    for (const [from_x, from_y, to_x, to_y] of pieces) {
        const [from, to] = [placed(from_x, from_y), placed(to_x, to_y)];
        path += `${from === last ? "" : `M${from}`}L${to}`;
        last = to;
    }
    return shape("path", { class: is_wall ? "live-wall" : "live-line", d: path, "stroke-width": (width * MM).toFixed(1) });
}

function placed(x: number, y: number): string {
    return `${(x * MM).toFixed(1)} ${(-y * MM).toFixed(1)}`;
}

/** What the colours stand for. */
function key({ strokes }: MapInfo): HTMLElement {
    const kinds: [string, string, boolean][] = [
        ["line", "line", strokes.some((one) => !one.is_wall)],
        ["wall", "wall", strokes.some((one) => one.is_wall)],
        ["trail", "path of the robot", true],
    ];
    const items = kinds.filter(([, , isThere]) => isThere).map(([kind, text]) =>
        make("li", {}, make("span", { class: "live-swatch", "data-kind": kind, "aria-hidden": "true" }), text),
    );
    return make("ul", { class: "live-key" }, ...items);
}

/** All maps of a world, and what its robots have come to so far. */
export class RobotMaps {
    readonly element: HTMLElement;
    /** What is told of robots that have no map; hidden while there is none. */
    readonly others = make("p", { class: "live-told" });
    readonly #maps: RobotMap[];
    #figures: readonly string[] = [];

    constructor(info: RobotInfo) {
        const maps = info.maps ?? [];
        this.#maps = maps.map((one) => new RobotMap(one, maps.length === 1));
        this.element = make("div", { class: "live-maps" }, ...this.#maps.map((one) => one.element));
    }

    get isEmpty(): boolean {
        return this.#maps.length === 0;
    }

    /** Whether there are figures of robots without a map. */
    get hasOthers(): boolean {
        return this.others.textContent !== "";
    }

    take({ poses, figures }: Seen): void {
        for (const [index, of] of (poses ?? []).entries()) this.#maps[index]?.take(of);
        if (figures !== undefined) this.#figures = figures;
    }

    /** Draws what has changed. */
    draw(): void {
        for (const map of this.#maps) map.draw();
    }

    /** Writes what people read. */
    update(): void {
        const left = new Set(this.#figures);
        for (const map of this.#maps) {
            const own = this.#figures.filter((one) => one.startsWith(`${map.name}: `));
            for (const one of own) left.delete(one);
            map.update(own);
        }
        write(this.others, [...left].join("\n"));
    }
}
