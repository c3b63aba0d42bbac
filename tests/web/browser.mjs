// node browser.mjs WEB VIEW OBJECT CHROMIUM: opens pages of rs-view (VIEW) in headless Chromium. WEB is the build folder of
// compositor/web. Exits with 77 where Chromium cannot be started.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";

const [web, view, object, chromium] = process.argv.slice(2);
const require = createRequire(join(web, "package.json"));
const { Core } = await import(pathToFileURL(join(web, "core.mjs")));
const folder = mkdtempSync(join(tmpdir(), "rayspace-web-"));
let browser;
try {
  const playwright = require("playwright-core");
  browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
} catch (error) {
  console.log(`SKIPPED: Chromium cannot be started: ${error.message}`);
  process.exit(77);
}

const loaded = () => document.querySelector("ray-space").loaded;

async function open(address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 320, height: 280 }, reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  page.problems = [];
  page.addresses = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("request", (request) => page.addresses.push(request.url()));
  await page.goto(address);
  return page;
}

async function openLoaded(address, options) {
  const page = await open(address, options);
  await page.waitForFunction(loaded, { timeout: 60000 });
  await page.waitForTimeout(400); // the view at full size
  return page;
}

const orbitOf = (page) => page.evaluate(() => ({ ...document.querySelector("ray-space").getCameraOrbit() }));

