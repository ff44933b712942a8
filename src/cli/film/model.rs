//! A bubble as a glTF model: a sphere whose material has the film's thickness as the texture of `KHR_materials_iridescence`.

use std::{io::Write, path::Path};

use anyhow::Context;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use crate::{
    export::map::equirect,
    output::{Metadata, PngPicture, write_atomically, write_text},
    physics::colour::Gamut,
};

/// Quads around the sphere, and from pole to pole.
const SECTORS: u32 = 128;
const RINGS: u32 = 64;

/// A bubble to be written.
pub struct Model<'a> {
    /// Radius in metres.
    pub radius_m: f64,
    /// Refractive index of the film.
    pub index: f64,
    /// Width and height in pixels of the map.
    pub size: [u32; 2],
    /// Equirectangular map of the thickness in nm, row by row from the top left.
    pub thickness_nm: &'a [f64],
    /// Metadata of the map's PNG.
    pub metadata: &'a Metadata,
}

impl Model<'_> {
    /// Writes the model, its mesh and its texture, which stand beside it: `NAME.gltf`, `NAME.bin` and `NAME_thickness.png`. Returns the step of the
    /// texture in nm: its values are within half of that.
    pub fn save(&self, path: &Path) -> anyhow::Result<f64> {
        let stem = path.file_stem().and_then(|stem| stem.to_str()).context("the name of the model is not UTF-8")?;
        let (mesh_name, texture_name) = (format!("{stem}.bin"), format!("{stem}_thickness.png"));
        let [low, high] = self.range_nm();
        let mesh = Mesh::new(self.radius_m);
        let rgba: Vec<u8> = self.thickness_nm.iter().flat_map(|nm| texel((nm - low) / (high - low))).collect();
        let [width, height] = self.size;
        let texture = PngPicture { width, height, rgba: &rgba, gamut: Gamut::Srgb, metadata: self.metadata };
        texture.save(&path.with_file_name(&texture_name))?;
        write_atomically(&path.with_file_name(&mesh_name), |file| file.write_all(&mesh.bytes()))?;
        let document = self.document(stem, [&mesh_name, &texture_name], &mesh);
        write_text(path, &format!("{document:#}\n"))?;
        Ok((high - low) / 255.0)
    }

    /// The thicknesses of the texture's values 0 and 255, in nm.
    fn range_nm(&self) -> [f64; 2] {
        let fold = |[low, high]: [f64; 2], nm: &f64| [low.min(*nm), high.max(*nm)];
        let [low, high] = self.thickness_nm.iter().fold([f64::INFINITY, 0.0], fold);
        [low.min(high).floor(), high.ceil().max(low.min(high).floor() + 1.0)]
    }

    fn document(&self, name: &str, [mesh_name, texture_name]: [&str; 2], mesh: &Mesh) -> Value {
        let [low, high] = self.range_nm();
        let (vertices, indices) = (mesh.vertices.len(), mesh.indices.len());
        let view = |offset: usize, length: usize, target: u32| json!({"buffer": 0, "byteOffset": offset, "byteLength": length, "target": target});
        let r = self.radius_m as f32;
        json!({
            "asset": {"version": "2.0", "generator": concat!("soapfilm ", env!("CARGO_PKG_VERSION"))},
            "extensionsUsed": ["KHR_materials_iridescence", "KHR_materials_ior", "KHR_materials_transmission"],
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "name": name}],
            "meshes": [{"name": name, "primitives": [{
                "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0,
            }]}],
            "materials": [{
                "name": "soap film",
                "doubleSided": true,
                "pbrMetallicRoughness": {"baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.0},
                "extensions": {
                    // Air behind the film too: without a film, nothing is reflected.
                    "KHR_materials_ior": {"ior": 1.0},
                    "KHR_materials_transmission": {"transmissionFactor": 1.0},
                    "KHR_materials_iridescence": {
                        "iridescenceFactor": 1.0,
                        "iridescenceIor": self.index,
                        "iridescenceThicknessMinimum": low,
                        "iridescenceThicknessMaximum": high,
                        "iridescenceThicknessTexture": {"index": 0},
                    },
                },
            }],
            "textures": [{"source": 0, "sampler": 0}],
            "images": [{"uri": texture_name, "mimeType": "image/png"}],
            // Linear; around the sphere the map repeats, at the poles it ends.
            "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 33071}],
            "buffers": [{"uri": mesh_name, "byteLength": mesh.bytes().len()}],
            "bufferViews": [
                view(0, 12 * vertices, 34962),
                view(12 * vertices, 12 * vertices, 34962),
                view(24 * vertices, 8 * vertices, 34962),
                view(32 * vertices, 4 * indices, 34963),
            ],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3", "min": [-r, -r, -r], "max": [r, r, r]},
                {"bufferView": 1, "componentType": 5126, "count": vertices, "type": "VEC3"},
                {"bufferView": 2, "componentType": 5126, "count": vertices, "type": "VEC2"},
                {"bufferView": 3, "componentType": 5125, "count": indices, "type": "SCALAR"},
            ],
        })
    }
}

