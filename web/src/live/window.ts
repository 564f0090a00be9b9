import type { Span } from "./plotdata.js";
import { HISTORY_MS } from "./history.js";

const LEAST_MS = 200;
const USUAL_MS = 30_000;
/** How much less or more time the next zoom shows. */
const ZOOM = 2;
/** How far one scrolls, as a part of what is shown. */
const SCROLL = 0.5;

/** Which part of a run the plots show: what comes now, or a part that is held. */
export class Window {
    #span_ms = USUAL_MS;
    /** None while it goes with the time. */
    #end_ms: number | null = null;

    /** How much time is shown. */
    get span_ms(): number {
        return this.#span_ms;
    }

    /** Whether it stays while values come. */
    get isHeld(): boolean {
        return this.#end_ms !== null;
    }

    /** What is shown at a time. */
    span(now_ms: number): Span {
        // In the beginning the plot fills from the left.
        const to_ms = Math.max(this.#end_ms ?? now_ms, this.#span_ms);
        return { from_ms: to_ms - this.#span_ms, to_ms };
    }

    hold(now_ms: number): void {
        this.#end_ms ??= now_ms;
    }

    release(): void {
        this.#end_ms = null;
    }

    /** Shows less or more time, around the middle of what is held, or up to what comes now. */
    zoom(isIn: boolean): void {
        const before_ms = this.#span_ms;
        this.#setSpan(isIn ? before_ms / ZOOM : before_ms * ZOOM);
        if (this.#end_ms !== null) this.#end_ms += (this.#span_ms - before_ms) / 2;
    }

    setSpan(span_ms: number): void {
        this.#setSpan(span_ms);
    }

    /** Shows exactly a part. */
    show(span: Span): void {
        const middle_ms = (span.from_ms + span.to_ms) / 2;
        this.#setSpan(span.to_ms - span.from_ms);
        this.#end_ms = middle_ms + this.#span_ms / 2;
    }

    /** Shows what came earlier or later; at the end it goes with the time again. */
    scroll(isEarlier: boolean, now_ms: number): void {
        const step_ms = this.#span_ms * SCROLL;
        this.showUntil((this.#end_ms ?? now_ms) + (isEarlier ? -step_ms : step_ms), now_ms);
    }

    /** Shows what came before a time, but nothing that is older than what is kept. */
    showUntil(end_ms: number, now_ms: number): void {
        const oldest_ms = Math.max(0, now_ms - HISTORY_MS);
        const least_ms = Math.min(oldest_ms + this.#span_ms, now_ms);
        this.#end_ms = end_ms >= now_ms ? null : Math.max(end_ms, least_ms);
    }

    #setSpan(span_ms: number): void {
        this.#span_ms = Math.min(Math.max(span_ms, LEAST_MS), HISTORY_MS);
    }
}
