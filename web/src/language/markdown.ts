// What the language server says in Markdown, as elements. It has paragraphs, lists, code, tables and emphasis.

import { el } from "../ui/dom";

/** The elements of a text in Markdown. */
export function markdown(text: string): HTMLElement {
    const made = el("div", { class: "markdown" });
    const lines = text.split("\n");
    while (lines.length > 0) {
        const line = lines[0] ?? "";
        if (line.startsWith("```")) made.append(code(lines));
        else if (/^\s*[-*] /.test(line)) made.append(list(lines));
        else if (line.startsWith("|")) made.append(table(lines));
        else if (/^#+ /.test(line)) made.append(el("h4", {}, ...inline(lines.shift()?.replace(/^#+ /, "") ?? "")));
        else if (/^(---|\*\*\*)\s*$/.test(line)) {
            lines.shift();
            made.append(el("hr"));
        } else if (line.trim() === "") lines.shift();
        else made.append(paragraph(lines));
    }
    return made;
}

function code(lines: string[]): HTMLElement {
    lines.shift();
    const end = lines.findIndex((line) => line.startsWith("```"));
    const inside = lines.splice(0, end < 0 ? lines.length : end);
    lines.shift();
    return el("pre", {}, el("code", {}, inside.join("\n")));
}

function list(lines: string[]): HTMLElement {
    const made = el("ul");
    while (/^\s*[-*] /.test(lines[0] ?? "")) made.append(el("li", {}, ...inline(lines.shift()?.replace(/^\s*[-*] /, "") ?? "")));
    return made;
}

function table(lines: string[]): HTMLElement {
    const rows: string[][] = [];
    while (lines[0]?.startsWith("|")) {
        const cells = (lines.shift() ?? "").replace(/^\||\|\s*$/g, "").split("|");
        if (!cells.every((cell) => /^\s*:?-+:?\s*$/.test(cell))) rows.push(cells.map((cell) => cell.trim()));
    }
    const [head = [], ...body] = rows;
    const row = (name: "th" | "td", cells: string[]) => el("tr", {}, ...cells.map((cell) => el(name, {}, ...inline(cell))));
    return el("table", {}, el("thead", {}, row("th", head)), el("tbody", {}, ...body.map((cells) => row("td", cells))));
}

function paragraph(lines: string[]): HTMLElement {
    const inside: string[] = [];
    while (lines[0]?.trim() && !/^(```|\||#+ |\s*[-*] )/.test(lines[0])) inside.push(lines.shift() ?? "");
    if (inside.length === 0) inside.push(lines.shift() ?? "");
    return el("p", {}, ...inline(inside.join("\n")));
}

/** Code, strong and emphasised words and links of a line. */
export function inline(text: string): (Node | string)[] {
    const made: (Node | string)[] = [];
    const marks = /`([^`]+)`|\*\*([^*]+)\*\*|\*([^*\s][^*]*)\*|\[([^\]]+)\]\(([^)\s]+)\)/g;
    let at = 0;
    for (const found of text.matchAll(marks)) {
        made.push(text.slice(at, found.index));
        const [whole, code, strong, emphasis, link, to] = found;
        if (code !== undefined) made.push(el("code", {}, code));
        else if (strong !== undefined) made.push(el("strong", {}, ...inline(strong)));
        else if (emphasis !== undefined) made.push(el("em", {}, emphasis));
        else if (/^https?:/.test(to ?? "")) made.push(el("a", { href: to, target: "_blank", rel: "noreferrer" }, link ?? ""));
        else made.push(link ?? "");
        at = found.index + whole.length;
    }
    made.push(text.slice(at));
    return made;
}
