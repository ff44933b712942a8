//! What a line of sight meets: the walls of the nearest bubble, with the film that stands there.

use std::{
    collections::{BTreeMap, HashSet},
    sync::OnceLock,
};

use glam::{DVec2, DVec3, IVec2};

use crate::{
    physics::{
        picture::{Line, PictureCamera, Surface, Wall},
        sphere::PaddedField,
    },
    plan::{BubbleKey, DrawKey, FieldKey, FilmKey, FlowLaw, OpticsKey},
    verify::reference::{FilmThickness, MovedFilms, camera, film_thickness},
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
    /// Where it flows to in the picture, degrees counterclockwise from the right; none at rest.
    pub flow_deg: Option<f64>,
    /// What the film is made of, and the light.
    pub optics: OpticsKey,
}

/// The walls of the nearest bubble on the line of sight through a position in the picture, in pixels from the top left, y down: the front wall and
/// the back wall from outside, one from inside, none beside all bubbles. What lies behind the mirror of a bath is not looked for.
#[must_use]
pub fn walls_in_sight(draw: &DrawKey, films: &FilmsRead, position: DVec2) -> Vec<WallInSight> {
    FilmView::new(draw, films).walls(position)
}

/// Thickness in nm at places of a film, unit vectors from the bubble's center in the world's axes; 0 where there is no film. `None` for a film that is
/// not in the picture or must be read from the device first.
#[must_use]
pub fn thickness_at(draw: &DrawKey, films: &FilmsRead, film: usize, places: &[DVec3]) -> Option<Vec<f64>> {
    let view = FilmView::new(draw, films);
    let bubble = view.bubbles.iter().find(|bubble| bubble.key.index == film)?;
    places.iter().map(|place| view.thickness_nm(bubble, *place)).collect()
}

/// The films of a picture, to be looked at along many lines of sight.
pub struct FilmView<'a> {
    draw: &'a DrawKey,
    films: &'a FilmsRead,
    camera: PictureCamera,
    bubbles: Vec<SeenBubble<'a>>,
}

/// A bubble of a picture.
struct SeenBubble<'a> {
    key: BubbleKey,
    surface: Surface,
    /// Its film, once it is looked at; none that must be read from the device first.
    thickness_nm: OnceLock<Option<FilmThickness<'a>>>,
}

/// A point of the film that is in front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmInFront {
    /// Height above the bubble's center, m.
    pub height_m: f64,
    /// Radius of the bubble, m.
    pub radius_m: f64,
    /// Index of the film.
    pub film: usize,
    /// Thickness along the normal, nm.
    pub thickness_nm: f64,
    /// Speed of the liquid along the film, m/s, if it is known.
    pub speed_m_s: Option<f64>,
    /// Vorticity of the film, 1/s, positive where it turns counterclockwise as seen from outside, if it is known.
    pub vorticity_1_s: Option<f64>,
}

/// Streamlines of one picture, while they are traced.
struct Streamlines {
    /// Squares of the picture that a line passes: no other one enters them.
    taken: HashSet<IVec2>,
    /// Side of a square, pixels.
    side: f64,
}

impl Streamlines {
    fn square(&self, position: DVec2) -> IVec2 {
        (position / self.side).floor().as_ivec2()
    }

    /// Whether a line may go on at a position, coming from another one: it crosses neither another line nor itself.
    fn enters(&mut self, from: DVec2, to: DVec2) -> bool {
        let square = self.square(to);
        square == self.square(from) || self.taken.insert(square)
    }
}

/// Length of a part of a streamline, pixels.
const STREAMLINE_STEP: f64 = 2.0;
/// Parts of a streamline in each direction, at most.
const STREAMLINE_STEPS: usize = 600;
/// Speed below which a film is at rest, rad/s: a bubble of 50 mm would take an hour to flow once around.
const REST_RAD_S: f64 = 2e-3;

