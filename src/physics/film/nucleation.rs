//! Nuclei of black film: as film thins, its surfaces touch here and there before they do so everywhere, and black spots open, which
//! rise, for they weigh less, and merge with the black film above, as Newton saw them (1704, "Opticks", book 2, part 1).

use glam::DVec3;

use super::random::Random;

/// Thickness below which film has nuclei, nm: that of straw-coloured film. A choice: films of some square millimetres
/// that are shielded from dust keep until 30 to 50 nm (Exerowa & Kruglyakov 1998, "Foam and Foam Films").
pub const NUCLEATION_NM: f64 = 170.0;

/// Nuclei on the whole sphere while a nanometre evaporates; a choice, which makes a spot in every ten degrees until the film is black.
const PER_NM: f64 = 4.0;
/// Radius of a spot when it has opened, radians: 0.7° to 3°.
const RADIUS: [f64; 2] = [0.012, 0.05];
/// Part of the radius within which a spot has collapsed entirely.
const CORE: f64 = 0.7;

/// Where a black spot opens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nucleus {
    /// Its middle, a unit vector.
    pub middle: DVec3,
    /// Its radius, radians.
    pub radius: f64,
}

impl Nucleus {
    /// How far film at a unit vector has collapsed, 0 to 1.
    #[must_use]
    pub fn collapsed(&self, x: DVec3) -> f64 {
        let t = ((x.distance(self.middle) / self.radius - CORE) / (1.0 - CORE)).clamp(0.0, 1.0);
        1.0 - t * t * (3.0 - 2.0 * t)
    }
}

/// Nuclei that form on a film of a seed while what has evaporated grows from one thickness to another, in nm; each with how much had then.
pub fn nuclei(seed: u32, from_nm: f64, to_nm: f64) -> impl DoubleEndedIterator<Item = (Nucleus, f64)> {
    let slots = (from_nm * PER_NM).floor().max(0.0) as u64..(to_nm * PER_NM).ceil().max(0.0) as u64;
    slots.map(move |slot| nucleus(seed, slot)).filter(move |(_, nm)| *nm >= from_nm && *nm < to_nm)
}

/// The one nucleus of a slot.
fn nucleus(seed: u32, slot: u64) -> (Nucleus, f64) {
    let mut random = Random::new(seed ^ (slot >> 32) as u32, NUCLEUS_STREAM.wrapping_add(slot as u32));
    let nucleus = Nucleus { middle: random.direction(), radius: random.between_log(RADIUS[0], RADIUS[1]) };
    (nucleus, (slot as f64 + random.between(0.0, 1.0)) / PER_NM)
}

/// First of the streams of random numbers that nuclei have, one each.
const NUCLEUS_STREAM: u32 = 0x6000_0000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_nuclei_form_however_the_film_is_cut_into_steps() {
        let whole: Vec<_> = nuclei(3, 0.0, 30.0).collect();
        let cuts = [0.0, 4.0, 4.1, 17.0, 30.0];
        let cut: Vec<_> = cuts.windows(2).flat_map(|span| nuclei(3, span[0], span[1])).collect();
        assert_eq!((whole.len(), &whole), (120, &cut));
        assert!(whole.iter().all(|(nucleus, _)| (0.012..0.05).contains(&nucleus.radius)));
        assert_eq!(nuclei(3, 30.0, 30.0).count(), 0, "film that does not thin has none");
    }

    #[test]
    fn a_spot_is_black_in_its_middle_and_ends_at_its_radius() {
        let nucleus = Nucleus { middle: DVec3::X, radius: 0.03 };
        let at = |away: f64| nucleus.collapsed(DVec3::new(away.cos(), away.sin(), 0.0));
        assert_eq!([at(0.0), at(0.02), at(0.031)], [1.0, 1.0, 0.0]);
        assert!((0.3..0.7).contains(&at(0.0255)));
    }
}
