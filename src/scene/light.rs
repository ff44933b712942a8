//! What lights the scene, and how its radiance becomes a picture.

use super::check::{self, Checked, Fault};
use super::shorten;
use serde::{Deserialize, Serialize};

/// The light around the bubbles: `[light]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Light {
    /// The environment map. Default: `tent`.
    pub environment: Environment,
    /// The illuminant whose spectrum white light has: a name (`D65`, `A`, `sodium`, ...), a black body (`3000 K`), or the path of a `.csv`
    /// file with lines `wavelength_nm,power`. Default: `D65`.
    pub illuminant: String,
    /// The same radiance from everywhere in place of the environment, linear BT.709; each 0 ..= 65504. Default: absent.
    pub constant: Option<[f64; 3]>,
    /// Turns the environment about the vertical, degrees, counter-clockwise seen from above; any finite number. Default: 0.
    pub rotation_deg: f64,
    /// Factor on the radiance of the light; 0 ..= 10000. Default: 1.
    pub intensity: f64,
    /// Parts of the environment that are lamps of other spectra, at most [`MAX_PATCHES`]. Where two overlap the later one counts.
    #[serde(rename = "patch", skip_serializing_if = "Vec::is_empty")]
    pub patches: Vec<LightPatch>,
}

/// The largest number of patches in one light: each spectrum is drawn for itself.
pub const MAX_PATCHES: usize = 8;

/// A round part of the environment that another illuminant lights, as a lamp in a room with a window: `[[light.patch]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightPatch {
    /// Direction of its middle around the vertical, from +x towards +y, degrees; any finite number. Default: 0.
    pub azimuth_deg: f64,
    /// The same above the horizon, degrees; -90 ..= 90. Default: 0.
    pub elevation_deg: f64,
    /// Angle from its middle to where half of it is left, degrees; 1 ..= 180. Default: 20.
    pub radius_deg: f64,
    /// Width of its soft edge, degrees; 0 ..= 90. Default: 4.
    pub edge_deg: f64,
    /// Its illuminant, as in [`Light::illuminant`]. Default: `D65`.
    pub illuminant: String,
    /// Its radiance, linear BT.709 relative to its illuminant's white; each 0 ..= 65504. Default: absent, what the environment has there.
    pub radiance: Option<[f64; 3]>,
}

impl Default for LightPatch {
    fn default() -> Self {
        Self {
            azimuth_deg: 0.0,
            elevation_deg: 0.0,
            radius_deg: 20.0,
            edge_deg: 4.0,
            illuminant: "D65".to_owned(),
            radiance: None,
        }
    }
}

impl LightPatch {
    fn check(&self) -> Checked {
        check::finite("azimuth_deg", self.azimuth_deg)?;
        check::in_range("elevation_deg", self.elevation_deg, -90.0..=90.0)?;
        check::in_range("radius_deg", self.radius_deg, 1.0..=180.0)?;
        check::in_range("edge_deg", self.edge_deg, 0.0..=90.0)?;
        check_illuminant(&self.illuminant)?;
        self.radiance.map_or(Ok(()), |radiance| check::all_in_range("radiance", radiance, check::RADIANCE))
    }
}

fn check_illuminant(name: &str) -> Checked {
    if name.trim().is_empty() {
        return Err(Fault::new("illuminant", "is empty; name one, as in `illuminant = \"D65\"`"));
    }
    check::plain_text("illuminant", name)
}

impl Default for Light {
    fn default() -> Self {
        Self {
            environment: Environment::Tent,
            illuminant: "D65".to_owned(),
            constant: None,
            rotation_deg: 0.0,
            intensity: 1.0,
            patches: Vec::new(),
        }
    }
}

impl Light {
    pub(super) fn check(&self) -> Checked {
        self.environment.check()?;
        check_illuminant(&self.illuminant)?;
        self.constant.map_or(Ok(()), |radiance| check::all_in_range("constant", radiance, check::RADIANCE))?;
        check::finite("rotation_deg", self.rotation_deg)?;
        check::in_range("intensity", self.intensity, 0.0..=10_000.0)?;
        check::at_most("patch", self.patches.len(), MAX_PATCHES)?;
        check::each("patch", &self.patches, LightPatch::check)
    }
}