/// Half of the distance between the velocities whose difference is the vorticity, radians: below the cells of any flow.
const HALF_STEP_RAD: f64 = 0.01;

impl<'a> FilmView<'a> {
    /// The films of a picture, as far as they have been read.
    #[must_use]
    pub fn new(draw: &'a DrawKey, films: &'a FilmsRead) -> Self {
        let seen = |key: BubbleKey| SeenBubble {
            surface: Surface::new(key.center_m - draw.camera.eye_m, key.radius_m, key.stretch),
            key,
            thickness_nm: OnceLock::new(),
        };
        let bubbles = draw.all_bubbles().into_iter().map(seen).collect();
        Self { draw, films, camera: camera(&draw.camera), bubbles }
    }

    /// As [`walls_in_sight`].
    #[must_use]
    pub fn walls(&self, position: DVec2) -> Vec<WallInSight> {
        let Some((bubble, walls)) = self.nearest(position) else { return Vec::new() };
        walls.iter().map(|wall| self.seen(bubble, wall)).collect()
    }

    /// The film that is in front at a position in the picture, in pixels from the top left, y down. `None` beside all bubbles, where there is no film,
    /// and where it must be read from the device first.
    #[must_use]
    pub fn front(&self, position: DVec2) -> Option<FilmInFront> {
        let (bubble, walls) = self.nearest(position)?;
        let (place, key) = (walls.first()?.place, &bubble.key);
        let thickness_nm = self.thickness_nm(bubble, place).filter(|nm| *nm > 0.0)?;
        Some(FilmInFront {
            height_m: key.radius_m * (key.stretch * place).z,
            radius_m: key.radius_m,
            film: key.index,
            thickness_nm,
            speed_m_s: velocity_rad_s(key, self.films, place).map(|velocity| velocity.length() * key.radius_m),
            vorticity_1_s: self.vorticity_1_s(key, place),
        })
    }

    /// Streamlines of the front walls at the moment, about `spacing` pixels apart: positions in the picture, in pixels from the top left, y down, each
    /// line in the direction of the flow. A film at rest, or one whose flow is not known, has none.
    #[must_use]
    pub fn streamlines(&self, spacing: f64) -> Vec<Vec<DVec2>> {
        let [columns, rows] = self.draw.size.map(|pixels| (f64::from(pixels) / spacing) as u32);
        let mut traced = Streamlines { taken: HashSet::new(), side: 0.5 * spacing };
        let mut lines = Vec::new();
        for k in 0..columns * rows {
            let seed = spacing * (DVec2::new((k % columns).into(), (k / columns).into()) + 0.5);
            let Some((bubble, walls)) = self.nearest(seed) else { continue };
            let square = traced.square(seed);
            if !traced.taken.insert(square) {
                continue;
            }
            let mut trace = |sign: f64| self.trace(bubble, (walls[0].place, seed), sign, &mut traced);
            let (mut line, after) = (trace(-1.0), trace(1.0));
            line.reverse();
            line.push(seed);
            line.extend(after);
            if line.len() > 2 {
                lines.push(line);
            }
        }
        lines
    }

    /// A streamline from a place and its position in the picture on, with the flow or against it, as far as it is seen.
    fn trace(
        &self,
        bubble: &SeenBubble<'_>,
        (mut place, mut position): (DVec3, DVec2),
        sign: f64,
        traced: &mut Streamlines,
    ) -> Vec<DVec2> {
        let key = &bubble.key;
        let from_eye_m = key.center_m - self.draw.camera.eye_m;
        let step_rad = STREAMLINE_STEP * self.draw.camera.pixel_height_m * from_eye_m.length() / key.radius_m;
        let direction = |place: DVec3| {
            let velocity = velocity_rad_s(key, self.films, place).filter(|velocity| velocity.length() > REST_RAD_S)?;
            Some(sign * (key.to_film.transpose() * velocity).normalize())
        };
        let mut line_on = || {
            let middle = (place + 0.5 * step_rad * direction(place)?).normalize();
            let next = (place + step_rad * direction(middle)?).normalize();
            let to = self.camera.position(self.draw.size, from_eye_m + key.radius_m * (key.stretch * next))?;
            let (_, walls) = self.nearest(to)?;
            let is_seen = walls.first()?.place.distance(next) < 0.1 * step_rad;
            (is_seen && traced.enters(position, to)).then(|| {
                (place, position) = (next, to);
                to
            })
        };
        std::iter::from_fn(&mut line_on).take(STREAMLINE_STEPS).collect()
    }

