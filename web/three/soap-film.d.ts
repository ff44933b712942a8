import { ShaderMaterial, type CubeTexture, type DataArrayTexture, type Texture } from "three";

/** What a soap film is made with. */
export interface SoapFilmParameters {
  /** The table of film colours: see `loadFilmTable`. */
  table: DataArrayTexture;
  /** 2 for a bubble, whose mesh stands for a sphere and shows both of its walls; 1 for a film on any mesh. Default 2. */
  walls?: 1 | 2;
  /** Thickness of an even film in nm, 0 to 1500. Default 400. */
  thicknessNm?: number;
  /**
   * The film's thickness in its red channel, between the ends of `thicknessRangeNm`. For 2 walls an equirectangular map of the whole film, such
   * as `soapfilm film -o film.exr` writes; for 1 wall a texture at the mesh's `uv`.
   */
  thicknessMap?: Texture | null;
  /** Thickness in nm where the map is 0 and where it is 1. Default [0, 1], for maps in nm. */
  thicknessRangeNm?: [number, number];
  /** What the film mirrors: a cube map or an equirectangular picture, linear. */
  environment?: Texture | CubeTexture | null;
  /** Factor on the environment's radiance. Default 1. */
  environmentIntensity?: number;
  /**
   * False: the environment is seen through the film, in the colours that the film leaves of it. True: the film is blended over what is drawn,
   * which one number for all colours dims. Default false; it cannot be changed later.
   */
  transparent?: boolean;
}

/** What can be read from a material of a soap film, and set. */
export interface SoapFilm {
  readonly table: DataArrayTexture;
  readonly walls: 1 | 2;
  thicknessNm: number;
  thicknessMap: Texture | null;
  thicknessRangeNm: [number, number];
  environment: Texture | CubeTexture | null;
  environmentIntensity: number;
}

/** A soap film for `WebGLRenderer`. Lights of the scene do not act on it: a film mirrors, and its light is the environment. */
export class SoapFilmMaterial extends ShaderMaterial {
  constructor(parameters: SoapFilmParameters);
}
export interface SoapFilmMaterial extends SoapFilm {}

/** Loads the table of film colours, water in daylight (D65), from beside this file, or from where a bundler has put `film.bin` and `film.json`. */
export function loadFilmTable(address?: string | URL): Promise<DataArrayTexture>;
