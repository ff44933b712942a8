//! Small bubbles of one layer and one material: which tiles show which of them.

use std::ops::Range;

use super::{Colours, Shared, values::max_small_samples};
use crate::{
    gpu::{
        composition::{PixelRect, PlacedSmall},
        device::{Gpu, GpuError},
        formats::radiance_format,
        kernel::Drawable,
        passes::{
            bake_table::TableOverrides,
            small_bubbles::{SmallBubbles, SmallTile, TILE},
        },
    },
    plan::Rendering,
    scene::Quality,
};

/// The bubbles of each tile of a picture, as the shader reads them.
struct TileLists {
    tiles: Vec<SmallTile>,
    /// Places of bubbles in the list of all, those of a tile in a row.
    lists: Vec<u32>,
    /// Pixels of the tiles that have bubbles, as few rectangles.
    rects: Vec<PixelRect>,
}

impl TileLists {
    /// The lists of bubbles, in the order in which they are drawn.
    fn new(bubbles: &[PlacedSmall], [width, height]: [u32; 2]) -> Self {
        let [across, down] = [width, height].map(|pixels| pixels.div_ceil(TILE));
        // After the last bubble of each tile: first how many, then where.
        let mut ends = vec![0; (across * down) as usize];
        for PlacedSmall { rect, .. } in bubbles {
            rect.tiles(across).for_each(|tile| ends[tile] += 1);
        }
        let mut tiles = Vec::with_capacity(ends.len());
        let mut sum = 0;
        for end in &mut ends {
            tiles.push(SmallTile { first: sum, end: sum + *end });
            (*end, sum) = (sum, sum + *end);
        }
        let mut lists = vec![0; sum as usize];
        for PlacedSmall { place, rect } in bubbles {
            for tile in rect.tiles(across) {
                lists[ends[tile] as usize] = *place as u32;
                ends[tile] += 1;
            }
        }
        let rects = rects_of(&tiles, across, [width, height]);
        Self { tiles, lists, rects }
    }

    /// The most bubbles that a tile has.
    fn most(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.end - tile.first).max().unwrap_or(0)
    }
}

/// The pixels of all tiles that have bubbles, runs one below the other in one rectangle.
fn rects_of(tiles: &[SmallTile], across: u32, [width, height]: [u32; 2]) -> Vec<PixelRect> {
    let mut rects: Vec<PixelRect> = Vec::new();
    // The last rectangle that begins in each column.
    let mut last: Vec<Option<usize>> = vec![None; across as usize];
    for [row, first, end] in runs(tiles, across) {
        let columns = first * TILE..(end * TILE).min(width);
        let rows = row * TILE..((row + 1) * TILE).min(height);
        let above =
            last[first as usize].filter(|rect| rects[*rect].rows.end == rows.start && rects[*rect].columns == columns);
        if let Some(above) = above {
            rects[above].rows.end = rows.end;
        } else {
            last[first as usize] = Some(rects.len());
            rects.push(PixelRect { columns, rows });
        }
    }
    rects
}

/// Tiles in a row that have bubbles: the row, the first column and the one after the last.
fn runs(tiles: &[SmallTile], across: u32) -> impl Iterator<Item = [u32; 3]> {
    let has_bubbles = |tile: &&SmallTile| tile.end > tile.first;
    tiles.chunks(across as usize).enumerate().flat_map(move |(row, tiles)| {
        let runs = tiles.chunk_by(move |a, b| has_bubbles(&a) == has_bubbles(&b));
        let ends = runs.scan(0, |end, run| {
            *end += run.len() as u32;
            Some((run, *end))
        });
        ends.filter(move |(run, _)| run.first().as_ref().is_some_and(has_bubbles))
            .map(move |(run, end)| [row as u32, end - run.len() as u32, end])
    })
}

/// Small bubbles that are ready to be drawn together.
pub(super) struct SmallDraw {
    /// How they are drawn.
    pub draw: Drawable,
    /// Pixels that show them.
    pub rects: Vec<PixelRect>,
}

