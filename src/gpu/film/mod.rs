//! A film's field on the device: the flow map, the tracer of the last remap, and the thickness that is shown.
//!
//! The tracer is the thickness's departure from the film's *level*, its mean: f32 then resolves what a well mixed film still varies by, where
//! of the thickness itself it would round the last waves away before they have calmed, and their rounded pattern would drive a flow for ever.
//!
//! The film is moved as a flow map: `map(x)` is the place of the liquid at x at the last remap, and the thickness is the tracer of that remap
//! looked up there. Each step composes the map with one backtrace; a remap looks the tracer up, stores it, and resets the map to the identity.
//! Remapping at every step is the classic semi-Lagrangian scheme; remapping rarely keeps filaments sharp, for the error then grows with the
//! number of remaps and not of steps (Taylor & Nave, arXiv 2106.13170, 2302.01205). When the map has become too distorted is measured and
//! decided on the device, so that no frame waits for it.
//!
//! Fields are stored panel by panel with halos. Passes compute halo cells like any others, for a place beyond a panel's edge is a place on the
//! sphere; nothing is ever copied across edges.

mod checkpoint;
mod company;
mod free;
mod moving;
mod play;
mod remap;
mod rest;
mod shown;
mod step;

pub use company::{Company, Member};
pub use free::{FreeMotion, Surroundings};
pub use moving::{MovingFilm, rules};
pub use play::play_together;

use super::{
    control::Control,
    device::{Gpu, GpuError},
    grid::Grid,
    panel_texture::PanelTexture,
    passes::{
        blacken::BlackFilm,
        conserve::Target,
        decide_remap::RemapRule,
        diffuse::Diffusion,
        sample_tracer::{Gathered, Sampling, sample_tracer},
    },
    readback::Readback,
    timing::{Groups, Recorder},
};
use crate::physics::{
    film::{Cap, Seed, SeedGrids, model::DrainLaw},
    sphere::{CubedSphere, GridError, HALO},
    transport::Scheme,
};

/// How a film is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// The scheme.
    pub scheme: Scheme,
    /// Whether lookups keep within the range of the cells around them, and corrections within the film's.
    pub limiter: bool,
    /// What the map gathers on the way.
    pub gathered: Gathered,
    /// Whether the amount of liquid is kept.
    pub conserved: bool,
    /// When the map is remapped.
    pub remap: RemapRule,
    /// How many of the film's cells a cell of the map spans along each side; the map of a smooth flow may be coarser than the film.
    pub map_coarsening: u32,
    /// Cells along a panel's edge of the grid that steps are traced on, where it is coarser than the film: smooth flows need no more.
    pub flow_cells: u32,
    /// Where the film ends, if anywhere. Beyond stands its image, which nothing shows or counts.
    pub cap: Option<Cap>,
    /// Angular radius of the drop at its bottom, if there is one, radians.
    pub drop_rad: Option<f64>,
}

impl Rules {
    /// Whether values must stay within the range that they began with.
    fn bounded(&self) -> bool {
        self.limiter && self.gathered == Gathered::Nothing
    }
}

/// A film's field. What its steps change is listed once, for checkpoints: in `checkpoint.rs`.
pub struct Field {
    rules: Rules,
    film: Grid,
    /// The tracer's grid, where it is another one.
    fine: Option<Grid>,
    /// The map's grid, where it is another one.
    smooth: Option<Grid>,
    /// Where steps are traced, if not on the film's own grid.
    coarse: Option<Grid>,
    step_map: PanelTexture,
    /// The map, and where its next step goes.
    map: [PanelTexture; 2],
    /// Whether the map is known to be the identity, as it is until a step is taken after the film was seeded or after a remap that was due
    /// whatever the device measured. Nobody looks through it then, and only pictures need to have it written down.
    map_is_identity: bool,
    /// Whether film may have left since the film was seeded: what did not is not bound to be as thick, or as thin, as it was.
    has_drained: bool,
    ticks_since_decision: u32,
    /// The tracer of the last remap.
    tracer: PanelTexture,
    /// What a remap samples before it is the tracer.
    sampled: wgpu::Buffer,
    /// Room for error compensation.
    corrected: Option<PanelTexture>,
    /// What is shown, before its correction, and as pictures read it.
    shown: wgpu::Buffer,
    texture: PanelTexture,
    /// Which of the maps it was sampled through.
    shown_map: usize,
    control: Control,
    /// What the tracer departs from.
    level: f32,
    /// What must be kept, of what is shown and of the tracer.
    targets: [Target; 2],
    /// What spreads the thickness at remaps, if anything does.
    diffusion: Option<Diffusion>,
    /// What makes thin film black at remaps, if any is thin enough.
    black: Option<BlackFilm>,
    /// How film leaves at its rim at remaps, if it does, and the longest time between two of them, ticks.
    drain: Option<(DrainLaw, u32)>,
}

