//! One ray with all that it splits into at walls of film, and the light that its branches bring.

use std::rc::Rc;

use glam::{DMat3, DVec3};

use super::{
    FilmSphere, PictureScene,
    bath::{mirrored_part, past_meniscus},
    walls::{Line, Surface, Wall},
    weights::Weights,
};
use crate::physics::{
    colour::{daylight_scale, responses},
    optics::{Polarised, SpectralWall},
};

/// Reflections followed at most along a branch; only rays within a hair of the limb have more to give.
const MAX_REFLECTIONS: u32 = 64;
/// Sine of the angle of incidence below which there is no plane of incidence: reflectances of s and p light differ by its square.
const NO_PLANE: f64 = 1e-6;
/// How far the cosines of two hits of one bubble may be apart by rounding where they are the same.
const SAME_COS: f64 = 1e-12;
/// Sine of the angle that two planes of incidence may be apart by rounding where they are the same.
const SAME_PLANE: f64 = 3e-8;

/// A scene, ready to have rays followed through it.
pub(super) struct LightPath<'a> {
    scene: &'a PictureScene<'a>,
    surfaces: Vec<Surface>,
    /// For each wavelength, the matrix from light to its colour; together they show white daylight as (1, 1, 1).
    responses: Vec<DMat3>,
    /// Their sum: what is seen of light that met no film.
    seen: DMat3,
    /// Whether a ray meets all walls in one plane of incidence, as those of one round bubble, with its mirror image in a bath.
    one_plane: bool,
    /// Height of the bath over the eye, in metres.
    bath_m: Option<f64>,
}

fn surface(sphere: &FilmSphere, eye_m: DVec3) -> Surface {
    Surface::new(sphere.center_m - eye_m, sphere.radius_m, sphere.stretch)
}

/// A ray between two reflections, and what is seen of light that arrives along it.
struct Branch {
    line: Line,
    weights: Weights,
    /// Unit vector across the plane of incidence that s and p refer to: the electric field of s light. That of p light is the line's direction
    /// × this.
    across: DVec3,
    /// Walls that have reflected it.
    reflections: u32,
    /// Bubbles that it has met, or been reflected in.
    met: Vec<Met>,
}

/// Light at the angle at which a line meets a bubble: a sphere is met at the same angle where the line enters and where it leaves, and
/// again after each reflection inside.
struct Met {
    bubble: usize,
    cos_theta: f64,
    incidence: Rc<SpectralWall>,
}

impl<'a> LightPath<'a> {
    pub fn new(scene: &'a PictureScene<'a>) -> Self {
        debug_assert!(scene.spheres.iter().all(|sphere| sphere.optics.weights() == scene.light), "films of one light");
        let eye_m = scene.camera.eye_m;
        let scale = DMat3::from_diagonal(daylight_scale());
        let responses: Vec<DMat3> = responses(scene.light).into_iter().map(|response| scale * response).collect();
        let seen = responses.iter().fold(DMat3::ZERO, |sum, response| sum + *response);
        let surfaces: Vec<Surface> = scene.spheres.iter().map(|sphere| surface(sphere, eye_m)).collect();
        // Where nothing stands on it, any height below the eye does.
        let level_m = || scene.spheres.first().map_or(-1.0, |sphere| sphere.center_m.z - eye_m.z);
        let one_plane = matches!(&scene.spheres[..], [sphere] if sphere.stretch == DMat3::IDENTITY);
        Self { scene, surfaces, responses, seen, one_plane, bath_m: scene.on_bath.then(level_m) }
    }

    /// The colour that is seen along a ray from the eye, a unit vector.
    pub fn colour(&self, ray: DVec3) -> DVec3 {
        let line = Line { origin_m: DVec3::ZERO, direction: ray, from: None };
        if !self.meets_film(&line) {
            return self.seen * self.arriving(ray, 0);
        }
        let (across, seen) = self.polarisation(ray);
        let weights = Weights::new(seen, self.responses.len());
        self.follow(Branch { line, weights, across, reflections: 0, met: Vec::new() })
    }

    /// What is seen of s and p light, and the direction across the plane that they refer to: halves without a polariser. With one, light that
    /// passes it is all s, which is half of what an ideal polariser takes given back.
    fn polarisation(&self, ray: DVec3) -> (DVec3, Polarised) {
        // An axis along the ray passes nothing of either.
        let passed =
            self.scene.polariser.map(|axis| axis.reject_from_normalized(ray)).filter(|axis| axis.length() > 1e-6);
        match passed {
            Some(axis) => (axis.normalize(), Polarised { s: 1.0, p: 0.0 }),
            None => (ray.any_orthonormal_vector(), Polarised { s: 0.5, p: 0.5 }),
        }
    }

    /// The colour of all light that arrives along a branch and those that split from it.
    fn follow(&self, mut branch: Branch) -> DVec3 {
        let mut seen = DVec3::ZERO;
        if branch.reflections < MAX_REFLECTIONS && !self.is_negligible(&branch) {
            loop {
                for wall in self.walls(&branch.line) {
                    seen += self.reflected(&mut branch, &wall);
                    if self.is_negligible(&branch) {
                        return seen + self.rest(&branch);
                    }
                }
                let Some(line) = self.beyond_bath(&branch.line) else { break };
                branch.weights.dim(mirrored_part(line.direction.z));
                // The mirror image of s light is s light.
                branch.weights.mirror();
                branch.across.z = -branch.across.z;
                branch.line = line;
            }
        }
        seen + self.rest(&branch)
    }

