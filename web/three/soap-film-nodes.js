// A soap film for three.js' WebGPURenderer, as a node material: spectral thin-film colours from soapfilm's table.

import {
  CustomBlending,
  DoubleSide,
  FrontSide,
  Material,
  NodeMaterial,
  OneFactor,
  OneMinusSrcAlphaFactor,
  Vector2,
} from "three/webgpu";
import {
  Fn,
  cameraWorldMatrix,
  cubeTexture,
  dot,
  equirectUV,
  faceForward,
  float,
  glsl,
  glslFn,
  int,
  mat3,
  mix,
  modelWorldMatrix,
  normalWorldGeometry,
  positionViewDirection,
  texture,
  uniform,
  uv,
  vec2,
  vec3,
  vec4,
  wgsl,
  wgslFn,
} from "three/tsl";
import { GLSL, WGSL } from "./functions.js";
import { checked, checkedEnvironment, parametersOf, tableColours } from "./table.js";

export { loadFilmTable } from "./table.js";

const IN_WGSL = [wgsl(WGSL)];
const IN_GLSL = [glsl(GLSL)];

// The program's functions, in the language that the renderer compiles.
const FUNCTIONS = {
  wgsl: {
    place: wgslFn("fn soap_film_place(c: f32, nm: f32) -> vec2f { return film_uv(c, nm); }", IN_WGSL),
    most: wgslFn("fn soap_film_most(c: f32) -> f32 { return film_max_reflectance(c); }", IN_WGSL),
  },
  glsl: {
    place: glslFn("vec2 soap_film_place(float c, float nm) { return film_uv(c, nm); }", IN_GLSL),
    most: glslFn("float soap_film_most(float c) { return film_max_reflectance(c); }", IN_GLSL),
  },
};

// What a wall reflects, or lets through, of s and of p light.
const product = (a, b) => ({ s: a.s.mul(b.s), p: a.p.mul(b.p) });
const through = (wall) => ({ s: wall.s.oneMinus(), p: wall.p.oneMinus() });
const unpolarised = (wall) => wall.s.add(wall.p).mul(0.5);

/** A bubble of two walls, or a film in a frame; see soap-film.d.ts. */
export class SoapFilmNodeMaterial extends NodeMaterial {
  static get type() {
    return "SoapFilmNodeMaterial";
  }

  #walls;
  #table;
  #environment;
  #thicknessMap;
  #values;

