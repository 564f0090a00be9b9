/** The values of one device, the oldest of which make room for new ones. */

/** How far back one can scroll. */
export const HISTORY_MS = 600_000;
/** What all devices of a board may hold. */
const ALL_BYTES = 64 << 20;
const FIRST_POINTS = 1 << 10;
/** For devices that report when they like. */
const USUAL_CYCLE_MS = 10;
/** Devices report a little more often than they say. */
const MARGIN = 1.1;

/** A ring of times and numbers, which grows up to its capacity. */
export class History {
    #times: Float64Array;
    #values: Float64Array;
    #first = 0;
    #length = 0;

    constructor(
        readonly elements: number,
        readonly capacity: number,
    ) {
        const points = Math.min(FIRST_POINTS, capacity);
        this.#times = new Float64Array(points);
        this.#values = new Float64Array(points * elements);
    }

    get length(): number {
        return this.#length;
    }

    /** Adds numbers at a time that is not before the last one. Numbers that are none leave a gap. */
    push(time_ms: number, numbers: ArrayLike<number | null>): void {
        if (this.#length === this.#times.length) this.#makeRoom();
        const at = this.#place(this.#length);
        this.#times[at] = time_ms;
        for (let element = 0; element < this.elements; element += 1) {
            this.#values[at * this.elements + element] = numbers[element] ?? NaN;
        }
        this.#length += 1;
        while (this.#length > 0 && this.time(0) < time_ms - HISTORY_MS) this.#drop();
    }

    /** The time of the point at an index, from the oldest on. */
    time(index: number): number {
        return this.#times[this.#place(index)] ?? NaN;
    }

    /** An element of the point at an index; NaN if it had none. */
    value(index: number, element: number): number {
        return this.#values[this.#place(index) * this.elements + element] ?? NaN;
    }

    /** The index of the first point that is not before a time. */
    from(time_ms: number): number {
        let low = 0;
        let high = this.#length;
        while (low < high) {
            const middle = (low + high) >> 1;
            if (this.time(middle) < time_ms) low = middle + 1;
            else high = middle;
        }
        return low;
    }

    #place(index: number): number {
        const at = this.#first + index;
        const size = this.#times.length;
        return at < size ? at : at - size;
    }

    #drop(): void {
        this.#first = this.#place(1);
        this.#length -= 1;
    }

    #makeRoom(): void {
        const size = this.#times.length;
        const wanted = Math.min(size * 2, this.capacity);
        if (wanted === size) return this.#drop();
        const times = new Float64Array(wanted);
        const values = new Float64Array(wanted * this.elements);
        const rest = size - this.#first;
        times.set(this.#times.subarray(this.#first));
        times.set(this.#times.subarray(0, this.#first), rest);
        values.set(this.#values.subarray(this.#first * this.elements));
        values.set(this.#values.subarray(0, this.#first * this.elements), rest * this.elements);
        this.#times = times;
        this.#values = values;
        this.#first = 0;
    }
}

/** Histories of ten minutes for all devices, or of less where they would need too much memory. */
export function histories(devices: readonly { elements: number; cycle_ms: number | null }[]): History[] {
    const wanted = devices.map((one) => Math.ceil((HISTORY_MS / (one.cycle_ms || USUAL_CYCLE_MS)) * MARGIN));
    const bytes = devices.reduce((sum, one, index) => sum + (wanted[index] ?? 0) * 8 * (1 + one.elements), 0);
    const part = Math.min(1, ALL_BYTES / Math.max(bytes, 1));
    return devices.map((one, index) => {
        const points = Math.max(16, Math.floor((wanted[index] ?? 0) * part));
        return new History(one.elements, points);
    });
}
