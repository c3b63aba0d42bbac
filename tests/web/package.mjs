// node package.mjs WEB OBJECT CHROMIUM: packs the npm package, installs it into an application, checks its types, bundles it and
// opens it in headless Chromium. WEB is the build folder of compositor/web. Exits with 77 where Chromium cannot be started.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { launch, open, run, serve } from "./chromium.mjs";

const [web, object, chromium] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "rayspace-npm-"));
const installed = join(folder, "node_modules/rayspace-viewer");
const tool = (name, ...words) => execFileSync(join(web, "node_modules/.bin", name), words, { cwd: folder, encoding: "utf8" });
const browser = await launch(web, chromium);

const page_of = (script) => `<!DOCTYPE html><title>Test</title><body><script type="module" src="${script}"></script>
  <ray-space src="thing.rso" alt="Thing" camera-controls></ray-space></body>`;
async function loads(files, name) {
  const server = await serve(files);
  const page = await open(browser, `${server.address}${name}`);
  await page.waitForFunction(() => document.querySelector("ray-space").loaded, { timeout: 60000 });
  assert.deepEqual(page.problems, []);
  server.close();
  return { page, requests: server.requests };
}
const thing = readFileSync(object);

const tests = {
  async containsWhatItStates() {
    const packed = execFileSync("npm", ["pack", "--silent", "--offline", "--pack-destination", folder], { cwd: join(web, "npm"), encoding: "utf8" }).trim();
    mkdirSync(installed, { recursive: true });
    execFileSync("tar", ["-xzf", join(folder, packed), "-C", installed, "--strip-components=1"]);
    const listed = execFileSync("tar", ["-tzf", join(folder, packed)], { encoding: "utf8" });
    for (const file of ["package.json", "README.md", "ray-space.js", "ray-space.wasm", "types/ray_space.d.ts"]) {
      assert.ok(listed.split("\n").includes(`package/${file}`), file);
    }
    const { dependencies, version } = JSON.parse(readFileSync(join(installed, "package.json"), "utf8"));
    assert.equal(dependencies, undefined);
    assert.match(version, /^\d+[.]\d+[.]\d+$/);
  },

  async hasTypes() {
    writeFileSync(join(folder, "right.ts"), `
      import type { RaySpaceElement } from "rayspace-viewer";
      import "rayspace-viewer";
      const element: RaySpaceElement = document.querySelector("ray-space")!;
      element.updateHotspot({ name: "hotspot-1", position: "0 0 1" });
      const theta: number = element.getCameraOrbit().theta;
      console.log(theta);`);
    writeFileSync(join(folder, "wrong.ts"), `import "rayspace-viewer";\ndocument.querySelector("ray-space")!.updateHotspot({ name: 1 });`);
    const options = ["--noEmit", "--strict", "--target", "es2022", "--module", "es2022", "--moduleResolution", "bundler", "--lib", "es2023,dom,dom.iterable", "--types", ""];
    tool("tsc", ...options, "right.ts");
    assert.throws(() => tool("tsc", ...options, "wrong.ts"), (error) => /not assignable to type 'string'/.test(error.stdout));
  },

  async worksInABundle() {
    writeFileSync(join(folder, "app.js"), `import "rayspace-viewer";\nwindow.bundled = true;`);
    tool("esbuild", "app.js", "--bundle", "--minify", "--format=esm", "--log-level=warning", "--outfile=bundle.js");
    copyFileSync(join(installed, "ray-space.wasm"), join(folder, "ray-space.wasm"));
    const files = { "/assets/bundle.js": readFileSync(join(folder, "bundle.js")), "/assets/ray-space.wasm": readFileSync(join(folder, "ray-space.wasm")) };
    const { page, requests } = await loads({ ...files, "/thing.rso": thing, "/app.html": page_of("assets/bundle.js") }, "/app.html");
    assert.equal(await page.evaluate(() => window.bundled), true);
    assert.ok(requests.includes("/assets/ray-space.wasm"), "the module is found beside the bundle");
    assert.equal(page.workers().length, 1);
  },

  async worksWithoutABundler() {
    const files = { "/lib/ray-space.js": readFileSync(join(installed, "ray-space.js")), "/lib/ray-space.wasm": readFileSync(join(installed, "ray-space.wasm")) };
    assert.match(files["/lib/ray-space.js"].toString(), /new URL\("[.]\/ray-space[.]wasm",import[.]meta[.]url\)/, "the form that bundlers find");
    await loads({ ...files, "/thing.rso": thing, "/app.html": page_of("lib/ray-space.js") }, "/app.html");
  },
};

await run(tests, async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});