/// What [`Field::plant`] spoils.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planted {
    /// The tracer.
    Tracer,
    /// The map.
    Map,
}

/// The grid of a film's map, given how many of the film's cells a cell of the map spans along each side.
fn map_sphere(film: CubedSphere, coarsening: u32) -> Result<CubedSphere, GridError> {
    CubedSphere::new(film.n().div_ceil(coarsening.max(1) as usize))
}

/// The grid that steps are traced on, where it is coarser than the film's.
fn flow_sphere(film: CubedSphere, cells: u32) -> Option<CubedSphere> {
    CubedSphere::new(cells as usize).ok().filter(|coarse| coarse.n() < film.n())
}

impl Field {
    /// An empty field. Fails where the scheme's tracer would be too fine, or the map too coarse.
    pub fn new(gpu: &Gpu, sphere: CubedSphere, rules: Rules) -> Result<Self, GpuError> {
        let tracer = rules.scheme.tracer_grid(sphere).map_err(|error| GpuError::Refused(error.to_string()))?;
        let grid = |sphere| Grid::new(gpu, sphere, rules.cap);
        let film = grid(sphere);
        let fine = (tracer != sphere).then(|| grid(tracer));
        let map =
            map_sphere(sphere, rules.map_coarsening).map_err(|error| GpuError::Refused(format!("the map: {error}")))?;
        let smooth = (map != sphere).then(|| grid(map));
        let coarse = flow_sphere(sphere, rules.flow_cells).map(grid);
        let tracer_grid = fine.as_ref().unwrap_or(&film);
        let field = |label, grid: &Grid, format| PanelTexture::new(gpu, label, [grid.side(); 2], format);
        let scalars = |label, grid: &Grid| field(label, grid, wgpu::TextureFormat::R32Float);
        let maps = |label, grid: Option<&Grid>| field(label, grid.unwrap_or(&film), wgpu::TextureFormat::Rgba32Float);
        Ok(Self {
            step_map: maps("step map", coarse.as_ref()),
            map: ["map", "next map"].map(|label| maps(label, smooth.as_ref())),
            map_is_identity: true,
            has_drained: false,
            ticks_since_decision: 0,
            tracer: scalars("tracer", tracer_grid),
            sampled: tracer_grid.field(gpu, "sampled", 4),
            corrected: (rules.scheme == Scheme::Bfecc).then(|| scalars("corrected", tracer_grid)),
            shown: film.field(gpu, "shown", 4),
            texture: scalars("film", &film),
            shown_map: 0,
            control: Control::new(gpu),
            level: 0.0,
            targets: [Target::default(); 2],
            diffusion: None,
            black: None,
            drain: None,
            rules,
            film,
            fine,
            smooth,
            coarse,
        })
    }

    /// Its mean over the film, which is kept.
    #[must_use]
    pub fn mean(&self) -> f64 {
        f64::from(self.level) + self.targets[0].mean
    }

    /// How it is moved.
    #[must_use]
    pub fn rules(&self) -> Rules {
        self.rules
    }

    /// Its grid.
    #[must_use]
    pub fn sphere(&self) -> CubedSphere {
        self.film.sphere
    }

    /// The grid that steps are traced on.
    fn flow_grid(&self) -> &Grid {
        self.coarse.as_ref().unwrap_or(&self.film)
    }

    /// What must be kept now, of what is shown or of the tracer.
    fn target(&self, of: usize) -> Target {
        let target = self.targets[of];
        Target { bounds: target.bounds.filter(|_| !self.has_drained), ..target }
    }

    fn tracer_grid(&self) -> &Grid {
        self.fine.as_ref().unwrap_or(&self.film)
    }

    fn map_grid(&self) -> &Grid {
        self.smooth.as_ref().unwrap_or(&self.film)
    }

