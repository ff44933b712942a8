//! The environment as the cube map that shaders sample.

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::parallel;

use super::{CubeFace, Equirect, Lamp, Repairs, Texel, mip, texel::texels_of};

/// One mip level of a [`CubeMap`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CubeLevel {
    /// Texels along the edge of each face.
    pub size: usize,
    /// The faces in the order of [`CubeFace::ALL`], each row by row from s = t = −1.
    #[serde(with = "texels")]
    pub faces: [Vec<Texel>; 6],
}

/// All texels of a level as bytes.
mod texels {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    use super::Texel;
    use crate::physics::bulk;

    pub fn serialize<S: Serializer>(faces: &[Vec<Texel>; 6], serializer: S) -> Result<S::Ok, S::Error> {
        bulk::serialize(&faces.concat(), serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[Vec<Texel>; 6], D::Error> {
        let bytes = <&[u8]>::deserialize(deserializer)?;
        let faces: Vec<_> = bytes.chunks_exact((bytes.len() / 6).max(1)).map(bytemuck::pod_collect_to_vec).collect();
        faces.try_into().map_err(|_| D::Error::custom("a cube has six faces"))
    }
}

/// Radiance from every direction, ready for `textureSampleLevel(cube, sampler, direction, lod)` with world directions as they
/// are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CubeMap {
    mips: Vec<CubeLevel>,
    lamps: Vec<Lamp>,
    id: u64,
    neutral: bool,
    contrast: f64,
    repairs: Repairs,
}

impl CubeMap {
    /// A cube map of `radiance` (linear BT.2020, from a direction that is not normalised), `size` texels to an edge, each the
    /// mean of `supersampling`² samples, with all mip levels down to one texel. A size or supersampling of 0 counts as 1.
    pub fn from_fn(size: usize, supersampling: usize, radiance: impl Fn(DVec3) -> DVec3 + Sync) -> Self {
        let (size, supersampling) = (size.max(1), supersampling.max(1));
        let mut mips = empty_mips(size);
        let (mut repairs, mut neutral) = (Repairs::default(), true);
        // One face at a time: only one then stands in memory in full precision.
        for face in CubeFace::ALL {
            let mut texels = vec![[0.0; 3]; size * size];
            repairs = repairs + fill_face(&mut texels, face, size, supersampling, &radiance);
            neutral &= texels.iter().all(is_grey);
            store_mips(&mut mips, face, texels);
        }
        let (id, contrast) = (content_id(&mips[0]), contrast(&mips));
        Self { mips, lamps: Vec::new(), id, neutral, contrast, repairs }
    }

    /// The same radiance from every direction.
    pub fn constant(radiance: DVec3) -> Self {
        Self::from_fn(1, 1, |_| radiance)
    }

    /// A panorama, with texels about as wide as its pixels; the repairs are the panorama's.
    pub fn from_equirect(panorama: &Equirect) -> Self {
        let map = Self::from_fn(size_for_panorama(panorama.width()), 2, |direction| panorama.radiance(direction));
        Self { repairs: panorama.repairs(), ..map }
    }

    /// The map with more lamps before it, which are no part of its texels.
    #[must_use]
    pub fn with_lamps(mut self, lamps: impl IntoIterator<Item = Lamp>) -> Self {
        for lamp in lamps {
            let numbers = [lamp.half_size.x, lamp.half_size.y, lamp.corner, lamp.edge].into_iter();
            let numbers = [lamp.towards, lamp.right, lamp.radiance]
                .into_iter()
                .flat_map(|vector| vector.to_array())
                .chain(numbers);
            self.id = numbers.map(f64::to_bits).fold(self.id, hashed);
            self.neutral &=
                lamp.radiance.max_element() - lamp.radiance.min_element() <= 1e-3 * lamp.radiance.max_element();
            self.lamps.push(lamp);
        }
        self
    }

    /// The lamps before the map.
    pub fn lamps(&self) -> &[Lamp] {
        &self.lamps
    }

    /// Texels along the edge of a face of the largest level.
    pub fn size(&self) -> usize {
        self.mips[0].size
    }

    /// All levels, the largest first, the last of one texel a face.
    pub fn mips(&self) -> &[CubeLevel] {
        &self.mips
    }

    /// A hash of the content: equal maps have equal ids on every machine.
    pub fn id(&self) -> u64 {
        self.id
    }

