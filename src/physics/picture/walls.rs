//! Where straight lines meet walls of film.

use glam::{DMat3, DVec3};

/// A straight part of a light path, followed from the eye against the light.
pub struct Line {
    /// Where it starts, in metres from the eye.
    pub origin_m: DVec3,
    /// Where it goes, a unit vector.
    pub direction: DVec3,
    /// The wall that turned it there: the bubble's number and the place on it, as in [`Wall`].
    pub from: Option<(usize, DVec3)>,
}

/// A wall of film that a line meets.
pub struct Wall {
    /// How far along the line, in metres.
    pub distance_m: f64,
    /// The bubble's number.
    pub bubble: usize,
    /// Where on the bubble: a unit vector from its center, where the bubble is round.
    pub place: DVec3,
    /// Unit vector across the wall, outward.
    pub normal: DVec3,
    /// Cosine of the angle of incidence.
    pub cos_theta: f64,
}

/// The surface of a bubble, as seen from the eye: positions far from the origin of the world keep their digits.
pub struct Surface {
    /// Center in metres from the eye.
    center_m: DVec3,
    radius_m: f64,
    stretch: DMat3,
    /// The inverse of the stretch. It turns normals too, for it is symmetric.
    to_round: DMat3,
}

impl Surface {
    /// The surface of a bubble, with its center in metres from the eye; the stretch is as in [`FilmSphere`](super::FilmSphere).
    #[must_use]
    pub fn new(center_m: DVec3, radius_m: f64, stretch: DMat3) -> Self {
        Self { center_m, radius_m, stretch, to_round: stretch.inverse() }
    }

    /// A place on the bubble, in metres from the eye.
    #[must_use]
    pub fn point_m(&self, place: DVec3) -> DVec3 {
        self.center_m + self.radius_m * (self.stretch * place)
    }

    /// Adds the walls that lie ahead on a line, for a bubble of that number: two from outside, one from inside.
    pub fn add_walls(&self, bubble: usize, line: &Line, walls: &mut Vec<Wall>) {
        let round = self.to_round * line.direction;
        // Metres on the line for a radius where the bubble is round.
        let metres = self.radius_m / round.length();
        let round = round.normalize();
        match line.from {
            Some((from, place)) if from == bubble => {
                // The rest of the chord, exactly. A line that goes outward does not come back.
                let chord = -2.0 * place.dot(round);
                if chord > 0.0 {
                    walls.push(self.wall(bubble, line, (place + chord * round).normalize(), metres * chord));
                }
            }
            _ => {
                let origin = self.to_round * ((line.origin_m - self.center_m) / self.radius_m);
                let along = origin.dot(round);
                let foot = origin - along * round;
                let half_chord = (1.0 - foot.length_squared()).sqrt();
                for side in [-half_chord, half_chord] {
                    // Not a number for a line that misses, and so not ahead.
                    let ahead = side - along;
                    if ahead > 0.0 {
                        walls.push(self.wall(bubble, line, foot + side * round, metres * ahead));
                    }
                }
            }
        }
    }

    fn wall(&self, bubble: usize, line: &Line, place: DVec3, distance_m: f64) -> Wall {
        let normal = (self.to_round * place).normalize();
        let cos_theta = line.direction.dot(normal).abs().min(1.0);
        Wall { distance_m, bubble, place, normal, cos_theta }
    }
}