    /// Workgroups of lookups at all of its cells, and at two by two of them.
    fn all_cells(&self) -> [Groups<'static>; 2] {
        [self.film.padded_groups().into(), self.film.quad_groups(self.map_grid().cells).into()]
    }

    /// Sets the tracer to a function of direction, and forgets all motion.
    pub fn seed(&mut self, gpu: &Gpu, value: impl Fn(glam::DVec3) -> f64 + Sync) {
        // A density in a wind that diverges is multiplied on the way, as departures must not be.
        let has_level = self.rules.gathered != Gathered::LogArea;
        let tracer = self.fine.as_ref().map(|grid| grid.sphere);
        let grids = SeedGrids { film: self.film.sphere, tracer, cap: self.film.cap };
        self.begin(gpu, &Seed::new(&grids, has_level, &value));
    }

    /// Sets the tracer to values on the field's own grids, and forgets all motion.
    pub fn begin(&mut self, gpu: &Gpu, Seed { level, film, tracer }: &Seed) {
        self.level = *level;
        let tracer = tracer.as_ref().unwrap_or(film);
        self.tracer.upload(gpu, &tracer.values);
        self.targets = [(film, self.level), (tracer, 0.0)].map(|(seeded, level)| {
            let bounds = self.rules.bounded().then_some(seeded.range);
            Target { mean: seeded.mean, bounds, level }
        });
        self.control.reset(gpu, self.level);
        (self.diffusion, self.black, self.drain) = (None, None, None);
        (self.map_is_identity, self.has_drained, self.ticks_since_decision) = (true, false, 0);
    }

    /// The map, if the scheme keeps one.
    fn kept_map(&self) -> Option<&PanelTexture> {
        self.rules.scheme.keeps_map().then_some(&self.map[0])
    }

    /// The map, if the scheme keeps one and it is not known to be the identity.
    fn map_so_far(&self) -> Option<&PanelTexture> {
        self.kept_map().filter(|_| !self.map_is_identity)
    }

    /// Looks the tracer up, in a pass over a number of workgroups: of single cells, or of two by two.
    fn sample(
        &self,
        recorder: &mut Recorder<'_>,
        name: &'static str,
        grid: &Grid,
        map: Option<&PanelTexture>,
        (from, to): (&PanelTexture, &wgpu::Buffer),
        [cells, quads]: [Groups<'_>; 2],
    ) -> Result<(), GpuError> {
        let Rules { scheme, limiter, gathered, cap, .. } = self.rules;
        let sampling = Sampling {
            scheme,
            limiter,
            gathered,
            cap,
            grid,
            map: map.map(|map| &map.view),
            map_cells: self.map_grid().cells,
            tracer: (&from.view, self.tracer_grid().cells),
            control: &self.control.block,
            to,
        };
        sample_tracer(recorder, name, &sampling, if sampling.takes_quads() { quads } else { cells })
    }

    /// Spoils one value of the tracer or of the map, to see that the damage is contained.
    pub fn plant(&self, gpu: &Gpu, planted: Planted, cell: usize, value: f32) {
        let (texture, sphere, texel) = match planted {
            Planted::Tracer => (&self.tracer, self.tracer_grid().sphere, &[value][..]),
            Planted::Map => (&self.map[0], self.map_grid().sphere, &[value, 0.0, 0.0, 0.0][..]),
        };
        let (panel, i, j) = sphere.cell(cell % sphere.cells());
        let [x, y, z] = [i + HALO, j + HALO, panel].map(|place| place as u32);
        texture.upload_texel(gpu, wgpu::Origin3d { x, y, z }, texel);
    }

    /// Starts to read back what the device knows of the film: a [`ControlBlock`](super::control::ControlBlock).
    #[must_use]
    pub fn read_control(&self, gpu: &Gpu) -> Readback {
        Readback::of_buffer(gpu, &self.control.block, self.control.block.size())
    }

    /// Copies as many bytes as some steps with a lookup of every cell move, and changes no state: steps are measured against it.
    pub fn copy_state(&self, recorder: &mut Recorder<'_>, steps: u64) {
        let tracer = self.tracer.copy(recorder);
        for _ in 0..steps {
            self.map[0].copy_to(recorder, &self.map[1]);
            self.tracer.copy_to(recorder, &tracer);
        }
    }
}
