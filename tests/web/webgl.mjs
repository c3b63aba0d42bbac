// node webgl.mjs WEB VECTORS CHROMIUM: the WebGL renderer of <ray-space> in headless Chromium, with its software driver. WEB
// is the build folder of compositor/web. Exits with 77 where Chromium cannot be started or has no WebGL 2.
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join } from "node:path";
import assert from "node:assert/strict";

const [web, vectors, chromium] = process.argv.slice(2);
const require = createRequire(join(web, "package.json"));
const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
args.push("--enable-precise-memory-info", "--js-flags=--expose-gc");
let browser;
try {
  browser = await require("playwright-core").chromium.launch({ executablePath: chromium, args });
} catch (error) {
  console.log(`SKIPPED: Chromium cannot be started: ${error.message}`);
  process.exit(77);
}

const types = { html: "text/html", js: "text/javascript", mjs: "text/javascript", json: "application/json", wasm: "application/wasm" };
const roots = { "/web/": web, "/vectors/": vectors };
const server = createServer((request, response) => {
  const root = Object.keys(roots).find((path) => request.url.startsWith(path));
  const name = request.url.split(".").pop();
  const body = root ? readFileSync(join(roots[root], request.url.slice(root.length))) : '<!doctype html><script src="/web/ray-space.js"></script>';
  response.writeHead(200, { "content-type": types[root ? name : "html"] ?? "application/octet-stream" }).end(body);
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const address = `http://127.0.0.1:${server.address().port}/`;

async function open(options = {}) {
  const context = await browser.newContext({ viewport: { width: 400, height: 300 }, reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  page.problems = [];
  page.warnings = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("console", (message) => {
    if (!message.text().startsWith("Canvas2D: ")) page.warnings.push(message.text());
  });
  await page.goto(address);
  await page.evaluate(defineHelpers);
  return page;
}

// Resident memory of the browser's processes in bytes; undefined where it cannot be read.
async function residentBytes() {
  if (!existsSync("/proc/self/statm")) return undefined;
  const devtools = await browser.newBrowserCDPSession();
  const { processInfo } = await devtools.send("SystemInfo.getProcessInfo");
  await devtools.detach();
  return processInfo.reduce((sum, { id }) => sum + 4096 * Number(readFileSync(`/proc/${id}/statm`, "utf8").split(" ")[1]), 0);
}

// In the page.
function defineHelpers() {
  // Appends an element, and waits for its first view.
  window.show = (attributes) =>
    new Promise((resolve, reject) => {
      const element = document.createElement("ray-space");
      element.style = "width: 160px; height: 120px";
      element.addEventListener("load", () => resolve(element), { once: true });
      element.addEventListener("error", (event) => reject(new Error(event.detail.message)), { once: true });
      const all = { src: "/vectors/shape-sharp.rso", core: "/web/core/rayspace_core.wasm", loading: "eager", ...attributes };
      for (const [name, value] of Object.entries(all)) element.setAttribute(name, value);
      document.body.append(element);
    });
  // The element itself renders until a moment after its load.
  window.showAtRest = async (attributes) => {
    const element = await show(attributes);
    await new Promise((resolve) => setTimeout(resolve, 500));
    return element;
  };
  // Chromium's first reading of a canvas rounds translucent pixels otherwise than later ones.
  window.pixels = ({ canvas }) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  // Renders a view by WebGL once its photos are uploaded; an upload for other views may be under way and comes first.
  // \return name of the renderer that has drawn it
  window.draw = async (renderer, width, height, view) => {
    await renderer.render(width, height, view);
    for (let n = 0; n < 3 && renderer.drawnBy !== "webgl"; ++n) {
      await renderer.settled?.();
      await renderer.render(width, height, view);
    }
    return renderer.drawnBy;
  };
}

const tests = {
  // Integer framebuffers: colours and depths.
  async rendersTheConformanceVectors() {
    const page = await open();
    const { views, wrong } = await page.evaluate(async () => {
      const { Core } = await import("/web/core.mjs");
      const { GlDevice, GlObject } = await import("/web/gl_device.mjs");
      const bytes = async (path) => (await fetch(path)).arrayBuffer();
      const core = await Core.create(await bytes("/web/core/rayspace_core.wasm"));
      const device = GlDevice.acquire(true);
      const { cases } = await (await fetch("/vectors/vectors.json")).json();
      let views = 0;
      const wrong = [];
      for (const each of cases) {
        core.open(new Uint8Array(await bytes(`/vectors/${each.object}`)), each.object);
        const object = GlObject.create(device, core.textures(device.maxSide, device.maxLayers));
        for (const [index, view] of each.views.entries()) {
          const { width, height, ring, filter, b, s, planes } = view.registers;
          const numbers = planes.flatMap((plane) => [plane.a, plane.c, ...plane.n, ...plane.t]);
          const inputs = core.prepareRegisters([width, height, ring, filter, b, ...s, ...numbers]);
          for (const photo of object.missing(inputs.photos)) object.upload(photo, core.photo(photo));
          device.draw(object, inputs, { withDepth: true });
          const { rgba, depth } = device.read(width, height);
          ++views;
          if (core.hash(rgba) !== view.rgba) wrong.push(`${each.name}, view ${index}: rgba`);
          if (core.hash(new Uint8Array(depth.buffer)) !== view.depth) wrong.push(`${each.name}, view ${index}: depth`);
        }
        object.delete();
      }
      device.release();
      return { views, wrong };
    });
    assert.deepEqual(wrong, []);
    assert.ok(views > 200, `${views} views`);
  },

  // All bytes of the canvas, also of translucent pixels; level, tilted and steep views, at three pixel ratios.
  async showsTheCanvasOfTheCore() {
    for (const deviceScaleFactor of [1, 2, 3]) {
      const page = await open({ deviceScaleFactor });
      const results = await page.evaluate(async () => {
        const webgl = await showAtRest({ renderer: "webgl" });
        const core = await showAtRest({ renderer: "core" });
        const { radius } = webgl.getCameraOrbit();
        const results = [];
        const { width, height } = webgl.viewRenderer.canvas;
        for (const [azimuth, elevation, zoom] of [[0, 0, 1], [0.7, 0, 0.6], [2, 0.2, 1], [4, -0.3, 0.8], [1, 1.35, 1.2]]) {
          const view = { azimuth, elevation, distance: zoom * radius };
          const drawnBy = await draw(webgl.viewRenderer, width, height, view);
          await core.viewRenderer.render(width, height, view);
          const [found, expected] = [pixels(webgl.viewRenderer), pixels(core.viewRenderer)];
          const translucent = expected.filter((a, i) => i % 4 === 3 && a > 0 && a < 255).length;
          results.push({ elevation, drawnBy, translucent, wrong: found.filter((value, i) => value !== expected[i]).length });
        }
        return { width, height, results };
      });
      const ratio = Math.min(deviceScaleFactor, 2);
      assert.deepEqual([results.width, results.height], [160 * ratio, 120 * ratio]);
      let translucentPixels = 0;
      for (const { elevation, drawnBy, translucent, wrong } of results.results) {
        assert.equal(drawnBy, "webgl", `elevation ${elevation}`);
        assert.equal(wrong, 0, `elevation ${elevation}`);
        translucentPixels += translucent;
      }
      assert.ok(translucentPixels > 100, `${translucentPixels} translucent pixels`);
      assert.deepEqual([...page.problems, ...page.warnings], []);
      await page.context().close();
    }
  },

  // Views between two rings, level and tilted, are mixed by the shader as by the core.
  async mixesTwoRings() {
    const page = await open();
    const results = await page.evaluate(async () => {
      const src = "/vectors/two-rings.rso";
      const webgl = await showAtRest({ renderer: "webgl", src });
      const core = await showAtRest({ renderer: "core", src });
      const { radius } = webgl.getCameraOrbit();
      const { width, height } = webgl.viewRenderer.canvas;
      const { Core } = await import("/web/core.mjs");
      const bytes = async (path) => (await fetch(path)).arrayBuffer();
      const described = (await Core.create(await bytes("/web/core/rayspace_core.wasm"))).open(new Uint8Array(await bytes(src)), src);
      const elevations = described.rings.map(({ elevation }) => elevation);
      const [low, high] = [Math.min(...elevations), Math.max(...elevations)];
      const results = [];
      for (const part of [0, 0.25, 0.45, 0.8]) {
        const view = { azimuth: 0.7, elevation: low + part * (high - low), distance: radius };
        const { weight } = await webgl.viewRenderer.prepare(width, height, view);
        const drawnBy = await draw(webgl.viewRenderer, width, height, view);
        await core.viewRenderer.render(width, height, view);
        const [found, expected] = [pixels(webgl.viewRenderer), pixels(core.viewRenderer)];
        results.push({ part, weight, drawnBy, wrong: found.filter((value, i) => value !== expected[i]).length });
      }
      return results;
    });
    for (const { part, weight, drawnBy, wrong } of results) {
      assert.equal(weight > 0, part > 0, `${part}: weight ${weight}`);
      assert.equal(drawnBy, "webgl", `${part}`);
      assert.equal(wrong, 0, `${part}`);
    }
  },

  async survivesTheLossOfItsContext() {
    const page = await open();
    const drawn = await page.evaluate(async () => {
      const element = await showAtRest({ renderer: "webgl" });
      const { viewRenderer } = element;
      const view = { azimuth: 0.5, elevation: 0.1, distance: element.getCameraOrbit().radius };
      const drawn = [await draw(viewRenderer, 160, 120, view)];
      pixels(viewRenderer);
      const expected = pixels(viewRenderer);
      const isSame = () => pixels(viewRenderer).every((value, i) => value === expected[i]);
      const loss = viewRenderer.device.gl.getExtension("WEBGL_lose_context");
      for (let n = 0; n < 2; ++n) {
        loss.loseContext();
        drawn.push(isSame());
        await viewRenderer.render(160, 120, view);
        drawn.push(viewRenderer.drawnBy, isSame());
        await new Promise((resolve) => setTimeout(resolve, 50));
        drawn.push(await draw(viewRenderer, 160, 120, view), isSame());
        loss.restoreContext();
        await new Promise((resolve) => setTimeout(resolve, 50));
        drawn.push(await draw(viewRenderer, 160, 120, view), isSame());
      }
      return drawn;
    });
    const round = [true, "core", true, "core", true, "webgl", true];
    assert.deepEqual(drawn, ["webgl", ...round, ...round]);
  },

  async photosBesideAViewAreUploadedAtRest() {
    const page = await open();
    const drawn = await page.evaluate(async () => {
      const element = await showAtRest({ renderer: "webgl" });
      const { viewRenderer } = element;
      const drawnAt = async (azimuth) => {
        await viewRenderer.render(160, 120, { azimuth, elevation: 0, distance: element.getCameraOrbit().radius });
        return viewRenderer.drawnBy;
      };
      await drawnAt(2);
      await new Promise((resolve) => setTimeout(resolve, 1500));
      return [await drawnAt(2.5), await drawnAt(1.5), await drawnAt(2 + Math.PI)];
    });
    assert.deepEqual(drawn, ["webgl", "webgl", "core"]);
  },

  // The driver of this test is software, so that `auto` takes the core.
  async theAttributeChoosesTheRenderer() {
    const page = await open();
    const chosen = await page.evaluate(async () => {
      const chosen = [];
      for (const renderer of ["auto", "core", "webgl", "fast"]) {
        const element = await showAtRest({ renderer });
        const view = { azimuth: 0.5, elevation: 0, distance: element.getCameraOrbit().radius };
        chosen.push(await draw(element.viewRenderer, 160, 120, view));
      }
      return chosen;
    });
    assert.deepEqual(chosen, ["core", "core", "webgl", "core"]);
    assert.deepEqual(page.warnings, ['ray-space: renderer "fast" is unknown; write auto, webgl or core']);
    const fallback = await page.evaluate(async () => {
      HTMLCanvasElement.prototype.getContext = ((original) => function (kind, ...rest) {
        return kind === "webgl2" ? null : original.call(this, kind, ...rest);
      })(HTMLCanvasElement.prototype.getContext);
      document.querySelectorAll("ray-space").forEach((element) => element.remove());
      const element = await showAtRest({ renderer: "webgl" });
      return element.viewRenderer.drawnBy;
    });
    assert.equal(fallback, "core");
    assert.match(page.warnings.at(-1), /no WebGL 2; the core renders instead/);
  },

  // Objects beyond the limits, or of browsers whose WebGL fails.
  async fallsBackToTheCore() {
    for (const [obstacle, reason] of [
      ["GlDevice", /webgl": .*the number of photos \d+ exceeds the driver's limit of 3/],
      ["budget", /webgl": the object needs \d+ MiB of textures/],
      ["linkProgram", /webgl": the browser does not compile the shaders/],
      ["checkFramebufferStatus", /webgl": WebGL does not render integers/],
    ]) {
      const page = await open();
      const drawn = await page.evaluate(async (obstacle) => {
        if (obstacle === "linkProgram") WebGL2RenderingContext.prototype.linkProgram = () => {};
        if (obstacle === "checkFramebufferStatus") WebGL2RenderingContext.prototype.checkFramebufferStatus = () => 0;
        const first = await show({ renderer: "webgl", style: "display: none" });
        const { device } = first.viewRenderer;
        if (obstacle === "GlDevice") device.maxLayers = 3;
        if (obstacle === "budget") device.constructor.budget_bytes = 1000;
        const element = await showAtRest({ renderer: "webgl" });
        const view = { azimuth: 0.5, elevation: 0, distance: 3 };
        const drawnBy = [];
        for (let n = 0; n < 3; ++n) drawnBy.push(await draw(element.viewRenderer, 160, 120, view));
        return [...drawnBy, pixels(element.viewRenderer).some((value) => value > 0)];
      }, obstacle);
      assert.deepEqual(drawn, ["core", "core", "core", true], obstacle);
      assert.ok(page.warnings.some((warning) => reason.test(warning)), `${obstacle}: ${page.warnings}`);
      await page.context().close();
    }
  },

  // Objects that are not drawn for a while give their textures to others.
  async texturesStayWithinTheBudget() {
    const page = await open();
    const drawn = await page.evaluate(async () => {
      const elements = [await showAtRest({ renderer: "webgl" }), await showAtRest({ renderer: "webgl" })];
      const [first, second] = elements.map(({ viewRenderer }) => viewRenderer);
      const view = { azimuth: 0.5, elevation: 0, distance: 3 };
      await new Promise((resolve) => setTimeout(resolve, 2500));
      const { device } = first;
      device.objects.forEach((_, object) => object.delete());
      await draw(first, 160, 120, view);
      device.constructor.budget_bytes = 1.5 * [...device.objects.values()][0].bytes;
      const drawn = [await draw(first, 160, 120, view), await draw(second, 160, 120, view)];
      await new Promise((resolve) => setTimeout(resolve, 2500));
      drawn.push(await draw(second, 160, 120, view), device.objects.size, await draw(first, 160, 120, view));
      return drawn;
    });
    assert.deepEqual(drawn, ["webgl", "core", "webgl", 1, "core"]);
  },

  // All share one context. After removal it is lost, workers end, and memory returns to its baseline.
  async fiftyElementsShareAContext() {
    const page = await open();
    const round = () =>
      page.evaluate(async () => {
        const elements = [];
        for (let n = 0; n < 50; ++n) elements.push(await show({ renderer: "webgl", style: "width: 32px; height: 24px" }));
        const drawn = [];
        const images = new Set();
        for (const [n, { viewRenderer }] of elements.entries()) {
          drawn.push(await draw(viewRenderer, 64, 48, { azimuth: 0.1 * n, elevation: 0, distance: 3 }));
          images.add(viewRenderer.canvas.toDataURL());
        }
        const devices = new Set(elements.map((element) => element.viewRenderer.device));
        const [device] = devices;
        const isAlive = !device.isLost;
        window.shown = elements;
        return { drawn: drawn.filter((name) => name === "webgl").length, images: images.size, devices: devices.size, isAlive };
      });
    const remove = () =>
      page.evaluate(async () => {
        const { device } = window.shown[0].viewRenderer;
        for (const element of window.shown) element.remove();
        window.shown = undefined;
        for (let n = 0; n < 3; ++n) {
          await new Promise((resolve) => setTimeout(resolve, 300));
          gc();
        }
        return { isLost: device.isLost, heap: performance.memory.usedJSHeapSize };
      });
    await round(); // scripts are compiled, caches are filled
    const before = { ...(await remove()), resident: await residentBytes() };
    const shown = await round();
    const most = await residentBytes();
    const after = { ...(await remove()), resident: await residentBytes() };
    assert.deepEqual(shown, { drawn: 50, images: 50, devices: 1, isAlive: true });
    assert.ok(after.isLost, "the context is freed");
    const mebibytes = (bytes) => (bytes / 2 ** 20).toFixed(1);
    const [heap, resident] = ["heap", "resident"].map((kind) => [before, after].map((found) => mebibytes(found[kind])).join(" to "));
    console.log(`        heap: ${heap} MiB; resident: ${resident} MiB, with the elements ${mebibytes(most)}`);
    assert.ok(after.heap < 1.25 * before.heap, "the heap returns to its baseline");
    if (most !== undefined) assert.ok(after.resident < 1.15 * before.resident, "processes return to their baseline");
    assert.deepEqual([...page.problems, ...page.warnings], []);
  },
};

let failed = 0;
const page = await open();
if (await page.evaluate(() => !document.createElement("canvas").getContext("webgl2"))) {
  console.log("SKIPPED: Chromium has no WebGL 2");
  process.exit(77);
}
for (const [name, test] of Object.entries(tests)) {
  if (process.argv[5] && process.argv[5] !== name) continue;
  try {
    await test();
    console.log(`passed  ${name}`);
  } catch (error) {
    ++failed;
    console.error(`FAILED  ${name}: ${error.stack}`);
  }
  for (const context of browser.contexts()) await context.close();
}
await browser.close();
server.close();
process.exit(failed === 0 ? 0 : 1);
