// node element.mjs WEB OBJECT CHROMIUM: hotspots, shadow, loading, poster and prompt of <ray-space> in headless Chromium. WEB
// is the build folder of compositor/web. Also opens examples/product_page.html. Exits with 77 where Chromium cannot be started.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { launch, open, run, serve } from "./chromium.mjs";

const [web, object, chromium] = process.argv.slice(2);
const kHotspots = `
  <button slot="hotspot-front" data-position="0.2 0.3 0.4" data-normal="0 0 1" data-visibility-attribute="seen">Front</button>
  <button slot="hotspot-side" data-position="0.5 -0.2 0.1">Side</button>
  <button slot="hotspot-back" data-position="0 0.1 -0.5" data-visibility-attribute="seen">Back</button>`;
const page_of = (body) => `<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Test</title>
  <style>body { margin: 0 } ray-space { width: 100%; height: 300px } button { border: 0; padding: 0; width: 24px; height: 24px }</style>
  <script src="ray-space.js"></script></head><body><main><h1 style="position: absolute; clip-path: inset(50%)">Test</h1>${body}</main></body></html>`;
const files = {
  "/ray-space.js": readFileSync(join(web, "ray-space.js")),
  "/ray-space.wasm": readFileSync(join(web, "core/rayspace_core.wasm")),
  "/thing.rso": readFileSync(object),
  "/other.rso": readFileSync(object),
  "/vase.rso": readFileSync(object),
  "/product_page.html": readFileSync(new URL("../../examples/product_page.html", import.meta.url)),
  "/poster.png": Buffer.from("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGNgYGD4DwABBAEAX+XDSwAAAABJRU5ErkJggg==", "base64"),
  "/hotspots.html": page_of(`<ray-space src="thing.rso" alt="Thing" camera-controls>${kHotspots}</ray-space>`),
  "/plain.html": page_of(`<ray-space src="thing.rso" alt="Thing"></ray-space>`),
  "/two.html": page_of(`<ray-space src="thing.rso" alt="First" camera-controls></ray-space><div style="height: 3000px"></div>
    <ray-space id="second" src="other.rso" alt="Second" camera-controls></ray-space>`),
  "/manual.html": page_of(`<ray-space src="thing.rso" alt="Thing" poster="poster.png" reveal="manual" camera-controls>${kHotspots}</ray-space>`),
};
const server = await serve(files);
const browser = await launch(web, chromium);
const { Core } = await import(pathToFileURL(join(web, "core.mjs")));
const core = await Core.create(files["/ray-space.wasm"]);
core.open(files["/thing.rso"], "thing");

const openPage = (name, options) => open(browser, `${server.address}/${name}`, options);
async function openLoaded(name, options) {
  const page = await openPage(name, options);
  await page.waitForFunction(() => document.querySelector("ray-space").loaded, { timeout: 60000 });
  await settled(page);
  return page;
}
// Waits until view, hotspots and shadow rest.
async function settled(page) {
  const state = () =>
    inElement(page, (element) => {
      const styles = [...element.shadowRoot.querySelectorAll(".hotspot, [part~=ground-shadow]")].map((each) => each.getAttribute("style"));
      return element.toDataURL() + element.shadowRoot.querySelector("[part~=progress]").hidden + styles;
    });
  let last;
  for (let now = ""; now !== last; now = await state()) {
    last = now;
    await page.waitForTimeout(400);
  }
}
const inElement = (page, act, argument) => page.$eval("ray-space", act, argument);
const set = (page, name, value) => inElement(page, (element, [name, value]) => element.setAttribute(name, value), [name, value]);

/** The element's camera as the core's, and its size. */
async function viewOf(page) {
  const { orbit, width, height } = await inElement(page, (element) => {
    const { width, height } = element.getBoundingClientRect();
    return { orbit: { ...element.getCameraOrbit(), toString: undefined }, width, height };
  });
  return { width, height, view: { azimuth: orbit.theta, elevation: Math.PI / 2 - orbit.phi, distance: orbit.radius } };
}

const numbers = (text) => text.split(" ").map(Number);