impl SmallDraw {
    /// The pixels that lie in some rows.
    pub fn parts(&self, rows: &Range<u32>) -> impl Iterator<Item = PixelRect> {
        self.rects.iter().filter_map(|rect| rect.within(rows))
    }
}

impl Shared<'_> {
    /// Whether a small bubble, by its place in the picture's list, is blurred by the lens.
    fn is_out_of_focus(&self, place: usize) -> bool {
        let small = &self.key.small[place];
        !self.key.camera.is_in_focus(small.center_m, small.radius_m)
    }

    /// Makes some small bubbles ready, whose films have these colours.
    pub(super) fn small(
        &self,
        gpu: &Gpu,
        Colours { films, table, .. }: &Colours<'_>,
        bubbles: &[PlacedSmall],
    ) -> Result<SmallDraw, GpuError> {
        let key = self.key;
        let lists = TileLists::new(bubbles, key.size);
        let coloured = films.table.as_ref().is_some_and(|table| table.coloured);
        let small = SmallBubbles {
            SAMPLES: max_small_samples(key, films.quadrature.quality, lists.most()),
            OUT_OF_FOCUS: bubbles.iter().any(|PlacedSmall { place, .. }| self.is_out_of_focus(*place)),
            FULL_PRECISION: key.full_precision,
            THRICE: films.quadrature.quality != Quality::Fast,
            YARDSTICK: key.rendering == Rendering::Yardstick,
            table_kind: TableOverrides { COLOURED: coloured, POLARISED: self.lighting.light.polariser.is_some() },
            lit: self.light.lit,
            view: &self.view,
            light: &self.light.light,
            environment: &self.environment.view,
            environment_sampler: self.environment.sampler(films.quadrature.quality),
            axes: &table.axes,
            table: &table.view,
            films: self.films,
            bubbles: &self.small,
            lists: &gpu.storage("lists of small bubbles", &lists.lists),
            tiles: &gpu.storage("tiles", &lists.tiles),
            picture_behind: self.behind,
            point_sampler: gpu.point_sampler(),
            lamps: &self.light.lamps,
        };
        let draw = small.cover(gpu, &[radiance_format(key.full_precision)])?;
        Ok(SmallDraw { draw, rects: lists.rects })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rect(columns: Range<u32>, rows: Range<u32>) -> PixelRect {
        PixelRect { columns, rows }
    }

    fn lists<const N: usize>(bubbles: [(usize, PixelRect); N], size: [u32; 2]) -> TileLists {
        TileLists::new(&bubbles.map(|(place, rect)| PlacedSmall { place, rect }), size)
    }

    #[test]
    fn each_tile_lists_its_bubbles_in_their_order() {
        let bubbles = [(5, rect(0..17, 0..4)), (2, rect(20..40, 3..20)), (9, rect(30..33, 0..16))];
        let lists = lists(bubbles, [44, 32]);
        let of = |tile: usize| &lists.lists[lists.tiles[tile].first as usize..lists.tiles[tile].end as usize];
        assert_eq!(
            [0, 1, 2, 3, 4, 5].map(|tile| of(tile).to_vec()),
            [vec![5], vec![5, 2, 9], vec![2, 9], vec![], vec![2], vec![2]]
        );
        assert_eq!(lists.most(), 3);
        assert_eq!(lists.rects, [rect(0..44, 0..16), rect(16..44, 16..32)]);
        assert!(TileLists::new(&[], [44, 32]).rects.is_empty());
    }

    #[test]
    fn runs_of_tiles_that_lie_one_below_the_other_are_one_rectangle() {
        let lists = lists([(0, rect(3..40, 0..40)), (1, rect(65..67, 17..31)), (2, rect(0..4, 50..60))], [70, 60]);
        assert_eq!(lists.rects, [rect(0..48, 0..48), rect(64..70, 16..32), rect(0..16, 48..60)]);
    }
}
