//! Small bubbles of one layer and one material: which tiles show which of them.

use super::{Shared, values::max_small_samples};
use crate::gpu::{
    composition::PixelRect,
    device::{Gpu, GpuError},
    formats::radiance_format,
    kernel::Drawable,
    passes::{
        bake_table::{Table, TableOverrides},
        bubble::OtherBubble,
        small_bubbles::{SmallBubbles, SmallTile, TILE},
    },
};

/// The bubbles of each tile of a picture, as the shader reads them.
struct TileLists {
    tiles: Vec<SmallTile>,
    /// Places of bubbles in the list of all, those of a tile in a row.
    lists: Vec<u32>,
    /// Pixels of all tiles that have bubbles.
    rect: PixelRect,
}

impl TileLists {
    /// The lists of bubbles, by their places and the pixels that may show each, in the order in which they are drawn.
    fn new(bubbles: &[(usize, PixelRect)], [width, height]: [u32; 2]) -> Option<Self> {
        let [across, down] = [width, height].map(|pixels| pixels.div_ceil(TILE));
        // After the last bubble of each tile: first how many, then where.
        let mut ends = vec![0; (across * down) as usize];
        for (_, rect) in bubbles {
            rect.tiles(across).for_each(|tile| ends[tile] += 1);
        }
        let mut tiles = Vec::with_capacity(ends.len());
        let mut sum = 0;
        for end in &mut ends {
            tiles.push(SmallTile { first: sum, end: sum + *end });
            (*end, sum) = (sum, sum + *end);
        }
        let mut lists = vec![0; sum as usize];
        for (place, rect) in bubbles {
            for tile in rect.tiles(across) {
                lists[ends[tile] as usize] = *place as u32;
                ends[tile] += 1;
            }
        }
        let rect = bubbles.iter().map(|(_, rect)| rect.clone()).reduce(|all, rect| all.with(&rect))?;
        Some(Self { tiles, lists, rect })
    }

    /// The most bubbles that a tile has.
    fn most(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.end - tile.first).max().unwrap_or(0)
    }
}

impl Shared<'_> {
    /// Makes some of all small bubbles ready, by their places, with the pixels that show them. `None` if no pixel does.
    pub(super) fn small(
        &self,
        gpu: &Gpu,
        table: &Table,
        all: &[OtherBubble],
        places: &[usize],
    ) -> Result<Option<(Drawable, PixelRect)>, GpuError> {
        let key = self.key;
        let rects = places.iter().map(|place| (*place, PixelRect::around(key.small[*place].bounds, key.size)));
        let rects: Vec<(usize, PixelRect)> = rects.filter(|(_, rect)| rect.pixels() > 0).collect();
        let Some(lists) = TileLists::new(&rects, key.size) else { return Ok(None) };
        let material = key.lent[key.small[places[0]].lent].material;
        let coloured = self.lighting.films[material].table.as_ref().is_some_and(|table| table.coloured);
        let small = SmallBubbles {
            SAMPLES: max_small_samples(key, lists.most()),
            FULL_PRECISION: key.full_precision,
            table_kind: TableOverrides { COLOURED: coloured, POLARISED: self.lighting.light.polariser.is_some() },
            view: &self.view,
            light: &self.light,
            environment: &self.environment.view,
            environment_sampler: &self.environment.sampler,
            axes: &table.axes,
            table: &table.view,
            table_sampler: &self.table_sampler,
            films: self.films,
            bubbles: &gpu.storage("small bubbles", all),
            lists: &gpu.storage("lists of small bubbles", &lists.lists),
            tiles: &gpu.storage("tiles", &lists.tiles),
            picture_behind: self.behind,
        };
        Ok(Some((small.cover(gpu, radiance_format(key.full_precision))?, lists.rect)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_tile_lists_its_bubbles_in_their_order() {
        let rect = |columns, rows| PixelRect { columns, rows };
        let bubbles = [(5, rect(0..17, 0..4)), (2, rect(20..40, 3..20)), (9, rect(30..33, 0..16))];
        let lists = TileLists::new(&bubbles, [48, 32]).unwrap();
        let of = |tile: usize| &lists.lists[lists.tiles[tile].first as usize..lists.tiles[tile].end as usize];
        assert_eq!(
            [0, 1, 2, 3, 4, 5].map(|tile| of(tile).to_vec()),
            [vec![5], vec![5, 2, 9], vec![2, 9], vec![], vec![2], vec![2]]
        );
        assert_eq!((lists.rect.clone(), lists.most()), (rect(0..40, 0..20), 3));
        assert!(TileLists::new(&[], [48, 32]).is_none());
    }
}