    /// Whether all of it is grey, to a thousandth.
    pub fn is_neutral(&self) -> bool {
        self.neutral
    }

    /// How many times as bright as the rest its bright parts are: the radiance that a two hundredth of its texels exceeds over their geometric
    /// mean, without the lamps. An overcast sky has 3, lamps in a dark room have hundreds or thousands.
    pub fn contrast(&self) -> f64 {
        self.contrast
    }

    /// What had to be repaired: pixels of the panorama, or texels where the map was made from a formula.
    pub fn repairs(&self) -> Repairs {
        self.repairs
    }

    /// Radiance from `direction` (of any length but zero): the lamps', and the largest level's, interpolated across the faces' edges too.
    pub fn sample(&self, direction: DVec3) -> DVec3 {
        self.lamps_from(direction, 0.0) + self.far(direction)
    }

    /// Radiance of the lamps from `direction` (of any length but zero), averaged over cones whose half angle has the tangent `defocus`.
    pub fn lamps_from(&self, direction: DVec3, defocus: f64) -> DVec3 {
        let unit = direction.normalize();
        self.lamps.iter().map(|lamp| lamp.radiance_from(unit, defocus, 0.0)).sum()
    }

    /// Radiance from `direction` (of any length but zero) without the lamps, from the largest level.
    pub fn far(&self, direction: DVec3) -> DVec3 {
        self.sample_level(0, direction)
    }

    /// Radiance from `direction` (of any length but zero) without the lamps', interpolated in one level.
    pub(super) fn sample_level(&self, level: usize, direction: DVec3) -> DVec3 {
        let level = &self.mips[level];
        let (face, st) = CubeFace::of_direction(direction);
        let position = (st + 1.0) * (level.size as f64 / 2.0) - 0.5;
        let corner = position.floor();
        let weight = position - corner;
        let tap = |x: f64, y: f64| level.texel(face, corner + DVec2::new(x, y));
        let across = |y| tap(0.0, y).lerp(tap(1.0, y), weight.x);
        across(0.0).lerp(across(1.0), weight.y)
    }

    /// The mean of the radiance over all directions, for lamps that are small: what a small diffuse sphere, lit on average, would show.
    pub fn mean_radiance(&self) -> DVec3 {
        let level = &self.mips[0];
        let rows = parallel::map(6 * level.size, |row| weighted_row(level, row));
        // Summed in order, so that equal maps have equal means to the last bit.
        let (radiance, weight) = rows.into_iter().fold((DVec3::ZERO, 0.0), |sum, row| (sum.0 + row.0, sum.1 + row.1));
        let lamps: DVec3 = self.lamps.iter().map(|lamp| lamp.area() * lamp.radiance).sum();
        radiance / weight + lamps / (4.0 * std::f64::consts::PI)
    }
}

impl CubeLevel {
    /// The texel at column and row `index` of `face`, or the neighbouring face's nearest if that lies outside.
    fn texel(&self, face: CubeFace, index: DVec2) -> DVec3 {
        let last = self.size as f64 - 1.0;
        let center = (index + 0.5) * (2.0 / self.size as f64) - 1.0;
        let inside = center.abs().max_element() < 1.0;
        let (face, st) = if inside { (face, center) } else { CubeFace::of_direction(face.direction(center)) };
        let nearest = ((st + 1.0) * (self.size as f64 / 2.0)).floor().clamp(DVec2::ZERO, DVec2::splat(last));
        self.radiance(face.layer(), nearest.y as usize * self.size + nearest.x as usize)
    }

