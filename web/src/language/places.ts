// Places: those of the language server, in lines and columns, and those of the editor, in characters from the start.

import type { ChangeSpec, Text } from "@codemirror/state";
import type { Position, Range, TextEdit } from "../talk";

/** Where a position is in a text; the nearest place if the text has changed since. */
export function offsetOf(text: Text, { line, character }: Position): number {
    if (line >= text.lines) return text.length;
    const of = text.line(line + 1);
    return Math.min(of.to, of.from + character);
}

/** The position of an offset. */
export function positionOf(text: Text, offset: number): Position {
    const line = text.lineAt(offset);
    return { line: line.number - 1, character: offset - line.from };
}

/** A range in characters from the start. */
export function spanOf(text: Text, { start, end }: Range): { from: number; to: number } {
    return { from: offsetOf(text, start), to: offsetOf(text, end) };
}

/** A range in lines and columns. */
export function rangeOf(text: Text, from: number, to: number): Range {
    return { start: positionOf(text, from), end: positionOf(text, to) };
}

/** Edits as the editor makes them. */
export function changesOf(text: Text, edits: TextEdit[]): ChangeSpec[] {
    return edits.map(({ range, newText }) => ({ ...spanOf(text, range), insert: newText }));
}

/** The smallest change from one text to another. */
export function difference(old: string, next: string): { from: number; to: number; insert: string } {
    let from = 0;
    while (from < old.length && from < next.length && old[from] === next[from]) from += 1;
    let same = 0;
    const most = Math.min(old.length, next.length) - from;
    while (same < most && old[old.length - 1 - same] === next[next.length - 1 - same]) same += 1;
    return { from, to: old.length - same, insert: next.slice(from, next.length - same) };
}