// The page from disk.
const tests = {
  async opensFromDiskWithoutNetwork() {
    const page = await openLoaded(pathToFileURL(join(folder, "page.html")).href);
    assert.deepEqual(page.problems, []);
    const outside = page.addresses.slice(1).filter((address) => !/^(data|blob):/.test(address));
    assert.deepEqual(outside, []);
    assert.equal(await page.title(), "Shape & more");
  },

  // Opaque pixels of a 2D canvas are kept exactly; others are stored premultiplied.
  async showsThePixelsOfTheCore() {
    const page = await openLoaded(pathToFileURL(join(folder, "page.html")).href);
    const shown = await page.evaluate(() => {
      const { canvas } = document.querySelector("ray-space").viewRenderer;
      const { width, height } = canvas;
      return { width, height, data: Array.from(canvas.getContext("2d").getImageData(0, 0, width, height).data) };
    });
    assert.deepEqual([shown.width, shown.height], [320, 280]);
    const core = await Core.create(readFileSync(join(web, "core/rayspace_core.wasm")));
    core.open(readFileSync(object), "object");
    const { theta, phi, radius } = await orbitOf(page);
    const expected = core.render(320, 280, { azimuth: theta, elevation: Math.PI / 2 - phi, distance: radius });
    let opaque = 0;
    for (let i = 0; i < expected.length; i += 4) {
      const alpha = expected[i + 3];
      assert.equal(shown.data[i + 3], alpha);
      if (alpha !== 255) continue;
      ++opaque;
      for (const channel of [0, 1, 2]) assert.equal(shown.data[i + channel], expected[i + channel]);
    }
    assert.ok(opaque > 1000, `${opaque} opaque pixels`);
  },

  async dragKeysAndWheelChangeTheView() {
    const page = await openLoaded(pathToFileURL(join(folder, "page.html")).href);
    await page.evaluate(() => {
      window.sources = [];
      document.querySelector("ray-space").addEventListener("camera-change", (event) => window.sources.push(event.detail.source));
    });
    const pixels = () => page.evaluate(() => document.querySelector("ray-space").toDataURL());
    let before = await orbitOf(page);
    const firstImage = await pixels();
    await page.mouse.move(100, 100);
    await page.mouse.down();
    await page.mouse.move(180, 120, { steps: 4 });
    await page.mouse.up();
    await page.waitForTimeout(400);
    let after = await orbitOf(page);
    assert.ok(Math.abs(after.theta - before.theta + (80 / 320) * 2 * Math.PI) < 1e-6, "drag turns");
    assert.ok(after.phi < before.phi, "drag tilts");
    assert.notEqual(await pixels(), firstImage);
    assert.ok((await page.evaluate(() => window.sources)).includes("user-interaction"));
    before = after;
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("PageUp");
    after = await orbitOf(page);
    assert.ok(after.theta > before.theta && after.radius < before.radius, "keys turn and zoom");
    for (let i = 0; i < 30; ++i) await page.keyboard.press("ArrowUp");
    const highest = Math.PI / 2 - (await orbitOf(page)).phi;
    before = await orbitOf(page);
    await page.mouse.wheel(0, 100);
    after = await orbitOf(page);
    assert.ok(after.radius > before.radius, "a focused element zooms by wheel");
    await page.keyboard.press("Home");
    after = await orbitOf(page);
    const captured = Math.PI / 2 - after.phi;
    await page.mouse.dblclick(150, 150);
    assert.ok((await orbitOf(page)).radius < 0.6 * after.radius, "double click zooms");
    await page.mouse.dblclick(150, 150);
    assert.ok(Math.abs((await orbitOf(page)).radius - after.radius) < 1e-9, "and back");
    assert.ok(Math.abs(highest - captured - Math.PI / 12) < 1e-6, "at most 15 degrees above the photos");
  },

  async attributesPlaceAndLimitTheCamera() {
    const page = await openLoaded(pathToFileURL(join(folder, "page.html")).href);
    const warnings = [];
    page.on("console", (message) => warnings.push(message.text()));
    const withAttribute = async (name, value) => {
      await page.evaluate(([name, value]) => document.querySelector("ray-space").setAttribute(name, value), [name, value]);
      return orbitOf(page);
    };
    const degree = Math.PI / 180;
    const auto = await orbitOf(page);
    const placed = await withAttribute("camera-orbit", "30deg 85deg 50%");
    assert.ok(Math.abs(placed.theta - 30 * degree) < 1e-9 && Math.abs(placed.phi - 85 * degree) < 1e-9);
    assert.ok(Math.abs(placed.radius - auto.radius / 2) < 1e-9);
    assert.equal(await page.evaluate(() => document.querySelector("ray-space").cameraOrbit), "30deg 85deg 50%");
    const limited = await withAttribute("min-camera-orbit", "auto 88deg 70%");
    assert.ok(Math.abs(limited.phi - 88 * degree) < 1e-9 && Math.abs(limited.radius - 0.7 * auto.radius) < 1e-9);
    assert.deepEqual(warnings, []);
    await withAttribute("camera-orbit", "30 85");
    assert.match(warnings[0], /camera-orbit "30 85" is no orbit/);
  },

  // On a touch screen, pinching zooms, and dragging up scrolls the page.
  async touchDoesNotTrapThePage() {
    const page = await openLoaded(pathToFileURL(join(folder, "page.html")).href, { hasTouch: true });
    await page.evaluate(() => document.body.insertAdjacentHTML("beforeend", "<div style='height:2000px'></div>"));
    const before = await orbitOf(page);
    const devtools = await page.context().newCDPSession(page);
    const touch = (type, points) =>
      devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await touch("touchStart", [[140, 100], [180, 100]]);
    await touch("touchMove", [[100, 100], [220, 100]]);
    await touch("touchEnd", []);
    const pinched = await orbitOf(page);
    assert.ok(pinched.radius < before.radius, "pinch zooms");
    const scrolled = async () => {
      await page.evaluate(() => scrollTo(0, 0));
      await touch("touchStart", [[160, 200]]);
      for (let y = 190; y > 40; y -= 10) await touch("touchMove", [[160, y]]);
      await touch("touchEnd", []);
      await page.waitForTimeout(300);
      return page.evaluate(() => scrollY);
    };
    assert.ok((await scrolled()) > 50, "the page scrolls");
    await page.evaluate(() => document.querySelector("ray-space").setAttribute("touch-action", "none"));
    assert.equal(await scrolled(), 0);
  },

  async autoRotatesUnlessMotionIsReduced() {
    const address = pathToFileURL(join(folder, "page.html")).href;
    const still = await openLoaded(address);
    const moving = await openLoaded(address, { reducedMotion: "no-preference" });
    const turned = async (page) => {
      const { theta } = await orbitOf(page);
      await page.waitForTimeout(600);
      return (await orbitOf(page)).theta - theta;
    };
    assert.equal(await turned(still), 0);
    assert.ok((await turned(moving)) > 0.01);
    // An element off screen rests.
    await moving.evaluate(() => {
      document.querySelector("main").style.marginTop = "3000px";
    });
    await moving.waitForTimeout(300);
    assert.equal(await turned(moving), 0);
  },

  async readsSitesAndNamesWhatIsWrong() {
    const good = readFileSync(join(folder, "site", "object name.rso"));
    const damaged = Buffer.from(good);
    damaged[damaged.length - 40] ^= 1;
    const files = {
      "/object%20name.rso": good,
      "/damaged.rso": damaged,
      "/short.rso": good.subarray(0, good.length / 2),
      "/foreign.rso": Buffer.from("PNG or whatever, in any case no object"),
      "/empty.rso": Buffer.alloc(0),
    };
    let policy = "";
    const types = { html: "text/html", js: "text/javascript", wasm: "application/wasm" };
    const server = createServer((request, response) => {
      let body = files[request.url];
      try {
        body ??= readFileSync(join(folder, "site", request.url === "/" ? "index.html" : request.url));
      } catch {
        response.writeHead(404).end();
        return;
      }
      if (policy) response.setHeader("content-security-policy", policy);
      response.setHeader("content-type", types[request.url.split(".").pop()] ?? (request.url === "/" ? "text/html" : "application/octet-stream"));
      response.setHeader("content-length", body.length).end(body);
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    const address = `http://127.0.0.1:${server.address().port}/`;
    const page = await openLoaded(address);
    assert.deepEqual(page.problems, []);
    const tried = (src) =>
      page.evaluate(
        (src) =>
          new Promise((resolve) => {
            const element = document.querySelector("ray-space");
            const end = (event) => resolve({ type: event.type, text: element.shadowRoot.querySelector("[part=message]").textContent });
            element.addEventListener("load", end, { once: true });
            element.addEventListener("error", end, { once: true });
            element.src = src;
          }),
        src,
      );
    for (const [src, reason] of [
      ["damaged.rso", /^damaged[.]rso: .*damaged/],
      ["short.rso", /^short[.]rso: .*damaged/],
      ["foreign.rso", /^foreign[.]rso: is not a ray-space object/],
      ["empty.rso", /^empty[.]rso: /],
      ["absent.rso", /^absent[.]rso: does not exist on the server/],
    ]) {
      const { type, text } = await tried(src);
      assert.equal(type, "error", src);
      assert.match(text, reason);
    }
    assert.deepEqual(await tried("object%20name.rso"), { type: "load", text: "" });
    assert.deepEqual(page.problems, []);
    // Without workers, the page's thread renders.
    policy = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; worker-src 'none'";
    await openLoaded(address);
    policy = "script-src 'self'; worker-src 'none'";
    const locked = await open(address);
    await locked.waitForFunction(() => document.querySelector("ray-space").shadowRoot.querySelector("[part=message]").textContent !== "");
    assert.match(await locked.evaluate(() => document.querySelector("ray-space").shadowRoot.querySelector("[part=message]").textContent), /WebAssembly/);
    server.close();
  },

  async isAccessible() {
    const page = await openLoaded(pathToFileURL(join(folder, "page.html")).href);
    await page.addScriptTag({ path: require.resolve("axe-core") });
    const { violations } = await page.evaluate(() => window.axe.run());
    assert.deepEqual(violations.map(({ id, help }) => `${id}: ${help}`), []);
    const label = await page.evaluate(() => {
      const stage = document.querySelector("ray-space").shadowRoot.querySelector("[part=stage]");
      return `${stage.getAttribute("role")}: ${stage.getAttribute("aria-label")}`;
    });
    assert.match(label, /^application: A "small" thing[.] Drag/);
  },
};

let failed = 0;
try {
  const words = ["--title", "Shape & more", "--alt", 'A "small" thing'];
  execFileSync(view, ["page", object, "-o", join(folder, "page.html"), ...words]);
  const copy = join(folder, "object name.rso");
  writeFileSync(copy, readFileSync(object));
  execFileSync(view, ["page", copy, "--site", join(folder, "site")]);
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log(`passed  ${name}`);
    } catch (error) {
      ++failed;
      console.error(`FAILED  ${name}: ${error.stack}`);
    }
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
process.exit(failed === 0 ? 0 : 1);
