// A soap film for three.js' WebGLRenderer: spectral thin-film colours from soapfilm's table.

import {
  CustomBlending,
  DoubleSide,
  FrontSide,
  Material,
  OneFactor,
  OneMinusSrcAlphaFactor,
  ShaderMaterial,
  Vector2,
} from "three";
import { GLSL } from "./functions.js";
import { checked, checkedEnvironment, parametersOf, tableColours } from "./table.js";

export { loadFilmTable } from "./table.js";

const VERTEX = `
varying vec3 vDirection;
varying vec3 vNormalWorld;
varying mat3 vToFilm;
varying vec2 vPlace;

void main() {
  mat4 toWorld = modelMatrix;
  #ifdef USE_INSTANCING
    toWorld = modelMatrix * instanceMatrix;
  #endif
  vec4 place = toWorld * vec4(position, 1.0);
  vToFilm = transpose(mat3(toWorld));
  vNormalWorld = transpose(inverse(mat3(toWorld))) * normal;
  vDirection = isOrthographic ? -vec3(viewMatrix[0].z, viewMatrix[1].z, viewMatrix[2].z) : place.xyz - cameraPosition;
  vPlace = uv;
  gl_Position = projectionMatrix * viewMatrix * place;
}`;

const FRAGMENT = `
#include <common>
${GLSL}
uniform sampler2DArray table;
uniform float thicknessNm;
uniform sampler2D thicknessMap;
uniform vec2 thicknessRangeNm;
uniform mat3 toTable;
uniform mat3 fromTable;
uniform float environmentIntensity;
#ifdef ENVIRONMENT_CUBE
  uniform samplerCube environment;
  uniform float environmentFlip;
#else
  uniform sampler2D environment;
#endif
varying vec3 vDirection;
varying vec3 vNormalWorld;
varying mat3 vToFilm;
varying vec2 vPlace;

// Radiance from a direction of the world, linear BT.2020.
vec3 light(vec3 direction) {
  #if defined(ENVIRONMENT_CUBE)
    vec3 radiance = texture(environment, vec3(environmentFlip * direction.x, direction.yz)).rgb;
  #elif defined(ENVIRONMENT)
    vec3 radiance = textureLod(environment, equirectUv(direction), 0.0).rgb;
  #else
    vec3 radiance = vec3(0.0);
  #endif
  return toTable * (environmentIntensity * radiance);
}

float thickness(vec2 place) {
  #ifdef THICKNESS_MAP
    return mix(thicknessRangeNm.x, thicknessRangeNm.y, textureLod(thicknessMap, place, 0.0).r);
  #else
    return thicknessNm;
  #endif
}

// Where an equirectangular map shows a point of the unit sphere, given in the world.
vec2 place_on_film(vec3 point) {
  vec3 on_film = normalize(vToFilm * point);
  return vec2(atan(-on_film.z, on_film.x) * RECIPROCAL_PI2, asin(on_film.y) * RECIPROCAL_PI) + 0.5;
}

// What a wall reflects of s and of p light.
struct Wall {
  vec3 s;
  vec3 p;
};

Wall wall(float cos_theta, float thickness_nm) {
  return Wall(film_reflection_of_layer(table, 1, cos_theta, thickness_nm), film_reflection_of_layer(table, 2, cos_theta, thickness_nm));
}

Wall product(Wall a, Wall b) {
  return Wall(a.s * b.s, a.p * b.p);
}

Wall through(Wall wall) {
  return Wall(1.0 - wall.s, 1.0 - wall.p);
}

vec3 unpolarised(Wall wall) {
  return 0.5 * (wall.s + wall.p);
}

void main() {
  vec3 direction = normalize(vDirection);
  vec3 point = normalize(vNormalWorld);
  #if WALLS == 1
    point = faceforward(point, direction, point);
  #endif
  float cos_theta = clamp(-dot(direction, point), 0.0, 1.0);
  vec3 outer = light(direction + 2.0 * cos_theta * point);
  #if WALLS == 1
    Wall front = wall(cos_theta, thickness(vPlace));
    vec3 reflected = unpolarised(front) * outer;
    vec3 passed = unpolarised(through(front));
  #else
    // The mesh stands for a sphere, on which every wall is met at the same angle and in the same plane, so s and p stay apart.
    vec3 back_point = point + 2.0 * cos_theta * direction;
    vec3 inside = direction - 2.0 * cos_theta * back_point;
    vec3 exit_point = back_point + 2.0 * cos_theta * inside;
    vec3 further = inside - 2.0 * cos_theta * exit_point;
    Wall front = wall(cos_theta, thickness(place_on_film(point)));
    Wall back = wall(cos_theta, thickness(place_on_film(back_point)));
    Wall exit = wall(cos_theta, thickness(place_on_film(exit_point)));
    Wall returned = product(through(front), back);
    // What is reflected twice inside leaves at a third wall or further on; all of it is taken to leave there, so that no light is lost.
    vec3 reflected = unpolarised(front) * outer + unpolarised(product(returned, through(exit))) * light(inside)
      + unpolarised(product(returned, exit)) * light(further);
    vec3 passed = unpolarised(product(through(front), through(back)));
  #endif
  #ifdef BLENDED
    // The canvas blends by one number: that of luminance in BT.2020.
    gl_FragColor = vec4(fromTable * reflected, 1.0 - dot(passed, vec3(0.2627, 0.6780, 0.0593)));
  #else
    gl_FragColor = vec4(fromTable * (reflected + passed * light(direction)), 1.0);
  #endif
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}`;

