//! What tasks ask for: numbers of a film at a point, and numbers that follow from the optics and the mechanics of films.

use glam::DVec3;

use crate::{
    physics::{
        colour::{FilmOptics, Illuminant, Walls},
        optics::{FilmMaterial, newton_order},
    },
    words::words,
};

words! {
    /// What a task asks for.
    pub enum Quantity: "quantity" {
        Thickness = "thickness", "Thickness of the film, nm";
        Angle = "angle", "Angle of incidence in air, degrees";
        Path = "path", "Path difference 2 n d cos of the angle inside, at 589 nm, in nm";
        Order = "order", "Order of Newton's colours, from 1 on";
        Luminance = "luminance", "Part of white light that is reflected as the eye weighs it (Y), per cent";
        Reflectance = "reflectance", "Part of unpolarised light of `wavelength_nm` that is reflected, per cent";
        ReflectanceS = "reflectance-s", "Part of s light of `wavelength_nm` that is reflected, per cent; its electric field is perpendicular to the plane of incidence";
        ReflectanceP = "reflectance-p", "Part of p light of `wavelength_nm` that is reflected, per cent; its electric field lies in the plane of incidence";
        ChromaticityX = "x", "Chromaticity x (CIE 1931) of the reflected light";
        ChromaticityY = "y", "Chromaticity y (CIE 1931) of the reflected light";
        BrightThickness = "bright-thickness", "Thickness, nm, that reflects `wavelength_nm` the most, of an `order`";
        DarkThickness = "dark-thickness", "Thickness, nm, that does not reflect `wavelength_nm`, of an `order`";
        BrewsterAngle = "brewster-angle", "Angle, degrees, at which water reflects no p light of `wavelength_nm`";
        DrainageTime = "drainage-time", "Time, s, in which the top of a bubble of `radius_mm` drains from `thickness_nm` to `to_nm`";
        EvaporationTime = "evaporation-time", "Time, s, in which film evaporates from `thickness_nm` to `to_nm` at `evaporation_nm_s`";
    }
}

impl Quantity {
    /// Its unit, as it stands after a number.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Thickness | Self::Path | Self::BrightThickness | Self::DarkThickness => " nm",
            Self::Angle | Self::BrewsterAngle => "°",
            Self::Luminance | Self::Reflectance | Self::ReflectanceS | Self::ReflectanceP => " %",
            Self::DrainageTime | Self::EvaporationTime => " s",
            Self::Order | Self::ChromaticityX | Self::ChromaticityY => "",
        }
    }

    /// Whether it is one of a point of a film, which the probe can be held to.
    #[must_use]
    pub fn is_of_point(self) -> bool {
        use Quantity as Q;
        !matches!(self, Q::BrightThickness | Q::DarkThickness | Q::BrewsterAngle | Q::DrainageTime | Q::EvaporationTime)
    }
}

/// A film at a point, under one angle and light.
#[derive(Clone, Debug)]
pub struct FilmPoint {
    /// What the film is made of.
    pub film: FilmMaterial,
    /// The light.
    pub illuminant: Illuminant,
    /// Thickness along the normal, nm.
    pub thickness_nm: f64,
    /// Cosine of the angle of incidence in air.
    pub cos_theta: f64,
}

impl FilmPoint {
    /// A quantity of the point, in the quantity's unit; `None` for one that is not of a point. `wavelength_nm` is of light of one wavelength.
    #[must_use]
    pub fn measure(&self, quantity: Quantity, wavelength_nm: f64) -> Option<f64> {
        let Self { film, thickness_nm, cos_theta, .. } = self;
        let reflectance =
            || film.wall(film.index.n(wavelength_nm), *cos_theta, wavelength_nm).reflectance(*thickness_nm);
        let path_nm = film.path_nm(*thickness_nm, *cos_theta);
        Some(match quantity {
            Quantity::Thickness => *thickness_nm,
            Quantity::Angle => cos_theta.acos().to_degrees(),
            Quantity::Path => path_nm,
            Quantity::Order => f64::from(newton_order(path_nm)),
            Quantity::Luminance => 100.0 * self.xyz().y,
            Quantity::Reflectance => 100.0 * reflectance().mean(),
            Quantity::ReflectanceS => 100.0 * reflectance().s,
            Quantity::ReflectanceP => 100.0 * reflectance().p,
            Quantity::ChromaticityX => self.xyz().x / self.xyz().element_sum(),
            Quantity::ChromaticityY => self.xyz().y / self.xyz().element_sum(),
            _ => return None,
        })
    }

    fn xyz(&self) -> DVec3 {
        let optics = FilmOptics::resolving(self.film.clone(), &self.illuminant, self.thickness_nm);
        optics.xyz(self.cos_theta, Walls::One { thickness_nm: self.thickness_nm })
    }
}
