// The cost of a frame beside that of three.js' materials: node benches/three/run.mjs SOAPFILM [ROUNDS]
//
// SOAPFILM is the command-line program. CHROMIUM and PLAYWRIGHT name the browser and the folder where npm has put playwright-core and three.
// Both draw 1280 x 720 pixels by the same driver in turn, Mesa's lavapipe and Chromium's SwiftShader, which draw by the CPU. What counts is
// CPU time, all threads together: the program's process, and of Chromium the process that draws. PICTURES names a folder for what the page draws.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, realpathSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";

const [soapfilm, rounds = "3"] = process.argv.slice(2);
const MODULES = resolve(process.env.PLAYWRIGHT ?? ".");
const { chromium } = createRequire(join(MODULES, "any.js"))("playwright-core");
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const scratch = mkdtempSync(join(tmpdir(), "soapfilm-three-"));

const SIZE = [1280, 720];
// A round draws so many frames: the clock of processes ticks a hundred times a second.
const FRAMES = 10;
const TICKS_PER_S = 100;

const found = (what, files) => files.find(existsSync) ?? fail(`${what} is not installed`);
function fail(message) {
  throw new Error(message);
}

const DRIVERS = {
  lavapipe: {
    manifest: found("lavapipe", ["/usr/share/vulkan/icd.d/lvp_icd.json", `/usr/share/vulkan/icd.d/lvp_icd.${{ x64: "x86_64", arm64: "aarch64" }[process.arch]}.json`]),
    // One of Chromium's workarounds for drivers leaves lavapipe without WebGL.
    args: ["--use-gl=angle", "--use-angle=vulkan", "--ignore-gpu-blocklist", "--disable-gpu-driver-bug-workarounds"],
  },
  SwiftShader: {
    manifest: found("SwiftShader", [dirname(realpathSync(executablePath)), "/usr/lib/chromium"].map((folder) => join(folder, "vk_swiftshader_icd.json"))),
    args: ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  },
};

const median = (numbers) => numbers.toSorted((a, b) => a - b)[Math.floor(numbers.length / 2)];

/** Serves this folder and three.js on the loopback address. */
async function serve() {
  const index = `<!doctype html><link rel="icon" href="data:," />
    <script type="importmap">{ "imports": { "three": "/three/build/three.module.js" } }</script>
    <script type="module">import * as materials from "/materials.js"; window.materials = materials;</script>`;
  const server = createServer((request, response) => {
    if (request.url === "/") return response.writeHead(200, { "content-type": "text/html" }).end(index);
    const file = request.url.startsWith("/three/") ? join(MODULES, "node_modules", request.url) : join(import.meta.dirname, request.url);
    if (!existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": "text/javascript" }).end(readFileSync(file));
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  return server;
}

/** CPU seconds that a process has taken. */
function cpuSeconds(pid) {
  const [user, system] = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ").slice(11, 13).map(Number);
  return (user + system) / TICKS_PER_S;
}

/** The process of a browser that draws. */
async function drawer(browser) {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  return processInfo.find(({ type }) => type === "GPU").id;
}

/** CPU milliseconds of a frame of three.js in each material. */
async function framesOfThree(address, { manifest, args }) {
  const env = { ...process.env, VK_DRIVER_FILES: manifest, VK_ICD_FILENAMES: manifest };
  const browser = await chromium.launch({ executablePath, env, args: ["--no-sandbox", ...args] });
  const pid = await drawer(browser);
  const page = await browser.newPage();
  page.on("pageerror", (error) => console.error(String(error)));
  await page.goto(address);
  await page.waitForFunction(() => window.materials);
  const costs = {};
  for (const kind of await page.evaluate(() => window.materials.KINDS)) {
    const adapter = await page.evaluate(([kind, size]) => {
      window.drawing = window.materials.drawing(kind, size);
      window.drawing.draw(2);
      return window.drawing.adapter;
    }, [kind, SIZE]);
    if (kind === "nothing") console.log(`three.js draws by ${adapter}`);
    if (process.env.PICTURES) {
      const picture = await page.evaluate(() => window.drawing.picture());
      writeFileSync(join(process.env.PICTURES, `${kind}.png`), Buffer.from(picture.split(",")[1], "base64"));
    }
    const costs_ms = [];
    for (let round = 0; round < Number(rounds); round++) {
      const before = cpuSeconds(pid);
      await page.evaluate((frames) => window.drawing.draw(frames), FRAMES);
      costs_ms.push((1000 * (cpuSeconds(pid) - before)) / FRAMES);
    }
    costs[kind] = median(costs_ms);
  }
  await browser.close();
  return costs;
}

/** CPU milliseconds of a frame of the program: of nothing, of a mirror sphere, and of a bubble in each quality. */
function framesOfOurs({ manifest }) {
  const env = { ...process.env, VK_DRIVER_FILES: manifest, VK_ICD_FILENAMES: manifest, WGPU_BACKEND: "vulkan", LP_NUM_THREADS: "0" };
  const stats = join(scratch, "stats.json");
  const measure = (scene, ...options) => {
    const common = ["-o", join(scratch, "frame.png"), "--size", SIZE.join("x"), "--repeat", String(FRAMES), "--stats", stats];
    execFileSync(soapfilm, ["render", scene, ...common, ...options], { env, stdio: "pipe" });
    return JSON.parse(readFileSync(stats, "utf8"));
  };
  const nothing = join(scratch, "nothing.toml");
  writeFileSync(nothing, 'version = 1\nbubble = []\n[light]\nenvironment = "tent"\n[view]\nbackdrop = [0.2, 0.2, 0.2]\n');
  const costs = { nothing: measure(nothing).cpu_ms_per_frame };
  for (const quality of ["fast", "standard", "spectral"]) {
    const near = ["--set", "camera.distance_m=0.1947", "--quality", quality];
    const cost = measure("tent", ...near, ...(quality === "fast" ? ["--yardstick"] : []));
    costs.mirror ??= cost.yardstick_cpu_ms_per_frame;
    costs[quality] = cost.cpu_ms_per_frame;
  }
  costs.origin = measure("origin", "--quality", "fast").cpu_ms_per_frame;
  return costs;
}

// What a frame of ours is held against. Nothing is not: three.js clears a picture then, which costs next to nothing.
const PAIRS = [
  ["mirror", "fresnel"],
  ["fast", "transmission"],
  ["standard", "transmission"],
  ["spectral", "transmission"],
  ["origin", "crowd"],
];

const server = await serve();
try {
  for (const [name, driver] of Object.entries(DRIVERS)) {
    console.log(`\n${name}, CPU ms for a frame of ${SIZE.join(" x ")}`);
    const theirs = await framesOfThree(`http://127.0.0.1:${server.address().port}/`, driver);
    for (const [kind, ms] of Object.entries(theirs)) console.log(`  three.js, ${kind.padEnd(28)}${ms.toFixed(0).padStart(6)}`);
    const ours = framesOfOurs(driver);
    for (const [kind, ms] of Object.entries(ours)) console.log(`  soapfilm, ${kind.padEnd(28)}${ms.toFixed(0).padStart(6)}`);
    for (const [mine, other] of PAIRS) console.log(`  ${`${mine} / ${other}`.padEnd(38)}${(ours[mine] / theirs[other]).toFixed(2).padStart(6)}`);
  }
} finally {
  server.close();
  rmSync(scratch, { recursive: true });
}
