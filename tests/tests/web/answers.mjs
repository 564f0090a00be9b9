// The answers of the module that is named to a list of requests on the standard input, as a list. How long
// they took goes to the standard error.
import { readFileSync } from "node:fs";
import { load } from "../../../crates/wasm/sensedsl.mjs";

const ask = await load(readFileSync(process.argv[2]));
const requests = JSON.parse(readFileSync(0, "utf8"));
const start = performance.now();
const answers = requests.map(ask.text);
const each = (performance.now() - start) / requests.length;
console.error(`${requests.length} requests, ${each.toFixed(1)} ms each`);
process.stdout.write(JSON.stringify(answers));
