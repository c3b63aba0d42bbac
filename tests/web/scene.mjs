// node scene.mjs WEB VIEW OBJECT CHROMIUM: opens scene pages of rs-view (VIEW) in headless Chromium, and compares them with
// its desktop renderer. WEB is the build folder of compositor/web. Exits with 77 where Chromium or OpenGL is missing.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [web, view, object, chromium] = process.argv.slice(2);
const require = createRequire(join(web, "package.json"));
const folder = mkdtempSync(join(tmpdir(), "rayspace-scene-"));
const kSize = { width: 480, height: 320 };

// An object on the floor of a room with two light sets, half hidden behind a board, and beside a window of glass.
const kRoom = `#VRML V2.0 utf8
NavigationInfo { type "WALK" speed 2 headlight FALSE }
Background { skyColor [ 0.2 0.4 0.8, 0.7 0.8 0.9 ] skyAngle [ 1.57 ] groundColor [ 0.3 0.3 0.3, 0.5 0.5 0.5 ] groundAngle [ 1.57 ] }
Viewpoint { description "front" position 0 1.2 6 fieldOfView 0.7 }
Viewpoint { description "above" position 0 4 5 orientation 1 0 0 -0.6 fieldOfView 0.7 }
Viewpoint { description "behind" position 0 1.2 -6 orientation 0 1 0 3.14159265 fieldOfView 0.7 }
Group { children [
  DirectionalLight { direction -0.4 -1 -0.5 intensity 0.7 ambientIntensity 0.5 }
  Transform { translation 0 -0.05 0 children Shape {
    appearance Appearance { material Material { ambientIntensity 1 diffuseColor 0.6 0.5 0.4 } } geometry Box { size 8 0.1 8 } } }
  Transform { translation -0.5 0.7 1.2 children Shape {
    appearance Appearance { material Material { ambientIntensity 1 diffuseColor 0.1 0.6 0.2 } } geometry Box { size 1 1.4 0.05 } } }
  Transform { translation 0 0 0 children RaySpace { url "thing.rso" size 1 description "thing" } }
] }
Group { children [
  DirectionalLight { direction 0 0 -1 intensity 0.3 ambientIntensity 1 color 1 0.3 0.3 }
  Transform { translation 2.2 0.5 0 children Shape {
    appearance Appearance { material Material { ambientIntensity 1 diffuseColor 0.8 0.8 0.8 } } geometry Sphere { radius 0.5 } } }
] }
`;

let browser;
try {
  const playwright = require("playwright-core");
  const options = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  browser = await playwright.chromium.launch({ executablePath: chromium, args: options });
} catch (error) {
  console.log(`SKIPPED: Chromium cannot be started: ${error.message}`);
  process.exit(77);
}

