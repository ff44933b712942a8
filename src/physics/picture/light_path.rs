//! One ray through one bubble: the hits on the film, and how much of the light each direction contributes.

use glam::{DMat3, DVec3};

use super::bath::{crossing, past_meniscus};
use crate::physics::{
    colour::{FilmOptics, daylight_scale, responses},
    optics::{Polarised, amplitudes},
};

/// Inner reflections followed at most; only rays within a hair of the limb have more to give.
const MAX_INNER: usize = 64;
/// What may be left to the last direction before following it further is pointless.
const NEGLIGIBLE: f64 = 1e-6;

/// A film under an illuminant, ready to have rays traced through bubbles of it.
pub(super) struct LightPath<'a> {
    optics: &'a FilmOptics,
    /// For each wavelength, the matrix from light to its colour; together they show white daylight as (1, 1, 1).
    responses: Vec<DMat3>,
    /// Direction that a polariser lets pass.
    polariser: Option<DVec3>,
}

/// The light along a ray: for each direction, the matrix from the light there to its colour.
pub(super) struct Arrivals {
    /// On what stands straight behind the bubble.
    pub straight: DMat3,
    /// On the surroundings in a direction: the outer reflection, if there is one, then each inner one.
    pub reflected: Vec<(DVec3, DMat3)>,
}

impl<'a> LightPath<'a> {
    pub fn new(optics: &'a FilmOptics, polariser: Option<DVec3>) -> Self {
        let scale = DMat3::from_diagonal(daylight_scale());
        let responses = responses(optics).into_iter().map(|response| scale * response).collect();
        Self { optics, responses, polariser }
    }

    /// What is seen of light that met no bubble.
    pub fn seen(&self) -> DMat3 {
        self.responses.iter().fold(DMat3::ZERO, |sum, response| sum + *response)
    }

    /// Follows a ray (a unit vector) from an eye in units of the radius, the bubble's center at the origin and stretched by a symmetric
    /// matrix, or of a radius in m and standing on a bath; `None` if it misses.
    pub fn trace(
        &self,
        eye: DVec3,
        ray: DVec3,
        stretch: DMat3,
        on_bath: Option<f64>,
        thickness_nm: &dyn Fn(DVec3) -> f64,
    ) -> Option<Arrivals> {
        let is_round = stretch == DMat3::IDENTITY;
        let to_round = stretch.inverse();
        let (eye, round) = if is_round { (eye, ray) } else { (to_round * eye, (to_round * ray).normalize()) };
        let along = eye.dot(round);
        let foot = eye - along * round;
        let inside = eye.length_squared() <= 1.0;
        if foot.length_squared() >= 1.0 || (!inside && along >= 0.0) {
            return None;
        }
        let cos_theta = (1.0 - foot.length_squared()).sqrt();
        let inner = self.inner_reflections(cos_theta);
        let hits = if is_round {
            Hits::on_sphere(foot, ray, cos_theta, inner)
        } else {
            Hits::on_ellipsoid([foot - cos_theta * round, foot + cos_theta * round], ray, to_round, inner)
        };
        let thickness_nm: Vec<f64> = hits.points.iter().map(|point| thickness_nm(*point)).collect();
        let mut factors = self.factors(&hits.cosines, &thickness_nm, inside, self.polarisation(to_round * foot, ray));
        if let Some(radius_m) = on_bath {
            factors.dim(&hits, (eye, ray), inside, radius_m);
        }
        let first = usize::from(inside);
        let reflected = hits.directions.into_iter().zip(factors.reflected).skip(first).collect();
        Some(Arrivals { straight: factors.straight, reflected })
    }

    /// How many inner reflections to follow, by the maximum reflectance of any film at this angle.
    fn inner_reflections(&self, cos_theta: f64) -> usize {
        let r2 = amplitudes(self.optics.film().reference_index(), cos_theta).s.powi(2);
        let max = 4.0 * r2 / (1.0 + r2).powi(2);
        let needed = NEGLIGIBLE.ln() / max.ln();
        // `max` is 1 exactly at the limb, where no number of reflections is enough.
        if needed.is_finite() && needed > 0.0 { (needed.ceil() as usize).clamp(1, MAX_INNER) } else { MAX_INNER }
    }

    /// Shares of s and p light that are seen: halves without a polariser. With one, the share of the light's power that passes it,
    /// together 1 as well, which is half of what an ideal polariser takes given back.
    fn polarisation(&self, foot: DVec3, ray: DVec3) -> Polarised {
        let across = ray.cross(foot).try_normalize();
        let (Some(axis), Some(across)) = (self.polariser, across) else { return Polarised { s: 0.5, p: 0.5 } };
        let [s, p] = [across, ray.cross(across)].map(|field| axis.dot(field).powi(2));
        // An axis along the ray passes nothing of either.
        if s + p > 1e-12 { Polarised { s: s / (s + p), p: p / (s + p) } } else { Polarised { s: 0.5, p: 0.5 } }
    }

