// node streaming.mjs WEB TOOLS RECIPE CHROMIUM [OBJECT]: loads an object from servers with and without ranges, slow and
// failing ones, in headless Chromium. WEB is the build folder of compositor/web, TOOLS that of the programs. The object
// is made from RECIPE unless OBJECT is given. Exits with 77 where Chromium cannot be started.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";

const [web, tools, recipe, chromium, given] = process.argv.slice(2);
const { Core } = await import(pathToFileURL(join(web, "core.mjs")));
const kFirst_bytes = 16 * 1024; // of the first request (object_stream.ts)
const kMostBefore_bytes = 300 * 1024; // before the first image

let browser;
try {
  const { chromium: launcher } = createRequire(join(web, "package.json"))("playwright-core");
  browser = await launcher.launch({ executablePath: chromium, args: ["--no-sandbox"] });
} catch (error) {
  console.log(`SKIPPED: Chromium cannot be started: ${error.message}`);
  process.exit(77);
}

function makeObject() {
  if (given) return readFileSync(given);
  const folder = mkdtempSync(join(tmpdir(), "rayspace-streaming-"));
  try {
    const set = join(folder, "set");
    execFileSync(join(tools, "rs-capture"), ["synth", recipe, "-q", "-o", set, "--views", "24", "--size", "160x160", "--spp", "1"]);
    execFileSync(join(tools, "rs-encode"), ["build", set, "-q", "-o", join(folder, "vase.rso"), "--effort", "1", "--quality", "95"]);
    return readFileSync(join(folder, "vase.rso"));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

// Chunks of an .rso file (encode/FORMAT.md, "Table").
function chunksOf(file) {
  return Array.from({ length: file.readUInt32LE(12) }, (_, i) => {
    const at = 48 + 32 * i;
    const begin = Number(file.readBigUInt64LE(at + 8));
    return { name: file.toString("latin1", at, at + 4), index: file.readUInt32LE(at + 4), begin, size: Number(file.readBigUInt64LE(at + 16)) };
  });
}

const file = makeObject();
const chunks = chunksOf(file);
const chunk = (name, index) => chunks.find((each) => each.name === name && each.index === index);

function damaged({ begin, size }) {
  const bad = Buffer.from(file);
  bad[begin + (size >> 1)] ^= 1;
  return bad;
}

// A server for one object: `file`, `ranges`, `etag`; `onrequest({ begin, end, count })` returns what happens to an
// answer: { pause_ms: after each 16 KiB, cut: bytes after which the connection is lost, hang: no answer }.
async function serve(options = {}) {
  const state = { file, ranges: true, etag: '"1"', headers: {}, onrequest: () => ({}), log: [], ...options };
  const server = createServer(async (request, response) => {
    const path = request.url.split("?")[0];
    if (path === "/") return response.writeHead(200, { "content-type": "text/html" }).end("<!DOCTYPE html><title>t</title><main></main>");
    if (path === "/ray-space.js") return response.writeHead(200, { "content-type": "text/javascript" }).end(readFileSync(join(web, "ray-space.js")));
    if (path === "/ray-space.wasm") return response.writeHead(200, { "content-type": "application/wasm" }).end(readFileSync(join(web, "core/rayspace_core.wasm")));
    if (path !== "/object.rso") return response.writeHead(404).end();
    const range = state.ranges && /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? "");
    const begin = range ? Number(range[1]) : 0;
    const end = range ? Math.min(Number(range[2]) + 1, state.file.length) : state.file.length;
    const event = { begin, end, count: state.log.length, range: Boolean(range) };
    state.log.push(event);
    if (range && begin >= state.file.length) return response.writeHead(416).end();
    const { pause_ms = 0, cut = Infinity, hang = false } = state.onrequest(event);
    if (hang) return;
    const ifRange = request.headers["if-range"];
    const whole = !range || (ifRange && ifRange !== state.etag);
    const headers = { "cache-control": "no-cache", ...(state.etag && { etag: state.etag }), ...state.headers };
    const body = whole ? state.file : state.file.subarray(begin, end);
    if (!state.chunked) headers["content-length"] = body.length;
    if (!whole) headers["content-range"] = `bytes ${begin}-${end - 1}/${state.file.length}`;
    response.writeHead(whole ? 200 : 206, headers);
    const wait = (time_ms) => new Promise((resolve) => setTimeout(resolve, time_ms));
    for (let at = 0; at < Math.min(body.length, cut) && !response.destroyed; at += kFirst_bytes) {
      response.write(body.subarray(at, Math.min(at + kFirst_bytes, cut)));
      if (pause_ms) await wait(pause_ms);
    }
    if (body.length <= cut) return response.end();
    await wait(200); // what was written arrives
    response.destroy();
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  state.address = `http://127.0.0.1:${server.address().port}/`;
  state.close = () => {
    server.closeAllConnections();
    server.close();
  };
  return state;
}

// Opens a page with the element; `ended` are its events.
async function open(server, src = "object.rso", orbit = "auto auto auto") {
  const context = await browser.newContext({ viewport: { width: 320, height: 280 }, reducedMotion: "reduce" });
  const page = await context.newPage();
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  await page.goto(server.address);
  await page.evaluate(
    ([src, orbit]) => {
      window.ended = [];
      const element = document.createElement("ray-space");
      element.style.cssText = "width: 300px; height: 260px";
      element.setAttribute("camera-controls", "");
      element.setAttribute("camera-orbit", orbit);
      for (const type of ["poster-dismissed", "load", "error"]) element.addEventListener(type, () => window.ended.push(type));
      element.setAttribute("src", src);
      const script = document.createElement("script");
      script.src = "ray-space.js";
      document.head.append(script);
      document.querySelector("main").append(element);
    },
    [src, orbit],
  );
  return page;
}

const happened = (page, type) => page.waitForFunction((type) => window.ended.includes(type), type, { timeout: 60000 });
const messageOf = (page) =>
  page.evaluate(() => document.querySelector("ray-space").shadowRoot.querySelector("[part=message]").textContent);
const hasView = (page) => page.evaluate(() => Boolean(document.querySelector("ray-space").shadowRoot.querySelector("canvas:not([part])")));

const core = await Core.create(readFileSync(join(web, "core/rayspace_core.wasm")));
core.open(file, "object");

// The view on screen is that of the whole object. A 2D canvas keeps opaque pixels exactly.
async function assertFinalView(page) {
  const shown = await page.evaluate(() => {
    const element = document.querySelector("ray-space");
    const { canvas } = element.viewRenderer;
    const { width, height } = canvas;
    const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
    const { theta, phi, radius } = element.getCameraOrbit();
    let text = ""; // as numbers, the pixels would take a minute to Playwright
    for (let at = 0; at < data.length; at += 8192) text += String.fromCharCode(...data.subarray(at, at + 8192));
    return { width, height, text: btoa(text), theta, phi, radius };
  });
  const pixels = Buffer.from(shown.text, "base64");
  const view = { azimuth: shown.theta, elevation: Math.PI / 2 - shown.phi, distance: shown.radius };
  const expected = core.render(shown.width, shown.height, view);
  let opaque = 0;
  let different = 0;
  for (let i = 0; i < expected.length; i += 4) {
    const isOpaque = expected[i + 3] === 255;
    opaque += isOpaque;
    different += pixels[i + 3] !== expected[i + 3] || (isOpaque && pixels.readUIntLE(i, 3) !== (expected[i] | (expected[i + 1] << 8) | (expected[i + 2] << 16)));
  }
  assert.equal(different, 0);
  assert.ok(opaque > 1000, `${opaque} opaque pixels`);
  assert.deepEqual(page.problems, []);
}

async function assertLoads(server, src, orbit) {
  const page = await open(server, src, orbit);
  await happened(page, "load");
  assert.deepEqual(await page.evaluate(() => window.ended), ["poster-dismissed", "load"]);
  await assertFinalView(page);
  await page.context().close();
}

// The load fails with a message; a view stays, or there is none.
async function assertFails(server, message, staysVisible) {
  const page = await open(server);
  await happened(page, "error");
  const named = await messageOf(page);
  assert.match(named, message);
  assert.ok(named.startsWith("object.rso: ") && !named.includes("\n"), named);
  assert.equal(await hasView(page), staysVisible);
  assert.equal((await page.evaluate(() => window.ended)).includes("load"), false);
  assert.deepEqual(page.problems, []);
  await page.context().close();
}

const tests = {
  async loadsByRangesWithoutLoadingTwice() {
    const server = await serve();
    await assertLoads(server);
    const sent = server.log.reduce((sum, { begin, end }) => sum + end - begin, 0);
    assert.equal(sent, file.length);
    assert.ok(server.log.every(({ range }) => range));
    assert.ok(server.log.length <= 4 + file.length / 100_000, `${server.log.length} requests`);
    console.log(`        ${server.log.length} requests for ${file.length} bytes`);
    server.close();
  },

  // Further requests are never answered.
  async showsTheFirstImageEarly() {
    const photo = chunk("PICT", 0);
    const before = Math.max(chunks.find(({ name }) => name === "shap").begin, kFirst_bytes) + photo.size + 16;
    assert.ok(before <= kMostBefore_bytes, `${before} bytes`);
    let sent = 0;
    const server = await serve({ onrequest: ({ begin, end }) => ({ hang: (sent += end - begin) > before }) });
    const page = await open(server);
    await happened(page, "poster-dismissed");
    assert.equal(await hasView(page), true);
    console.log(`        first image after at most ${before} bytes`);
    server.close();
    await page.context().close();
  },

  async loadsWholeFromServersWithoutRanges() {
    for (const chunked of [false, true]) {
      const server = await serve({ ranges: false, chunked, etag: "" });
      await assertLoads(server);
      assert.equal(server.log.length, 1);
      server.close();
    }
  },

  async showsTheFirstImageOfAWholeFileEarly() {
    const shown = chunk("PICT", 0).begin + chunk("PICT", 0).size + kFirst_bytes;
    const server = await serve({ ranges: false, onrequest: () => ({ pause_ms: 30 }) });
    const page = await open(server);
    await happened(page, "poster-dismissed");
    const progress = await page.evaluate(() => document.querySelector("ray-space").shadowRoot.querySelector("progress").value);
    assert.ok(progress < 0.9 && progress * file.length > shown - 2 * kFirst_bytes, `${progress}`);
    await happened(page, "load");
    await assertFinalView(page);
    server.close();
  },

  async loadsDataAddressesAndOtherOrigins() {
    const server = await serve();
    const other = await serve({ headers: { "access-control-allow-origin": "*" } });
    await assertLoads(server, `data:application/octet-stream;base64,${file.toString("base64")}`);
    await assertLoads(server, `${other.address}object.rso`);
    assert.ok(other.log.every(({ range }) => range));
    server.close();
    other.close();
  },

  async startsWithWhatTheViewShows() {
    const server = await serve({ onrequest: () => ({ pause_ms: 20 }) });
    await assertLoads(server, "object.rso", "120deg auto auto");
    const first = server.log.find(({ begin }) => begin >= chunk("PICT", 0).begin);
    assert.ok(chunk("PICT", 8).begin === first.begin, `bytes ${first.begin} to ${first.end}`);
    server.close();
  },

  async visitorsTurnTheObjectWhileItLoads() {
    const server = await serve({ onrequest: () => ({ pause_ms: 40 }) });
    const page = await open(server);
    await happened(page, "poster-dismissed");
    for (let i = 0; i < 8; ++i) {
      await page.mouse.move(100, 100);
      await page.mouse.down();
      await page.mouse.move(170, 110, { steps: 4 });
      await page.mouse.up();
    }
    await happened(page, "load");
    await page.waitForTimeout(1500); // inertia
    await assertFinalView(page);
    server.close();
  },

  async continuesLostConnections() {
    const server = await serve({ onrequest: ({ count }) => (count === 1 || count === 3 ? { cut: 3000 } : {}) });
    await assertLoads(server);
    const sent = server.log.reduce((sum, { begin, end }) => sum + end - begin, 0);
    const again = server.log[1].end - server.log[1].begin + server.log[3].end - server.log[3].begin - 6000;
    assert.ok(sent <= file.length + again, "continues where the connection ended");
    server.close();
    const whole = await serve({ ranges: false, onrequest: ({ count }) => (count < 2 ? { cut: file.length >> 1 } : {}) });
    await assertLoads(whole);
    assert.equal(whole.log.length, 3);
    whole.close();
  },

  async keepsTheViewWhenTheConnectionStaysLost() {
    const server = await serve({ onrequest: ({ begin }) => (begin > chunk("PICT", 0).begin ? { cut: 100 } : {}) });
    await assertFails(server, /the connection was lost; reload the page/, true);
    server.close();
  },

  async namesMissingAndChangedFiles() {
    const server = await serve();
    const absent = await open(server, "absent.rso");
    await happened(absent, "error");
    assert.match(await messageOf(absent), /^absent[.]rso: does not exist on the server [(]404[)]$/);
    server.close();
    const changing = await serve();
    changing.onrequest = ({ count }) => {
      if (count === 5) changing.etag = '"2"';
      return {};
    };
    await assertFails(changing, /was changed on the server/, true);
    changing.close();
  },

  async namesDamagedFiles() {
    for (const [bad, message, staysVisible] of [
      [damaged({ begin: 12, size: 0 }), /the header's checksum does not match; the file is damaged/, false],
      [damaged(chunk("RMAP", 0)), /chunk RMAP 0: its checksum does not match/, false],
      [damaged(chunk("shap", 0)), /chunk shap 0: its checksum does not match/, true],
      [damaged(chunk("PICT", 3)), /chunk PICT 3: its checksum does not match/, true],
      [file.subarray(0, file.length >> 1), /bytes long instead of/, false],
      [Buffer.alloc(0), /is not a ray-space object/, false],
    ]) {
      const server = await serve({ file: bad });
      await assertFails(server, message, staysVisible);
      server.close();
    }
    // Without ranges and sizes, a truncated file ends after its first image.
    const server = await serve({ file: file.subarray(0, file.length - 5000), ranges: false, chunked: true });
    await assertFails(server, /bytes long instead of/, true);
    server.close();
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test();
    console.log(`passed  ${name}`);
  } catch (error) {
    ++failed;
    console.error(`FAILED  ${name}: ${error.stack}`);
  }
}
await browser.close();
process.exit(failed === 0 ? 0 : 1);
