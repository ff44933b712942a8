//! From a scene and a shot of it to a frame request: all that the picture needs.

use glam::{DMat3, DVec2};

use super::{
    BubbleKey, CameraKey, DrawKey, FilmKey, FrameRequest, LensSample, LentFilm, LightKey, Moment, PlateKey, Rendering,
    Shot, Story, TonemapKey,
    bodies::bodies,
    crowd::{InSight, in_sight},
    exposed_ev,
    films::{cap, has_field},
    keys::samples,
    light::{light, light_of, lighting},
    range_nm,
    resources::{Resources, SpectralLight},
    sight::{SMALLEST_FIELD_PIXELS, bounds, is_magnified, thicknesses},
};
use crate::{
    physics::{
        bubble::reach,
        colour::white_balance,
        film::fold_seed,
        optics::{FilmIndex, FilmIndexError, FilmMaterial},
        picture::Finish,
    },
    scene::{Boundary, Bubble, Camera, Fault, FilmIndexName, Lens, Scene},
};

/// The frame request for a single shot of a scene. For several shots, make a [`Story`] once.
///
/// # Errors
///
/// As [`Story::request`].
pub fn request(scene: &Scene, resources: &Resources, shot: &Shot) -> Result<FrameRequest, Fault> {
    Story::new(scene.clone()).request(resources, shot)
}

impl Story {
    /// The frame request for a shot of the scene.
    ///
    /// # Errors
    ///
    /// The key of a scene that cannot be drawn: a camera below the bath, an index that no film has.
    pub fn request(&self, resources: &Resources, shot: &Shot) -> Result<FrameRequest, Fault> {
        self.request_from(&self.camera_at(shot.moment), resources, shot)
    }

    /// The frame request for a shot of the scene through one place of the lens.
    ///
    /// # Errors
    ///
    /// As [`Story::request`].
    pub fn request_through(
        &self,
        lens: &LensSample,
        resources: &Resources,
        shot: &Shot,
    ) -> Result<FrameRequest, Fault> {
        self.request_by(&self.camera_at(shot.moment), lens, resources, shot)
    }

    /// Refuses the moment of a scene whose camera sees nothing then.
    ///
    /// # Errors
    ///
    /// The key of a camera below the bath.
    pub fn check_view(&self, moment: Moment) -> Result<(), Fault> {
        let is_below = |height_m: f64| self.camera_at(moment).eye().z <= height_m;
        if bath_m(self).is_some_and(is_below) { Err(below_bath(self, moment)) } else { Ok(()) }
    }

    fn camera_at(&self, moment: Moment) -> Camera {
        self.camera.at(moment.ticks() * self.motion.tick_s)
    }

    /// The frame request for a shot of the scene from a camera that stands, in place of the scene's own.
    ///
    /// # Errors
    ///
    /// As [`Story::request`].
    pub fn request_from(&self, seen_from: &Camera, resources: &Resources, shot: &Shot) -> Result<FrameRequest, Fault> {
        self.request_by(seen_from, &LensSample::MIDDLE, resources, shot)
    }

    fn request_by(
        &self,
        seen_from: &Camera,
        lens: &LensSample,
        resources: &Resources,
        shot: &Shot,
    ) -> Result<FrameRequest, Fault> {
        let scene: &Scene = self;
        let bath_m = bath_m(scene);
        // A bath and what it mirrors are sharp.
        let lens = &LensSample { blurs_bubbles: lens.blurs_bubbles && bath_m.is_none(), ..*lens };
        let camera = through(camera(seen_from, shot.size), lens, (&scene.lens, scene.lens.in_focus_m(seen_from)));
        if bath_m.is_some_and(|height_m| camera.eye_m.z <= height_m) {
            return Err(below_bath(scene, shot.moment));
        }
        let own = scene.bubbles.iter().enumerate();
        let own = own.filter_map(|(index, bubble)| visible(self, &camera, shot, index, bubble));
        let mut bubbles: Vec<BubbleKey> = own.collect();
        let InSight { bubbles: made, small, mut lent } = in_sight(self, &camera, shot);
        bubbles.extend(made);
        let materials = materials(self, resources)?;
        bubbles.iter_mut().for_each(|bubble| bubble.material = materials.of_film[bubble.index]);
        lent.iter_mut().for_each(|lent| lent.material = materials.of_film[lent.index]);
        // Farthest first.
        let power = |bubble: &BubbleKey| camera.power(bubble.center_m, bubble.radius_m);
        bubbles.sort_by(|a, b| power(b).total_cmp(&power(a)));
        let films = materials.in_sight(&bubbles, &lent);
        let are_many = bubbles.len() + small.len() > 1 || !small.is_empty();
        let own =
            SpectralLight { environment: resources.environment.clone(), illuminant: resources.illuminant.clone() };
        let lighting = |source: &SpectralLight, light: LightKey| lighting(scene, source, light, &films, are_many);
        let defocus_rad = lens.defocus * scene.lens.defocus_rad(seen_from);
        let light = light(scene, resources, (&camera, shot.size[1]), defocus_rad);
        let draw = DrawKey {
            size: shot.size,
            full_precision: shot.full_precision,
            exposed_ev: if shot.full_precision { 0 } else { exposed_ev(scene.view.exposure_ev) },
            rendering: Rendering::Full,
            camera,
            lighting: lighting(&own, light),
            spectral_lights: resources
                .spectral_lights
                .iter()
                .map(|source| lighting(source, light_of(scene, source, light)))
                .collect(),
            bubbles,
            small: small.into(),
            lent,
            on_bath: bath_m.is_some(),
            plate: plate(scene, resources, shot.size),
        };
        let dither = scene.view.dither.then_some(fold_seed(scene.view.dither_seed));
        let balances = scene.view.white_balance && !resources.illuminant.is_monochromatic();
        let balance = if balances { white_balance(&resources.illuminant) } else { DMat3::IDENTITY };
        let exposure_ev = scene.view.exposure_ev;
        let finish = finish(scene, shot);
        let picture = TonemapKey { draw, exposure_ev, finish, balance, gamut: shot.gamut, dither };
        Ok(FrameRequest { picture, has_field: self.owners().iter().map(has_field).collect(), pace: shot.pace })
    }
}

