// What of a text counts: without comments and strings.

/** The text with comments and strings blanked, so that braces and names in them do not count; all else stays in its place. */
export function blanked(text: string): string {
    return text.replace(/\/\/[^\n]*|\/\*[\s\S]*?(?:\*\/|$)|"(?:[^"\\\n]|\\.)*"?/g, (found) => found.replace(/[^\n]/g, " "));
}