    /// With the cosine at each hit, or one for all.
    fn factors(&self, cosines: &[f64], thickness_nm: &[f64], inside: bool, polarisation: Polarised) -> Factors {
        let first = self.optics.spectral_wall(cosines[0]);
        let reflectances = |k: usize| match cosines.get(k) {
            Some(cos_theta) if k > 0 => self.optics.spectral_wall(*cos_theta).reflectances(thickness_nm[k]),
            _ => first.reflectances(thickness_nm[k]),
        };
        let front = reflectances(0);
        let outer = self.colour(front.iter().map(|r| polarisation.times(*r)));
        // What is inside and heads for the next wall.
        let entered = |r: &Polarised| if inside { polarisation } else { polarisation.times(r.rest()) };
        let mut left: Vec<Polarised> = front.iter().map(entered).collect();
        let mut leave = |k: usize| {
            let reflectances = reflectances(k);
            let colour = self.colour(left.iter().zip(&reflectances).map(|(left, r)| left.times(r.rest())));
            left.iter_mut().zip(reflectances).for_each(|(left, r)| *left = left.times(r));
            colour
        };
        let straight = leave(1);
        let last = thickness_nm.len() - 1;
        let mut reflected = vec![outer];
        reflected.extend((2..=last).map(&mut leave));
        // The last direction followed keeps all that is left.
        reflected.push(self.colour(left.into_iter()));
        Factors { straight, reflected }
    }

    /// The matrix from light to its colour, by the part of each wavelength that is seen, both polarisations together.
    fn colour(&self, seen: impl Iterator<Item = Polarised>) -> DMat3 {
        self.responses.iter().zip(seen).fold(DMat3::ZERO, |sum, (response, seen)| sum + *response * (seen.s + seen.p))
    }
}

/// Matrices of a ray's directions, summed over wavelengths and polarisations.
struct Factors {
    straight: DMat3,
    /// Outer reflection first, then each inner one.
    reflected: Vec<DMat3>,
}

impl Factors {
    /// Takes from each direction what a bath on the way does: see `bath.rs`.
    fn dim(&mut self, hits: &Hits, (eye, ray): (DVec3, DVec3), inside: bool, radius_m: f64) {
        let past = |point: DVec3| past_meniscus(point.z, radius_m);
        let leaving = |point: DVec3, direction: DVec3| crossing(point.z, direction.z, direction);
        let (front, back) = (hits.points[0], hits.points[1]);
        let entered = crossing(eye.z, front.z, ray) * past(front);
        self.reflected[0] *= entered * leaving(front, hits.directions[0]);
        let mut left = if inside { crossing(eye.z, back.z, ray) } else { entered * crossing(front.z, back.z, ray) };
        left *= past(back);
        self.straight *= left * leaving(back, ray);
        for (k, factor) in self.reflected.iter_mut().enumerate().skip(1) {
            let (point, direction) = (hits.points[k], hits.directions[k]);
            // The chord on from a point of the sphere.
            let next = point - 2.0 * point.dot(direction) * direction;
            left *= crossing(point.z, next.z, direction) * past(next);
            *factor *= left * leaving(next, direction);
        }
    }
}

/// Where a ray meets the wall, as points of the unit sphere, and where it goes from there.
struct Hits {
    /// The cosine of incidence at each point, or one for all.
    cosines: Vec<f64>,
    /// The front wall, then each point on the inside that the ray comes to.
    points: Vec<DVec3>,
    /// The outer reflection, then the direction after each inner one.
    directions: Vec<DVec3>,
}

impl Hits {
    /// With the foot of the perpendicular from the center on the ray; every chord has the length 2 cos θ.
    fn on_sphere(foot: DVec3, ray: DVec3, cos_theta: f64, inner: usize) -> Self {
        let chord = 2.0 * cos_theta;
        let front = foot - cos_theta * ray;
        let mut points = vec![front];
        let mut directions = vec![ray + chord * front];
        let (mut point, mut direction) = (foot + cos_theta * ray, ray);
        for _ in 0..inner {
            points.push(point);
            direction -= chord * point;
            directions.push(direction);
            point += chord * direction;
        }
        Self { cosines: vec![cos_theta], points, directions }
    }

    /// With the two points where the ray goes through the wall, and the matrix that makes the bubble round, by which normals are turned too.
    fn on_ellipsoid([front, back]: [DVec3; 2], ray: DVec3, to_round: DMat3, inner: usize) -> Self {
        let mut hits = Self { cosines: Vec::new(), points: Vec::new(), directions: Vec::new() };
        hits.meet(front, ray, to_round);
        let (mut point, mut direction) = (back, ray);
        for _ in 0..inner {
            direction = hits.meet(point, direction, to_round);
            let round = (to_round * direction).normalize();
            point -= 2.0 * point.dot(round) * round;
        }
        hits
    }

    /// Adds a hit, and returns where it turns the ray.
    fn meet(&mut self, point: DVec3, direction: DVec3, to_round: DMat3) -> DVec3 {
        let normal = (to_round * point).normalize();
        let along = direction.dot(normal);
        let reflected = direction - 2.0 * along * normal;
        self.cosines.push(along.abs());
        self.points.push(point);
        self.directions.push(reflected);
        reflected
    }
}