/// What lens and film do to a picture. Each moment has a grain of its own.
fn finish(scene: &Scene, shot: &Shot) -> Finish {
    let Lens { glare, vignetting_ev, grain, .. } = scene.lens;
    let grain_seed = if grain > 0.0 { fold_seed(scene.view.dither_seed ^ (shot.moment.tick << 20)) } else { 0 };
    Finish { glare, vignetting_ev, grain, grain_seed }
}

/// Height of the bath that bubbles stand on, if there is one, m.
fn bath_m(scene: &Scene) -> Option<f64> {
    scene.bubbles.iter().find(|bubble| bubble.boundary == Boundary::Bath).map(|bubble| bubble.center_m[2])
}

/// What is wrong with a camera below the bath.
fn below_bath(scene: &Scene, moment: Moment) -> Fault {
    let reason = "looks from below the bath that the bubbles stand on";
    let reason = if scene.camera.keyframes.is_empty() {
        format!("{reason}; raise it, or `target_m`")
    } else {
        let time_s = moment.ticks() * scene.motion.tick_s;
        format!("{reason}, at {time_s:.2} s; raise it, or `target_m`, in the keyframes")
    };
    Fault::new("elevation_deg", reason).inside("camera")
}

fn camera(camera: &Camera, [_, height]: [u32; 2]) -> CameraKey {
    CameraKey {
        eye_m: camera.eye(),
        forward: camera.forward(),
        right: camera.right(),
        up: camera.up(),
        pixel_height_m: 2.0 * (0.5 * camera.fov_y_rad()).tan() / f64::from(height),
        shift: DVec2::ZERO,
        lens_radius_m: 0.0,
        focus_m: camera.distance_m,
    }
}

/// A camera that looks through one place of its lens, which has a depth in focus. What is in focus stays where it is in the picture.
fn through(camera: CameraKey, sample: &LensSample, (lens, in_focus_m): (&Lens, f64)) -> CameraKey {
    let LensSample { offset_m, in_pixel, defocus, blurs_bubbles } = *sample;
    let in_focus = offset_m / (in_focus_m * camera.pixel_height_m);
    CameraKey {
        eye_m: camera.eye_m + offset_m.x * camera.right + offset_m.y * camera.up,
        shift: camera.shift + DVec2::new(in_focus.x, -in_focus.y) - in_pixel,
        lens_radius_m: if blurs_bubbles { 0.5e-3 * defocus * lens.aperture_mm } else { 0.0 },
        focus_m: in_focus_m,
        ..camera
    }
}

fn plate(scene: &Scene, resources: &Resources, size: [u32; 2]) -> Option<PlateKey> {
    let plate = resources.plate.clone().filter(|_| scene.view.plate.is_some())?;
    Some(PlateKey { plate, whole: size, corner: [0; 2], size })
}

/// What the films of a scene are made of.
struct Materials {
    /// Each material once, in the order of the bubbles.
    list: Vec<FilmMaterial>,
    /// The place in the list of each film's material.
    of_film: Vec<usize>,
}

impl Materials {
    /// Each material, and the range of thicknesses that films of it have which are in sight.
    fn in_sight(&self, bubbles: &[BubbleKey], lent: &[LentFilm]) -> Vec<(FilmMaterial, f64)> {
        let mut thickest = vec![0.0_f64; self.list.len()];
        let mut add = |material: usize, nm: f64| thickest[material] = thickest[material].max(nm);
        bubbles.iter().for_each(|bubble| add(bubble.material, bubble.thickness_factor * thickest_nm(&bubble.film)));
        // Not by the bubbles that happen to be in sight: the table must not change with them.
        lent.iter().for_each(|lent| add(lent.material, lent.max_thickness_factor * thickest_nm(&lent.film)));
        self.list.iter().cloned().zip(thickest.into_iter().map(range_nm)).collect()
    }
}

