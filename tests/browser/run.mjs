// The program in a real browser: node tests/browser/run.mjs FOLDER SOAPFILM [FILTER]
//
// FOLDER is what `./dev web` builds, SOAPFILM the command-line program, FILTER a part of the tests' names. Chromium draws with SwiftShader, and so
// does the program that it is compared with. CHROMIUM and PLAYWRIGHT name the browser and the folder where npm has put
// playwright-core and three.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, realpathSync, rmSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, extname, join, normalize } from "node:path";

import { NODE_TESTS, THREE_PAGES, WEBGL_TESTS } from "./three.mjs";
import { MODULES, PATIENCE_MS, SCENE, difference, drag, drop, link, ready, settle, ticks, toml, until } from "./tools.mjs";
import { TOUCH_TESTS } from "./touch.mjs";

const [folder, soapfilm, filter = ""] = process.argv.slice(2);
const { chromium } = createRequire(join(MODULES, "any.js"))("playwright-core");
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const scratch = mkdtempSync(join(tmpdir(), "soapfilm-browser-"));

// Chromium shows canvases of WebGPU only if it composes with Vulkan too.
const WITH_WEBGPU = [
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
  "--enable-features=Vulkan",
  "--use-vulkan=swiftshader",
  "--use-angle=vulkan",
  "--disable-gpu-watchdog",
];

// A WebGPU that composes with Vulkan leaves Chromium no WebGL.
const WITH_WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

// Pages that only this test has.
const PAGES = {
  "/npm/two.html": `<!doctype html><link rel="icon" href="data:," /><script type="module" src="./soap-bubble.js"></script>
    <soap-bubble scene="furnace" controls></soap-bubble><soap-bubble scene="./quiet.toml" paused></soap-bubble>`,
  "/npm/quiet.toml": SCENE,
  ...THREE_PAGES,
};

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".jpg": "image/jpeg" };

/** Serves a folder on the loopback address; the server's address. */
async function serve(root) {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://any").pathname));
    if (PAGES[path]) return response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "text/plain" }).end(PAGES[path]);
    // Modules of npm lie beside the browser's driver.
    const modules = path.startsWith("/three/") && join(MODULES, "node_modules");
    const file = join(modules || root, path.endsWith("/") ? `${path}index.html` : path);
    if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" });
    response.end(readFileSync(file));
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** The manifest of Chromium's own SwiftShader, for the program beside it. */
function swiftshader() {
  const folders = [dirname(realpathSync(executablePath)), "/usr/lib/chromium"];
  const manifest = folders.map((folder) => join(folder, "vk_swiftshader_icd.json")).find(existsSync);
  assert(manifest, "Chromium's vk_swiftshader_icd.json is not found");
  return manifest;
}

/** The program's own picture of a scene, by the same driver. */
function rendered(scene, size, time) {
  const file = join(scratch, `${scene}-${time}.png`);
  const manifest = swiftshader();
  const env = { ...process.env, VK_DRIVER_FILES: manifest, VK_ICD_FILENAMES: manifest, WGPU_BACKEND: "vulkan" };
  delete env.SOAPFILM_REQUIRE_ADAPTER;
  execFileSync(soapfilm, ["render", scene, "-o", file, "--size", size, "--time", `${time}`], { env, stdio: "pipe" });
  return readFileSync(file);
}

const SIZE = "240x160";

