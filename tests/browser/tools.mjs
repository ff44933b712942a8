// What the tests of the page do with it.

import assert from "node:assert/strict";
import { resolve } from "node:path";
import { deflateRawSync } from "node:zlib";

/** Where npm has put modules. */
export const MODULES = resolve(process.env.PLAYWRIGHT ?? ".");

// Software machines are slow, and the gate runs on few cores.
export const PATIENCE_MS = 120_000;

// Soap films of few cells in even light, which cost little.
export const SCENE = `version = 1
[light]
constant = [1.0, 1.0, 1.0]
[[bubble]]
[bubble.film]
cells = 64
`;

/** The greatest difference of two PNG files, in levels of 8 bits, and how many pixels differ by more than 2. */
export function difference(page, pngs) {
  const texts = pngs.map((png) => `data:image/png;base64,${png.toString("base64")}`);
  return page.evaluate(async (texts) => {
    const pixels = async (text) => {
      const picture = await createImageBitmap(await (await fetch(text)).blob(), { colorSpaceConversion: "none" });
      const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
      context.drawImage(picture, 0, 0);
      return context.getImageData(0, 0, picture.width, picture.height);
    };
    const [a, b] = await Promise.all(texts.map(pixels));
    if (a.width !== b.width || a.height !== b.height) return { sizes: [a.width, a.height, b.width, b.height] };
    const differences = a.data.map((value, at) => Math.abs(value - b.data[at]));
    return { max: differences.reduce((x, y) => Math.max(x, y)), above2: differences.filter((d) => d > 2).length };
  }, texts);
}

export const state = (page) => page.evaluate(() => document.documentElement.dataset.soapfilm);

/** Waits until a page's picture is there, or fails with its message. */
export async function ready(page) {
  await page.waitForFunction(() => ["ready", "error"].includes(document.documentElement.dataset.soapfilm), null, {
    timeout: PATIENCE_MS,
  });
  assert.equal(await state(page), "ready", await page.textContent("#soapfilm-message"));
}

export const toml = (page) => page.evaluate(() => window.soapfilm.toToml());

/** Waits until the scene's TOML passes a test. */
export function until(page, condition) {
  return page.waitForFunction(`(${condition})(window.soapfilm.toToml())`, null, { timeout: PATIENCE_MS, polling: 200 });
}

/** Waits until the page has had time for what it was told. */
export async function settle(page) {
  await page.waitForTimeout(1000);
  await frames(page);
}

/** Waits until the page has drawn what it was told: a press and a move in one frame are no drag. */
export async function frames(page) {
  await page.waitForTimeout(150);
  await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
}

/** Waits until film time has passed: only what lasts in that stirs a film, and a slow machine needs long for a tick. */
export async function ticks(page) {
  await frames(page);
  const begun = await page.evaluate(() => window.soapfilm.time);
  await page.waitForFunction((begun) => window.soapfilm.time > begun, begun, { timeout: PATIENCE_MS });
}

/** Drags the pointer, and waits at each step. */
export async function drag(page, [x, y], [dx, dy], wait = frames) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 4; k++) {
    await wait(page);
    await page.mouse.move(x + (k * dx) / 4, y + (k * dy) / 4);
  }
  await wait(page);
  await page.mouse.up();
}

/** Drops a file on the page. */
export function drop(page, name, text) {
  return page.evaluate(
    ([name, text]) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([text], name));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    },
    [name, text],
  );
}

/** The address of a page that shows a scene, with time paused. */
export function link(address, toml, query = "") {
  return `${address}/?pause=1${query}#scene=${deflateRawSync(toml).toString("base64url")}`;
}
