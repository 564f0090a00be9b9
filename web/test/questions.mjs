// Questions of newcomers, and whether the site's search answers them: each page of `tests/site/questions.csv` must be among
// the first hits for its words. The words are looked up as the page itself does it, with mdBook's own index and settings.
//
//     node test/questions.mjs

import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import vm from "node:vm";
import { root } from "./site.mjs";

const FIRST = 5;

/** A table with commas; a cell in quotes may have commas and, doubled, quotes. */
export function table(text) {
    const rows = text.trim().split("\n").map((line) => [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map(([, quoted, plain]) => (quoted === undefined ? plain : quoted.replaceAll('""', '"')).trim()));
    const [head, ...body] = rows;
    return body.map((row) => Object.fromEntries(head.map((name, at) => [name, row[at] ?? ""])));
}

/** A function from words to the pages that the search of a site finds, best first. */
export function search(site) {
    const names = readdirSync(site);
    const script = (start) => readFileSync(join(site, names.find((name) => name.startsWith(start) && name.endsWith(".js"))), "utf8");
    const window = { search: {} };
    const context = vm.createContext({ window });
    vm.runInContext(script("elasticlunr-"), context);
    vm.runInContext(script("searchindex-"), context);
    const { index, search_options, doc_urls } = window.search;
    const loaded = context.elasticlunr.Index.load(index);
    return (words) => loaded.search(words, search_options).map(({ ref }) => doc_urls[ref]);
}

/** What is wrong with the answers to the questions; nothing if all are found. */
export function unanswered(site, text) {
    const find = search(site);
    const rows = table(text);
    if (rows.length === 0) throw new Error("there are no questions");
    return rows.flatMap(({ question, "search words": words, "expected page": page }) => {
        const hits = find(words).slice(0, FIRST);
        return hits.some((hit) => hit.split("#")[0] === page) ? [] : [`${question} (${words}): ${page} is not among ${hits.join(", ") || "no hits"}`];
    });
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? "").href) {
    const text = readFileSync(join(root, "tests/site/questions.csv"), "utf8");
    const wrong = unanswered(process.env.SENSEDSL_SITE ?? join(root, "target/site"), text);
    console.log(wrong.length === 0 ? `the search answers all ${table(text).length} questions` : wrong.join("\n"));
    process.exitCode = wrong.length === 0 ? 0 : 1;
}
