// A sphere in materials of three.js, or many of them, drawn again and again: what `run.mjs` measures. The canvas is on no page, so that nothing is
// composed.

import * as THREE from "three";

// As the program's preset `tent` seen from near: a bubble of 10 cm that covers 99 % of the picture's height.
const RADIUS_M = 0.05;
const DISTANCE_M = 0.1947;
const FOV_Y_DEG = 30;
// As the program's preset `origin`: spheres of 10 to 40 cm in a cube of 10 m, and the camera near its middle.
const CROWD = { count: 500, seed: 1, size_m: 10, radii_m: [0.1, 0.4], distance_m: 3.2, fov_y_deg: 60 };

/** Bright cloth with three lamps and a dark floor, as an equirectangular panorama. */
function panorama() {
  const [width, height] = [1024, 512];
  const data = new Uint16Array(4 * width * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const [u, v] = [x / width, y / height];
      const lamp = v > 0.55 && v < 0.8 && (3 * u) % 1 < 0.25;
      const radiance = lamp ? 8 : v < 0.4 ? 0.2 : 0.7 + 0.2 * Math.sin(40 * u);
      const texel = [radiance, radiance, 0.9 * radiance, 1].map(THREE.DataUtils.toHalfFloat);
      data.set(texel, 4 * (y * width + x));
    }
  }
  const texture = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.HalfFloatType);
  texture.mapping = THREE.EquirectangularReflectionMapping;
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** One reflection and three refractions, one for each primary, mixed by a power of the angle: how bubbles were drawn before iridescence. */
function fresnelMaterial(cube) {
  return new THREE.ShaderMaterial({
    uniforms: { cube: { value: cube } },
    vertexShader: `
      varying vec3 reflected, red, green, blue;
      varying float part;
      void main() {
        vec3 place = (modelMatrix * vec4(position, 1.0)).xyz;
        vec3 towards = normalize(place - cameraPosition);
        vec3 outward = normalize(mat3(modelMatrix) * normal);
        reflected = reflect(towards, outward);
        red = refract(towards, outward, 1.02);
        green = refract(towards, outward, 1.02 * 0.99);
        blue = refract(towards, outward, 1.02 * 0.98);
        part = 0.1 + pow(1.0 + dot(towards, outward), 2.0);
        gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
      }`,
    fragmentShader: `
      uniform samplerCube cube;
      varying vec3 reflected, red, green, blue;
      varying float part;
      void main() {
        vec3 behind = vec3(textureCube(cube, red).r, textureCube(cube, green).g, textureCube(cube, blue).b);
        gl_FragColor = vec4(mix(behind, textureCube(cube, reflected).rgb, clamp(part, 0.0, 1.0)), 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
  });
}

const IRIDESCENT = { color: 0xffffff, roughness: 0, ior: 1.33, iridescence: 1, iridescenceIOR: 1.33, iridescenceThicknessRange: [500, 500] };

const MATERIALS = {
  mirror: () => new THREE.MeshStandardMaterial({ color: 0xffffff, metalness: 1, roughness: 0 }),
  fresnel: (cube) => fresnelMaterial(cube),
  additive: () => new THREE.MeshPhysicalMaterial({ ...IRIDESCENT, color: 0, transparent: true, blending: THREE.AdditiveBlending }),
  transmission: () => new THREE.MeshPhysicalMaterial({ ...IRIDESCENT, transmission: 1, thickness: 0 }),
  "transmission, both sides": () => new THREE.MeshPhysicalMaterial({ ...IRIDESCENT, transmission: 1, thickness: 0, side: THREE.DoubleSide }),
};

/** Numbers from 0 to 1, the same in each run. */
function* randomNumbers(seed) {
  for (let state = seed; ; ) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    yield state / 2 ** 32;
  }
}

/** Spheres of one material that fill a cube. */
function crowd(material) {
  const numbers = randomNumbers(CROWD.seed);
  const between = (low, high) => low + (high - low) * numbers.next().value;
  const geometry = new THREE.SphereGeometry(1, 64, 32);
  const group = new THREE.Group();
  for (let number = 0; number < CROWD.count; number++) {
    const sphere = new THREE.Mesh(geometry, material);
    sphere.position.set(...[0, 1, 2].map(() => between(-CROWD.size_m / 2, CROWD.size_m / 2)));
    sphere.scale.setScalar(between(...CROWD.radii_m));
    group.add(sphere);
  }
  return group;
}

/** Draws a sphere of a material, many spheres or nothing, a number of times, and waits until it is drawn. */
export function drawing(kind, [width, height]) {
  const renderer = new THREE.WebGLRenderer({ antialias: true });
  renderer.setSize(width, height, false);
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0.2, 0.2, 0.2);
  const light = panorama();
  scene.environment = new THREE.PMREMGenerator(renderer).fromEquirectangular(light).texture;
  const cube = new THREE.WebGLCubeRenderTarget(512, { type: THREE.HalfFloatType, generateMipmaps: true, minFilter: THREE.LinearMipmapLinearFilter });
  const camera = new THREE.PerspectiveCamera(FOV_Y_DEG, width / height, 0.01, 100);
  camera.position.z = DISTANCE_M;
  if (["fresnel", "crowd"].includes(kind)) cube.fromEquirectangularTexture(renderer, light);
  if (kind === "crowd") {
    scene.background = cube.texture;
    scene.add(crowd(fresnelMaterial(cube.texture)));
    camera.fov = CROWD.fov_y_deg;
    camera.position.z = CROWD.distance_m;
    camera.updateProjectionMatrix();
  } else if (kind !== "nothing") {
    scene.add(new THREE.Mesh(new THREE.SphereGeometry(RADIUS_M, 64, 32), MATERIALS[kind](cube.texture)));
  }
  const gl = renderer.getContext();
  const pixel = new Uint8Array(4);
  return {
    adapter: gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL),
    draw(frames) {
      for (let frame = 0; frame < frames; frame++) {
        renderer.render(scene, camera);
        // Drivers leave out what nobody sees: a picture that the next one covers.
        gl.readPixels(width / 2, height / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      }
    },
    picture: () => (renderer.render(scene, camera), renderer.domElement.toDataURL()),
  };
}

export const KINDS = ["nothing", ...Object.keys(MATERIALS), "crowd"];
