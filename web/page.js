// The page around the program: reads the address, tells how far the picture is, and takes dropped files.
//
// ?scene=NAME&time=SECONDS&size=WxH&ui=0&pause=1, and #scene=… with a whole scene in it.

import { load } from "./program.js";
import { SoapBubble, keepFile, nameTabs, sceneOfLink } from "./soapfilm.js";

const ADVICE =
  "This browser has no WebGPU, which soapfilm draws with. Use Chrome or Edge 113, Safari 26, or Firefox 141 or newer, with " +
  "hardware acceleration switched on, and open the page by https:// or from localhost. The picture above was made by soapfilm.";

const canvas = document.getElementById("soapfilm");
const message = document.getElementById("soapfilm-message");

function tell(state, text) {
  document.documentElement.dataset.soapfilm = state;
  message.textContent = state === "loading" ? "Loading…" : text;
}

function fail(text) {
  tell("error", text);
}

async function hasWebGpu() {
  return Boolean(navigator.gpu && (await navigator.gpu.requestAdapter()));
}

// The canvas has so many pixels of the screen.
function resize(size) {
  const [, width, height] = /^(\d+)x(\d+)$/.exec(size) ?? [];
  if (!width) throw new Error(`size=${size}: give width and height in pixels, such as size=1280x720`);
  canvas.style.width = `${width / devicePixelRatio}px`;
  canvas.style.height = `${height / devicePixelRatio}px`;
}

async function keepAll(files) {
  for (const file of files) keepFile(file.name, new Uint8Array(await file.arrayBuffer()));
  // A scene finds the other files by their names.
  return (files.find((file) => file.name.endsWith(".toml")) ?? files[0])?.name;
}

function takeDroppedFiles(bubble) {
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", async (event) => {
    event.preventDefault();
    const name = await keepAll([...event.dataTransfer.files]);
    if (name) bubble.open(name);
  });
}

// A lock tells other tabs that this one is open, so that its unsaved work is not taken for left. Browsers have locks where the page is safe.
async function nameTab() {
  if (!navigator.locks) return;
  const own = crypto.randomUUID();
  await new Promise((held) => navigator.locks.request(own, () => (held(), new Promise(() => {}))));
  const { held } = await navigator.locks.query();
  nameTabs(own, held.map((lock) => lock.name));
}

// The scene that the address holds, or the one that it names.
function sceneName(query) {
  const toml = sceneOfLink(location.hash);
  if (toml === undefined) return query.get("scene") ?? "default";
  keepFile("link.toml", new TextEncoder().encode(toml));
  return "link.toml";
}

async function main() {
  tell("loading", "");
  if (!(await hasWebGpu())) {
    document.documentElement.classList.add("without");
    return fail(ADVICE);
  }
  const query = new URLSearchParams(location.search);
  if (query.has("size")) resize(query.get("size"));
  await load();
  await nameTab();
  const bubble = await SoapBubble.show(canvas, sceneName(query), query.get("ui") !== "0", tell);
  bubble.pause(query.get("pause") === "1");
  const time = Number(query.get("time") ?? 0);
  if (!(time >= 0)) throw new Error(`time=${query.get("time")}: give seconds, 0 or more`);
  bubble.seek(time);
  takeDroppedFiles(bubble);
  window.soapfilm = bubble;
}

main().catch((error) => fail(error.message ?? String(error)));
