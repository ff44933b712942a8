//! What lights the scene, and how its radiance becomes a picture.

use super::{
    Key,
    check::{self, Checked, Fault},
    section::{Value, section},
    shorten,
};
use crate::{
    physics::{
        colour::Illuminant,
        spectra::{FIRST_NM, LAST_NM, Spectrum, SpectrumError},
    },
    words::words,
};
use serde::{Deserialize, Serialize};

section! {
    /// The light around the bubbles: `[light]`.
    pub struct Light, LightKeys: [
        #[serde(skip_serializing_if = "Option::is_none")]
        spectrum: Option<LightSpectrum> = None, "A spectrum that stands in the scene and takes the place of the illuminant";
        #[serde(rename = "patch", skip_serializing_if = "Vec::is_empty")]
        patches: Vec<LightPatch> = Vec::new(), "Parts of the environment with another illuminant, at most [`MAX_PATCHES`]; where two overlap the later one counts";
        #[serde(rename = "lamp", skip_serializing_if = "Vec::is_empty")]
        lamps: Vec<LightLamp> = Vec::new(), "Lamps before the environment, at most [`MAX_LAMPS`]; their light adds up";
    ]
    environment: Environment = Environment::Tent, ["`\"tent\"`, `\"windows\"`, `\"park\"`, `\"studio\"`, a path"], "Environment", "", "the environment map: built in, or an equirectangular `.exr` or `.hdr` file";
    illuminant: String = "D65".to_owned(), ["a name"], "Illuminant", "", "the illuminant whose spectrum white light has: `\"D65\"`, `\"D50\"`, `\"A\"`, `\"E\"`, `\"FL2\"`, `\"FL11\"`, `\"LED\"`, `\"LED-B1\"`, `\"sodium\"`, a black body like `\"3000 K\"`, or the path of a `.csv` [table](#files-that-a-scene-names) of wavelengths and powers";
    constant: Option<[f64; 3]> = None, [0.0 ..= 65504.0], "Radiance", "", "`[r, g, b]`: the same radiance from everywhere instead of the environment, linear BT.709";
    rotation_deg: f64 = 0.0, [finite], "Rotation", "°", "rotation of the environment about the vertical, counter-clockwise seen from above";
    intensity: f64 = 1.0, [0.0 ..= 10000.0], "Intensity", "x", "factor on the radiance of the light";
}

section! {
    /// A spectrum by points, linear between them and zero outside: `[light.spectrum]`.
    pub struct LightSpectrum, LightSpectrumKeys:
    wavelengths_nm: Vec<f64> = vec![FIRST_NM, LAST_NM], ["2 to 1000 numbers"], "Wavelengths", " nm", "wavelengths of the points in rising order, 360 to 780 nm";
    power: Vec<f64> = vec![1.0, 1.0], ["2 to 1000 numbers"], "Power", "", "spectral power at each of them, 0 or more, in any unit";
}

/// The largest number of points in one spectrum.
pub const MAX_SPECTRUM_POINTS: usize = 1000;

/// The largest power that a point may have.
const MAX_POWER: f64 = 1e12;

/// What the spectrum of a scene is called where illuminants have names.
const SPECTRUM_NAME: &str = "the spectrum of the scene";

impl LightSpectrum {
    /// Its points: wavelength in nm and power.
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f64, f64)> {
        self.wavelengths_nm.iter().copied().zip(self.power.iter().copied())
    }

    /// The light that has this spectrum.
    ///
    /// # Errors
    /// It has no power, or none that is seen.
    pub fn illuminant(&self) -> Result<Illuminant, SpectrumError> {
        Illuminant::new(SPECTRUM_NAME, Spectrum::within_points(&self.points().collect::<Vec<_>>()))
    }

    fn check(&self) -> Checked {
        self.check_ranges()?;
        let (count, powers) = (self.wavelengths_nm.len(), self.power.len());
        if !(2..=MAX_SPECTRUM_POINTS).contains(&count) {
            let reason = format!("is a list of {count}; it must hold 2 to {MAX_SPECTRUM_POINTS} numbers");
            return Err(Fault::new("wavelengths_nm", reason));
        }
        if powers != count {
            let reason = format!("is a list of {powers}; it must hold as many numbers as `wavelengths_nm`, {count}");
            return Err(Fault::new("power", reason));
        }
        check::all_in_range("wavelengths_nm", &self.wavelengths_nm, FIRST_NM..=LAST_NM)?;
        if let Some(pair) = self.wavelengths_nm.windows(2).find(|pair| pair[1] <= pair[0]) {
            let reason = format!("has {} after {}; sort the points by wavelength, each once", pair[1], pair[0]);
            return Err(Fault::new("wavelengths_nm", reason));
        }
        check::all_in_range("power", &self.power, 0.0..=MAX_POWER)?;
        if self.power.iter().all(|power| *power == 0.0) {
            return Err(Fault::new("power", "is 0 everywhere; give one of the points some power"));
        }
        Ok(())
    }
}

