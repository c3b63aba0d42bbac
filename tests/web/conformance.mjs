// node conformance.mjs CORE.mjs CORE.wasm VECTORS: compares the WebAssembly core with the conformance vectors
// (engine/conformance/PROTOCOL.md). The core renders all of them.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [script, module, folder] = process.argv.slice(2);
const { Core } = await import(pathToFileURL(script));
const core = await Core.create(readFileSync(module));
const { cases } = JSON.parse(readFileSync(`${folder}/vectors.json`));

function registersOf(view) {
  const planes = view.planes.flatMap((plane) => [plane.a, plane.c, ...plane.n, ...plane.t]);
  return [view.width, view.height, view.ring, view.filter, view.b, ...view.s, ...planes];
}

let views = 0;
let wrong = 0;
for (const each of cases) {
  core.open(readFileSync(`${folder}/${each.object}`), each.object);
  for (const [index, view] of each.views.entries()) {
    const found = core.hashesOf(registersOf(view.registers));
    ++views;
    for (const kind of ["rgba", "depth"]) {
      const expected = view[kind];
      if (found[kind] === expected) continue;
      ++wrong;
      console.error(`${each.name}, view ${index}: ${kind} hashes to ${found[kind]} instead of ${expected}`);
    }
  }
}
console.log(`${views} views of ${cases.length} cases, ${wrong} differences`);
process.exit(views > 0 && wrong === 0 ? 0 : 1);
