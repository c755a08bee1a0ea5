use std::fmt;

/// The size of a frame in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
}

impl Size {
    /// `width` x `height`, taken as they are.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// The whole frame as a window of itself.
    #[must_use]
    pub const fn window(self) -> Window {
        Window { x: 0, y: 0, width: self.width, height: self.height }
    }

    /// How many pixels it has.
    #[must_use]
    pub const fn pixels(self) -> u64 {
        self.width as u64 * self.height as u64
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// A rectangle of pixels: columns `x..x + width` of rows `y..y + height`.
/// Row 0 is at the top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    /// The leftmost column.
    pub x: u32,
    /// The topmost row.
    pub y: u32,
    /// How many columns.
    pub width: u32,
    /// How many rows.
    pub height: u32,
}

impl Window {
    /// How many pixels it has.
    #[must_use]
    pub const fn pixels(self) -> u64 {
        self.width as u64 * self.height as u64
    }

    /// Whether it has pixels and all of them lie in a frame of that size.
    #[must_use]
    pub const fn fits(self, frame: Size) -> bool {
        self.width > 0
            && self.height > 0
            && self.right() <= frame.width as u64
            && self.bottom() <= frame.height as u64
    }

    /// The column after the last one.
    const fn right(self) -> u64 {
        self.x as u64 + self.width as u64
    }

    /// The row after the last one.
    const fn bottom(self) -> u64 {
        self.y as u64 + self.height as u64
    }

    /// The pixels that both windows have; `None` where there are none.
    #[must_use]
    pub fn intersection(self, other: Self) -> Option<Self> {
        let x = self.x.max(other.x);
        let y = self.y.max(other.y);
        let width = self.right().min(other.right()).saturating_sub(u64::from(x));
        let height = self.bottom().min(other.bottom()).saturating_sub(u64::from(y));
        // No more than either window has, so they fit.
        (width > 0 && height > 0).then_some(Self {
            x,
            y,
            width: width as u32,
            height: height as u32,
        })
    }

    /// How many [`tile`](Self::tile)s of that side it is cut into.
    #[must_use]
    pub const fn tile_count(self, side: u32) -> u64 {
        self.width.div_ceil(side) as u64 * self.height.div_ceil(side) as u64
    }

    /// Tile number `index` of the squares of `side` pixels that the window is
    /// cut into, row by row from its top left corner; those at the right and
    /// at the bottom may be smaller.
    ///
    /// # Panics
    /// Where `index` is not below [`tile_count`](Self::tile_count).
    #[must_use]
    pub fn tile(self, side: u32, index: u64) -> Self {
        assert!(index < self.tile_count(side), "tile {index} is outside the window");
        let columns = u64::from(self.width.div_ceil(side));
        // Both are at most the window's sides, so they fit.
        let (left, top) = ((index % columns) as u32 * side, (index / columns) as u32 * side);
        Self {
            x: self.x + left,
            y: self.y + top,
            width: side.min(self.width - left),
            height: side.min(self.height - top),
        }
    }
}

impl fmt::Display for Window {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{},{}", self.x, self.y, self.width, self.height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_each_pixel_once() {
        for (width, height, side) in [(1, 1, 16), (16, 16, 16), (33, 17, 16), (5, 40, 7)] {
            let window = Window { x: 3, y: 2, width, height };
            let mut seen = vec![0_u8; (width * height) as usize];
            for index in 0..window.tile_count(side) {
                let tile = window.tile(side, index);
                assert_eq!(tile.intersection(window), Some(tile));
                for y in tile.y..tile.y + tile.height {
                    for x in tile.x..tile.x + tile.width {
                        seen[((y - 2) * width + (x - 3)) as usize] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|&n| n == 1), "{window} in tiles of {side}");
        }
    }

    #[test]
    fn windows_fit_or_do_not() {
        let frame = Size::new(10, 8);
        assert!(frame.window().fits(frame));
        assert!(Window { x: 9, y: 7, width: 1, height: 1 }.fits(frame));
        assert!(!Window { x: 9, y: 7, width: 2, height: 1 }.fits(frame));
        assert!(!Window { x: 9, y: 8, width: 1, height: 1 }.fits(frame));
        assert!(!Window { x: 0, y: 0, width: 0, height: 1 }.fits(frame));
        assert!(!Window { x: u32::MAX, y: 0, width: u32::MAX, height: 1 }.fits(frame));
    }

    #[test]
    fn windows_that_only_touch_share_nothing() {
        let left = Window { x: 0, y: 0, width: 4, height: 4 };
        let right = Window { x: 4, y: 0, width: 4, height: 4 };
        assert_eq!(left.intersection(right), None);
        let inner = Window { x: 3, y: 2, width: 4, height: 4 };
        assert_eq!(left.intersection(inner), Some(Window { x: 3, y: 2, width: 1, height: 2 }));
    }
}
