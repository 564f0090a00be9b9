// Colours of the text, word by word: at once, before the language server has read it.

import { HighlightStyle, LanguageSupport, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

const KEYWORDS = new Set([
    "use", "const", "board", "on", "spare", "sensor", "actuator", "returns", "accepts", "chip", "driver", "connection",
    "reading", "command", "for", "reserve", "release", "allow", "link", "prefer", "avoid", "raw", "controller", "every", "test",
]);
/** Words that begin a step of a test, at the beginning of a statement alone. */
const STEPS = new Set(["at", "fault", "always", "never", "eventually", "when"]);
/** Words that join the pieces of a step, which are names elsewhere. */
const JOINTS = new Set(["and", "or", "not", "in", "then", "within", "from", "to", "for", "at", "of", "set"]);
const DECLARING = new Set([
    "board", "chip", "driver", "connection", "sensor", "actuator", "reading", "command", "const", "controller", "test",
]);
const TYPED = new Set(["returns", "accepts", "for"]);
const UNITS = /^(m\/s\^2|deg\/s|mm\/s|cm\/s|m\/s|kOhm|degC|kHz|MHz|Ohm|deg|rpm|us|ms|Hz|mV|mm|cm|mA|s|V|m|A|W|%)(?![A-Za-z0-9_])/;
const NUMBER = /^(0[xX][0-9A-Fa-f_]+|0[bB][01_]+|[0-9][0-9_]*(\.[0-9][0-9_]*)?([eE][+-]?[0-9][0-9_]*)?)/;

interface State {
    isComment: boolean;
    /** How many blocks are open. */
    depth: number;
    /** What a name would be now. */
    next: "declared" | "type" | "board" | "unit" | null;
    /** Where a statement is: before its first word, in a step of a test, in something else. */
    place: "start" | "step" | "other";
}

const language = StreamLanguage.define<State>({
    name: "sensedsl",
    startState: () => ({ isComment: false, depth: 0, next: null, place: "start" }),
    languageData: {
        commentTokens: { line: "//", block: { open: "/*", close: "*/" } },
        closeBrackets: { brackets: ["{", "[", "(", '"'] },
        indentOnInput: /^\s*\}$/,
    },
    indent: ({ depth }, textAfter, { unit }) => Math.max(0, depth - (/^\s*\}/.test(textAfter) ? 1 : 0)) * unit,
    token: (stream, state) => {
        if (state.isComment) {
            if (stream.skipTo("*/")) {
                stream.match("*/");
                state.isComment = false;
            } else stream.skipToEnd();
            return "comment";
        }
        if (stream.eatSpace()) return null;
        if (stream.match("//")) {
            stream.skipToEnd();
            return "comment";
        }
        if (stream.match("/*")) {
            state.isComment = true;
            return "comment";
        }
        const { next, place } = state;
        state.next = null;
        if (place === "start") state.place = "other";
        if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return "string";
        if (next === "unit" && stream.match(UNITS)) return "unit";
        if (stream.match(NUMBER)) {
            state.next = "unit";
            return "number";
        }
        const word = stream.match(/^[A-Za-z_][A-Za-z0-9_]*/);
        if (word) return named(state, { next, place }, stream.current(), Boolean(stream.match(/^\s*=(?!=)/, false)));
        const sign = stream.next();
        if (sign === "{" || sign === "}" || sign === ";") state.place = "start";
        if (sign === "{") state.depth += 1;
        if (sign === "}") state.depth = Math.max(0, state.depth - 1);
        return null;
    },
    tokenTable: { unit: tags.unit },
});

function named(state: State, before: Pick<State, "next" | "place">, word: string, isAssigned: boolean): string {
    const { next, place } = before;
    if (next === "declared") return "variableName.definition";
    if (place === "step") {
        // A value comes after `set NAME =`.
        if (isAssigned) state.place = "other";
        return !isAssigned && (JOINTS.has(word) || word === "raw") ? "keyword" : "variableName";
    }
    if (isAssigned) return "propertyName";
    if (next === "type" || next === "board") return "typeName";
    if (place === "start" && STEPS.has(word)) {
        state.place = "step";
        return "keyword";
    }
    if (!KEYWORDS.has(word)) return "variableName";
    if (DECLARING.has(word)) state.next = "declared";
    else if (TYPED.has(word)) state.next = "type";
    else if (word === "on") state.next = "board";
    return "keyword";
}

const style = HighlightStyle.define([
    { tag: tags.keyword, color: "var(--code-keyword)", fontWeight: "600" },
    { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
    { tag: tags.string, color: "var(--code-string)" },
    { tag: [tags.number, tags.unit], color: "var(--code-number)" },
    { tag: tags.propertyName, color: "var(--code-property)" },
    { tag: tags.typeName, color: "var(--code-type)" },
    { tag: tags.definition(tags.variableName), color: "var(--code-name)", fontWeight: "600" },
]);

/** The language, with its colours. */
export function sensedsl(): LanguageSupport {
    return new LanguageSupport(language, syntaxHighlighting(style));
}
