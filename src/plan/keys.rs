//! The keys of products: for each, exactly what its pass reads.

use std::{fmt, ops::Range, sync::Arc};

use glam::{DMat3, DVec2, DVec3};

use crate::{
    physics::{
        colour::{BandTask, FilmOptics, Gamut, Illuminant},
        environment::CubeMap,
        film::{InitialFilm, PrescribedFlow},
        optics::FilmMaterial,
        sphere::CubedSphere,
        transport::Scheme,
    },
    scene::Quality,
};

/// A film in a light.
#[derive(Clone, Debug)]
pub struct OpticsKey {
    /// What the film is made of.
    pub film: FilmMaterial,
    /// The light.
    pub illuminant: Arc<Illuminant>,
}

impl PartialEq for OpticsKey {
    fn eq(&self, other: &Self) -> bool {
        self.film == other.film
            && (Arc::ptr_eq(&self.illuminant, &other.illuminant) || self.illuminant == other.illuminant)
    }
}

impl OpticsKey {
    /// The film and the light with all their spectra.
    #[must_use]
    pub fn spectra(&self) -> FilmOptics {
        FilmOptics::new(self.film.clone(), &self.illuminant)
    }
}

/// The lookup table of what single walls reflect.
#[derive(Clone, Debug, PartialEq)]
pub struct TableKey {
    /// Film and light.
    pub optics: OpticsKey,
    /// Thickness at the last row, at normal incidence, in nm.
    pub max_thickness_nm: f64,
    /// Columns, along √cosθ.
    pub columns: u32,
    /// Rows, along thickness times the cosine inside the film.
    pub rows: u32,
    /// Whether it holds what is reflected of each of three primaries, or of white light alone.
    pub coloured: bool,
    /// Whether s and p light are apart.
    pub polarised: bool,
}

impl TableKey {
    /// Columns of a full table.
    pub const COLUMNS: u32 = 64;
    /// Thickness that the table spans at least, in nm.
    pub const MIN_RANGE_NM: f64 = 1500.0;
    /// Rows for [`TableKey::MIN_RANGE_NM`]: 0.73 nm a row.
    pub const MIN_ROWS: u32 = 2048;
    /// Rows at most: the smallest limit on textures that adapters have.
    const MAX_ROWS: u32 = 8192;

    /// A full table for films up to a range, see [`range_nm`], for unpolarised white light. The rows grow with the range, so that their
    /// spacing stays.
    #[must_use]
    pub fn full(optics: OpticsKey, max_thickness_nm: f64) -> Self {
        let rows = (f64::from(Self::MIN_ROWS) * max_thickness_nm / Self::MIN_RANGE_NM).ceil() as u32;
        let rows = rows.min(Self::MAX_ROWS);
        Self { optics, max_thickness_nm, columns: Self::COLUMNS, rows, coloured: false, polarised: false }
    }

    /// The same range with fewer rows: what a window shows until the full table is there.
    #[must_use]
    pub fn coarser(&self, factor: u32) -> Self {
        Self { rows: (self.rows / factor).max(2), ..self.clone() }
    }

    /// Layers of the texture: a primary each, first of s and then of p light.
    #[must_use]
    pub fn layers(&self) -> u32 {
        (if self.coloured { 3 } else { 1 }) * (if self.polarised { 2 } else { 1 })
    }
}

/// The range of tables and bands for films up to a thickness, in nm: steps of 250 nm, so that small edits make nothing anew.
#[must_use]
pub fn range_nm(thickest_nm: f64) -> f64 {
    ((thickest_nm / 250.0).ceil() * 250.0).max(TableKey::MIN_RANGE_NM)
}

/// The fitted wavelengths that shaders sum over.
#[derive(Clone, Debug, PartialEq)]
pub struct BandsKey {
    /// Film and light.
    pub optics: OpticsKey,
    /// Thickness that they are fitted to, in nm.
    pub range_nm: f64,
    /// Which errors they may leave.
    pub quality: Quality,
}

impl BandsKey {
    /// Bands at most: what a uniform buffer has room for.
    pub const MOST: usize = 80;

    /// What the bands are summed for.
    #[must_use]
    pub fn task(&self) -> BandTask {
        // Thicker films have single walls from the table at every quality, for more bands than there are would be needed.
        let is_enough = self.quality == Quality::Spectral && self.wanted() <= Self::MOST;
        if is_enough { BandTask::Everything } else { BandTask::CrossTerms }
    }

    /// Whether single walls come from a table.
    #[must_use]
    pub fn needs_table(&self) -> bool {
        self.task() == BandTask::CrossTerms
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.wanted().min(Self::MOST)
    }

