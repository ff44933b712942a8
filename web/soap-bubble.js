// <soap-bubble scene="windows" time="2" controls></soap-bubble>: soap bubbles in any page.

import { load as loadProgram } from "./program.js";
import { SoapBubble, keepFile } from "./soapfilm.js";

const STYLE = `
  :host { display: inline-block; position: relative; width: 300px; height: 200px; background: #0e0e0e; }
  :host([hidden]) { display: none; }
  canvas { display: block; width: 100%; height: 100%; outline-offset: -2px; }
  p { position: absolute; inset: 0; margin: 0; padding: 1em; color: #c8c8c8; font: 14px/1.5 system-ui, sans-serif; }
`;

const ADVICE = "Soap bubbles need WebGPU: use Chrome or Edge 113, Safari 26, or Firefox 141 or newer.";

let program;

/** Loads the program, once for all elements of a page. */
function load() {
  program ??= (async () => {
    if (!(navigator.gpu && (await navigator.gpu.requestAdapter()))) throw new Error(ADVICE);
    await loadProgram();
  })();
  return program;
}

/** The name of a built-in scene, or of a file that is fetched: an address that ends in .toml. */
async function sceneName(scene) {
  if (!scene.endsWith(".toml")) return scene;
  const answer = await fetch(scene);
  if (!answer.ok) throw new Error(`${scene}: ${answer.status} ${answer.statusText}`);
  keepFile(scene, new Uint8Array(await answer.arrayBuffer()));
  return scene;
}

/** Soap bubbles with correct thin-film interference. */
export class SoapBubbleElement extends HTMLElement {
  static observedAttributes = ["scene", "time", "paused", "controls"];

  #bubble = null;
  #canvas = null;
  #message = null;
  #isInView = true;
  #views = new IntersectionObserver((entries) => {
    this.#isInView = entries.at(-1).isIntersecting;
    this.#applyPause();
  });

  /** A built-in scene's name, or the address of a scene file. */
  get scene() {
    return this.getAttribute("scene") ?? "default";
  }
  set scene(value) {
    this.setAttribute("scene", value);
  }

  /** Time of the film, s. */
  get time() {
    return this.#bubble?.time ?? Number(this.getAttribute("time") ?? 0);
  }
  set time(value) {
    this.setAttribute("time", value);
  }

  /** Whether time stands. */
  get paused() {
    return this.hasAttribute("paused");
  }
  set paused(value) {
    this.toggleAttribute("paused", Boolean(value));
  }

  /** Whether the pointer turns, shifts and zooms the view. */
  get controls() {
    return this.hasAttribute("controls");
  }
  set controls(value) {
    this.toggleAttribute("controls", Boolean(value));
  }

  /** The scene with all that was done to it, as a scene file has it. */
  toToml() {
    return this.#bubble?.toToml() ?? "";
  }

  connectedCallback() {
    const root = this.shadowRoot ?? this.attachShadow({ mode: "open" });
    root.innerHTML = `<style>${STYLE}</style><canvas tabindex="0"></canvas><p role="status"></p>`;
    this.#canvas = root.querySelector("canvas");
    this.#message = root.querySelector("p");
    this.#applyControls();
    this.#start(this.#canvas).catch((error) => this.#tell("error", error.message ?? String(error)));
  }

  disconnectedCallback() {
    this.#views.disconnect();
    this.#bubble?.remove();
    this.#bubble?.free();
    this.#bubble = this.#canvas = null;
  }

  attributeChangedCallback(name, _, value) {
    if (name === "controls" && this.#canvas) this.#applyControls();
    if (!this.#bubble) return;
    if (name === "scene") this.#load(this.scene).catch((error) => this.#tell("error", error.message));
    if (name === "time") this.#bubble.seek(Number(value ?? 0));
    if (name === "paused") this.#applyPause();
  }

  async #start(canvas) {
    await load();
    const name = await sceneName(this.scene);
    // Taken off the page meanwhile.
    if (canvas !== this.#canvas) return;
    const bubble = await SoapBubble.show(canvas, name, false, (state, text) => this.#tell(state, text));
    if (canvas !== this.#canvas) {
      bubble.remove();
      return bubble.free();
    }
    this.#bubble = bubble;
    this.#bubble.seek(Number(this.getAttribute("time") ?? 0));
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.paused = true;
    this.#applyPause();
    this.#views.observe(this);
  }

  async #load(scene) {
    await this.#bubble.load(await sceneName(scene));
  }

  #applyPause() {
    this.#bubble?.pause(this.paused || !this.#isInView);
  }

  #applyControls() {
    this.#canvas.style.pointerEvents = this.controls ? "" : "none";
    this.#canvas.style.touchAction = this.controls ? "none" : "";
    this.#canvas.tabIndex = this.controls ? 0 : -1;
  }

  #tell(state, text) {
    this.dataset.state = state;
    this.#message.textContent = state === "error" ? text : "";
    this.dispatchEvent(new CustomEvent(state === "error" ? "bubble-error" : state, { detail: text }));
  }
}

customElements.define("soap-bubble", SoapBubbleElement);
