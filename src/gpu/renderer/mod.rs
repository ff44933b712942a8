//! Walks a plan: owns the products, records each pass from its key, and keeps the record of what is on the GPU.

mod execute;
mod films;
mod readbacks;
mod sums;

use std::{collections::BTreeMap, ops::Range};

use glam::DVec3;

use super::{
    abilities::missing_for_measurement,
    composition::{Composition, composition},
    device::{Gpu, GpuError},
    draw::{DrawInputs, DrawPass, pixels_shaded, strips},
    environment::Environment,
    film::{Company, MovingFilm},
    film_atlas::FilmAtlas,
    formats::{PICTURE_FORMAT, POLARISATION_FORMAT, radiance_format},
    passes::{bake_table::Table, finish::Finished, open_hole::OpenHole, tonemap::tonemap},
    quadrature::Quadrature,
    shown_film::Shown,
    target::Target,
    timing::{Counts, Recorder, TimeLog},
};
use crate::{
    physics::{environment::CubeMap, picture::Finish},
    plan::{
        DrawKey, FilmKey, FrameRequest, GpuState, Lighting, Plan, Prepared, Product, QuadratureKey, TableKey,
        TonemapKey, Work, plan,
    },
};

/// Everything that is on the device.
#[derive(Default)]
struct Products {
    lights: Vec<LightProducts>,
    films: Vec<Option<MovingFilm>>,
    /// What holds films while they flow together.
    company: Company,
    holes: Vec<Option<OpenHole>>,
    radiance: Option<Target>,
    /// The photograph behind the bubbles, linear BT.709.
    plate: Option<Target>,
    /// Pictures of what is behind the layer that is drawn, and of all before it.
    drawn: [Option<Target>; 2],
    /// What is polarised of the picture, and of what is behind the layer that is drawn.
    polarised: [Option<Target>; 2],
    /// Films of bubbles that others show.
    atlas: Option<FilmAtlas>,
    /// The picture in one spectral light, and its sum with the pictures before.
    added: Option<Target>,
    sum: Option<Target>,
    finished: Finished,
    picture: Option<Target>,
}

/// What one light's pictures are drawn with.
#[derive(Default)]
struct LightProducts {
    films: Vec<FilmColours>,
    environment: Option<Environment>,
    /// The environment as it is seen behind the bubbles, where that is out of focus.
    defocused: Option<Environment>,
}

/// The colours of films of one material in a light.
#[derive(Default)]
struct FilmColours {
    table: Option<Table>,
    baking: Option<Table>,
    quadrature: Option<Quadrature>,
}

impl Products {
    /// Drops all that pictures are made in.
    fn forget_pictures(&mut self) {
        (self.radiance, self.added, self.sum, self.picture) = (None, None, None, None);
        (self.drawn, self.polarised, self.atlas, self.finished) = Default::default();
    }

    /// Drops what the state no longer lists.
    fn keep(&mut self, state: &GpuState) {
        self.lights.truncate(state.lights.len());
        let lights = self.lights.iter_mut().zip(&state.lights);
        lights.for_each(|(light, state)| {
            light.films.truncate(state.films.len());
            light.defocused.take_if(|_| state.defocused.is_none());
        });
        if state.plate.is_none() {
            self.plate = None;
            if state.lights.len() <= 1 {
                (self.added, self.sum) = (None, None);
            }
        }
        self.films.truncate(state.fields.len());
        let films = self.films.iter_mut().zip(&state.fields);
        films.filter(|(_, field)| field.is_none()).for_each(|(film, _)| *film = None);
        self.holes.truncate(state.holes.len());
        let holes = self.holes.iter_mut().zip(&state.holes);
        holes.filter(|(_, key)| key.is_none()).for_each(|(hole, _)| *hole = None);
    }
}

/// Draws scenes: plans, executes, and hands out pictures.
pub struct Renderer {
    /// The device.
    pub gpu: Gpu,
    /// Times of the passes that ran.
    pub times: TimeLog,
    /// Work done since the start.
    pub counts: Counts,
    /// Hears how much of a plan's [`Plan::work`] the device has just done, and tells whether the rest is still wanted. With it, the end of each
    /// submission is waited for.
    pub watcher: Option<Watcher>,
    /// What passes send to the device, as far as it is computed already.
    pub prepared: Prepared,
    state: GpuState,
    products: Products,
}

impl Renderer {
    /// A renderer with nothing on the device yet.
    #[must_use]
    pub fn new(gpu: Gpu) -> Self {
        Self {
            gpu,
            times: TimeLog::default(),
            counts: Counts::default(),
            watcher: None,
            prepared: Prepared::default(),
            state: GpuState::default(),
            products: Products::default(),
        }
    }