    /// Thickness, in nm, up to which as many as there is room for resolve the products' fringes. Thicker films have none that white light
    /// would show.
    #[must_use]
    pub fn coherent_nm(&self) -> f64 {
        // Where single walls come from a table, more bands than standard's are of no use.
        let measured = self.measured().min(if self.needs_table() { 13.0 } else { f64::MAX });
        Self::MOST as f64 / measured * TableKey::MIN_RANGE_NM
    }

    /// How many would do.
    fn wanted(&self) -> usize {
        (self.measured() * self.range_nm / TableKey::MIN_RANGE_NM).ceil() as usize
    }

    /// How many do for 1500 nm; thicker films have more fringes, and need as many more.
    fn measured(&self) -> f64 {
        match self.quality {
            Quality::Fast => 6.0,
            Quality::Standard => 13.0,
            Quality::Spectral => 36.0,
        }
    }
}

/// The light around the bubbles.
#[derive(Clone, Debug)]
pub struct EnvironmentKey(pub Arc<CubeMap>);

impl EnvironmentKey {
    /// Texels along a face's edge.
    #[must_use]
    pub fn size(&self) -> u32 {
        self.0.size() as u32
    }
}

impl PartialEq for EnvironmentKey {
    fn eq(&self, other: &Self) -> bool {
        self.0.id() == other.0.id()
    }
}

/// A moment of a film: a tick, and how far towards the next one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Whole ticks.
    pub tick: u64,
    /// Part of the next tick, in [0, 1).
    pub fraction: f64,
}

impl Moment {
    /// The moment of a tick.
    #[must_use]
    pub fn tick(tick: u64) -> Self {
        Self { tick, fraction: 0.0 }
    }

    /// The first tick that has no part in this moment.
    #[must_use]
    pub fn end_tick(&self) -> u64 {
        self.tick + u64::from(self.fraction > 0.0)
    }

    /// The moment of a time, for a tick's length. A time within a billionth of a tick counts as the tick.
    #[must_use]
    pub fn of_time(time_s: f64, tick_s: f64) -> Self {
        let ticks = (time_s / tick_s).max(0.0);
        let nearest = ticks.round();
        if (ticks - nearest).abs() < 1e-9 * nearest.max(1.0) {
            return Self::tick(nearest as u64);
        }
        Self { tick: ticks.floor() as u64, fraction: ticks - ticks.floor() }
    }
}

impl fmt::Display for Moment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tick {}", self.tick)?;
        if self.fraction > 0.0 {
            write!(f, " + {:.3}", self.fraction)?;
        }
        Ok(())
    }
}

/// How the film's liquid is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlowLaw {
    /// Not at all.
    Rest,
    /// Low swings to and fro.
    Sloshing {
        /// Factor on all speeds.
        strength: f64,
        /// Which of all such flows.
        seed: u32,
    },
    /// A slow large-scale breath of air that never quite rests.
    Draught {
        /// Factor on all speeds.
        strength: f64,
        /// Which of all such flows.
        seed: u32,
    },
    /// The draught, and vortices that drift in it.
    Stirred {
        /// Factor on all speeds.
        strength: f64,
        /// Which of all such flows.
        seed: u32,
    },
}

impl FlowLaw {
    /// The law as a velocity field.
    #[must_use]
    pub fn prescribed(self) -> PrescribedFlow {
        match self {
            Self::Rest => PrescribedFlow::default(),
            Self::Sloshing { strength, seed } => PrescribedFlow::sloshing(seed, strength),
            Self::Draught { strength, seed } => PrescribedFlow::draught(seed, strength),
            Self::Stirred { strength, seed } => PrescribedFlow::stirred(seed, strength),
        }
    }

    fn strength(self) -> f64 {
        match self {
            Self::Rest => 0.0,
            Self::Sloshing { strength, .. } | Self::Draught { strength, .. } | Self::Stirred { strength, .. } => {
                strength
            }
        }
    }

    /// Ticks in a step of the film, for a tick's length and the angle between cells: as many as keep the step accurate, and more where
    /// even those would move nothing by a thousandth of a cell.
    #[must_use]
    pub fn ticks_a_step(self, tick_s: f64, cell_angle: f64) -> u64 {
        // At strength 1 the fastest vortices turn by a quarter of a radian in 0.1 s, where a Runge-Kutta step errs by 1e-5 of that; the
        // swings of 2 s and more are followed by its three moments.
        let accurate_s = (0.1 / self.strength()).min(0.2);
        let still_s = 1e-3 * cell_angle / self.prescribed().max_speed_bound();
        (accurate_s.max(still_s) / tick_s).max(1.0) as u64
    }
}

/// A law, and the tick from which it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowSegment {
    /// First tick.
    pub from_tick: u64,
    /// The law from there on.
    pub law: FlowLaw,
}

