// What needs no page: where parts go in a text, addresses with projects, snippets, archives.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, test } from "node:test";
import { build, stop } from "esbuild";
import { load } from "../../crates/wasm/sensedsl.mjs";
import { example, root, site } from "./site.mjs";

// Else its process is waited for.
after(stop);

/** A module of the studio, as Node takes it. */
async function module(path) {
    const { outputFiles } = await build({ entryPoints: [`${root}/web/src/${path}`], bundle: true, write: false, format: "esm", platform: "node", logLevel: "error" });
    return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}

const SNIPPET = "sensor ${1:Warm} returns int16 {\n    id = 1;\n    driver = lm75;\n}";

test("a part goes into the board of the cursor, with a name and an identifier of its own", async () => {
    const { insertion } = await module("panels/insert.ts");
    const put = (text, at) => {
        const { from, insert, select } = insertion(text, at, SNIPPET);
        return { text: text.slice(0, from) + insert + text.slice(from), name: insert.slice(select.from, select.to) };
    };
    const empty = put("board B on X {\n}\n", 0);
    assert.equal(empty.text, "board B on X {\n    sensor Warm returns int16 {\n        id = 1;\n        driver = lm75;\n    }\n}\n");
    assert.equal(empty.name, "Warm");
    const fig2 = example("fig2");
    const inside = put(fig2, fig2.indexOf("type = i2c"));
    assert.match(inside.text, /prio = \+2;\n {4}\}\n {4}sensor Warm returns int16 \{\n {8}id = 1;/);
    const again = put(inside.text, 0);
    assert.equal(again.name, "Warm2");
    assert.match(again.text, /Warm2 returns int16 \{\n {8}id = 2;/);
    const second = put("board A on X {\n}\nboard B on X { // }\n}\n", 20);
    assert.match(second.text, /board B on X \{ \/\/ \}\n {4}sensor Warm/);
    assert.match(put("", 0).text, /^board Robot on STM32F4DiscoveryBoard \{\n {4}sensor Warm/);
});

test("a board takes the place of the one that is named, or is named now", async () => {
    const { boardChange } = await module("panels/insert.ts");
    const changed = (text, at = 0) => {
        const { from, to, insert } = boardChange(text, at, "Y");
        return text.slice(0, from) + insert + text.slice(to);
    };
    assert.equal(changed("board B on X {\n}\n"), "board B on Y {\n}\n");
    assert.equal(changed('board B on "x.csv" {\n}\n'), "board B on Y {\n}\n");
    assert.equal(changed("board STM32F4DiscoveryBoard {\n}\n"), "board STM32F4DiscoveryBoard on Y {\n}\n");
    assert.equal(changed("board A on X {\n}\nboard B on X {\n}\n", 20), "board A on X {\n}\nboard B on Y {\n}\n");
});

test("an address has the project, and nothing else is taken for one", async () => {
    const { fragmentOf, projectOf } = await module("project/share.ts");
    const project = { files: { "a.sense": example("rover"), "t.csv": "Pin,ä→✓\n" }, open: "a.sense" };
    const fragment = fragmentOf(project);
    assert.match(fragment, /^#p=[A-Za-z0-9_-]+$/);
    assert.deepEqual(projectOf(fragment), project);
    assert.equal(projectOf("#else"), null);
    assert.throws(() => projectOf(fragment.slice(0, -20)));
    assert.throws(() => projectOf("#p=%"));
    // What unpacks to very much is refused.
    const bomb = fragmentOf({ files: { "a.sense": " ".repeat(5_000_000) }, open: "a.sense" });
    assert.throws(() => projectOf(bomb));
});

test("every word of the language has its colour, and is a name elsewhere", async () => {
    const { sensedsl } = await module("language/highlight.ts");
    const { parser } = sensedsl().language;
    const coloured = (text, name) => {
        const words = [];
        parser.parse(text).iterate({ enter: (node) => { if (node.name === name) words.push(text.slice(node.from, node.to)); } });
        return words;
    };
    const query = readFileSync(`${root}/editors/tree-sitter-sensedsl/queries/highlights.scm`, "utf8");
    const words = query.match(/\[([^\]]*)\] @keyword/)[1].match(/[a-z]+/g);
    assert.ok(words.length > 40, `${words.length} words`);
    const all = readFileSync(`${root}/tests/editors/every_word.sense`, "utf8");
    assert.deepEqual([...new Set(coloured(all, "keyword"))].sort(), words.sort());
    const some = "test at { at = to; always A == B and C.overruns in 1 m .. N; } board B { controller when every 5 ms { reads = [at, of]; } }";
    assert.deepEqual(coloured(some, "keyword"), ["test", "always", "and", "in", "board", "controller", "every"]);
    assert.deepEqual(coloured(some, "propertyName"), ["at", "reads"]);
    assert.deepEqual(coloured(some, "variableName.definition"), ["at", "B", "when"]);
    assert.deepEqual(coloured("at 1 s set for = 5; at /* = */ A set B = at;", "keyword"), ["at", "set", "at", "set"]);
});

test("the design is the open file, or the one that uses it", async () => {
    const { designOf } = await module("studio.ts");
    const texts = { "a.sense": 'use "legs.sense";\nboard B on X {}', "legs.sense": "sensor L returns uint8 {}", "b.sense": "board C on X {}", "t.csv": "" };
    assert.equal(designOf(texts, "legs.sense"), "a.sense");
    assert.equal(designOf(texts, "b.sense"), "b.sense");
    assert.equal(designOf(texts, "t.csv"), "a.sense");
    assert.equal(designOf({ "x.sense": "" }, "x.sense"), "x.sense");
});

test("the smallest change is made", async () => {
    const { difference } = await module("language/places.ts");
    assert.deepEqual(difference("abcd", "abXcd"), { from: 2, to: 2, insert: "X" });
    assert.deepEqual(difference("aaa", "aa"), { from: 2, to: 3, insert: "" });
    assert.deepEqual(difference("", "a"), { from: 0, to: 0, insert: "a" });
});

test("an archive has the same bytes whenever and wherever it is made", async () => {
    const { zipped } = await module("project/zip.ts");
    const one = zipped({ "b/x": "1", a: "2" });
    assert.deepEqual(one, zipped({ a: "2", "b/x": "1" }));
});

test("paths stay below the project", async () => {
    const { wrongPath } = await module("project/filebar.ts");
    for (const path of ["../a.sense", "/a.sense", "a//b.sense", "a/../b.sense", ".a.sense", "a b.sense", "a"]) assert.notEqual(wrongPath(path, []), null, path);
    for (const path of ["a.sense", "parts/legs-2.sense", "t.csv"]) assert.equal(wrongPath(path, []), null, path);
    assert.notEqual(wrongPath("a.sense", ["a.sense"]), null);
});

test("a drawing is taken with the world that names it, and no other one", async () => {
    const { readFiles } = await module("project/filebar.ts");
    const file = (name, text) => new File([text], name);
    const svg = "<svg xmlns='http://www.w3.org/2000/svg'/>";
    const world = 'map = "oval.svg"\n';
    const both = await readFiles([file("oval.svg", svg), file("logo.svg", svg), file("oval.toml", world), file("photo.png", new Uint8Array([0x89, 0, 1]))], {});
    assert.deepEqual(both, { texts: { "oval.svg": svg, "oval.toml": world }, refused: ["photo.png"], unnamed: ["logo.svg"] });
    // A world that is in the project already counts, a design does not.
    assert.deepEqual(Object.keys((await readFiles([file("oval.svg", svg)], { "w/oval.toml": world })).texts), ["oval.svg"]);
    assert.deepEqual((await readFiles([file("oval.svg", svg)], { "robot.sense": world })).unnamed, ["oval.svg"]);
    const large = await readFiles([file("oval.svg", "x".repeat(1_000_001)), file("oval.toml", world)], {});
    assert.deepEqual(large.refused, ["oval.svg"]);
});

test("without the texts of projects the tool answers the same, and with them a project is whole", async () => {
    const module = await WebAssembly.compile(readFileSync(`${site}/sensedsl.wasm`));
    const [lean, full] = [await load(module), await load(module)];
    full.fill(new Uint8Array(readFileSync(`${site}/texts.bin`)));
    const named = ["fig2", "rover", "line_follower"].map((name) => [name, example(name)]);
    const asked = named.flatMap(([name, text]) => ["chibios", "embassy"].map((target) => [name, text, target]));
    const uno = "board ARDUINO_UNO_R3 { sensor Light returns uint16 { type = analog; } }";
    for (const [name, text, target] of [...asked, ["Uno", uno, "arduino"]]) {
        const request = { path: "a.sense", files: { "a.sense": text }, target };
        assert.deepEqual(lean(request), full(request), `${name} ${target}`);
        const [without, whole] = [lean.project(request), full.project(request)].map(({ files }) => Object.values(files ?? {}));
        const hasHole = (text) => text.includes("\0".repeat(100));
        assert.ok(without.some(hasHole), `${name} ${target}: nothing was taken out`);
        assert.ok(!whole.some(hasHole), `${name} ${target}: something is missing`);
    }
});