    /// What is on the device.
    #[must_use]
    pub fn state(&self) -> &GpuState {
        &self.state
    }

    /// Runs the passes that a frame request needs, and returns the plan that listed them.
    pub fn render(&mut self, request: &FrameRequest) -> Result<Plan, GpuError> {
        let plan = plan(request, &self.state);
        self.execute(&plan)?;
        Ok(plan)
    }

    /// Forgets a picture, or a film's moment, so that the next plan makes them again: how frames are measured.
    pub fn forget_picture(&mut self) {
        self.state.radiance = None;
        self.state.picture = None;
        for field in self.state.fields.iter_mut().flatten() {
            field.shown = None;
        }
    }

    fn submit(times: &TimeLog, counts: &mut Counts, recorder: Recorder<'_>) {
        let done = recorder.submit(times);
        counts.dispatches += done.dispatches;
        counts.draws += done.draws;
        counts.pixels_shaded += done.pixels_shaded;
        counts.cells_stepped += done.cells_stepped;
        counts.state_bytes += done.state_bytes;
        counts.submissions += done.submissions;
    }

    fn light(&mut self, light: usize) -> &mut LightProducts {
        let lights = &mut self.products.lights;
        if lights.len() <= light {
            lights.resize_with(light + 1, LightProducts::default);
        }
        &mut lights[light]
    }

    fn colours(&mut self, [light, material]: [usize; 2]) -> &mut FilmColours {
        let films = &mut self.light(light).films;
        if films.len() <= material {
            films.resize_with(material + 1, FilmColours::default);
        }
        &mut films[material]
    }

    fn bake(&mut self, place: [usize; 2], key: &TableKey, rows: Range<u32>) -> Result<(), GpuError> {
        if rows.start == 0 {
            self.colours(place).baking = Some(Table::new(&self.gpu, key));
        }
        let [light, material] = place;
        let Some(table) = &self.products.lights[light].films[material].baking else { return Ok(()) };
        let mut recorder = Recorder::new(&self.gpu);
        table.bake(&mut recorder, key, rows.clone())?;
        Self::submit(&self.times, &mut self.counts, recorder);
        if rows.end == key.rows {
            let colours = self.colours(place);
            colours.table = colours.baking.take();
        }
        Ok(())
    }

    fn fit(&mut self, place: [usize; 2], key: &QuadratureKey) {
        let work = (!key.from_table).then(|| self.prepared.take(&Work::Fit(key.clone())));
        self.colours(place).quadrature = Some(match work {
            Some(Product::Wavelengths(wavelengths)) => Quadrature::fitted(&self.gpu, key, &wavelengths),
            _ => Quadrature::fit(&self.gpu, key),
        });
    }

    /// The picture in the scene's own light, plus the picture in each spectral light.
    fn draw(&mut self, key: &DrawKey) -> Result<(), GpuError> {
        if key.full_precision
            && let Some(reason) = missing_for_measurement(&self.gpu.adapter)
        {
            return Err(GpuError::NoFullPrecision { adapter: self.gpu.adapter_name(), reason });
        }
        let format = radiance_format(key.full_precision);
        let composition = composition(key);
        let has_layers = composition.layers() > 1;
        let drawn_size = if has_layers { key.size } else { [1, 1] };
        for slot in &mut self.products.drawn {
            *slot = Some(Target::fit(slot.take(), &self.gpu, "drawn", drawn_size, format));
        }
        let tracks = composition.tracks_polarisation(key);
        for slot in &mut self.products.polarised {
            let size = if tracks { key.size } else { [1, 1] };
            *slot = Some(Target::fit(slot.take(), &self.gpu, "polarised", size, POLARISATION_FORMAT));
        }
        self.gather_films(key, &composition);
        let radiance = Target::fit(self.products.radiance.take(), &self.gpu, "radiance", key.size, format);
        self.draw_light(key, &composition, (0, &key.lighting), &radiance)?;
        let radiance = self.add_lights(key, &composition, radiance)?;
        self.products.radiance = Some(radiance);
        Ok(())
    }