/// A film whose thickness varies: how it began, what drove it, and the moment.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldKey {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// Thickness at tick 0.
    pub initial: InitialFilm,
    /// Length of a tick in seconds.
    pub tick_s: f64,
    /// How the liquid is moved.
    pub scheme: Scheme,
    /// The most ticks from one remap of the flow map to the next.
    pub remap_ticks: u32,
    /// Laws in the order of their ticks, as far as the moment has seen them; the first holds from tick 0.
    pub flows: Vec<FlowSegment>,
    /// The moment.
    pub moment: Moment,
}

impl FieldKey {
    /// The same film at another moment.
    #[must_use]
    pub fn at(&self, moment: Moment) -> Self {
        Self { moment, ..self.clone() }
    }

    /// Cells of the whole sphere.
    #[must_use]
    pub fn cell_count(&self) -> u64 {
        6 * u64::from(self.cells) * u64::from(self.cells)
    }

    /// The law that holds during a tick.
    #[must_use]
    pub fn law(&self, tick: u64) -> FlowLaw {
        self.flows.iter().rev().find(|segment| segment.from_tick <= tick).map_or(FlowLaw::Rest, |segment| segment.law)
    }

    /// The last tick until the moment at which a step ends: where the film's state stands. What the moment is beyond it, the shown
    /// thickness alone is ahead of the state, so that steps are the same however a history is cut into frames.
    #[must_use]
    pub fn state_tick(&self) -> u64 {
        self.step_at(self.moment.tick).start
    }

    /// Ticks of the whole steps from the end of one until the moment, in order.
    pub fn steps_from(&self, tick: u64) -> impl Iterator<Item = Range<u64>> {
        let mut next = tick;
        std::iter::from_fn(move || {
            let step = self.step_at(next);
            next = step.end;
            (step.end <= self.moment.tick).then_some(step)
        })
    }

    /// The step that a tick lies in. Steps begin with each law and are cut where the next one comes into force; a law of rest is one step.
    fn step_at(&self, tick: u64) -> Range<u64> {
        let after = self.flows.partition_point(|segment| segment.from_tick <= tick);
        let end = self.flows.get(after).map_or(u64::MAX, |next| next.from_tick);
        let Some(segment) = self.flows[..after].last() else { return 0..end };
        if segment.law == FlowLaw::Rest {
            return segment.from_tick..end;
        }
        let length = segment.law.ticks_a_step(self.tick_s, self.cell_angle());
        let start = tick - (tick - segment.from_tick) % length;
        start..start.saturating_add(length).min(end)
    }

    /// Angle between neighbouring cells, in radians; that of the coarsest grid for a size that no grid has.
    #[must_use]
    pub fn cell_angle(&self) -> f64 {
        CubedSphere::new(self.cells as usize).map_or(std::f64::consts::FRAC_PI_2 / 8.0, CubedSphere::cell_angle)
    }

    /// Whether this film's past, up to the other's moment, is the other's: then it can go on from there.
    #[must_use]
    pub fn continues(&self, past: &Self) -> bool {
        past.moment.tick <= self.moment.tick
            && !self.law_differs_until(past)
            && self.step_at(past.moment.tick).start == past.moment.tick
    }

    /// Whether anything that shaped the other film up to its moment is different in this one.
    #[must_use]
    pub fn law_differs_until(&self, other: &Self) -> bool {
        let end = other.moment.end_tick();
        let past = |key: &Self| key.flows.iter().filter(|segment| segment.from_tick < end).copied().collect::<Vec<_>>();
        (self.cells, self.initial, self.tick_s, self.scheme, self.remap_ticks)
            != (other.cells, other.initial, other.tick_s, other.scheme, other.remap_ticks)
            || past(self) != past(other)
    }
}

/// Thickness of black film, in nm, at which evaporation ends: common black films are 10 to 30 nm thick.
pub const BLACK_FILM_NM: f64 = 10.0;

/// What a bubble's film is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum FilmKey {
    /// One thickness everywhere, in nm: no field at all.
    Uniform(f64),
    /// A field.
    Field(FieldKey),
}

/// One bubble as the picture sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct BubbleKey {
    /// Index of the bubble in the scene, and of its film.
    pub index: usize,
    /// Centre in metres.
    pub centre_m: DVec3,
    /// Radius in metres.
    pub radius_m: f64,
    /// Bounding rectangle in clip coordinates, lower left and upper right.
    pub bounds: [DVec2; 2],
    /// Takes directions of the world to the film, which may turn as a whole.
    pub to_film: DMat3,
    /// What has evaporated from the whole film, in nm.
    pub thinned_nm: f64,
    /// Samples along each side of a pixel.
    pub samples: u32,
    /// Whether the film is looked up through its flow map at each pixel: where cells are larger than pixels.
    pub magnified: bool,
    /// Whether thickness is filtered over each sample: where a pixel spans more of the film than a cell.
    pub filtered: bool,
    /// The film.
    pub film: FilmKey,
}

