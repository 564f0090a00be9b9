import type { Seen } from "../../../crates/wasm/sensedsl.mjs";

/** What was seen first and what was seen after it, as one. */
export function merged(first: Seen | null, second: Seen): Seen {
    if (first === null) return second;
    for (const value of second.values) first.values.push(value);
    for (const note of second.notes) first.notes.push(note);
    first.now_ms = second.now_ms;
    first.state = second.state;
    first.counts = second.counts;
    first.health = second.health ?? first.health;
    if (second.outputs !== undefined) first.outputs = second.outputs;
    if (second.figures !== undefined) first.figures = second.figures;
    first.poses = concatenated(first.poses, second.poses);
    return first;
}

/** Where robots were, one list after the other on each map. */
function concatenated(first: Seen["poses"], second: Seen["poses"]): Seen["poses"] {
    if (first === undefined || second === undefined) return second ?? first;
    return second.map((poses, map) => [...(first[map] ?? []), ...poses]);
}
