import { NodeMaterial, type CubeTexture, type DataArrayTexture, type Texture } from "three/webgpu";
import type { SoapFilmParameters } from "./soap-film.js";

export { loadFilmTable } from "./soap-film.js";
export type { SoapFilmParameters } from "./soap-film.js";

/** `SoapFilmMaterial` for `WebGPURenderer`, with either of its backends. Rotations of instances do not turn a thickness map. */
export class SoapFilmNodeMaterial extends NodeMaterial {
  constructor(parameters: SoapFilmParameters);
  readonly table: DataArrayTexture;
  readonly walls: 1 | 2;
  thicknessNm: number;
  thicknessMap: Texture | null;
  thicknessRangeNm: [number, number];
  environment: Texture | CubeTexture | null;
  environmentIntensity: number;
}
