//! The colour of a film at a point, which needs no GPU.

use glam::{DMat3, DVec3};

use super::{Error, MAX_THICKNESS_NM};
use crate::physics::{
    colour::{BT709, BT2020, Display, FilmOptics, Gamut, Illuminant, Walls, daylight_scale},
    optics::FilmMaterial,
};

/// The colour that a film reflects of white light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// CIE 1931 XYZ, 2° observer, relative to the light: a perfect mirror has Y = 1.
    pub xyz: DVec3,
}

impl Colour {
    /// Linear BT.709, which has the primaries of sRGB. Films have colours outside of it, which are negative in a component.
    #[must_use]
    pub fn bt709(&self) -> DVec3 {
        BT709.from_xyz() * self.xyz
    }

    /// Red, green and blue as pictures show them, 8 bits of sRGB. The light is multiplied by 2 to the power of `exposure_ev` stops before: a
    /// film reflects a few per cent, so that 3 to 4 stops make a bright colour.
    #[must_use]
    pub fn srgb(&self, exposure_ev: f64) -> [u8; 3] {
        let display = Display { exposure_ev, balance: DMat3::IDENTITY, gamut: Gamut::Srgb, dither: None };
        display.encode(daylight_scale() * (BT2020.from_xyz() * self.xyz), [0, 0])
    }
}

/// The colour that one wall of soapy water reflects of daylight (D65), in f64 on the CPU. `thickness_nm` is the thickness along the normal, 0 to
/// [`MAX_THICKNESS_NM`] nm, and `cos_theta` the cosine of the angle of incidence in air, 0 to 1.
///
/// For other liquids and lights, for two walls, and for many points of one film use [`FilmOptics`], which this function makes anew each time.
///
/// ```
/// // A quarter of a wavelength of green light reflects the most: some 8 % of it.
/// let bright = soapfilm::colour(104.0, 1.0)?;
/// assert!((bright.xyz.y - 0.078).abs() < 0.002);
/// // Much thinner film is black.
/// assert!(soapfilm::colour(5.0, 1.0)?.xyz.y < 0.001);
/// # Ok::<(), soapfilm::Error>(())
/// ```
///
/// # Errors
/// [`Error::Thickness`] and [`Error::Cosine`] for numbers outside of these ranges.
pub fn colour(thickness_nm: f64, cos_theta: f64) -> Result<Colour, Error> {
    if !(0.0..=MAX_THICKNESS_NM).contains(&thickness_nm) {
        return Err(Error::Thickness(thickness_nm));
    }
    if !(0.0..=1.0).contains(&cos_theta) {
        return Err(Error::Cosine(cos_theta));
    }
    let optics = FilmOptics::resolving(FilmMaterial::default(), &Illuminant::default(), thickness_nm);
    Ok(Colour { xyz: optics.xyz(cos_theta, Walls::One { thickness_nm }) })
}