/// The materials of all films of a scene, in sight or not.
fn materials(story: &Story, resources: &Resources) -> Result<Materials, Fault> {
    let mut named: Vec<(&FilmIndexName, f64)> = Vec::new();
    let mut materials = Materials { list: Vec::new(), of_film: Vec::new() };
    for (number, Bubble { film, .. }) in story.owners().iter().enumerate() {
        let name = (&film.index, film.skin_nm);
        let known = named.iter().position(|known| *known == name);
        let place = known.unwrap_or(named.len());
        if known.is_none() {
            let index = film_index(&film.index, resources);
            let (list, number) = story.place_of_film(number);
            let refused = |error| Fault::unusable("index", error).inside("film").inside_item(list, number);
            materials.list.push(FilmMaterial { index: index.map_err(refused)?, skin_nm: film.skin_nm });
            named.push(name);
        }
        materials.of_film.push(place);
    }
    if materials.list.is_empty() {
        // What the light's own colour is told from.
        materials.list.push(FilmMaterial::default());
    }
    Ok(materials)
}

/// The index of a film by its name in a scene.
///
/// # Errors
/// There is no such liquid, or no film has such an index.
pub fn film_index(index: &FilmIndexName, resources: &Resources) -> Result<FilmIndex, FilmIndexError> {
    match index {
        FilmIndexName::Water => Ok(FilmIndex::Water),
        FilmIndexName::Constant(n) => FilmIndex::constant(*n),
        FilmIndexName::Named(name) => {
            resources.liquids.get(name).map_or_else(|| name.parse(), |known| Ok(known.clone()))
        }
    }
}

fn thickest_nm(film: &FilmKey) -> f64 {
    match film {
        FilmKey::Uniform(thickness_nm) => *thickness_nm,
        FilmKey::Field(field) => field.initial.range_nm().1,
    }
}

/// Samples along a pixel's side of a film that ends on a ring or at a hole: its edge is not smoothed otherwise.
const EDGE_SAMPLES: u32 = 2;

/// A bubble as the picture sees it, if any pixel can.
fn visible(story: &Story, camera: &CameraKey, shot: &Shot, index: usize, bubble: &Bubble) -> Option<BubbleKey> {
    let center_m = story.center_m(index, shot.moment.ticks() * story.motion.tick_s);
    let age = story.age(index, shot.moment)?;
    // What a film ends at does not grow with it.
    let size = if bubble.boundary == Boundary::Free { age.size() } else { 1.0 };
    let radius_m = Some(bubble.radius_mm * 1e-3 * size).filter(|radius_m| *radius_m > 0.0)?;
    // The bath holds a bubble's foot, and it does not oscillate as a sphere does.
    let is_held = bubble.boundary == Boundary::Bath;
    let stretch = if is_held { DMat3::IDENTITY } else { age.life.shape(age.moment).stretch() };
    let bounds = bounds(camera, shot.size, center_m, radius_m * reach(stretch))?;
    let distance = center_m.distance(camera.eye_m).max(radius_m);
    let radius_pixels = radius_m / distance / camera.pixel_height_m;
    let film = match story.film_of_age(index, &age) {
        FilmKey::Field(_) if radius_pixels < SMALLEST_FIELD_PIXELS => FilmKey::Uniform(bubble.film.thickness_nm),
        film => film,
    };
    let ticks = age.moment.ticks();
    let has_edge = bubble.boundary == Boundary::Ring || age.hole.is_some();
    let samples = samples(radius_pixels).max(if has_edge { EDGE_SAMPLES } else { 1 });
    let is_sharp = camera.is_in_focus(center_m, radius_m);
    let magnified = is_sharp && is_magnified(&film, radius_m, radius_pixels, center_m.distance(camera.eye_m));
    Some(BubbleKey {
        id: index as u32 + 1,
        index,
        material: 0,
        center_m,
        radius_m,
        stretch,
        bounds,
        // A film of one thickness looks the same however it is turned.
        to_film: match film {
            FilmKey::Uniform(_) => DMat3::IDENTITY,
            FilmKey::Field(_) => DMat3::from_quat(story.film_turn(age.life.born as f64 + ticks).inverse()),
        },
        evaporated_nm: age.life.evaporation.nm(ticks),
        samples,
        // The edge of a hole is no thickness between others.
        thicknesses: if age.hole.is_none() { thicknesses(&film, radius_pixels, is_sharp) } else { 1 },
        magnified,
        // Where cells are larger than pixels, pixels are small, and each sample is costly.
        refined: samples == 1 && !magnified,
        film,
        thickness_factor: 1.0,
        hole: age.hole,
        cap: cap(bubble),
        bodies: bodies(bubble, center_m, age.hole.is_some(), camera, shot),
    })
}