    /// Copies the films of bubbles that others show to one texture.
    fn gather_films(&mut self, key: &DrawKey, composition: &Composition) {
        let of_others = composition.placed.iter().flat_map(|placed| placed.among.iter().chain(&placed.mirrored));
        let of_others = of_others.map(|place| &key.bubbles[*place]).map(|bubble| (bubble.index, &bubble.film));
        let lent = key.lent.iter().filter(|_| !key.small.is_empty()).map(|lent| (lent.index, &lent.film));
        let film = |(index, film): (usize, &FilmKey)| {
            let field = matches!(film, FilmKey::Field(_)).then(|| self.products.films.get(index)?.as_ref())??;
            Some((index, field.field.shown()))
        };
        let films: BTreeMap<usize, Shown<'_>> = of_others.chain(lent).filter_map(film).collect();
        let mut recorder = Recorder::new(&self.gpu);
        let (is_needed, atlas) = (!films.is_empty(), FilmAtlas::of(self.products.atlas.take(), &mut recorder, &films));
        if is_needed {
            Self::submit(&self.times, &mut self.counts, recorder);
        }
        self.products.atlas = Some(atlas);
    }

    /// The picture in one light alone, whose tables and environment are those of a light of the scene.
    fn draw_light(
        &mut self,
        key: &DrawKey,
        composition: &Composition,
        (light, lighting): (usize, &Lighting),
        target: &Target,
    ) -> Result<(), GpuError> {
        self.light(light);
        let products = &mut self.products.lights[light];
        // Without an environment key nothing of it is read; a black one fills the binding.
        let environment =
            products.environment.get_or_insert_with(|| Environment::upload(&self.gpu, &CubeMap::constant(DVec3::ZERO)));
        // The map of a picture before may still be there.
        let backdrop = key.defocus(lighting).and(products.defocused.as_ref()).unwrap_or(environment);
        let (films, holes) = (&self.products.films, &self.products.holes);
        let hole = |film: usize| holes.get(film).and_then(Option::as_ref);
        let film = |film: usize| films.get(film).and_then(Option::as_ref).map(|film| film.field.shown());
        let colours = |material: usize| {
            let FilmColours { table, quadrature, .. } = products.films.get(material)?;
            Some((table.as_ref(), quadrature.as_ref()?))
        };
        let ([Some(behind), Some(so_far)], Some(atlas)) = (&self.products.drawn, &self.products.atlas) else {
            return Ok(());
        };
        let drawn = [behind, so_far];
        let [Some(polarised), Some(polarised_behind)] = &self.products.polarised else { return Ok(()) };
        let polarised = [polarised, polarised_behind];
        let pass = DrawPass::new(
            &self.gpu,
            key,
            lighting,
            &DrawInputs {
                environment,
                backdrop,
                colours: &colours,
                film: &film,
                hole: &hole,
                composition,
                drawn,
                polarised,
                atlas,
            },
        )?;
        for rows in strips(key.size) {
            let mut recorder = Recorder::new(&self.gpu);
            let work = u64::from(key.size[0]) * rows.len() as u64;
            pass.record(&mut recorder, target, (drawn, polarised), &rows);
            Self::submit(&self.times, &mut self.counts, recorder);
            told(&self.watcher, &self.gpu, work)?;
        }
        self.counts.pixels_shaded += pixels_shaded(key);
        Ok(())
    }

    fn tonemap(&mut self, key: &TonemapKey) -> Result<(), GpuError> {
        let Some(radiance) = &self.products.radiance else { return Ok(()) };
        let picture = Target::fit(self.products.picture.take(), &self.gpu, "picture", key.draw.size, PICTURE_FORMAT);
        let mut recorder = Recorder::new(&self.gpu);
        let linear = match key.finish == Finish::default() {
            true => radiance,
            false => self.products.finished.record(&mut recorder, key, radiance)?,
        };
        tonemap(&mut recorder, key, &linear.view, &picture.view)?;
        recorder.counts.pixels_shaded += key.draw.size.map(u64::from).iter().product::<u64>();
        Self::submit(&self.times, &mut self.counts, recorder);
        self.products.picture = Some(picture);
        Ok(())
    }
}

/// Hears how much work is done, and returns whether to go on.
pub type Watcher = Box<dyn Fn(u64) -> bool + Send>;

/// Reports work to the watcher once it is done; in browsers, where nothing may block, once it is submitted.
#[cfg_attr(target_arch = "wasm32", allow(unused_variables, reason = "nothing is waited for"))]
fn told(watcher: &Option<Watcher>, gpu: &Gpu, work: u64) -> Result<(), GpuError> {
    if let Some(watcher) = watcher {
        #[cfg(not(target_arch = "wasm32"))]
        gpu.wait()?;
        if !watcher(work) {
            return Err(GpuError::Cancelled);
        }
    }
    Ok(())
}