/// An equirectangular environment map: a built-in one by name, or a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", expecting = "expected \"tent\", \"windows\" or the path of an .exr or .hdr file")]
pub enum Environment {
    /// Built in: a photographer's light tent with soft lamps.
    Tent,
    /// Built in: a dark room with bright windows.
    Windows,
    /// Path of an `.exr` or `.hdr` file, as written in the scene.
    #[serde(untagged)]
    File(String),
}

impl Environment {
    fn check(&self) -> Checked {
        match self {
            Self::File(path) if !is_picture(path) => {
                let path = shorten(path, check::LONGEST_NAME);
                let reason = format!("is {path:?}; use \"tent\", \"windows\" or the path of an .exr or .hdr file");
                Err(Fault::new("environment", reason))
            }
            Self::File(path) => check::plain_text("environment", path),
            Self::Tent | Self::Windows => Ok(()),
        }
    }
}

fn is_picture(path: &str) -> bool {
    let path = path.to_ascii_lowercase();
    path.ends_with(".exr") || path.ends_with(".hdr")
}

/// How the radiance becomes a picture: `[view]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct View {
    /// Exposure, stops: the radiance is multiplied by 2 to this power; -20 ..= 20. Default: 0.
    pub exposure_ev: f64,
    /// What stands straight behind the bubbles. Default: a very dark neutral, on which the film's colours show.
    pub backdrop: Backdrop,
    /// How exactly colours are computed. Default: `standard`.
    pub quality: Quality,
    /// Angle of a polariser before the camera, degrees from the horizontal, anticlockwise as the camera sees it; any finite number. It takes
    /// half of unpolarised light, which the exposure gives back. Default: absent, no polariser.
    pub polariser_deg: Option<f64>,
    /// Whether 8-bit pictures are adapted to the illuminant (Bradford), as cameras and eyes do: its white is then shown as white. Light of
    /// one hue has no white to adapt to and stays as it is. Default: false.
    pub white_balance: bool,
    /// Whether 8-bit pictures are dithered. Default: true.
    pub dither: bool,
    /// Seed of the dither. Default: 0.
    pub dither_seed: u64,
}

impl Default for View {
    fn default() -> Self {
        Self {
            exposure_ev: 1.5,
            backdrop: Backdrop::Radiance([0.0012, 0.0012, 0.0016]),
            quality: Quality::Standard,
            polariser_deg: None,
            white_balance: false,
            dither: true,
            dither_seed: 0,
        }
    }
}

impl View {
    pub(super) fn check(&self) -> Checked {
        check::in_range("exposure_ev", self.exposure_ev, -20.0..=20.0)?;
        self.polariser_deg.map_or(Ok(()), |angle| check::finite("polariser_deg", angle))?;
        match self.backdrop {
            Backdrop::Environment => Ok(()),
            Backdrop::Radiance(radiance) => check::all_in_range("backdrop", radiance, check::RADIANCE),
        }
    }
}

/// How exactly the shaders compute colours. In all of them single walls and coloured light are right; they differ in the products of two
/// and more walls, which colours cannot be multiplied for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quality {
    /// Light that meets several walls is summed over few wavelengths.
    Fast,
    /// Products from a dozen wavelengths: the error can hardly be seen.
    #[default]
    Standard,
    /// Everything from some thirty wavelengths, and no table.
    Spectral,
}

impl Quality {
    /// All of them, the fastest first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Standard, Self::Spectral];

    /// The name in scenes and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Standard => "standard",
            Self::Spectral => "spectral",
        }
    }
}

/// What stands straight behind the bubbles; it need not be what lights them, as a photographer's black card shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", expecting = "expected \"environment\" or three numbers [r, g, b]")]
pub enum Backdrop {
    /// The light's own environment (or constant).
    Environment,
    /// One radiance, linear BT.709; each 0 ..= 65504.
    #[serde(untagged)]
    Radiance([f64; 3]),
}
