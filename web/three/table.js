// The table of film colours that stands beside this file, as three.js takes it.

import { ColorManagement, DataArrayTexture, HalfFloatType, LinearFilter, Matrix3 } from "three";
import { LinearRec2020ColorSpaceImpl } from "three/addons/math/ColorSpaces.js";

/** Loads this package's table, from another address where a bundler has moved it. */
export async function loadFilmTable(address = new URL("./film.bin", import.meta.url)) {
  const { columns, rows, layers, format } = await (await answer(String(address).replace(/\.bin$/, ".json"))).json();
  if (format !== "rgba16float") throw new Error(`${address}: texels are ${format}; write the table without --float32`);
  const texels = new Uint16Array(await (await answer(address)).arrayBuffer());
  if (texels.length !== 4 * columns * rows * layers.length) throw new Error(`${address}: ${texels.length} numbers do not fill it`);
  const table = new DataArrayTexture(texels, columns, rows, layers.length);
  table.type = HalfFloatType;
  table.magFilter = table.minFilter = LinearFilter;
  table.needsUpdate = true;
  return table;
}

async function answer(address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
  return answer;
}

/** Matrices from three.js' working colour space to the table's, linear BT.2020, and back. */
export function tableColours() {
  const working = ColorManagement.spaces[ColorManagement.workingColorSpace];
  const table = LinearRec2020ColorSpaceImpl;
  return {
    toTable: new Matrix3().multiplyMatrices(table.fromXYZ, working.toXYZ),
    fromTable: new Matrix3().multiplyMatrices(working.fromXYZ, table.toXYZ),
  };
}

const DEFAULTS = {
  walls: 2,
  thicknessNm: 400,
  thicknessMap: null,
  thicknessRangeNm: [0, 1],
  environment: null,
  environmentIntensity: 1,
  transparent: false,
};

/** Parameters with defaults, refused where they cannot be meant. */
export function checked(parameters) {
  const { table, ...own } = { ...DEFAULTS, ...parameters };
  if (!table?.isDataArrayTexture) throw new TypeError("table: give what loadFilmTable() answers");
  if (own.walls !== 1 && own.walls !== 2) throw new RangeError(`walls: ${own.walls}; a bubble has 2, a film in a frame 1`);
  return { table, ...own };
}

/** What a material was made with, and set to since. */
export function parametersOf(material) {
  return Object.fromEntries(["table", ...Object.keys(DEFAULTS)].map((name) => [name, material[name]]));
}

/** An environment that can be mirrored sharply: a cube map, or an equirectangular picture. */
export function checkedEnvironment(texture) {
  if (texture?.isPMREMTexture) throw new TypeError("environment: a film is a mirror; give the texture itself, not its PMREM");
  return texture;
}
