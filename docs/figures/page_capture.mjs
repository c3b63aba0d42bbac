// node page_capture.mjs WEB PAGE.html FRAMES: photographs a page of rs-view while a visitor turns and zooms the object, as
// FRAMES/NNN.png. WEB is the build folder of compositor/web. The figure of the README:
//
//     rs-view page demo-out/doll.rso -o page.html && node docs/figures/page_capture.mjs build/release/compositor/web page.html frames
//     img2webp -lossy -q 60 -d 80 -loop 0 frames/*.png -o docs/figures/page.webp
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [web, file, frames] = process.argv.slice(2);
const { chromium } = createRequire(resolve(web, "package.json"))("playwright-core");
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const width = 560;
const height = 400;
const page = await browser.newPage({ viewport: { width, height }, reducedMotion: "reduce" });
await page.goto(pathToFileURL(resolve(file)).href);
await page.waitForFunction(() => document.querySelector("ray-space").loaded);

// A disc shows the pointer, which screenshots lack.
await page.evaluate(() => {
  const pointer = document.createElement("div");
  pointer.style.cssText =
    "position:fixed;width:18px;height:18px;margin:-9px;border-radius:50%;background:#0006;border:2px solid #fff;pointer-events:none";
  document.body.append(pointer);
  addEventListener("pointermove", ({ x, y }) => Object.assign(pointer.style, { left: `${x}px`, top: `${y}px` }), true);
});

mkdirSync(frames, { recursive: true });
let count = 0;
async function shoot() {
  await page.waitForTimeout(400); // the view at full size
  await page.screenshot({ path: join(frames, `${String(count++).padStart(3, "0")}.png`) });
}

// Moves the pointer from one point to another; the ends are slow.
async function drag(from, to, steps) {
  for (let i = 1; i <= steps; ++i) {
    const t = (1 - Math.cos((Math.PI * i) / steps)) / 2;
    await page.mouse.move(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]));
    await shoot();
  }
}

const middle = [width / 2, height / 2];
const left = [0.1 * width, 0.55 * height];
await page.mouse.move(...middle);
await shoot();
await page.mouse.down();
await drag(middle, left, 14);
await drag(left, [0.9 * width, 0.45 * height], 26);
for (let i = 0; i < 4; ++i) {
  await page.keyboard.press("+");
  await shoot();
}
await drag([0.9 * width, 0.45 * height], middle, 14);
await page.mouse.up();
for (let i = 0; i < 4; ++i) {
  await page.keyboard.press("-");
  await shoot();
}
await browser.close();
