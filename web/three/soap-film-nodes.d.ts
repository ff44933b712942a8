import { NodeMaterial } from "three/webgpu";
import type { SoapFilm, SoapFilmParameters } from "./soap-film.js";

export { loadFilmTable } from "./soap-film.js";
export type { SoapFilm, SoapFilmParameters } from "./soap-film.js";

/** `SoapFilmMaterial` for `WebGPURenderer`, with either of its backends. Rotations of instances do not turn a thickness map. */
export class SoapFilmNodeMaterial extends NodeMaterial {
  constructor(parameters: SoapFilmParameters);
}
export interface SoapFilmNodeMaterial extends SoapFilm {}
