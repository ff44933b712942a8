//! What a line of sight meets: the walls of the nearest bubble, with the film that stands there.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::{
    physics::{
        picture::{Line, Surface, Wall},
        sphere::PaddedField,
    },
    plan::{BubbleKey, DrawKey, FieldKey, FilmKey, FlowLaw, OpticsKey},
    verify::reference::{MovedFilms, camera, film_thickness},
};

/// What was read of films on the device, by the index of the film.
#[derive(Debug, Default)]
pub struct FilmsRead {
    /// Thickness in nm.
    pub thickness_nm: MovedFilms,
    /// Velocity in rad/s, in the film's axes, of films that move by themselves.
    pub velocity_rad_s: BTreeMap<usize, PaddedField<DVec3>>,
}

/// A wall of film that a line of sight meets.
#[derive(Clone, Debug, PartialEq)]
pub struct WallInSight {
    /// Index of its film, which for a bubble of the scene is the bubble's own.
    pub film: usize,
    /// Unit vector from the bubble's center to the place, in the world's axes.
    pub place: DVec3,
    /// Cosine of the angle of incidence in air.
    pub cos_theta: f64,
    /// Thickness along the normal, nm; 0 where there is no film. `None` where the film must be read from the device first.
    pub thickness_nm: Option<f64>,
    /// Speed of the liquid along the film, m/s, if it is known.
    pub speed_m_s: Option<f64>,
    /// What the film is made of, and the light.
    pub optics: OpticsKey,
}

/// The walls of the nearest bubble on the line of sight through a position in the picture, in pixels from the top left, y down: the front wall and
/// the back wall from outside, one from inside, none beside all bubbles. What lies behind the mirror of a bath is not looked for.
#[must_use]
pub fn walls_in_sight(draw: &DrawKey, films: &FilmsRead, position: DVec2) -> Vec<WallInSight> {
    let direction = camera(&draw.camera).ray(draw.size, position);
    let line = Line { origin_m: DVec3::ZERO, direction, from: None };
    let met = draw.all_bubbles().into_iter().filter_map(|bubble| {
        let mut walls = Vec::new();
        let surface = Surface::new(bubble.center_m - draw.camera.eye_m, bubble.radius_m, bubble.stretch);
        surface.add_walls(0, &line, &mut walls);
        // A cap of a film ends somewhere; beyond it there is nothing to meet.
        walls.retain(|wall| bubble.cap.is_none_or(|cap| cap.contains(bubble.to_film * wall.place)));
        Some((walls.first()?.distance_m, bubble, walls))
    });
    let Some((_, bubble, walls)) = met.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Vec::new() };
    walls.iter().map(|wall| seen(draw, &bubble, films, wall)).collect()
}

/// Thickness in nm at places of a film, unit vectors from the bubble's center in the world's axes; 0 where there is no film. `None` for a film that is
/// not in the picture or must be read from the device first.
#[must_use]
pub fn thickness_at(draw: &DrawKey, films: &FilmsRead, film: usize, places: &[DVec3]) -> Option<Vec<f64>> {
    let bubble = draw.all_bubbles().into_iter().find(|bubble| bubble.index == film)?;
    let is_known = matches!(bubble.film, FilmKey::Uniform(_)) || films.thickness_nm.contains_key(&film);
    let thickness_nm = is_known.then(|| film_thickness(&bubble, draw.on_bath, &films.thickness_nm).ok())??;
    Some(places.iter().map(|place| thickness_nm(*place)).collect())
}

fn seen(draw: &DrawKey, bubble: &BubbleKey, films: &FilmsRead, wall: &Wall) -> WallInSight {
    let known = matches!(bubble.film, FilmKey::Uniform(_)) || films.thickness_nm.contains_key(&bubble.index);
    let thickness = known.then(|| film_thickness(bubble, draw.on_bath, &films.thickness_nm).ok()).flatten();
    WallInSight {
        film: bubble.index,
        place: wall.place,
        cos_theta: wall.cos_theta,
        thickness_nm: thickness.map(|thickness_nm| thickness_nm(wall.place)),
        speed_m_s: velocity_rad_s(bubble, films, wall.place).map(|velocity| velocity.length() * bubble.radius_m),
        optics: draw.lighting.films[bubble.material].quadrature.optics.clone(),
    }
}

/// Velocity of the liquid at a place on a bubble, rad/s, in the film's axes.
fn velocity_rad_s(bubble: &BubbleKey, films: &FilmsRead, place: DVec3) -> Option<DVec3> {
    let FilmKey::Field(field) = &bubble.film else { return Some(DVec3::ZERO) };
    let direction = bubble.to_film * place;
    match field.law(field.state_tick()) {
        FlowLaw::Rest => Some(DVec3::ZERO),
        FlowLaw::Free(_) => films.velocity_rad_s.get(&bubble.index).map(|velocity| velocity.bilinear(direction)),
        law => Some(law.prescribed().velocity(direction, time_s(field))),
    }
}

fn time_s(field: &FieldKey) -> f64 {
    field.moment.ticks() * field.tick_s
}
