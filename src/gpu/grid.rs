//! A cubed sphere on the device, and fields on it.

use std::sync::OnceLock;

use super::device::Gpu;
use crate::physics::{
    film::Cap,
    sphere::{CubedSphere, HALO, HaloEntry, HaloTable},
};

/// What passes know of a cap, see `shaders/sphere/cap.wgsl`: the height of the rim and the inversion. All directions are above the rim of a
/// film that has none.
#[must_use]
pub fn rim_numbers(cap: Option<Cap>) -> [f32; 2] {
    cap.map_or([-2.0, 1.0], |cap| [cap.rim_z as f32, cap.inversion as f32])
}

/// A grid and the tables of it that passes read.
pub struct Grid {
    /// The grid.
    pub sphere: CubedSphere,
    /// Cells along a panel's edge.
    pub cells: u32,
    /// tan(α) of each cell coordinate of an edge, halo included.
    pub tangents: wgpu::Buffer,
    /// Solid angles of the cells of one panel; of all panels where the film has a rim, with 0 beyond it.
    pub areas: wgpu::Buffer,
    halo: OnceLock<wgpu::Buffer>,
    /// Where the film ends, if anywhere.
    pub cap: Option<Cap>,
    /// Solid angle of the film.
    pub film_area: f64,
}

impl Grid {
    pub(in crate::gpu) fn new(gpu: &Gpu, sphere: CubedSphere, cap: Option<Cap>) -> Self {
        let (areas, film_area) = match cap {
            None => (sphere.panel_areas(), 4.0 * std::f64::consts::PI),
            Some(cap) => {
                let areas = film_areas(sphere, cap);
                let sum = areas.iter().sum();
                (areas, sum)
            }
        };
        let areas: Vec<f32> = areas.into_iter().map(|area| area as f32).collect();
        Self {
            cap,
            film_area,
            sphere,
            cells: sphere.n() as u32,
            tangents: gpu.storage("tangents", &sphere.edge_tangents()),
            areas: gpu.storage("areas", &areas),
            halo: OnceLock::new(),
        }
    }

    /// What each cell of the halo is interpolated from, made when it is first asked for.
    pub(in crate::gpu) fn halo(&self, gpu: &Gpu) -> &wgpu::Buffer {
        self.halo.get_or_init(|| gpu.storage("film halo", &halo_entries(self.sphere)))
    }

    /// A field with a number of bytes per cell, in padded storage.
    pub(in crate::gpu) fn field(&self, gpu: &Gpu, label: &str, bytes: u64) -> wgpu::Buffer {
        use wgpu::BufferUsages as Usage;
        gpu.buffer(label, self.sphere.padded_len() as u64 * bytes, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST)
    }

    /// Cells along an edge of a padded panel.
    #[must_use]
    pub fn side(&self) -> u32 {
        self.cells + 2 * HALO as u32
    }

    /// Workgroups of a pass with one invocation per cell, halo included, in tiles of 8 x 8: rows of 64 would leave many idle.
    #[must_use]
    pub fn padded_groups(&self) -> [u32; 3] {
        let tiles = self.side().div_ceil(8);
        [tiles, tiles, 6]
    }

    /// Whether its cells lie two by two between the same cells of another grid, whose cells are an even number of times as wide.
    #[must_use]
    pub fn has_quads_in(&self, other_cells: u32) -> bool {
        self.cells.is_multiple_of(2 * other_cells)
    }

    /// Workgroups of a pass with one invocation for two by two cells between the same cells of another grid.
    #[must_use]
    pub fn quad_groups(&self, other_cells: u32) -> [u32; 3] {
        let tiles = (self.side() + self.quad_skew(other_cells)).div_ceil(16);
        [tiles, tiles, 6]
    }

    /// Cells that the first two by two begin before storage does, halo included: 0 or 1. Of the other grid's cells, which are an even number
    /// of this one's wide, the first one's center lies half that number from the edge.
    #[must_use]
    pub fn quad_skew(&self, other_cells: u32) -> u32 {
        (HALO as u32 + self.cells / (2 * other_cells)) % 2
    }

    /// Workgroups of a pass with one invocation per cell without the halo, in tiles of 8 x 8.
    #[must_use]
    pub fn cell_groups(&self) -> [u32; 3] {
        let tiles = self.cells.div_ceil(8);
        [tiles, tiles, 6]
    }
}

/// Solid angles of film in all cells, in the grid's order.
#[must_use]
pub fn film_areas(sphere: CubedSphere, cap: Cap) -> Vec<f64> {
    cap.areas(sphere)
}

/// What each cell of a grid's halo is interpolated from: all beyond edges, then all beyond corners.
#[must_use]
pub fn halo_entries(grid: CubedSphere) -> Vec<HaloEntry> {
    let table = HaloTable::new(grid);
    [table.edges, table.corners].concat()
}