    /// The nearest bubble on a line of sight, with the walls that it meets.
    fn nearest(&self, position: DVec2) -> Option<(&SeenBubble<'a>, Vec<Wall>)> {
        let line = Line { origin_m: DVec3::ZERO, direction: self.camera.ray(self.draw.size, position), from: None };
        let met = self.bubbles.iter().filter_map(|bubble| {
            let mut walls = Vec::new();
            bubble.surface.add_walls(0, &line, &mut walls);
            // A cap of a film ends somewhere; beyond it there is nothing to meet.
            let key = &bubble.key;
            walls.retain(|wall| key.cap.is_none_or(|cap| cap.contains(key.to_film * wall.place)));
            Some((walls.first()?.distance_m, bubble, walls))
        });
        let (_, bubble, walls) = met.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((bubble, walls))
    }

    /// Thickness in nm at a place of a bubble; `None` where the film must be read from the device first.
    fn thickness_nm(&self, bubble: &SeenBubble<'a>, place: DVec3) -> Option<f64> {
        let film = bubble.thickness_nm.get_or_init(|| {
            let (key, films) = (&bubble.key, &self.films.thickness_nm);
            let is_known = matches!(key.film, FilmKey::Uniform(_)) || films.contains_key(&key.index);
            is_known.then(|| film_thickness(key, self.draw.on_bath, films).ok()).flatten()
        });
        film.as_ref().map(|thickness_nm| thickness_nm(place))
    }

    fn seen(&self, bubble: &SeenBubble<'a>, wall: &Wall) -> WallInSight {
        let key = &bubble.key;
        let velocity = velocity_rad_s(key, self.films, wall.place);
        WallInSight {
            film: key.index,
            place: wall.place,
            cos_theta: wall.cos_theta,
            thickness_nm: self.thickness_nm(bubble, wall.place),
            speed_m_s: velocity.map(|velocity| velocity.length() * key.radius_m),
            flow_deg: velocity.filter(|velocity| velocity.length() > REST_RAD_S).map(|velocity| {
                let way = key.to_film.transpose() * velocity;
                way.dot(self.draw.camera.up).atan2(way.dot(self.draw.camera.right)).to_degrees()
            }),
            optics: self.draw.lighting.films[key.material].quadrature.optics.clone(),
        }
    }

    /// The curl of the velocity along the normal, by central differences.
    fn vorticity_1_s(&self, key: &BubbleKey, place: DVec3) -> Option<f64> {
        let right = place.any_orthonormal_vector();
        let up = place.cross(right);
        // The component along one tangent of the difference of velocities along the other. Films turn as a whole, so that tangents turn too.
        let slope = |way: DVec3, part: DVec3| {
            let at = |side: f64| velocity_rad_s(key, self.films, (place + side * HALF_STEP_RAD * way).normalize());
            Some((at(1.0)? - at(-1.0)?).dot(key.to_film * part) / (2.0 * HALF_STEP_RAD))
        };
        Some(slope(right, up)? - slope(up, right)?)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        input::load_scene_with,
        physics::colour::Gamut,
        plan::{Moment, Pace, Shot},
    };

    const SIZE: [u32; 2] = [200, 200];