/** A bubble of two walls, or a film in a frame; see soap-film.d.ts. */
export class SoapFilmMaterial extends ShaderMaterial {
  constructor(parameters) {
    const { table, walls, transparent, environment, thicknessMap, thicknessNm, thicknessRangeNm, environmentIntensity } =
      checked(parameters);
    const { toTable, fromTable } = tableColours();
    const values = { table, thicknessNm, thicknessMap: null, toTable, fromTable, environment: null, environmentIntensity };
    const own = { thicknessRangeNm: new Vector2(...thicknessRangeNm), environmentFlip: 1 };
    super({
      name: "SoapFilmMaterial",
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: Object.fromEntries(Object.entries({ ...values, ...own }).map(([name, value]) => [name, { value }])),
      defines: { WALLS: walls },
      side: walls === 1 ? DoubleSide : FrontSide,
      transparent,
      depthWrite: !transparent,
      blending: CustomBlending,
      blendSrc: OneFactor,
      blendDst: OneMinusSrcAlphaFactor,
    });
    this.#define("BLENDED", transparent);
    this.environment = environment;
    this.thicknessMap = thicknessMap;
  }

  get table() {
    return this.uniforms.table.value;
  }
  get walls() {
    return this.defines.WALLS;
  }

  get thicknessNm() {
    return this.uniforms.thicknessNm.value;
  }
  set thicknessNm(value) {
    this.uniforms.thicknessNm.value = value;
  }

  get thicknessMap() {
    return this.uniforms.thicknessMap.value;
  }
  set thicknessMap(texture) {
    this.uniforms.thicknessMap.value = texture;
    this.#define("THICKNESS_MAP", texture);
  }

  get thicknessRangeNm() {
    return this.uniforms.thicknessRangeNm.value.toArray();
  }
  set thicknessRangeNm(range) {
    this.uniforms.thicknessRangeNm.value.fromArray(range);
  }

  get environment() {
    return this.uniforms.environment.value;
  }
  set environment(texture) {
    this.uniforms.environment.value = checkedEnvironment(texture);
    // Pictures of cube maps are handed to WebGL with left and right exchanged, those that were rendered are not.
    this.uniforms.environmentFlip.value = texture?.isRenderTargetTexture ? 1 : -1;
    this.#define("ENVIRONMENT", texture);
    this.#define("ENVIRONMENT_CUBE", texture?.isCubeTexture);
  }

  get environmentIntensity() {
    return this.uniforms.environmentIntensity.value;
  }
  set environmentIntensity(value) {
    this.uniforms.environmentIntensity.value = value;
  }

  clone() {
    return Material.prototype.copy.call(new SoapFilmMaterial(parametersOf(this)), this);
  }

  #define(name, value) {
    if (Boolean(value) === name in this.defines) return;
    if (value) this.defines[name] = "";
    else delete this.defines[name];
    this.needsUpdate = true;
  }
}