  constructor(parameters) {
    super();
    const { table, walls, transparent, environment, thicknessMap, thicknessNm, thicknessRangeNm, environmentIntensity } =
      checked(parameters);
    this.#walls = walls;
    this.#table = table;
    this.#environment = checkedEnvironment(environment);
    this.#thicknessMap = thicknessMap;
    const { toTable, fromTable } = tableColours();
    this.#values = {
      thicknessNm: uniform(thicknessNm),
      thicknessRangeNm: uniform(new Vector2(...thicknessRangeNm)),
      environmentIntensity: uniform(environmentIntensity),
      toTable: uniform(toTable),
      fromTable: uniform(fromTable),
    };
    this.lights = false;
    this.side = walls === 1 ? DoubleSide : FrontSide;
    this.transparent = transparent;
    this.depthWrite = !transparent;
    this.blending = CustomBlending;
    this.blendSrc = OneFactor;
    this.blendDst = OneMinusSrcAlphaFactor;
    this.#build();
  }

  get table() {
    return this.#table;
  }
  get walls() {
    return this.#walls;
  }

  get thicknessNm() {
    return this.#values.thicknessNm.value;
  }
  set thicknessNm(value) {
    this.#values.thicknessNm.value = value;
  }

  get thicknessMap() {
    return this.#thicknessMap;
  }
  set thicknessMap(texture) {
    this.#thicknessMap = texture;
    this.#build();
  }

  get thicknessRangeNm() {
    return this.#values.thicknessRangeNm.value.toArray();
  }
  set thicknessRangeNm(range) {
    this.#values.thicknessRangeNm.value.fromArray(range);
  }

  get environment() {
    return this.#environment;
  }
  set environment(texture) {
    this.#environment = checkedEnvironment(texture);
    this.#build();
  }

  get environmentIntensity() {
    return this.#values.environmentIntensity.value;
  }
  set environmentIntensity(value) {
    this.#values.environmentIntensity.value = value;
  }

  clone() {
    return Material.prototype.copy.call(new SoapFilmNodeMaterial(parametersOf(this)), this);
  }

  #build() {
    this.fragmentNode = Fn((builder) => this.#colour(builder.renderer.backend.isWebGPUBackend ? FUNCTIONS.wgsl : FUNCTIONS.glsl))();
    this.needsUpdate = true;
  }

  // Radiance from a direction of the world, linear BT.2020.
  #light(direction) {
    const map = this.#environment;
    if (!map) return vec3(0);
    const radiance = map.isCubeTexture ? cubeTexture(map, direction) : texture(map, equirectUV(direction), float(0));
    return this.#values.toTable.mul(radiance.rgb.mul(this.#values.environmentIntensity));
  }

  #thickness(place) {
    if (!this.#thicknessMap) return this.#values.thicknessNm;
    const { x, y } = this.#values.thicknessRangeNm;
    return mix(x, y, texture(this.#thicknessMap, place, float(0)).r);
  }

  #wall(functions, cosTheta, thicknessNm) {
    const place = functions.place(cosTheta, thicknessNm).toVar();
    const most = functions.most(cosTheta).toVar();
    const layer = (index) => texture(this.#table, place, float(0)).depth(int(index)).rgb.mul(most).toVar();
    return { s: layer(1), p: layer(2) };
  }

  #colour(functions) {
    const direction = cameraWorldMatrix.mul(vec4(positionViewDirection, 0)).xyz.negate().normalize().toVar();
    const normal = normalWorldGeometry.normalize();
    const point = (this.#walls === 1 ? faceForward(normal, direction, normal) : normal).toVar();
    const cosTheta = dot(direction, point).negate().clamp(0, 1).toVar();
    const outer = this.#light(direction.add(point.mul(cosTheta).mul(2)));
    const { reflected, passed } =
      this.#walls === 1 ? this.#film(functions, cosTheta, outer) : this.#bubble(functions, direction, point, cosTheta, outer);
    const { fromTable } = this.#values;
    // The canvas blends by one number: that of luminance in BT.2020.
    if (this.transparent) return vec4(fromTable.mul(reflected), dot(passed, vec3(0.2627, 0.678, 0.0593)).oneMinus());
    return vec4(fromTable.mul(reflected.add(passed.mul(this.#light(direction)))), 1);
  }

  #film(functions, cosTheta, outer) {
    const front = this.#wall(functions, cosTheta, this.#thickness(uv()));
    return { reflected: unpolarised(front).mul(outer), passed: unpolarised(through(front)) };
  }

  // The mesh stands for a sphere, on which every wall is met at the same angle and in the same plane, so s and p stay apart.
  #bubble(functions, direction, point, cosTheta, outer) {
    const chord = cosTheta.mul(2).toVar();
    const backPoint = point.add(direction.mul(chord)).toVar();
    const inside = direction.sub(backPoint.mul(chord)).toVar();
    const exitPoint = backPoint.add(inside.mul(chord)).toVar();
    const further = inside.sub(exitPoint.mul(chord)).toVar();
    const wallAt = (point) => this.#wall(functions, cosTheta, this.#thickness(placeOnFilm(point)));
    const [front, back, exit] = [point, backPoint, exitPoint].map(wallAt);
    const returned = product(through(front), back);
    // What is reflected twice inside leaves at a third wall or further on; all of it is taken to leave there, so that no light is lost.
    const reflected = unpolarised(front)
      .mul(outer)
      .add(unpolarised(product(returned, through(exit))).mul(this.#light(inside)))
      .add(unpolarised(product(returned, exit)).mul(this.#light(further)));
    return { reflected, passed: unpolarised(product(through(front), through(back))) };
  }
}

// Where an equirectangular map shows a point of the unit sphere, given in the world.
function placeOnFilm(point) {
  const onFilm = mat3(modelWorldMatrix).transpose().mul(point).normalize().toVar();
  const { x, y, z } = onFilm;
  return vec2(z.negate().atan(x).div(2 * Math.PI), y.asin().div(Math.PI)).add(0.5);
}
