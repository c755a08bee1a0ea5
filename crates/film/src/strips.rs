use crate::Window;
use crate::grid::Grid;

/// A strip of a film or of its layers: at most `ROWS` rows high, and open to be
/// written to while other threads write to other strips.
#[derive(Debug)]
pub struct Strip<'a, T, const ROWS: usize> {
    window: Window,
    /// The part of each row that lies in it; those below the last row are empty.
    rows: [&'a mut [T]; ROWS],
}

impl<T: Copy, const ROWS: usize> Strip<'_, T, ROWS> {
    /// Where it is in the frame.
    #[must_use]
    pub const fn window(&self) -> Window {
        self.window
    }

    /// Writes `values`, row by row, to the pixels of `tile` (in the frame's
    /// coordinates).
    ///
    /// # Panics
    /// Where `tile` reaches out of the strip, or `values` has another number of
    /// pixels.
    pub fn put(&mut self, tile: Window, values: &[T]) {
        assert_eq!(values.len() as u64, tile.pixels(), "one value for each pixel");
        assert_eq!(tile.intersection(self.window), Some(tile), "the tile lies in the strip");
        let (left, top) = ((tile.x - self.window.x) as usize, (tile.y - self.window.y) as usize);
        let width = tile.width as usize;
        for (row, values) in self.rows[top..].iter_mut().zip(values.chunks_exact(width)) {
            row[left..left + width].copy_from_slice(values);
        }
    }
}

impl<T: Copy> Grid<T> {
    /// All of it in strips of that width and of `ROWS` rows, row by row from its top
    /// left corner; those at the right and at the bottom may be smaller.
    ///
    /// # Panics
    /// Where `width` or `ROWS` is 0.
    pub(crate) fn strips_mut<const ROWS: usize>(
        &mut self,
        width: u32,
    ) -> impl Iterator<Item = Strip<'_, T, ROWS>> {
        let window = self.window();
        let columns = window.width as usize;
        let bands = self.values_mut().chunks_mut(columns * ROWS);
        bands.zip((window.y..).step_by(ROWS)).flat_map(move |(band, y)| {
            let height = (band.len() / columns) as u32;
            let mut rows = band.chunks_mut(columns);
            let mut rest: [&mut [T]; ROWS] =
                std::array::from_fn(|_| rows.next().unwrap_or_default());
            (0..window.width).step_by(width as usize).map(move |left| {
                let width = width.min(window.width - left);
                let rows = rest.each_mut().map(|row| {
                    let (part, right) = std::mem::take(row)
                        .split_at_mut_checked(width as usize)
                        .unwrap_or_default();
                    *row = right;
                    part
                });
                Strip { window: Window { x: window.x + left, y, width, height }, rows }
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Size;

    #[test]
    fn strips_cover_each_pixel_once_and_are_where_they_say() {
        for (width, height, side) in [(1, 1, 1), (8, 4, 8), (33, 17, 10), (5, 41, 7), (9, 3, 40)] {
            let window = Window { x: 3, y: 2, width, height };
            let mut grid = Grid::new(Size::new(60, 60), window, 0_u32).expect("it fits");
            let mut number = 0;
            for mut strip in grid.strips_mut::<4>(side) {
                number += 1;
                let place = strip.window();
                assert!(place.width <= side && place.height <= 4);
                // By single pixels, from the last to the first.
                for y in (place.y..place.y + place.height).rev() {
                    for x in (place.x..place.x + place.width).rev() {
                        strip.put(
                            Window { x, y, width: 1, height: 1 },
                            &[number * 10_000 + y * 100 + x],
                        );
                    }
                }
            }
            assert_eq!(number, width.div_ceil(side) * height.div_ceil(4));
            for y in window.y..window.y + height {
                for x in window.x..window.x + width {
                    let strips = width.div_ceil(side);
                    let number = (y - 2) / 4 * strips + (x - 3) / side + 1;
                    assert_eq!(grid.get(x, y), number * 10_000 + y * 100 + x);
                }
            }
        }
    }

    #[test]
    fn strips_are_written_to_by_tiles() {
        let window = Window { x: 1, y: 1, width: 5, height: 3 };
        let mut grid = Grid::new(Size::new(9, 9), window, 0).expect("it fits");
        let mut strips: Vec<_> = grid.strips_mut::<2>(3).collect();
        strips[1].put(Window { x: 4, y: 1, width: 2, height: 2 }, &[1, 2, 3, 4]);
        strips[2].put(Window { x: 2, y: 3, width: 2, height: 1 }, &[5, 6]);
        assert_eq!(grid.values(), [0, 0, 0, 1, 2, 0, 0, 0, 3, 4, 0, 5, 6, 0, 0]);
    }

    #[test]
    #[should_panic(expected = "the tile lies in the strip")]
    fn a_strip_ends_where_the_next_begins() {
        let window = Window { x: 0, y: 0, width: 6, height: 2 };
        let mut grid = Grid::new(Size::new(6, 2), window, 0).expect("it fits");
        let mut strips = grid.strips_mut::<2>(3);
        let mut first = strips.next().expect("there are two");
        first.put(Window { x: 2, y: 0, width: 2, height: 1 }, &[1, 2]);
    }
}