/// Where the picture is taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraKey {
    /// The eye, in metres.
    pub eye_m: DVec3,
    /// Unit vector along the line of sight.
    pub forward: DVec3,
    /// Unit vector to the right of the picture.
    pub right: DVec3,
    /// Unit vector to its top.
    pub up: DVec3,
    /// Height of a pixel on the plane one metre before the eye, in metres.
    pub pixel_height_m: f64,
}

/// What stands straight behind the bubbles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BackdropKey {
    /// The environment.
    Environment,
    /// A radiance, linear BT.2020.
    Colour(DVec3),
}

/// How the environment lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightKey {
    /// Factor on the environment's radiance, linear BT.2020.
    pub gain: DVec3,
    /// From the environment's light to what is seen of it under the illuminant: linear BT.2020, where (1, 1, 1) is daylight's white.
    pub seen: DMat3,
    /// Factor that makes daylight's white (1, 1, 1).
    pub scale: DVec3,
    /// Direction in the world along which the electric field passes a polariser before the camera, if there is one.
    pub polariser: Option<DVec3>,
    /// Turn of the environment about the vertical, anticlockwise from above, in radians.
    pub rotation_rad: f64,
    /// The backdrop.
    pub backdrop: BackdropKey,
}

/// The linear picture.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawKey {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Whether radiance is kept as f32, for measurements, or as f16, for looking at.
    pub full_precision: bool,
    /// Whether each film is replaced by a sphere with one environment lookup: the yardstick of the frame's cost.
    pub yardstick: bool,
    /// The camera.
    pub camera: CameraKey,
    /// The scene's own light.
    pub lighting: Lighting,
    /// Lights of other illuminants. Light adds up: the picture is the sum of the pictures in each light alone.
    pub lamps: Vec<Lighting>,
    /// The bubbles that can be seen, farthest first.
    pub bubbles: Vec<BubbleKey>,
}

/// Light of one illuminant, and what the films' optics in it need.
#[derive(Clone, Debug, PartialEq)]
pub struct Lighting {
    /// How it lights.
    pub light: LightKey,
    /// Where it comes from.
    pub environment: EnvironmentKey,
    /// The table, where the quality has one.
    pub table: Option<TableKey>,
    /// The bands.
    pub bands: BandsKey,
}

impl DrawKey {
    /// All lights, the scene's own first.
    pub fn lights(&self) -> impl Iterator<Item = &Lighting> {
        std::iter::once(&self.lighting).chain(&self.lamps)
    }

    /// Whether any light from the environment can reach the picture.
    #[must_use]
    pub fn needs_environment(&self) -> bool {
        !self.bubbles.is_empty() || self.lighting.light.backdrop == BackdropKey::Environment
    }

    /// The first thing in which two pictures differ.
    #[must_use]
    pub fn difference(&self, other: &Self) -> &'static str {
        if self.size != other.size {
            "the picture's size"
        } else if self.camera != other.camera {
            "the camera"
        } else if self.lighting != other.lighting {
            self.lighting.difference(&other.lighting)
        } else if self.lamps != other.lamps {
            "a light of another illuminant"
        } else if self.bubbles != other.bubbles {
            "a bubble or its film"
        } else {
            "the way of drawing"
        }
    }
}

impl Lighting {
    fn difference(&self, other: &Self) -> &'static str {
        if self.light != other.light || self.environment != other.environment {
            "the light"
        } else if self.table != other.table {
            "the table"
        } else {
            "the bands"
        }
    }
}

/// The finished picture.
#[derive(Clone, Debug, PartialEq)]
pub struct TonemapKey {
    /// The linear picture.
    pub draw: DrawKey,
    /// Exposure in stops.
    pub exposure_ev: f64,
    /// From the linear picture to what the display is given, linear BT.2020: white balance.
    pub balance: DMat3,
    /// Colours that the display has.
    pub gamut: Gamut,
    /// Seed of the dither, if there is any.
    pub dither: Option<u32>,
}

impl TonemapKey {
    /// The first thing in which two pictures differ.
    #[must_use]
    pub fn difference(&self, other: &Self) -> &'static str {
        if self.draw != other.draw {
            "the linear picture"
        } else if self.exposure_ev != other.exposure_ev {
            "the exposure"
        } else if self.balance != other.balance || self.gamut != other.gamut {
            "the white balance or the gamut"
        } else {
            "the dither"
        }
    }
}