const TESTS = {
  async "the picture is the program's own"({ page, address }) {
    for (const [scene, time] of [
      ["windows", 0],
      ["stirred", 0.05],
    ]) {
      await page.goto(`${address}/?scene=${scene}&time=${time}&size=${SIZE}&ui=0&pause=1`);
      await ready(page);
      const shown = await page.locator("#soapfilm").screenshot();
      const { max, above2, sizes } = await difference(page, [shown, rendered(scene, SIZE, time)]);
      assert(max <= 2, `${scene} at ${time} s: ${max} levels, ${above2} values above 2, ${sizes}`);
    }
  },

  async "the pointer turns the view and stirs, and both are undone"({ page, address }) {
    await page.goto(link(address, SCENE));
    await ready(page);
    const before = await toml(page);
    await drag(page, [300, 300], [120, 0]);
    await until(page, `(toml) => toml !== ${JSON.stringify(before)}`);
    await settle(page);
    await page.keyboard.press("Control+z");
    await until(page, `(toml) => toml === ${JSON.stringify(before)}`);
    // Only liquid that time passes for can be stirred.
    await page.keyboard.press("2");
    await page.keyboard.press("Space");
    await settle(page);
    await drag(page, [300, 300], [120, 0], ticks);
    await until(page, '(toml) => toml.includes("[[event]]")');
    await settle(page);
    await page.keyboard.press("Control+z");
    await until(page, '(toml) => !toml.includes("[[event]]")');
  },

  async "a dropped scene is opened, and a wrong one changes nothing"({ page, address }) {
    await page.goto(link(address, SCENE, "&ui=0"));
    await ready(page);
    await drop(page, "mine.toml", SCENE.replace("[[bubble]]", "[[bubble]]\nradius_mm = 33.0"));
    await until(page, '(toml) => toml.includes("radius_mm = 33.0")');
    await drop(page, "wrong.toml", "version = 1\nlihgt = 3\n");
    await settle(page);
    assert((await toml(page)).includes("radius_mm = 33.0"));
  },

  async "a link holds the scene"({ page, address }) {
    await page.goto(link(address, SCENE, "&ui=0"));
    await ready(page);
    const [scene, fragment] = await page.evaluate(() => [window.soapfilm.toToml(), window.soapfilm.fragment]);
    await page.goto("about:blank");
    await page.goto(`${address}/?ui=0&pause=1${fragment}`);
    await ready(page);
    assert.equal(await toml(page), scene);
  },

  async "a lost device is replaced"({ page, address }) {
    await page.goto(link(address, SCENE, `&ui=0&size=${SIZE}`));
    await ready(page);
    const before = await page.locator("#soapfilm").screenshot();
    await page.evaluate(() => {
      window.states = [];
      new MutationObserver(() => window.states.push(document.documentElement.dataset.soapfilm)).observe(
        document.documentElement,
        { attributeFilter: ["data-soapfilm"] },
      );
      window.soapfilm.loseDevice();
    });
    await page.waitForFunction(() => window.states.at(-1) === "ready", null, { timeout: PATIENCE_MS });
    assert.deepEqual(await page.evaluate(() => window.states), ["loading", "ready"]);
    const { max } = await difference(page, [before, await page.locator("#soapfilm").screenshot()]);
    assert.equal(max, 0);
  },

  async "the page does little itself until its picture is there"({ page, address }) {
    const devtools = await page.context().newCDPSession(page);
    await devtools.send("Performance.enable", { timeDomain: "threadTicks" });
    await page.goto(`${address}/?scene=default&pause=1&ui=0`);
    await ready(page);
    const { metrics } = await devtools.send("Performance.getMetrics");
    const spent_s = metrics.find(({ name }) => name === "TaskDuration").value;
    // The film, the colours and the environments alone take 5 s of the page's own thread, this build's start half a second.
    assert(spent_s < 2.5, `the page's thread worked for ${spent_s.toFixed(1)} s`);
  },

  async "tabs keep their unsaved work apart"({ page, address }) {
    const works = () => page.evaluate(() => Object.keys(localStorage).filter((key) => key.startsWith("soapfilm unsaved ")));
    const work = async (tab, count) => {
      await tab.goto(link(address, SCENE));
      await ready(tab);
      await drag(tab, [300, 300], [120, 0]);
      await tab.waitForFunction(
        (count) => Object.keys(localStorage).filter((key) => key.startsWith("soapfilm unsaved ")).length === count,
        count,
        { timeout: PATIENCE_MS, polling: 200 },
      );
    };
    await work(page, 1);
    const other = await page.context().newPage();
    await work(other, 2);
    const kept = await works();
    await other.close();
    assert.deepEqual((await works()).sort(), kept.sort(), "a tab that closes leaves its work");
  },

  async "a scene that there is not is an error in words"({ page, address }) {
    await page.goto(`${address}/?scene=widnows`);
    await page.waitForFunction(() => document.documentElement.dataset.soapfilm === "error");
    assert.match(await page.textContent("#soapfilm-message"), /did you mean `windows`/);
  },

  async "the browser's compiler takes every shader with every constant"({ page, address }) {
    await page.goto(link(address, SCENE, "&ui=0"));
    await ready(page);
    const { failures, planted, count } = await page.evaluate(async () => {
      const { Shader } = await import("./soapfilm.js");
      const device = await (await navigator.gpu.requestAdapter()).requestDevice();
      const failures = [];
      let count = 0;
      const compile = async (shader, variant, more = "") => {
        count += 1;
        device.pushErrorScope("validation");
        const module = device.createShaderModule({ code: shader.text(variant) + more });
        const { messages } = await module.getCompilationInfo();
        await device.popErrorScope();
        const wrong = messages.filter((message) => message.type === "error");
        const name = shader.variants[variant];
        failures.push(...wrong.map((message) => `${shader.place(message.lineNum)}: ${message.message} (${name})`));
      };
      for (const shader of Shader.all()) {
        for (const variant of shader.variants.keys()) await compile(shader, variant);
      }
      const works = failures.length;
      await compile(Shader.all()[0], 0, "fn planted() { nothing(); }");
      return { failures: failures.slice(0, works), planted: failures[works], count };
    });
    assert.deepEqual(failures, []);
    assert.match(planted ?? "", /\.wgsl:\d+: .*nothing/);
    assert(count > 200, `${count} shaders`);
  },

  async "elements share a page"({ page, address }) {
    await page.goto(`${address}/npm/two.html`);
    const count = () => document.querySelectorAll('soap-bubble[data-state="ready"]').length;
    await page.waitForFunction(`(${count})() === 2`, null, { timeout: PATIENCE_MS, polling: 200 });
    const times = () => page.evaluate(() => [...document.querySelectorAll("soap-bubble")].map((bubble) => bubble.time));
    await page.waitForFunction(() => document.querySelector("soap-bubble").time > 0, null, { timeout: PATIENCE_MS });
    assert.equal((await times())[1], 0, "the second one is paused");
    await page.evaluate(() => document.querySelector("soap-bubble").remove());
  },
};

