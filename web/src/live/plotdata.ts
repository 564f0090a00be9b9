import type { History } from "./history.js";

/** A part of the run. */
export interface Span {
    from_ms: number;
    to_ms: number;
}

/** A number; null where the line is broken, undefined where there is nothing to draw. */
export type Plotted = number | null | undefined;

/** A line is broken where so many cycles, and at least so much time, have brought no value. */
const BREAK_CYCLES = 5;
const BREAK_MS = 1_500;

/** A column's extremes in the order in which they came, and its last value. */
const SLOTS = 3;

/**
 * The columns of a plot, each of which has the time between two pixels. They begin at multiples of their width, so that
 * a plot that moves on does not flicker.
 */
export class Columns {
    readonly #width_ms: number;
    readonly #first: number;
    readonly #count: number;
    readonly #to_ms: number;

    constructor(span: Span, pixels: number) {
        this.#width_ms = (span.to_ms - span.from_ms) / Math.max(1, pixels);
        this.#first = Math.floor(span.from_ms / this.#width_ms) - 1;
        this.#count = Math.max(1, pixels) + 3;
        this.#to_ms = span.to_ms;
    }

    /** The times of all slots, in seconds. */
    times_s(): number[] {
        const middle = this.#width_ms / SLOTS / 2;
        return Array.from({ length: this.#count * SLOTS }, (_, slot) => (this.#start_ms(slot / SLOTS) + middle) / 1_000);
    }

    #start_ms(column: number): number {
        return (this.#first + column) * this.#width_ms;
    }

    #column(time_ms: number): number {
        const column = Math.floor(time_ms / this.#width_ms) - this.#first;
        return Math.min(Math.max(column, 0), this.#count - 1);
    }

    /** What is measured: a line from value to value, broken where values are missing. No peak is lost. */
    measured(history: History, element: number, cycle_ms: number | null): Plotted[] {
        const slots = new Array<Plotted>(this.#count * SLOTS).fill(undefined);
        const break_ms = cycle_ms === null ? Infinity : Math.max(BREAK_MS, BREAK_CYCLES * cycle_ms);
        const begin = history.from(this.#start_ms(0));
        if (begin > 0 && begin < history.length && history.time(begin) - history.time(begin - 1) <= break_ms) {
            slots[0] = between(history, element, begin, this.#start_ms(0));
        }
        this.#fill(slots, history, element, break_ms);
        return slots;
    }

    /** What is set: it holds until it is set again. */
    held(history: History, element: number): Plotted[] {
        const slots = new Array<Plotted>(this.#count * SLOTS).fill(undefined);
        const begin = history.from(this.#start_ms(0));
        if (begin > 0) slots[0] = history.value(begin - 1, element);
        const end = this.#fill(slots, history, element, Infinity);
        if (end > 0) slots[this.#column(this.#to_ms) * SLOTS + SLOTS - 1] = history.value(end - 1, element);
        return slots;
    }

    /** Puts all values into their columns; the index of the first one after them. */
    #fill(slots: Plotted[], history: History, element: number, break_ms: number): number {
        const end_ms = this.#start_ms(this.#count);
        let last_ms = Infinity;
        let last = 0;
        let index = history.from(this.#start_ms(0));
        for (; index < history.length; index += 1) {
            const time_ms = history.time(index);
            if (time_ms >= end_ms) break;
            const column = this.#column(time_ms);
            const value = history.value(index, element);
            if (time_ms - last_ms > break_ms && column > last + 1) slots[column * SLOTS - 1] = null;
            if (Number.isNaN(value)) slots[column * SLOTS] ??= null;
            else add(slots, column * SLOTS, value);
            last_ms = time_ms;
            last = column;
        }
        return index;
    }
}

/** The value on the line between a point and the one before it. */
function between(history: History, element: number, index: number, time_ms: number): number {
    const [before_ms, after_ms] = [history.time(index - 1), history.time(index)];
    const [before, after] = [history.value(index - 1, element), history.value(index, element)];
    const value = before + ((after - before) * (time_ms - before_ms)) / (after_ms - before_ms);
    return Number.isFinite(value) ? value : after;
}

/** Puts another value into a column. */
function add(slots: Plotted[], at: number, value: number): void {
    const first = slots[at];
    const second = slots[at + 1];
    if (first == null) slots[at] = value;
    else if (second == null) slots[at + 1] = value;
    else {
        const [least, most] = [Math.min(first, second), Math.max(first, second)];
        // An extreme that comes now comes after the other one.
        if (value > most) [slots[at], slots[at + 1]] = [least, value];
        if (value < least) [slots[at], slots[at + 1]] = [most, value];
        slots[at + 2] = value;
    }
}

/** What a plot shows of an element, in numbers. */
export interface Summary {
    count: number;
    first: number;
    least: number;
    mean: number;
    most: number;
    last: number;
}

/** The numbers of an element in a part of the run. */
export function summary(history: History, element: number, span: Span): Summary {
    const found = { count: 0, first: NaN, least: Infinity, mean: NaN, most: -Infinity, last: NaN };
    let sum = 0;
    for (let index = history.from(span.from_ms); index < history.length && history.time(index) <= span.to_ms; index += 1) {
        const value = history.value(index, element);
        if (Number.isNaN(value)) continue;
        if (found.count === 0) found.first = value;
        found.count += 1;
        found.least = Math.min(found.least, value);
        found.most = Math.max(found.most, value);
        found.last = value;
        sum += value;
    }
    if (found.count > 0) found.mean = sum / found.count;
    return found;
}