async function open(address, options = {}) {
  const context = await browser.newContext({ viewport: kSize, reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  page.problems = [];
  page.addresses = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("request", (request) => page.addresses.push(request.url()));
  await page.goto(address);
  return page;
}

const settled = (page) => page.waitForFunction(() => document.querySelector("ray-space-scene").settled, undefined, { timeout: 90000 });

async function openLoaded(address, options) {
  const page = await open(address, options);
  await settled(page);
  return page;
}

const visitorOf = (page) => page.evaluate(() => document.querySelector("ray-space-scene").getVisitor());
const onDisk = () => pathToFileURL(join(folder, "room.html")).href;
const partOf = (name) => `ray-space-scene >> [part="${name}"]`;

async function goTo(page, viewpoint) {
  await page.locator(partOf("viewpoints")).selectOption({ label: viewpoint });
  await settled(page);
}

// Red, green and blue of an image file's pixels, decoded by the page.
function pixelsOf(page, png) {
  return page.evaluate(async (address) => {
    const image = await createImageBitmap(await (await fetch(address)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    return Array.from(context.getImageData(0, 0, image.width, image.height).data);
  }, `data:image/png;base64,${png.toString("base64")}`);
}

const shownBy = (page) =>
  page.evaluate(() => document.querySelector("ray-space-scene").toDataURL()).then((url) => Buffer.from(url.split(",")[1], "base64"));

const at = (pixels, x, y) => pixels.slice(4 * (y * kSize.width + x), 4 * (y * kSize.width + x) + 3);
const isGreen = ([r, g, b]) => g > 1.5 * r && g > 1.5 * b;

const tests = {
  async opensFromDiskWithoutNetwork() {
    const page = await openLoaded(onDisk());
    assert.deepEqual(page.problems, []);
    assert.deepEqual(page.addresses.slice(1).filter((address) => !/^(data|blob):/.test(address)), []);
    assert.equal(await page.title(), "Room & more");
    const names = await page.evaluate(() => document.querySelector("ray-space-scene").viewpoints);
    assert.deepEqual(names, ["front", "above", "behind"]);
  },

  // The same viewpoints by the desktop's raster renderer.
  async looksLikeTheDesktop() {
    const page = await openLoaded(onDisk());
    for (const viewpoint of ["front", "above", "behind"]) {
      await goTo(page, viewpoint);
      const file = join(folder, `${viewpoint}.png`);
      const size = `${kSize.width}x${kSize.height}`;
      execFileSync(view, ["render", join(folder, "room.wrl"), "--viewpoint", viewpoint, "--size", size, "--object-depth", "pixel", "-o", file]);
      const expected = await pixelsOf(page, readFileSync(file));
      const shown = await pixelsOf(page, await shownBy(page));
      assert.equal(shown.length, expected.length);
      let sum = 0;
      let differing = 0;
      for (let i = 0; i < shown.length; i += 4) {
        const difference = [0, 1, 2].reduce((total, c) => total + Math.abs(shown[i + c] - expected[i + c]), 0) / 3;
        sum += difference;
        differing += difference > 32;
      }
      const pixels = shown.length / 4;
      console.log(`        ${viewpoint}: mean difference ${(sum / pixels).toFixed(2)}, ${((100 * differing) / pixels).toFixed(2)} % beyond 32`);
      assert.ok(sum / pixels < 5, viewpoint);
      assert.ok(differing / pixels < 0.03, viewpoint);
    }
  },

  // The board is 1.2 in front of the object's axis: it hides the object from the front, and is hidden from behind.
  async objectsHideAndAreHidden() {
    const page = await openLoaded(onDisk());
    const inside = [Math.round(0.47 * kSize.width), Math.round(0.52 * kSize.height)];
    assert.ok(isGreen(at(await pixelsOf(page, await shownBy(page)), ...inside)), "the board hides the object");
    await goTo(page, "behind");
    const behind = await pixelsOf(page, await shownBy(page));
    assert.ok(!isGreen(at(behind, kSize.width - inside[0], inside[1])), "the object hides the board");
  },

  async walksByKeysAndLooksByDragging() {
    const page = await openLoaded(onDisk());
    await page.locator(partOf("stage")).focus();
    const start = await visitorOf(page);
    // Holds a key until the visitor has moved far enough: software rendering may need seconds for a frame.
    const hold = async (key, isFarEnough, what) => {
      const deadline = Date.now() + 20000;
      await page.keyboard.down(key);
      let now = await visitorOf(page);
      while (!isFarEnough(now) && Date.now() < deadline) {
        await page.waitForTimeout(50);
        now = await visitorOf(page);
      }
      await page.keyboard.up(key);
      assert.ok(isFarEnough(now), what);
      return visitorOf(page);
    };
    const forward = await hold("w", ({ eye }) => eye[2] < start.eye[2] - 0.1, "W walks forward");
    assert.equal(forward.eye[1], start.eye[1], "at the same height");
    await hold("ArrowDown", ({ eye }) => eye[2] > forward.eye[2] + 0.1, "arrows walk");
    await hold("d", ({ eye }) => eye[0] > forward.eye[0] + 0.1, "D walks to the right");
    await hold("ArrowLeft", ({ heading }) => heading > 0.1, "arrows turn");
    const before = await visitorOf(page);
    await page.mouse.move(200, 150);
    await page.mouse.down();
    await page.mouse.move(250, 130, { steps: 4 });
    await page.mouse.up();
    const after = await visitorOf(page);
    assert.ok(Math.abs(after.heading - before.heading - 0.2) < 1e-6, "dragging turns");
    assert.ok(Math.abs(after.pitch - before.pitch + 0.08) < 1e-6, "and tilts");
    assert.deepEqual(after.eye, before.eye);
    assert.deepEqual(page.problems, []);
  },

  async aClickOnAnObjectOrbitsIt() {
    const page = await openLoaded(onDisk());
    await goTo(page, "behind");
    await page.mouse.click(0.5 * kSize.width, 0.5 * kSize.height);
    await settled(page);
    assert.match(await page.locator(partOf("notice")).textContent(), /^thing: drag/);
    const distance = ({ eye }) => Math.hypot(eye[0], eye[2]);
    const before = await visitorOf(page);
    await page.mouse.move(200, 150);
    await page.mouse.down();
    await page.mouse.move(300, 150, { steps: 4 });
    await page.mouse.up();
    const after = await visitorOf(page);
    assert.ok(Math.hypot(after.eye[0] - before.eye[0], after.eye[2] - before.eye[2]) > 0.5, "the visitor moves");
    assert.ok(Math.abs(distance(after) - distance(before)) < 0.01, "at the same distance");
    await page.keyboard.press("Escape");
    assert.equal(await page.locator(partOf("notice")).textContent(), "");
    // By keyboard alone.
    await page.locator(partOf("objects")).selectOption({ label: "thing" });
    assert.match(await page.locator(partOf("notice")).textContent(), /^thing: drag/);
  },

  async touchLooksWithOneFingerAndMovesWithTwo() {
    const page = await openLoaded(onDisk(), { hasTouch: true });
    const devtools = await page.context().newCDPSession(page);
    const touch = (type, points) =>
      devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const start = await visitorOf(page);
    await touch("touchStart", [[200, 150]]);
    await touch("touchMove", [[240, 150]]);
    await touch("touchEnd", []);
    const turned = await visitorOf(page);
    assert.ok(turned.heading > start.heading + 0.1);
    assert.deepEqual(turned.eye, start.eye);
    await touch("touchStart", [[200, 200], [260, 200]]);
    await touch("touchMove", [[200, 150], [260, 150]]);
    await touch("touchEnd", []);
    const moved = await visitorOf(page);
    assert.ok(Math.hypot(moved.eye[0] - start.eye[0], moved.eye[2] - start.eye[2]) > 0.3);
    assert.equal(moved.heading, turned.heading);
  },

  async followsTheWindowSize() {
    const page = await openLoaded(onDisk());
    await page.setViewportSize({ width: 300, height: 500 });
    await page.waitForFunction(() => {
      const { width, height } = document.querySelector("ray-space-scene").shadowRoot.querySelector("canvas");
      return width === 300 && height === 500;
    });
    await settled(page);
  },

  async sitesStateWhatIsMissing() {
    let hidden = "";
    const types = { html: "text/html", js: "text/javascript", wasm: "application/wasm" };
    const server = createServer((request, response) => {
      const name = request.url === "/" ? "/index.html" : request.url;
      try {
        if (name === hidden) throw new Error();
        const body = readFileSync(join(folder, "site", name));
        response.setHeader("content-type", types[name.split(".").pop()] ?? "application/octet-stream");
        response.setHeader("content-length", body.length).end(body);
      } catch {
        response.writeHead(404).end();
      }
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    const address = `http://127.0.0.1:${server.address().port}/`;
    const page = await openLoaded(address);
    assert.deepEqual(page.problems, []);
    assert.equal(await page.locator(partOf("notice")).textContent(), "");
    hidden = "/thing.rso";
    const without = await openLoaded(address);
    assert.match(await without.locator(partOf("notice")).textContent(), /^Objects are missing: thing[.]rso: does not exist on the server/);
    hidden = "/scene.glb";
    const empty = await open(address);
    await empty.waitForFunction(() => document.querySelector("ray-space-scene").shadowRoot.querySelector("[part=message]").textContent !== "");
    assert.match(await empty.locator(partOf("message")).textContent(), /^scene[.]glb: does not exist on the server/);
    server.close();
  },

  async isAccessible() {
    const page = await openLoaded(onDisk());
    await page.addScriptTag({ path: require.resolve("axe-core") });
    const { violations } = await page.evaluate(() => window.axe.run());
    assert.deepEqual(violations.map(({ id, help }) => `${id}: ${help}`), []);
    assert.match(await page.locator(partOf("stage")).getAttribute("aria-label"), /^A room with a thing[.] Walk/);
  },
};

let failed = 0;
try {
  writeFileSync(join(folder, "room.wrl"), kRoom);
  copyFileSync(object, join(folder, "thing.rso"));
  const words = ["--title", "Room & more", "--alt", "A room with a thing"];
  execFileSync(view, ["page", join(folder, "room.wrl"), "-o", join(folder, "room.html"), ...words]);
  execFileSync(view, ["page", join(folder, "room.wrl"), "--site", join(folder, "site")]);
  for (const [name, test] of Object.entries(tests)) {
    if (process.env.RAYSPACE_WEB_TEST && name !== process.env.RAYSPACE_WEB_TEST) continue;
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
