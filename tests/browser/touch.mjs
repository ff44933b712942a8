// Fingers on the page, as Chromium's own input has them.

import assert from "node:assert/strict";

import { SCENE, frames, link, ready, settle, ticks, toml, until } from "./tools.mjs";

/** Moves fingers in a few steps, and waits at each: `places(part)` are theirs for a part from 0 to 1. */
async function fingers(page, places, wait = frames) {
  const devtools = await page.context().newCDPSession(page);
  const touch = (type, places) =>
    devtools.send("Input.dispatchTouchEvent", { type, touchPoints: places.map(([x, y], id) => ({ x, y, id })) });
  await touch("touchStart", places(0));
  for (let k = 1; k <= 4; k++) {
    await wait(page);
    await touch("touchMove", places(k / 4));
  }
  await wait(page);
  await touch("touchEnd", []);
}

const oneFinger = (page, wait) => fingers(page, (part) => [[300 + 120 * part, 300]], wait);

/** A number of the scene. */
const value = async (page, key) => Number(new RegExp(`^${key} = (.*)$`, "m").exec(await toml(page))?.[1]);

export const TOUCH_TESTS = {
  async "one finger turns the view, or stirs, and two fingers zoom"({ page, address }) {
    await page.goto(link(address, SCENE));
    await ready(page);
    const begun = await toml(page);
    await oneFinger(page);
    await until(page, `(toml) => toml !== ${JSON.stringify(begun)}`);
    await settle(page);
    await page.keyboard.press("2");
    await page.keyboard.press("Space");
    await settle(page);
    await oneFinger(page, ticks);
    await until(page, '(toml) => toml.includes("[[event]]")');
    await settle(page);

    const [azimuth_deg, distance_m] = [await value(page, "azimuth_deg"), await value(page, "distance_m")];
    assert(Number.isFinite(azimuth_deg), await toml(page));
    await fingers(page, (part) => [
      [300 - 60 * part, 300],
      [340 + 60 * part, 300],
    ]);
    await settle(page);
    assert.equal(await value(page, "azimuth_deg"), azimuth_deg, "two fingers do not turn the view");
    // Fingers 160 pixels apart that were 40 apart.
    const nearer = distance_m / (await value(page, "distance_m"));
    assert(nearer > 2, `${nearer} times nearer: ${await toml(page)}`);
  },
};
