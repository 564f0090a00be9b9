// What the module that is named says to a list of [function, text] on the standard input, as a list of texts. How long it
// took goes to the standard error.
import { readFileSync } from "node:fs";
import { load } from "../../../crates/wasm/sensedsl.mjs";

const { raw } = await load(readFileSync(process.argv[2]));
const requests = JSON.parse(readFileSync(0, "utf8"));
const start = performance.now();
const answers = requests.map(([name, text]) => raw[name](text));
const each = (performance.now() - start) / requests.length;
console.error(`${requests.length} requests, ${each.toFixed(1)} ms each`);
process.stdout.write(JSON.stringify(answers));