/// The largest number of patches in one light: each spectrum is drawn for itself.
pub const MAX_PATCHES: usize = 8;

/// The largest number of lamps in one light.
pub const MAX_LAMPS: usize = 8;

section! {
    /// A lamp before the environment, as photographers put up: `[[light.lamp]]`.
    pub struct LightLamp, LightLampKeys:
    shape: LampShape = LampShape::Softbox, [word], "Shape", "", "its shape";
    azimuth_deg: f64 = 0.0, [finite], "Azimuth", "°", "azimuth of its center, from +x towards +y";
    elevation_deg: f64 = 30.0, [-90.0 ..= 90.0], "Elevation", "°", "elevation of its center above the horizon";
    roll_deg: f64 = 0.0, [finite], "Roll", "°", "angle by which it is turned about its center, counter-clockwise as it is seen";
    width_deg: f64 = 30.0, [0.05 ..= 120.0], "Width", "°", "angle that its width spans; of a disc, its diameter";
    height_deg: f64 = 40.0, [0.05 ..= 120.0], "Height", "°", "angle that its height spans; ignored for a disc";
    edge_deg: f64 = 1.0, [0.0 ..= 30.0], "Edge", "°", "width of its soft edge";
    luminance: f64 = 10.0, [0.0 ..= 1000000.0], "Luminance", "", "its luminance; a white surface in full light has 1";
    kelvin: Option<f64> = None, [1000.0 ..= 25000.0], "Temperature", " K", "its colour, as that of a black body, K; without it, that of the illuminant";
}

words! {
    /// Shapes of lamps.
    #[derive(Default)]
    pub enum LampShape: "shape" {
        Disc = "disc", "A round lamp, as a bare flash or the sun";
        #[default]
        Softbox = "softbox", "A rectangle with rounded corners";
        Strip = "strip", "A softbox of a fifth of the width";
    }
}

section! {
    /// A round part of the environment that another illuminant lights, as a lamp in a room with a window: `[[light.patch]]`.
    pub struct LightPatch, LightPatchKeys:
    azimuth_deg: f64 = 0.0, [finite], "Azimuth", "°", "azimuth of its center, from +x towards +y";
    elevation_deg: f64 = 0.0, [-90.0 ..= 90.0], "Elevation", "°", "elevation of its center above the horizon";
    radius_deg: f64 = 20.0, [1.0 ..= 180.0], "Radius", "°", "angle from its center to half of its radiance";
    edge_deg: f64 = 4.0, [0.0 ..= 90.0], "Edge", "°", "width of its soft edge";
    illuminant: String = "D65".to_owned(), ["a name"], "Illuminant", "", "its illuminant, named as in `[light]`";
    radiance: Option<[f64; 3]> = None, [0.0 ..= 65504.0], "Radiance", "", "`[r, g, b]`: its radiance, linear BT.709; without it, the radiance of the environment there";
}

impl LightPatch {
    fn check(&self) -> Checked {
        self.check_ranges()?;
        check_illuminant(&self.illuminant)
    }
}

fn check_illuminant(name: &str) -> Checked {
    if name.trim().is_empty() {
        return Err(Fault::new("illuminant", "is empty; name one, as in `illuminant = \"D65\"`"));
    }
    check::plain_text("illuminant", name)
}

