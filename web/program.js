// Loads the program: in the page, and again in a worker, which computes what would hold the page up.

import init, { employ } from "./soapfilm.js";

async function compiled() {
  const answer = fetch(new URL("./soapfilm_bg.wasm", import.meta.url));
  try {
    return await WebAssembly.compileStreaming(answer.then((response) => response.clone()));
  } catch {
    // The server gives the file another type.
    return WebAssembly.compile(await (await answer).arrayBuffer());
  }
}

export async function load() {
  const module = await compiled();
  await init({ module_or_path: module });
  try {
    const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    worker.postMessage(module);
    employ(worker);
  } catch (error) {
    console.warn(`soapfilm has no worker: ${error}`);
  }
}