/// A texel whose green channel, which the extension reads, is a part of the range.
fn texel(part: f64) -> [u8; 4] {
    let value = (255.0 * part).round().clamp(0.0, 255.0) as u8;
    [value, value, value, u8::MAX]
}

/// A sphere around the origin, +y up as in all of glTF.
struct Mesh {
    radius_m: f64,
    /// Normals and places on the map.
    vertices: Vec<(DVec3, DVec2)>,
    indices: Vec<u32>,
}

impl Mesh {
    fn new(radius_m: f64) -> Self {
        let columns = SECTORS + 1;
        let place =
            |k: u32| DVec2::new(f64::from(k % columns) / f64::from(SECTORS), f64::from(k / columns) / f64::from(RINGS));
        let to_gltf = |direction: DVec3| DVec3::new(direction.x, direction.z, -direction.y);
        let vertices = (0..columns * (RINGS + 1)).map(place).map(|place| (to_gltf(equirect(place)), place)).collect();
        let quads = (0..RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| (ring, ring * columns + sector)));
        let triangles = quads.flat_map(|(ring, k)| {
            let (below, right) = (k + columns, k + columns + 1);
            // Counter-clockwise from outside; at the poles one of the two has no area.
            let upper = [k, right, k + 1];
            let lower = [k, below, right];
            [(ring > 0).then_some(upper), (ring + 1 < RINGS).then_some(lower)].into_iter().flatten().flatten()
        });
        Self { radius_m, vertices, indices: triangles.collect() }
    }

    /// Positions, normals, places on the map, then indices.
    fn bytes(&self) -> Vec<u8> {
        let positions = self.vertices.iter().flat_map(|(normal, _)| (self.radius_m * *normal).as_vec3().to_array());
        let normals = self.vertices.iter().flat_map(|(normal, _)| normal.as_vec3().to_array());
        let places = self.vertices.iter().flat_map(|(_, place)| place.as_vec2().to_array());
        let floats = positions.chain(normals).chain(places).flat_map(f32::to_le_bytes);
        floats.chain(self.indices.iter().flat_map(|index| index.to_le_bytes())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sphere_is_closed_and_faces_outwards() {
        let mesh = Mesh::new(0.05);
        let at = |index: &u32| mesh.vertices[*index as usize].0;
        let mut area = 0.0;
        for triangle in mesh.indices.chunks(3) {
            let [a, b, c] = [at(&triangle[0]), at(&triangle[1]), at(&triangle[2])];
            let across = 0.5 * (b - a).cross(c - a);
            assert!(across.dot(a + b + c) > 0.0, "{triangle:?}");
            area += across.length();
        }
        let sphere = 4.0 * std::f64::consts::PI;
        // So many flat triangles are within a thousandth of it.
        assert!((area / sphere - 1.0).abs() < 1e-3, "{area}");
        assert_eq!(mesh.bytes().len(), 32 * mesh.vertices.len() + 4 * mesh.indices.len());
    }

    #[test]
    fn the_texture_holds_the_thickness() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.gltf");
        let thickness_nm: Vec<f64> = (0..32).map(|k| 100.3 + 20.0 * f64::from(k)).collect();
        let metadata = Metadata::new();
        let model =
            Model { radius_m: 0.05, index: 1.333, size: [8, 4], thickness_nm: &thickness_nm, metadata: &metadata };
        let step_nm = model.save(&path).unwrap();
        let document: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let film = &document["materials"][0]["extensions"]["KHR_materials_iridescence"];
        let [low, high] =
            ["Minimum", "Maximum"].map(|end| film[format!("iridescenceThickness{end}")].as_f64().unwrap());
        let texture = crate::output::read_back::read_png(&folder.path().join("film_thickness.png")).unwrap();
        for (pixel, nm) in texture.rgba.chunks(4).zip(&thickness_nm) {
            let shown_nm = low + (high - low) * f64::from(pixel[1]) / 255.0;
            assert!((shown_nm - nm).abs() <= 0.5 * step_nm + 1e-9, "{shown_nm} for {nm}");
        }
        let length = document["buffers"][0]["byteLength"].as_u64().unwrap();
        assert_eq!(std::fs::metadata(folder.path().join("film.bin")).unwrap().len(), length);
    }
}
