//! Work of the CPU: what a pass sends to the device, where computing that takes long. It needs the pass's key alone, so a window has it done on
//! another thread, and a page in a worker, before it runs the pass. Who waits for a picture does it on the spot.

use serde::{Deserialize, Serialize};

use super::{
    Pass, Plan,
    keys::{DefocusKey, FieldKey, QuadratureKey},
};
use crate::physics::{
    colour::QuadratureWavelength,
    environment::Defocused,
    film::{InitialFilm, Seed, SeedGrids},
    sphere::{CubedSphere, GridError},
};

/// The values of a film at tick 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedKey {
    /// Where they are.
    pub grids: SeedGrids,
    /// Their function.
    pub initial: InitialFilm,
}

impl SeedKey {
    /// The values that a field begins with.
    ///
    /// # Errors
    /// The field has too few or too many cells.
    pub fn of(key: &FieldKey) -> Result<Self, GridError> {
        let film = CubedSphere::new(key.cells as usize)?;
        let tracer = Some(key.scheme.tracer_grid(film)?).filter(|tracer| *tracer != film);
        Ok(Self { grids: SeedGrids { film, tracer, cap: key.cap() }, initial: key.initial })
    }

    /// The values.
    #[must_use]
    pub fn seed(&self) -> Seed {
        Seed::new(&self.grids, true, &self.initial.profile())
    }
}

/// What is to be computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Work {
    /// An environment out of focus.
    Defocus(DefocusKey),
    /// Quadrature wavelengths.
    Fit(QuadratureKey),
    /// A film at tick 0.
    Seed(SeedKey),
}

/// What has been computed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Product {
    /// An environment out of focus.
    Backdrop(Defocused),
    /// Quadrature wavelengths.
    Wavelengths(Vec<QuadratureWavelength>),
    /// A film at tick 0.
    Seed(Seed),
}

impl Work {
    /// All that a plan's passes begin with.
    pub fn of_plan(plan: &Plan) -> impl Iterator<Item = Self> {
        plan.steps.iter().filter_map(|(pass, _)| Self::of(pass))
    }

    fn of(pass: &Pass) -> Option<Self> {
        match pass {
            Pass::DefocusBackdrop { key, .. } => Some(Self::Defocus(key.clone())),
            Pass::FitQuadrature { key, .. } if !key.from_table => Some(Self::Fit(key.clone())),
            // The pass says itself what is wrong with its grid.
            Pass::SeedField { key, .. } => SeedKey::of(key).ok().map(Self::Seed),
            _ => None,
        }
    }

    /// Does it.
    #[must_use]
    pub fn done(&self) -> Product {
        match self {
            Self::Defocus(key) => Product::Backdrop(key.made()),
            Self::Fit(key) => Product::Wavelengths(key.wavelengths()),
            Self::Seed(key) => Product::Seed(key.seed()),
        }
    }
}

/// Products that are there before the passes that begin with them.
#[derive(Default)]
pub struct Prepared(Vec<(Work, Product)>);

impl Prepared {
    /// Keeps what was computed.
    pub fn add(&mut self, work: Work, product: Product) {
        self.0.push((work, product));
    }

    /// Whether some work is done.
    #[must_use]
    pub fn has(&self, work: &Work) -> bool {
        self.0.iter().any(|(known, _)| known == work)
    }

    /// Drops what nobody has taken.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// The product of some work, which is done now if it is not prepared.
    pub fn take(&mut self, work: &Work) -> Product {
        let place = self.0.iter().position(|(known, _)| known == work);
        place.map_or_else(|| work.done(), |place| self.0.swap_remove(place).1)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::{
        physics::{
            environment::{CubeTiles, Procedural},
            sphere::Cap,
        },
        plan::{EnvironmentKey, OpticsKey},
        scene::Quality,
    };

    fn works() -> [Work; 3] {
        let optics = OpticsKey { film: Default::default(), illuminant: Default::default() };
        let film = CubedSphere::new(16).unwrap();
        let grids = SeedGrids { film, tracer: CubedSphere::new(32).ok(), cap: Some(Cap::HEMISPHERE) };
        [
            Work::Defocus(DefocusKey {
                environment: EnvironmentKey(Procedural::Park.map()),
                half_angle_rad: 0.3,
                tiles: CubeTiles::within(
                    &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[y, z]| DVec3::new(9.0, y, z)),
                ),
            }),
            Work::Fit(QuadratureKey { optics, range_nm: 1500.0, quality: Quality::Fast, from_table: false }),
            Work::Seed(SeedKey {
                grids,
                initial: InitialFilm::Blown { thickness_nm: 700.0, stratification: 0.3, seed: 3 },
            }),
        ]
    }

    /// As a page's worker gets its work, and sends what it has done.
    #[test]
    fn work_and_products_survive_the_way_to_another_memory() {
        for work in works() {
            let sent: Work = postcard::from_bytes(&postcard::to_allocvec(&work).unwrap()).unwrap();
            assert!(sent == work);
            let bytes = postcard::to_allocvec(&sent.done()).unwrap();
            let product: Product = postcard::from_bytes(&bytes).unwrap();
            assert_eq!(postcard::to_allocvec(&product).unwrap(), bytes);
            match (product, work.done()) {
                (Product::Backdrop(sent), Product::Backdrop(done)) => assert!(sent == done),
                (Product::Wavelengths(sent), Product::Wavelengths(done)) => assert!(sent == done),
                (Product::Seed(sent), Product::Seed(done)) => assert!(sent == done),
                other => panic!("{other:?}"),
            }
        }
    }

    #[test]
    fn what_is_prepared_is_taken_once() {
        let [_, work, _] = works();
        let mut prepared = Prepared::default();
        prepared.add(work.clone(), Product::Wavelengths(Vec::new()));
        assert!(prepared.has(&work));
        assert!(matches!(prepared.take(&work), Product::Wavelengths(none) if none.is_empty()));
        assert!(!prepared.has(&work));
        assert!(matches!(prepared.take(&work), Product::Wavelengths(some) if some.len() == 6));
    }
}
