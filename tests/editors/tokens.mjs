// Texts in, their colours out, by the engine of VS Code: reads a JSON list of texts, and prints for each a list of
// [from, to, scopes], with offsets in UTF-16 units. The argument is the grammar's file.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import oniguruma from 'vscode-oniguruma';
import textmate from 'vscode-textmate';

const wasm = createRequire(import.meta.url).resolve('vscode-oniguruma/release/onig.wasm');
await oniguruma.loadWASM(readFileSync(wasm));
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => textmate.parseRawGrammar(readFileSync(process.argv[2], 'utf8'), 'grammar.json'),
});
const grammar = await registry.loadGrammar('source.sensedsl');

const answers = JSON.parse(readFileSync(0, 'utf8')).map((text) => {
  const colours = [];
  let state = textmate.INITIAL;
  let start = 0;
  for (const line of text.split('\n')) {
    const result = grammar.tokenizeLine(line, state);
    for (const { startIndex, endIndex, scopes } of result.tokens) {
      colours.push([start + startIndex, start + Math.min(endIndex, line.length), scopes.slice(1)]);
    }
    state = result.ruleStack;
    start += line.length + 1;
  }
  return colours;
});
process.stdout.write(JSON.stringify(answers));
