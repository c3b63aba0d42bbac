// Headless Chromium, a server of files in memory, and a runner, for tests of <ray-space>.
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join } from "node:path";

const kTypes = { html: "text/html", js: "text/javascript", wasm: "application/wasm" };

/** Ends the process with 77 where Chromium cannot be started. WEB is the build folder of compositor/web. */
export async function launch(web, chromium) {
  const { chromium: kind } = createRequire(join(web, "package.json"))("playwright-core");
  try {
    return await kind.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  } catch (error) {
    console.log(`SKIPPED: Chromium cannot be started: ${error.message}`);
    process.exit(77);
  }
}

/**
 * Serves FILES, bytes or texts by path. `requests` lists the paths asked for; `delay_ms` holds back answers by path.
 */
export async function serve(files) {
  const requests = [];
  const delay_ms = {};
  const server = createServer((request, response) => {
    const body = files[request.url];
    requests.push(request.url);
    setTimeout(() => {
      if (body === undefined) return response.writeHead(404).end();
      response.setHeader("content-type", kTypes[request.url.split(".").pop()] ?? "application/octet-stream");
      response.end(body);
    }, delay_ms[request.url] ?? 0);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { address: `http://127.0.0.1:${server.address().port}`, requests, delay_ms, close: () => server.close() };
}

/** Opens a page in a context of its own; `problems` and `warnings` collect what goes wrong. */
export async function open(browser, address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 400, height: 300 }, reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  page.problems = [];
  page.warnings = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("console", (message) => message.type() === "warning" && page.warnings.push(message.text()));
  await page.goto(address);
  return page;
}

/** Runs tests by name and ends the process. */
export async function run(tests, close) {
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
  await close();
  process.exit(failed === 0 ? 0 : 1);
}
