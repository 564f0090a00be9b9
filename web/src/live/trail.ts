/** Where a robot has been: the newest part of its path, in bounded memory, as paths of a drawing that fade with their age. */

/** Points of a piece, and how many pieces there are; the oldest one makes room. */
const PIECE_POINTS = 100;
const PIECES_MAX = 24;
/** The oldest piece is still to be seen. */
const OPACITY_MIN = 0.2;

/** A piece of the path. */
export interface Piece {
    /** As the `d` of a path. */
    path: string;
    points: number;
}

/** The path of a robot. Points that are closer than a distance are one. */
export class Trail {
    /** The oldest first. */
    readonly pieces: Piece[] = [];
    #last: readonly [number, number] | null = null;

    constructor(readonly distance: number) {}

    /** Adds a point; whether there is anything new to draw. */
    push(x: number, y: number): boolean {
        const last = this.#last;
        if (!Number.isFinite(x + y)) return false;
        if (last !== null && Math.hypot(x - last[0], y - last[1]) < this.distance) return false;
        this.#last = [x, y];
        const piece = this.pieces.at(-1);
        if (piece !== undefined && piece.points < PIECE_POINTS) {
            piece.path += `L${short(x)} ${short(y)}`;
            piece.points += 1;
            return true;
        }
        // A piece begins where the one before it ends.
        const [from_x, from_y] = last ?? [x, y];
        this.pieces.push({ path: `M${short(from_x)} ${short(from_y)}L${short(x)} ${short(y)}`, points: 1 });
        if (this.pieces.length > PIECES_MAX) this.pieces.shift();
        return true;
    }

    /** How much of a piece is seen, by how many are newer. */
    opacity(index: number): number {
        const newer = this.pieces.length - 1 - index;
        return 1 - ((1 - OPACITY_MIN) * newer) / (PIECES_MAX - 1);
    }
}

function short(number: number): string {
    return `${Math.round(number * 10) / 10}`;
}

/** A length for a scale: 1, 2 or 5 times a power of ten metres, at most so many metres. */
export function scaleLength(most: number): number {
    const power = 10 ** Math.floor(Math.log10(most));
    const factor = [5, 2].find((one) => one * power <= most) ?? 1;
    return factor * power;
}

/** A length for people. */
export function shownLength(metres: number): string {
    if (metres >= 1) return `${Number(metres.toPrecision(3))} m`;
    if (metres >= 0.01) return `${Number((metres * 100).toPrecision(3))} cm`;
    return `${Number((metres * 1_000).toPrecision(3))} mm`;
}

const DIRECTIONS = ["right", "up and right", "up", "up and left", "left", "down and left", "down", "down and right"];

/** A direction in words; y goes upwards. */
export function directionName(x: number, y: number): string {
    const eighth = Math.round(Math.atan2(y, x) / (Math.PI / 4));
    return DIRECTIONS[(eighth + 8) % 8] ?? "";
}
