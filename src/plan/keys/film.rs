//! Keys of films that move: the moment, the laws until then, and the field.

use glam::DVec3;

use crate::physics::{
    bubble::{CenterPath, Opening},
    film::{
        Cap, Evaporation, FlowLaw, FreeFlow, InitialFilm, NUCLEATION_NM, Patch, Push, Pushes, Regeneration,
        model::MAX_RIM_PATCHES, properties::BLACK_FILM_ONSET,
    },
    sphere::CubedSphere,
    timeline::{Moment, Timeline},
    transport::Scheme,
};

/// The boundary of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmBoundary {
    /// The cap of film above a rim, if the film has a rim and ends there.
    pub cap: Option<Cap>,
    /// Angular radius of the drop at its bottom, if there is one, radians.
    pub drop_rad: Option<f64>,
    /// How it regenerates at its rim, if it does.
    pub regeneration: Option<Regeneration>,
}

/// A film whose thickness varies: how it began, what drove it, and the moment.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldKey {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// Cells along a panel's edge of its flow; at most as many as the film has.
    pub flow_cells: u32,
    /// Thickness at tick 0.
    pub initial: InitialFilm,
    /// Its boundary, unless it is free.
    pub boundary: Option<Box<FilmBoundary>>,
    /// Length of a tick in seconds.
    pub tick_s: f64,
    /// How the liquid is moved.
    pub scheme: Scheme,
    /// Maximum ticks between two remaps of the flow map.
    pub remap_ticks: u32,
    /// Evaporation; empty for films whose motion does not depend on it.
    pub evaporation: Evaporation,
    /// Laws, as far as the moment has seen them; the first holds from tick 0.
    pub flows: Timeline<FlowLaw>,
    /// Pushes; empty for films that cannot be pushed.
    pub pushes: Pushes,
    /// Where the bubble goes, in radii, which a film that moves by itself feels.
    pub path: CenterPath,
    /// The moment.
    pub moment: Moment,
}

impl FieldKey {
    /// The cap of film above a rim, if the film has a rim and ends there.
    #[must_use]
    pub fn cap(&self) -> Option<Cap> {
        self.boundary.as_ref().and_then(|boundary| boundary.cap)
    }

    /// Angular radius of the drop at its bottom, if there is one, radians.
    #[must_use]
    pub fn drop_rad(&self) -> Option<f64> {
        self.boundary.as_ref().and_then(|boundary| boundary.drop_rad)
    }

    /// How it regenerates at its rim, if it does.
    #[must_use]
    pub fn regeneration(&self) -> Option<Regeneration> {
        self.boundary.as_ref().and_then(|boundary| boundary.regeneration)
    }

    /// This film at another moment.
    #[must_use]
    pub fn at(&self, moment: Moment) -> Self {
        Self { moment, ..self.clone() }
    }

    /// Cells of the whole sphere.
    #[must_use]
    pub fn cell_count(&self) -> u64 {
        6 * u64::from(self.cells) * u64::from(self.cells)
    }

    /// The law that holds during a tick.
    #[must_use]
    pub fn law(&self, tick: u64) -> FlowLaw {
        self.flows.at(tick).copied().unwrap_or(FlowLaw::Rest)
    }

    /// What has evaporated since the beginning, in nm, at a time in ticks.
    #[must_use]
    pub fn evaporated_nm(&self, ticks: f64) -> f64 {
        self.evaporation.nm(ticks)
    }

    /// Whether any of the film may be thin enough to collapse to black film, or for nuclei of it, at a time in ticks.
    #[must_use]
    pub fn has_black_film(&self, ticks: f64) -> bool {
        let drains = matches!(self.law(ticks as u64), FlowLaw::Free(free) if free.drainage > 0.0);
        let evaporated_nm = self.evaporated_nm(ticks);
        let begins_nm = if evaporated_nm > 0.0 { NUCLEATION_NM } else { 1e9 * BLACK_FILM_ONSET };
        drains || self.regeneration().is_some() || self.initial.range_nm().0 - evaporated_nm < begins_nm
    }

    /// Patches that leave the film's rim between two times in ticks, under the law at the later one: the first [`MAX_RIM_PATCHES`].
    #[must_use]
    pub fn patches_during(&self, from_ticks: f64, to_ticks: f64) -> Vec<Patch> {
        let FlowLaw::Free(free) = self.law(to_ticks as u64) else { return Vec::new() };
        let Some(regeneration) = self.regeneration() else { return Vec::new() };
        let rate = regeneration.rate_1_s(free.patch_speed(&regeneration));
        let patches = regeneration.patches(rate, from_ticks * self.tick_s, to_ticks * self.tick_s);
        // Of the smallest patches there would be millions, finer than any cell.
        patches.take(MAX_RIM_PATCHES).collect()
    }

    /// What pushes the film in a step between two times in ticks.
    #[must_use]
    pub fn pushes_during(&self, from_ticks: f64, to_ticks: f64) -> Vec<Push> {
        self.pushes.in_step(from_ticks, to_ticks, self.tick_s)
    }

    /// How fast what pushes the film until a time in ticks may make it shear and turn then, 1/s.
    #[must_use]
    pub fn strain_until(&self, ticks: f64) -> f64 {
        let FlowLaw::Free(FreeFlow { forces, .. }) = self.law(ticks as u64) else { return 0.0 };
        self.pushes.strain_1_s(ticks, self.tick_s, &forces)
    }

    /// The bubble's mean acceleration between two times in ticks, over its radius: 1/s².
    #[must_use]
    pub fn acceleration_during(&self, from_ticks: f64, to_ticks: f64) -> DVec3 {
        self.path.mean_acceleration(from_ticks * self.tick_s, to_ticks * self.tick_s)
    }

    /// Angle between neighbouring cells, in radians; for a size that no grid has, the angle of the coarsest grid.
    #[must_use]
    pub fn cell_angle(&self) -> f64 {
        CubedSphere::new(self.cells as usize).map_or(std::f64::consts::FRAC_PI_2 / 8.0, CubedSphere::cell_angle)
    }
}

/// A hole, and the film that it opens in.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenHoleKey {
    /// The film, at the moment of the burst.
    pub film: FilmKey,
    /// What has evaporated from it, nm.
    pub evaporated_nm: f64,
    /// Radius of the bubble, m.
    pub radius_m: f64,
    /// The hole.
    pub hole: Opening,
}

/// What a bubble's film is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum FilmKey {
    /// One thickness everywhere, in nm: no field at all.
    Uniform(f64),
    /// A field.
    Field(FieldKey),
}