async function expectHotspotsInPlace(page) {
  const { width, height, view } = await viewOf(page);
  const spots = await page.$$eval("[slot]", (all) =>
    all.map((spot) => {
      const box = spot.getBoundingClientRect();
      const host = spot.parentElement.getBoundingClientRect();
      return { position: spot.dataset.position, x: box.x + box.width / 2 - host.x, y: box.y + box.height / 2 - host.y };
    }),
  );
  assert.equal(spots.length, 3);
  for (const spot of spots) {
    const expected = core.project(width, height, view, numbers(spot.position));
    assert.ok(Math.hypot(spot.x - expected.x, spot.y - expected.y) < 0.1, `${spot.x},${spot.y} instead of ${expected.x},${expected.y}`);
  }
}

async function expectAccessible(page) {
  await page.addScriptTag({ path: createRequire(join(web, "package.json")).resolve("axe-core") });
  const { violations } = await page.evaluate(() => window.axe.run());
  assert.deepEqual(violations.map(({ id, help }) => `${id}: ${help}`), []);
}

const activeSlot = (page) => page.evaluate(() => document.activeElement?.slot || document.activeElement?.localName);

const tests = {
  async hotspotsAreWhereTheCoreProjectsThem() {
    for (const deviceScaleFactor of [1, 2, 3]) {
      const page = await openLoaded("hotspots.html", { deviceScaleFactor });
      await expectHotspotsInPlace(page);
      await set(page, "camera-orbit", "50deg 80deg 70%");
      await settled(page);
      await expectHotspotsInPlace(page);
      await page.setViewportSize({ width: 253, height: 300 });
      await settled(page);
      await expectHotspotsInPlace(page);
      await page.mouse.move(100, 100);
      await page.mouse.down();
      await page.mouse.move(160, 130, { steps: 3 });
      await page.mouse.up();
      await settled(page);
      await expectHotspotsInPlace(page);
      assert.deepEqual([page.problems, page.warnings], [[], []]);
    }
  },

  async hotspotsHideOnTheFarSide() {
    const page = await openLoaded("hotspots.html");
    await inElement(page, (element) => {
      window.changes = [];
      for (const spot of element.children) {
        spot.addEventListener("hotspot-visibility", (event) => window.changes.push([spot.slot, event.detail.visible]));
      }
    });
    const seen = () => page.$$eval("[slot]", (all) => all.map((spot) => [spot.hasAttribute("data-seen"), getComputedStyle(spot).opacity]));
    assert.deepEqual(await seen(), [[true, "1"], [false, "1"], [false, "0"]]);
    await set(page, "camera-orbit", "180deg auto auto");
    await settled(page);
    assert.deepEqual((await seen()).map(([flag]) => flag), [false, false, true]);
    assert.deepEqual((await page.evaluate(() => window.changes)).filter(([slot]) => slot !== "hotspot-side"), [
      ["hotspot-front", false],
      ["hotspot-back", true],
    ]);
  },

  async tabVisitsHotspotsInOrderAndTurnsToThem() {
    const page = await openLoaded("hotspots.html");
    const order = [];
    for (let i = 0; i < 4; ++i) {
      await page.keyboard.press("Tab");
      order.push(await activeSlot(page));
      if (i > 0) continue;
      const ring = await inElement(page, (element) => getComputedStyle(element.shadowRoot.querySelector("[part~=stage]")).outlineStyle);
      assert.notEqual(ring, "none", "the focus is visible");
    }
    assert.deepEqual(order, ["ray-space", "hotspot-front", "hotspot-side", "hotspot-back"]);
    await settled(page);
    const { view } = await viewOf(page);
    assert.ok(Math.abs(Math.abs(view.azimuth) - Math.PI) < 1e-6, "the back is shown");
    assert.equal(await inElement(page, (element) => element.queryHotspot("hotspot-back").facingCamera), true);
    // Keys of a hotspot do not turn the object.
    await page.keyboard.press("ArrowLeft");
    assert.deepEqual((await viewOf(page)).view, view);
  },

  async hotspotsMoveAndWrongOnesAreNamed() {
    const page = await openLoaded("hotspots.html");
    await inElement(page, (element) => element.updateHotspot({ name: "hotspot-side", position: "0.1 0.2 0.3", normal: "0 0 -1" }));
    const data = await inElement(page, (element) => JSON.parse(JSON.stringify(element.queryHotspot("hotspot-side"))));
    assert.deepEqual([data.position, data.normal, data.facingCamera], [{ x: 0.1, y: 0.2, z: 0.3 }, { x: 0, y: 0, z: -1 }, false]);
    await expectHotspotsInPlace(page);
    await inElement(page, (element) => {
      element.insertAdjacentHTML("beforeend", "<button slot=hotspot-wrong data-position='0 1m'>?</button>");
    });
    await page.waitForTimeout(50);
    assert.match(page.warnings[0], /hotspot-wrong: data-position "0 1m" is no point/);
  },

  async pointsOfTheSurfaceAreUnderThePointer() {
    const page = await openLoaded("hotspots.html");
    for (const orbit of ["20deg auto auto", "70deg 75deg 80%"]) {
      await set(page, "camera-orbit", orbit);
      const { width, height, view } = await viewOf(page);
      const places = [...Array(20 * 15).keys()].map((n) => ({ x: 20 * (n % 20) + 4, y: 20 * Math.floor(n / 20) + 3 }));
      const at = places.find(({ x, y }) => core.surfacePoint(width, height, view, x, y));
      assert.ok(at, "the object is in view");
      const found = await inElement(page, async (element, { x, y }) => {
        const surface = await element.positionAndNormalFromPoint(x, y);
        return surface && { position: String(surface.position), normal: String(surface.normal) };
      }, at);
      const expected = core.surfacePoint(width, height, view, at.x, at.y);
      numbers(found.position).forEach((value, axis) => assert.ok(Math.abs(value - expected.position[axis]) < 1e-4));
      const back = core.project(width, height, view, expected.position);
      assert.ok(Math.hypot(back.x - at.x, back.y - at.y) < 0.8, "and projects back");
      assert.ok(Math.abs(Math.hypot(...numbers(found.normal)) - 1) < 1e-3);
    }
    assert.equal(await inElement(page, (element) => element.positionAndNormalFromPoint(2, 2)), null);
  },

  async theShadowLiesOnTheGround() {
    const page = await openLoaded("plain.html");
    const shadow = () =>
      inElement(page, (element) => {
        const canvas = element.shadowRoot.querySelector("[part~=ground-shadow]");
        const { left, right, top, bottom } = canvas.getBoundingClientRect();
        let opacity = 0;
        if (canvas.width > 1) opacity = Math.max(...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data);
        return { hidden: canvas.hidden, box: [left, right, top, bottom], style: Number(canvas.style.opacity), opacity };
      });
    assert.equal((await shadow()).hidden, true, "no shadow by default");
    await set(page, "camera-orbit", "30deg 76deg auto");
    await set(page, "shadow-intensity", "0.5");
    await settled(page);
    const drawn = await shadow();
    assert.ok(!drawn.hidden && drawn.opacity > 150, `${drawn.opacity}`);
    assert.ok(drawn.style > 0 && drawn.style <= 0.5);
    const { width, height, view } = await viewOf(page);
    const { ground } = core.footprint();
    const corners = [[-1, -1], [1, -1], [-1, 1], [1, 1]].map(([x, z]) => core.project(width, height, view, [1.8 * x, ground, 1.8 * z]));
    const xs = corners.map(({ x }) => x);
    const ys = corners.map(({ y }) => y);
    [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)].forEach((edge, n) => {
      assert.ok(Math.abs(edge - drawn.box[n]) < 0.5, `${drawn.box} instead of ${edge} at ${n}`);
    });
    await set(page, "max-camera-orbit", "auto 120deg auto");
    await set(page, "camera-orbit", "auto 115deg auto");
    await settled(page);
    assert.equal((await shadow()).hidden, true, "invisible from below");
    await set(page, "shadow-softness", "soft");
    await set(page, "camera-orbit", "auto 76deg auto");
    await settled(page);
    assert.match(page.warnings.join("\n"), /shadow-softness "soft" is no number/);
  },

  async objectsLoadWhenThePageIsScrolledToThem() {
    server.requests.length = 0;
    const page = await openLoaded("two.html");
    assert.ok(server.requests.includes("/thing.rso") && !server.requests.includes("/other.rso"), `${server.requests}`);
    await page.$eval("#second", (element) => element.scrollIntoView());
    await page.waitForFunction(() => document.querySelector("#second").loaded, { timeout: 60000 });
    assert.equal(page.workers().length, 2);
    // Both are there, and only the visible one is drawn.
    await page.$eval("#second", (element) => element.setAttribute("camera-orbit", "90deg auto auto"));
    await settled(page);
    const [first, second] = await page.$$eval("ray-space", (all) => all.map((element) => element.getCameraOrbit().theta));
    assert.notEqual(first, second);
    server.requests.length = 0;
    const eager = await openPage("two.html");
    await eager.$eval("#second", (element) => element.setAttribute("loading", "eager"));
    await eager.waitForFunction(() => document.querySelector("#second").loaded, { timeout: 60000 });
    assert.deepEqual([page.problems, eager.problems], [[], []]);
  },

  async removalEndsLoadingAndFreesTheWorker() {
    const page = await openLoaded("two.html");
    assert.equal(page.workers().length, 1);
    await page.evaluate(() => document.querySelector("ray-space").remove());
    await page.waitForTimeout(200);
    assert.equal(page.workers().length, 0);
    server.delay_ms["/other.rso"] = 600;
    server.requests.length = 0;
    await page.$eval("#second", (element) => element.scrollIntoView());
    while (!server.requests.includes("/other.rso")) await page.waitForTimeout(20);
    await page.evaluate(() => {
      window.second = document.querySelector("#second");
      for (const type of ["load", "error"]) window.second.addEventListener(type, () => (window.late = type));
      window.second.remove();
    });
    await page.waitForTimeout(1000);
    delete server.delay_ms["/other.rso"];
    assert.deepEqual(await page.evaluate(() => [window.second.loaded, window.late ?? "nothing"]), [false, "nothing"]);
    assert.equal(page.workers().length, 0);
    // It loads where it is put back.
    await page.evaluate(() => document.querySelector("main").prepend(window.second));
    await page.evaluate(() => scrollTo(0, 0));
    await page.waitForFunction(() => window.late === "load", { timeout: 60000 });
    assert.deepEqual(page.problems, []);
  },

  async thePosterCoversTheObjectUntilItIsDismissed() {
    const page = await openLoaded("manual.html");
    const state = () =>
      inElement(page, (element) => {
        const visible = (selector) => element.shadowRoot.querySelector(selector).checkVisibility({ visibilityProperty: true });
        return [element.modelIsVisible, visible("[part~=poster]"), visible("canvas"), visible(".hotspot")];
      });
    assert.deepEqual(await state(), [false, true, false, false]);
    await inElement(page, (element) => {
      window.events = [];
      for (const type of ["poster-dismissed", "model-visibility"]) {
        element.addEventListener(type, (event) => window.events.push(event.detail ? `${type} ${event.detail.visible}` : type));
      }
      element.dismissPoster();
    });
    assert.deepEqual(await state(), [true, false, true, true]);
    await inElement(page, (element) => element.showPoster());
    assert.deepEqual(await state(), [false, true, false, false]);
    await set(page, "reveal", "auto");
    assert.deepEqual(await state(), [true, false, true, true]);
    const shown = ["poster-dismissed", "model-visibility true"];
    assert.deepEqual(await page.evaluate(() => window.events), [...shown, "model-visibility false", ...shown]);
  },

  async thePosterCanBeDismissedBeforeTheObjectIsThere() {
    server.delay_ms["/thing.rso"] = 300;
    const page = await openPage("manual.html");
    await inElement(page, (element) => element.dismissPoster());
    delete server.delay_ms["/thing.rso"];
    await page.waitForFunction(() => document.querySelector("ray-space").modelIsVisible, { timeout: 60000 });
  },

  async thePromptFadesAtTheFirstAction() {
    const page = await openLoaded("hotspots.html");
    const visible = () =>
      inElement(page, (element) => element.shadowRoot.querySelector("[part~=interaction-prompt]").checkVisibility({ visibilityProperty: true }));
    assert.equal(await visible(), false, "not at once");
    await page.waitForTimeout(3000);
    assert.equal(await visible(), true);
    await expectAccessible(page);
    await page.keyboard.press("Tab");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await visible(), false);
    await set(page, "alt", "Thing again");
    await page.waitForTimeout(3200);
    assert.equal(await visible(), false, "and does not return");
    const quiet = await openLoaded("plain.html");
    await quiet.evaluate(() => {
      const element = document.querySelector("ray-space");
      element.setAttribute("interaction-prompt-threshold", "0");
      element.setAttribute("interaction-prompt", "none");
      element.setAttribute("camera-controls", "");
    });
    await settled(quiet);
    assert.equal(await quiet.$eval("ray-space", (element) => element.shadowRoot.querySelector(".shown")), null);
  },

  async viewsAreReachedByAnimationUnlessMotionIsReduced() {
    const page = await openLoaded("plain.html", { reducedMotion: "no-preference" });
    await set(page, "interpolation-decay", "400");
    const theta = async () => (await viewOf(page)).view.azimuth;
    const begin = await theta();
    await set(page, "camera-orbit", "90deg auto auto");
    await page.waitForTimeout(150);
    const between = await theta();
    assert.ok(between > begin && between < Math.PI / 2, `${between}`);
    await inElement(page, (element) => element.jumpCameraToGoal());
    assert.ok(Math.abs((await theta()) - Math.PI / 2) < 1e-9);
    await set(page, "interpolation-decay", "20");
    await set(page, "camera-orbit", "-80deg auto auto"); // the shorter way: 170 degrees
    await page.waitForTimeout(800);
    assert.ok(Math.abs((await theta()) + (80 * Math.PI) / 180) < 1e-6, `${await theta()}`);
  },

  async sidesAreDescribedInThePagesWords() {
    const page = await openLoaded("hotspots.html");
    await set(page, "a11y", JSON.stringify({ left: "Linke Seite", "interaction-prompt": "Zum Drehen ziehen" }));
    const text = (selector) => inElement(page, (element, selector) => element.shadowRoot.querySelector(selector).textContent.trim(), selector);
    assert.equal(await text("[part~=interaction-prompt]"), "Zum Drehen ziehen");
    await page.keyboard.press("Tab");
    for (let i = 0; i < 12; ++i) await page.keyboard.press("ArrowLeft"); // of 7.5 degrees
    assert.equal(await text("[part~=direction]"), "Linke Seite");
    await page.keyboard.press("ArrowRight");
    for (let i = 0; i < 11; ++i) await page.keyboard.press("ArrowRight");
    assert.equal(await text("[part~=direction]"), "View from the front");
    await set(page, "a11y", "left");
    assert.match(page.warnings.join(), /a11y is no JSON object/);
  },

  async imagesAreSavedAndTheTargetIsKnown() {
    const page = await openLoaded("plain.html");
    const saved = await inElement(page, async (element) => {
      const blob = await element.toBlob({ mimeType: "image/webp" });
      return { type: blob.type, size: blob.size, target: String(element.getCameraTarget()) };
    });
    assert.equal(saved.type, "image/webp");
    assert.ok(saved.size > 500);
    assert.equal(numbers(saved.target)[0], 0);
  },

  async theExampleShowsItsTexts() {
    const page = await openLoaded("product_page.html");
    await expectAccessible(page);
    await page.$eval("[slot=hotspot-glaze]", (spot) => spot.focus());
    await settled(page);
    await page.keyboard.press("Enter");
    assert.match(await page.textContent("#text"), /glaze/);
    assert.deepEqual([page.problems, page.warnings], [[], []]);
  },

  async twoFingersZoomAndOneTurns() {
    const page = await openLoaded("hotspots.html", { hasTouch: true });
    const devtools = await page.context().newCDPSession(page);
    const touch = (type, points) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const before = (await viewOf(page)).view;
    await touch("touchStart", [[180, 60], [220, 60]]);
    await touch("touchMove", [[140, 60], [260, 60]]);
    await touch("touchEnd", []);
    const zoomed = (await viewOf(page)).view;
    assert.ok(zoomed.distance < before.distance);
    await touch("touchStart", [[200, 60]]);
    for (let x = 200; x <= 280; x += 10) await touch("touchMove", [[x, 60]]);
    await touch("touchEnd", []);
    await settled(page);
    assert.ok((await viewOf(page)).view.azimuth < zoomed.azimuth);
    await expectHotspotsInPlace(page);
  },
};

await run(tests, async () => {
  await browser.close();
  server.close();
});
