/** Soap bubbles with correct thin-film interference: `<soap-bubble scene="windows" time="2" controls>`. Needs WebGPU. */
export class SoapBubbleElement extends HTMLElement {
  /** A built-in scene's name (`default`), or the address of a scene file that ends in `.toml`. */
  scene: string;
  /** Time of the film in seconds from its start. */
  time: number;
  /** Whether time stands. Set at first where `prefers-reduced-motion` asks for it. */
  paused: boolean;
  /** Whether the pointer turns, shifts and zooms the view. */
  controls: boolean;
  /** The scene with all that was done to it, as a scene file has it; empty before the first picture. */
  toToml(): string;

  /** `loading` and `ready` tell of the picture that is wanted; `bubble-error` has a text that says what is wrong. */
  addEventListener(type: "loading" | "ready", listener: (event: CustomEvent<"">) => void): void;
  addEventListener(type: "bubble-error", listener: (event: CustomEvent<string>) => void): void;
  addEventListener<K extends keyof HTMLElementEventMap>(
    type: K,
    listener: (event: HTMLElementEventMap[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

declare global {
  interface HTMLElementTagNameMap {
    "soap-bubble": SoapBubbleElement;
  }
}