    /// Takes from a branch what a wall reflects, and returns the colour of the light that arrives there.
    fn reflected(&self, branch: &mut Branch, wall: &Wall) -> DVec3 {
        let sphere = &self.scene.spheres[wall.bubble];
        if self.bath_m.is_some() {
            branch.weights.dim(past_meniscus(wall.place.z, sphere.radius_m));
        }
        let thickness_nm = (sphere.thickness_nm)(wall.place);
        // Where there is no film there is no plane of incidence either.
        if thickness_nm == 0.0 {
            return DVec3::ZERO;
        }
        branch.turn_to(wall);
        if self.one_plane {
            // Nothing is seen of it without another turn.
            branch.weights.drop_coherence();
        }
        let incidence = branch.met(wall, || Rc::new(sphere.optics.spectral_wall(wall.cos_theta)));
        let weights = branch.weights.take_reflected(&incidence, thickness_nm);
        let direction = branch.line.direction;
        let line = Line {
            origin_m: self.surfaces[wall.bubble].point_m(wall.place),
            direction: (direction - 2.0 * direction.dot(wall.normal) * wall.normal).normalize(),
            from: Some((wall.bubble, wall.place)),
        };
        let met = vec![Met { bubble: wall.bubble, cos_theta: wall.cos_theta, incidence }];
        self.follow(Branch { line, weights, across: branch.across, reflections: branch.reflections + 1, met })
    }

    /// Whether splitting what is left of a branch is pointless.
    fn is_negligible(&self, branch: &Branch) -> bool {
        branch.weights.totals().all(|seen| seen < self.scene.negligible)
    }

    /// The colour of the light that arrives from as far as a branch looks, past all walls.
    fn rest(&self, branch: &Branch) -> DVec3 {
        let seen = self.responses.iter().zip(branch.weights.totals());
        let matrix = seen.fold(DMat3::ZERO, |sum, (response, seen)| sum + *response * seen);
        matrix * self.arriving(branch.line.direction, branch.reflections)
    }

    /// Light that arrives from a direction after a number of reflections by walls: without one, it is what stands behind the bubbles.
    fn arriving(&self, direction: DVec3, reflections: u32) -> DVec3 {
        let meets_bath = self.bath_m.is_some() && direction.z < 0.0;
        let (direction, left) =
            if meets_bath { (direction.with_z(-direction.z), mirrored_part(direction.z)) } else { (direction, 1.0) };
        let behind = self.scene.backdrop.filter(|_| reflections == 0);
        left * behind.unwrap_or(self.scene.surroundings)(direction)
    }

    fn meets_film(&self, line: &Line) -> bool {
        !self.walls(line).is_empty() || self.beyond_bath(line).is_some_and(|line| !self.walls(&line).is_empty())
    }

    /// The walls that a line meets, the nearest first, as far as the bath.
    fn walls(&self, line: &Line) -> Vec<Wall> {
        let mut walls = Vec::new();
        for (bubble, surface) in self.surfaces.iter().enumerate() {
            surface.add_walls(bubble, line, &mut walls);
        }
        if let Some(bath) = self.to_bath_m(line) {
            walls.retain(|wall| wall.distance_m < bath);
        }
        walls.sort_unstable_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
        walls
    }

    /// The distance along a line to the bath, in metres.
    fn to_bath_m(&self, line: &Line) -> Option<f64> {
        let level_m = self.bath_m.filter(|_| line.direction.z < 0.0)?;
        // The foot of a wall is below the level by rounding.
        Some(((level_m - line.origin_m.z) / line.direction.z).max(0.0))
    }

    /// The line that the bath turns a line into.
    fn beyond_bath(&self, line: &Line) -> Option<Line> {
        let origin_m = line.origin_m + self.to_bath_m(line)? * line.direction;
        Some(Line { origin_m, direction: line.direction.with_z(-line.direction.z), from: None })
    }
}

impl Branch {
    /// Turns s and p to the plane of incidence at a wall.
    fn turn_to(&mut self, wall: &Wall) {
        let across = self.line.direction.cross(wall.normal);
        if across.length() < NO_PLANE {
            return;
        }
        let across = across.normalize();
        let sine = self.line.direction.cross(self.across).dot(across);
        if sine.abs() > SAME_PLANE {
            self.weights.turn(self.across.dot(across), sine);
        }
        self.across = across;
    }

    /// Light at the angle at which it meets a wall. A line meets a bubble at most twice, so the second time it is not kept.
    fn met(&mut self, wall: &Wall, new: impl FnOnce() -> Rc<SpectralWall>) -> Rc<SpectralWall> {
        let same = |met: &Met| met.bubble == wall.bubble && (met.cos_theta - wall.cos_theta).abs() < SAME_COS;
        if let Some(known) = self.met.iter().position(same) {
            return self.met.swap_remove(known).incidence;
        }
        let incidence = new();
        self.met.push(Met { bubble: wall.bubble, cos_theta: wall.cos_theta, incidence: incidence.clone() });
        incidence
    }
}
