// Reads what `sensedsl` prints for people: what is wrong, and where.

export interface Place {
    severity: string;
    code: string;
    /** Everything that was said of it. */
    text: string;
    /** Where it is; from 1. Not all has a place. */
    file?: string;
    line?: number;
    column?: number;
}

const HEAD = /^(error|warning|hint)\[([EWH]\d{4})\]: /;
const AT = /^ *--> (.+?):(\d+):(\d+)$/;

/** The diagnostics in an output, in its order. */
export function placesOf(output: string): Place[] {
    const found: Place[] = [];
    for (const line of output.split(/\r?\n/)) {
        const head = HEAD.exec(line);
        if (head) {
            found.push({ severity: head[1] ?? "", code: head[2] ?? "", text: line });
            continue;
        }
        const last = found.at(-1);
        if (!last) continue;
        const at = AT.exec(line);
        if (at && last.file === undefined) {
            last.file = at[1];
            last.line = Number(at[2]);
            last.column = Number(at[3]);
        }
        last.text += `\n${line}`;
    }
    return found.map((one) => ({ ...one, text: one.text.trimEnd() }));
}