/** Without WebGPU the page says what to do, and shows a picture. */
async function testWithout({ page, address }) {
  await page.addInitScript(() => Object.defineProperty(Navigator.prototype, "gpu", { value: undefined }));
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.soapfilm === "error");
  assert.match(await page.textContent("#soapfilm-message"), /no WebGPU.*Use Chrome/);
  assert(await page.locator("img").evaluate((picture) => picture.decode().then(() => picture.checkVisibility())));
}

/** Runs a test in a page of its own, where every message of an error fails it. */
async function run(browser, address, test) {
  const context = await browser.newContext({ viewport: { width: 960, height: 640 } });
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  try {
    await test({ page, address, soapfilm });
  } finally {
    // A page that is left would go on drawing, beside the next test.
    await context.close();
  }
  assert.deepEqual(errors, []);
}

const server = await serve(folder);
let failed = 0;

/** Runs the tests whose names are asked for, in a browser with these arguments. */
async function runAll(tests, args) {
  const asked = Object.entries(tests).filter(([name]) => name.includes(filter));
  if (!asked.length) return;
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", ...args] });
  for (const [name, test] of asked) {
    const begun = performance.now();
    try {
      await run(browser, server.address, test);
      console.log(`ok      ${name} (${((performance.now() - begun) / 1000).toFixed(1)} s)`);
    } catch (error) {
      failed += 1;
      console.log(`FAILED  ${name}\n${error.stack}`);
    }
  }
  await browser.close();
}

await runAll({ ...TESTS, ...TOUCH_TESTS, ...NODE_TESTS }, WITH_WEBGPU);
await runAll({ ...WEBGL_TESTS, "without WebGPU the page says so": testWithout }, WITH_WEBGL);
server.close();
rmSync(scratch, { recursive: true });
process.exitCode = failed ? 1 : 0;