impl Light {
    pub(super) fn check(&self) -> Checked {
        self.check_ranges()?;
        check_illuminant(&self.illuminant)?;
        let spectrum = self.spectrum.as_ref().map_or(Ok(()), LightSpectrum::check);
        spectrum.map_err(|fault| fault.inside("spectrum"))?;
        check::at_most("patch", self.patches.len(), MAX_PATCHES)?;
        check::each("patch", &self.patches, LightPatch::check)?;
        check::at_most("lamp", self.lamps.len(), MAX_LAMPS)?;
        check::each("lamp", &self.lamps, LightLamp::check_ranges)
    }
}

/// An equirectangular environment map: a built-in one by name, or a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(
    rename_all = "lowercase",
    expecting = "expected \"tent\", \"windows\", \"park\", \"studio\" or the path of an .exr or .hdr file"
)]
pub enum Environment {
    /// Built in: a photographer's light tent with soft lamps.
    Tent,
    /// Built in: a dark room with bright windows.
    Windows,
    /// Built in: a meadow among dark trees under clouds and a low sun.
    Park,
    /// Built in: two softboxes and a strip light on black.
    Studio,
    /// Path of an `.exr` or `.hdr` file, as written in the scene.
    #[serde(untagged)]
    File(String),
}

impl Value for Environment {
    fn check(&self, key: &Key) -> Checked {
        match self {
            Self::File(path) if is_picture(path) => path.check(key),
            Self::File(path) => {
                let path = shorten(path, check::LONGEST_NAME);
                let reason = format!(
                    "is {path:?}; use \"tent\", \"windows\", \"park\", \"studio\" or the path of an .exr or .hdr file"
                );
                Err(Fault::new(key.name, reason))
            }
            Self::Tent | Self::Windows | Self::Park | Self::Studio => Ok(()),
        }
    }
}

fn is_picture(path: &str) -> bool {
    let path = path.to_ascii_lowercase();
    path.ends_with(".exr") || path.ends_with(".hdr")
}

section! {
    /// How the radiance becomes a picture: `[view]`.
    pub struct View, ViewKeys:
    exposure_ev: f64 = 1.5, [-20.0 ..= 20.0], "Exposure", " EV", "exposure in stops: the radiance is multiplied by 2 to this power";
    backdrop: Backdrop = Backdrop::Radiance([0.0012, 0.0012, 0.0016]), [0.0 ..= 65504.0], "Backdrop", "", "what is seen behind the bubbles: `\"environment\"`, or a radiance `[r, g, b]`, linear BT.709";
    plate: Option<String> = None, ["a path"], "Plate", "", "a photograph that stands behind the bubbles and is seen through them, cropped to fill the picture: the path of a `.png`, `.jpg`, `.exr` or `.hdr` file; it takes the place of `backdrop`";
    quality: Quality = Quality::Standard, [word], "Quality", "", "accuracy of colours; the choices differ only in light that meets several walls, and single walls are accurate in all";
    polariser_deg: Option<f64> = None, [finite], "Polariser", "°", "angle of a polariser in front of the camera, from the horizontal, counter-clockwise";
    white_balance: bool = false, [flag], "White balance", "", "whether 8-bit pictures are adapted to the illuminant (Bradford); light of one hue stays as it is";
    dither: bool = true, [flag], "Dither", "", "whether 8-bit pictures are dithered: fine noise hides the steps between levels";
    dither_seed: u64 = 0, [whole], "Dither seed", "", "random seed of the dither";
}

words! {
    /// Accuracy of the colours in shaders. Single walls and coloured light are accurate at all qualities; they differ in the products of two
    /// and more walls, which colours cannot be multiplied for.
    #[derive(Default)]
    pub enum Quality: "quality" {
        Fast = "fast", "Fastest: light that meets several walls is the product of their colours, or, in coloured or polarised light, is summed over a few wavelengths";
        #[default]
        Standard = "standard", "Light that meets several walls is summed over a dozen wavelengths: the error is hardly visible";
        Spectral = "spectral", "Most accurate: all light is summed over some thirty wavelengths or more";
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

impl Value for Backdrop {
    fn check(&self, key: &Key) -> Checked {
        match self {
            Self::Environment => Ok(()),
            Self::Radiance(radiance) => radiance.check(key),
        }
    }
}