    fn radiance(&self, layer: usize, index: usize) -> DVec3 {
        self.faces[layer][index].radiance()
    }
}

/// See [`CubeMap::is_neutral`].
fn is_grey(&[r, g, b]: &[f32; 3]) -> bool {
    let max = r.max(g).max(b);
    max - r.min(g).min(b) <= 1e-3 * max
}

/// See [`CubeMap::contrast`].
fn contrast(mips: &[CubeLevel]) -> f64 {
    // Parts a degree wide.
    const SIZE: usize = 64;
    // Black counts as this part of what is bright: it would have no logarithm.
    const DARKEST: f64 = 1e-5;
    let Some(level) = mips.iter().find(|level| level.size <= SIZE) else { return 1.0 };
    let texels = (0..6).flat_map(|layer| (0..level.size * level.size).map(move |k| (layer, k)));
    let mut radiances: Vec<f64> = texels.map(|(layer, k)| level.radiance(layer, k).max_element()).collect();
    radiances.sort_by(f64::total_cmp);
    let bright = radiances[(radiances.len() - 1) * 995 / 1000];
    if bright == 0.0 {
        return 1.0;
    }
    let logarithms: f64 = radiances.iter().map(|radiance| (radiance / bright).max(DARKEST).ln()).sum();
    (-logarithms / radiances.len() as f64).exp()
}

/// Texels for a panorama: at a face's center a texel of size s spans 2/s radians, a pixel of width w spans 2π/w.
fn size_for_panorama(width: usize) -> usize {
    let matching = (width as f64 / std::f64::consts::PI).ceil() as usize;
    matching.next_multiple_of(16).clamp(16, 2048)
}

/// Levels of the sizes that the GPU expects: each half the last, rounded down.
fn empty_mips(size: usize) -> Vec<CubeLevel> {
    let sizes = std::iter::successors(Some(size), |&size| (size > 1).then_some(size / 2));
    sizes.map(|size| CubeLevel { size, faces: Default::default() }).collect()
}

fn fill_face(
    texels: &mut [[f32; 3]],
    face: CubeFace,
    size: usize,
    supersampling: usize,
    radiance: &(impl Fn(DVec3) -> DVec3 + Sync),
) -> Repairs {
    let fill_row = |row: usize, texels: &mut [[f32; 3]]| -> Repairs {
        let columns = texels.iter_mut().enumerate();
        columns.map(|(column, texel)| fill_texel(texel, face, [column, row], size, supersampling, radiance)).sum()
    };
    parallel::change(texels, size, fill_row).into_iter().sum()
}

fn fill_texel(
    texel: &mut [f32; 3],
    face: CubeFace,
    index: [usize; 2],
    size: usize,
    supersampling: usize,
    radiance: &impl Fn(DVec3) -> DVec3,
) -> Repairs {
    let samples = size * supersampling;
    let position =
        |index: usize, sample: usize| (2 * (index * supersampling + sample) + 1) as f64 / samples as f64 - 1.0;
    let mut sum = DVec3::ZERO;
    for row in 0..supersampling {
        for column in 0..supersampling {
            sum += radiance(face.direction(DVec2::new(position(index[0], column), position(index[1], row))));
        }
    }
    *texel = (sum / (supersampling * supersampling) as f64).as_vec3().to_array();
    Repairs::repair(texel)
}

/// Stores a face and its smaller versions, each made from the last in full precision.
fn store_mips(mips: &mut [CubeLevel], face: CubeFace, mut texels: Vec<[f32; 3]>) {
    for level in mips {
        if level.size * level.size != texels.len() {
            texels = mip::halve(&texels, texels.len().isqrt());
        }
        level.faces[face.layer()] = texels_of(&texels);
    }
}

/// Radiance times solid angle, and solid angle, summed over one row of one face; `row` counts through all faces.
fn weighted_row(level: &CubeLevel, row: usize) -> (DVec3, f64) {
    let (layer, row) = (row / level.size, row % level.size);
    let coordinate = |index: usize| (2 * index + 1) as f64 / level.size as f64 - 1.0;
    (0..level.size).fold((DVec3::ZERO, 0.0), |(radiance, weight), column| {
        // A texel's solid angle falls with the cube of its distance from the cube's center.
        let solid_angle = (1.0 + coordinate(row).powi(2) + coordinate(column).powi(2)).powf(-1.5);
        (radiance + solid_angle * level.radiance(layer, row * level.size + column), weight + solid_angle)
    })
}

/// A 64-bit hash in the manner of FNV-1a, a texel at a time: std's hashers may change between releases of Rust.
fn content_id(level: &CubeLevel) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325 ^ level.size as u64;
    for texel in level.faces.iter().flatten() {
        hash = hashed(hash, u64::from(texel.0));
    }
    hash
}

fn hashed(hash: u64, bits: u64) -> u64 {
    let hash = (hash ^ bits).wrapping_mul(0x0000_0100_0000_01b3);
    // Multiplication carries bits only upwards.
    hash ^ hash >> 32
}

#[cfg(test)]
mod tests;