    fn draw(settings: &[&str]) -> DrawKey {
        let settings: Vec<_> = settings.iter().map(|setting| setting.parse().unwrap()).collect();
        let scene = load_scene_with("bands", &settings).unwrap();
        let moment = Moment { tick: 60, ..Moment::default() };
        let shot = Shot { size: SIZE, moment, full_precision: false, gamut: Gamut::Srgb, pace: Pace::Whole };
        scene.request(&shot).unwrap().picture.draw
    }

    /// A film that turns as a rigid body about the vertical has twice its rate as vorticity at the top, and `2 Ω cos ϑ` elsewhere.
    #[test]
    fn vorticity_is_the_curl_of_the_velocity() {
        let draw = draw(&["camera.elevation_deg=40", "motion.flow=free"]);
        let mut films = FilmsRead::default();
        let grid = crate::physics::sphere::CubedSphere::new(64).unwrap();
        films.thickness_nm.insert(0, PaddedField::sample(grid, |_| 500.0));
        films.velocity_rad_s.insert(0, PaddedField::sample(grid, |x| 3.0 * DVec3::Z.cross(x)));
        let view = FilmView::new(&draw, &films);
        for position in [DVec2::new(100.0, 100.0), DVec2::new(90.0, 60.0), DVec2::new(130.0, 120.0)] {
            let front = view.front(position).unwrap();
            let cos = front.height_m / front.radius_m;
            let sin = (1.0 - cos * cos).sqrt();
            assert!((front.vorticity_1_s.unwrap() - 6.0 * cos).abs() < 0.02, "{position}: {front:?} {cos}");
            assert!((front.speed_m_s.unwrap() - 3.0 * sin * front.radius_m).abs() < 1e-3, "{position}: {front:?}");
            let [front, back] = &view.walls(position)[..] else { panic!("two walls") };
            // In front it flows to the right, behind to the left.
            let (right, left) = (front.flow_deg.unwrap(), back.flow_deg.unwrap());
            assert!(right.abs() < 60.0 && left.abs() > 120.0, "{position}: {right} and {left}");
        }
        assert_eq!(view.front(DVec2::new(2.0, 2.0)), None, "beside the bubble");
    }

    /// A film that turns about the vertical flows along circles of one height, counterclockwise from above.
    #[test]
    fn streamlines_follow_the_flow() {
        let draw = draw(&["camera.elevation_deg=20", "motion.flow=free"]);
        let mut films = FilmsRead::default();
        let grid = crate::physics::sphere::CubedSphere::new(64).unwrap();
        films.thickness_nm.insert(0, PaddedField::sample(grid, |_| 500.0));
        assert!(FilmView::new(&draw, &films).streamlines(20.0).is_empty(), "nothing is known of the flow");
        films.velocity_rad_s.insert(0, PaddedField::sample(grid, |x| 3.0 * DVec3::Z.cross(x)));
        let (view, to_film) = (FilmView::new(&draw, &films), draw.bubbles[0].to_film);
        let lines = view.streamlines(20.0);
        assert!(lines.len() > 4, "{}", lines.len());
        for line in &lines {
            let places: Vec<DVec3> = line.iter().map(|at| to_film * view.walls(*at)[0].place).collect();
            let height = |end: fn(f64, f64) -> f64| places.iter().map(|place| place.z).reduce(end).unwrap();
            let (low, high) = (height(f64::min), height(f64::max));
            assert!(high - low < 1e-3, "{low} to {high}");
            assert!(places.windows(2).all(|pair| pair[0].cross(pair[1]).z > 0.0), "{line:?}");
        }
    }

    #[test]
    fn films_that_are_not_read_have_no_thickness() {
        let draw = draw(&[]);
        let films = FilmsRead::default();
        let middle = DVec2::new(100.0, 100.0);
        assert_eq!(FilmView::new(&draw, &films).front(middle), None);
        assert_eq!(walls_in_sight(&draw, &films, middle)[0].thickness_nm, None);
        assert_eq!(thickness_at(&draw, &films, 0, &[DVec3::X]), None);
    }
}
