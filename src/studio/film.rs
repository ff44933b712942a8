//! The film of a bubble as numbers.

use glam::DVec3;

use super::{Error, Studio, moment, shot};
use crate::{
    input::LoadedScene,
    parallel,
    physics::sphere::{CubedSphere, HaloTable, PaddedField},
    plan::{BubbleKey, FilmKey, FrameRequest, Story, film_grids, settle_detail},
    scene::{Camera, Scene},
    verify::{
        reference::{FilmThickness, MovedFilms, ReferenceError, film_thickness, moved_film},
        reference_film::ReferenceFilm,
    },
};

/// One cell of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmCell {
    /// Unit vector from the bubble's center to the cell's middle, in the world's axes: +z is up.
    pub direction: DVec3,
    /// The cell's solid angle in steradians; the angles of all cells add up to 4π.
    pub solid_angle_sr: f64,
    /// Thickness along the normal, nm; 0 where there is no film: in a hole, below a ring or a bath.
    pub thickness_nm: f64,
}

/// Width and height in pixels of the picture that computes a film: small, for only the film is read.
const SIZE: [u32; 2] = [64, 64];

/// A bubble's film at a moment.
struct MovedFilm {
    key: BubbleKey,
    grid: CubedSphere,
    films: MovedFilms,
}

/// Reads a bubble's film at a time in seconds.
pub(super) fn read(
    studio: &mut Studio,
    loaded: &LoadedScene,
    bubble: usize,
    time_s: f64,
) -> Result<Vec<FilmCell>, Error> {
    moved(studio, loaded, bubble, time_s)?.cells()
}

/// Reads a bubble's film in some directions, in axes that turn with the film.
pub(super) fn read_at(
    studio: &mut Studio,
    loaded: &LoadedScene,
    (bubble, time_s): (usize, f64),
    directions: &[DVec3],
) -> Result<Vec<f64>, Error> {
    moved(studio, loaded, bubble, time_s)?.at(directions)
}

fn moved(studio: &mut Studio, loaded: &LoadedScene, bubble: usize, time_s: f64) -> Result<MovedFilm, Error> {
    let asked = Asked::new(loaded, bubble, time_s)?;
    studio.renderer.render(&asked.request)?;
    let (grid, films) = match asked.key.film {
        FilmKey::Uniform(_) => (asked.grid_of_scene()?, MovedFilms::new()),
        FilmKey::Field(_) => {
            let (grid, field) = moved_film(&studio.renderer, bubble)?.ok_or(Error::NothingDrawn)?;
            (grid, MovedFilms::from([(bubble, field)]))
        }
    };
    Ok(MovedFilm { key: asked.key, grid, films })
}

/// Thickness of each cell of a bubble's film, moved by the film model in f64 on the CPU; no adapter is needed. It is slow, and takes films of the
/// scheme `map` with at most 64 cells along an edge. `progress` hears how many more ticks of the film's time are done. The other arguments are as in
/// [`Studio::film`].
///
/// # Errors
/// Those of [`Studio::film`], and [`Error::ReferenceFilm`] for films that the model does not take.
pub fn reference_film(
    scene: &LoadedScene,
    bubble: usize,
    time_s: f64,
    progress: &dyn Fn(u64),
) -> Result<Vec<FilmCell>, Error> {
    moved_in_f64(scene, bubble, time_s, progress)?.cells()
}

/// Thickness of a bubble's film in some directions, as [`Studio::film_at`], moved as [`reference_film`] does.
///
/// # Errors
/// Those of [`reference_film`].
pub fn reference_film_at(
    scene: &LoadedScene,
    (bubble, time_s): (usize, f64),
    directions: &[DVec3],
    progress: &dyn Fn(u64),
) -> Result<Vec<f64>, Error> {
    moved_in_f64(scene, bubble, time_s, progress)?.at(directions)
}

fn moved_in_f64(scene: &LoadedScene, bubble: usize, time_s: f64, progress: &dyn Fn(u64)) -> Result<MovedFilm, Error> {
    let asked = Asked::new(scene, bubble, time_s)?;
    let (grid, films) = match &asked.key.film {
        FilmKey::Uniform(_) => (asked.grid_of_scene()?, MovedFilms::new()),
        FilmKey::Field(key) => {
            let mut film = ReferenceFilm::new(key)?;
            film.play(key, progress);
            let (grid, nm) = (film.film().grid(), film.thickness_nm(key));
            let field = PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| nm[cell]);
            (grid, MovedFilms::from([(bubble, field)]))
        }
    };
    Ok(MovedFilm { key: asked.key, grid, films })
}

/// A bubble's film that is asked for.
struct Asked {
    /// The frame request that computes it: a small picture of the bubble alone.
    request: FrameRequest,
    key: BubbleKey,
    /// Cells along an edge that the scene has for it.
    cells: u32,
}

impl Asked {
    fn new(loaded: &LoadedScene, bubble: usize, time_s: f64) -> Result<Self, Error> {
        let count = loaded.scene.bubbles.len();
        if bubble >= count {
            return Err(Error::NoBubble { index: bubble, count });
        }
        let moment = moment(&loaded.scene, time_s)?;
        let mut close_up = loaded.clone();
        look_at(&mut close_up.scene, bubble, time_s);
        let mut request = shot(&close_up, SIZE, moment, false)?;
        let draw = &mut request.picture.draw;
        draw.bubbles.retain(|key| key.index == bubble);
        draw.small = [].into();
        draw.lent.clear();
        let key = request.picture.draw.bubbles.first().cloned().ok_or(Error::NoFilm { bubble, time_s })?;
        Ok(Self { request, key, cells: film_grids(&close_up.scene, bubble)[0] })
    }

    /// The grid of a film of one thickness, which has no field.
    fn grid_of_scene(&self) -> Result<CubedSphere, Error> {
        Ok(CubedSphere::new(self.cells as usize).map_err(ReferenceError::from)?)
    }
}

/// Turns the camera to a bubble. How fine its film is stays as the scene's own camera has it.
fn look_at(scene: &mut Scene, bubble: usize, time_s: f64) {
    settle_detail(scene);
    let center_m = Story::new(scene.clone()).center_m(bubble, time_s);
    let distance_m = 4.0 * 1e-3 * scene.bubbles[bubble].radius_mm;
    // From above, where a camera is never below a bath.
    scene.camera = Camera { target_m: center_m.into(), distance_m, elevation_deg: 45.0, ..Camera::default() };
}

impl MovedFilm {
    /// The film as pictures see it: thinned by evaporation, with its hole, and with nothing beyond its rim.
    fn cells(&self) -> Result<Vec<FilmCell>, Error> {
        let thickness_nm = self.thickness_nm()?;
        let to_world = self.key.to_film.transpose();
        let cell = |(index, solid_angle_sr): (usize, f64)| {
            let direction = to_world * self.grid.cell_direction(index);
            FilmCell { direction, solid_angle_sr, thickness_nm: thickness_nm(direction) }
        };
        Ok(self.grid.areas().into_iter().enumerate().map(cell).collect())
    }

    /// Thickness in nm in some directions of the film's own axes.
    fn at(&self, directions: &[DVec3]) -> Result<Vec<f64>, Error> {
        let thickness_nm = self.thickness_nm()?;
        let to_world = self.key.to_film.transpose();
        Ok(parallel::map(directions.len(), |k| thickness_nm(to_world * directions[k])))
    }

    fn thickness_nm(&self) -> Result<FilmThickness<'_>, Error> {
        // A bath shows the image of the film below its rim; there is no film.
        Ok(film_thickness(&self.key, false, &self.films)?)
    }
}
