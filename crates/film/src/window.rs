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

    /// The frame's pixels that are not in this window, which lies in it, as windows
    /// above, to the left, to the right and below, as far as there are such.
    pub fn around(self, frame: Size) -> impl Iterator<Item = Self> {
        // The window's sides are not beyond those of the frame, so they fit.
        let (right, bottom) = (self.right() as u32, self.bottom() as u32);
        let beside = |x, width| Self { x, width, ..self };
        let across = |y, height| Self { x: 0, y, width: frame.width, height };
        let all = [
            across(0, self.y),
            beside(0, self.x),
            beside(right, frame.width.saturating_sub(right)),
            across(bottom, frame.height.saturating_sub(bottom)),
        ];
        all.into_iter().filter(|window| window.pixels() > 0)
    }

    /// It in strips of that width and `rows` rows, row by row from its top left
    /// corner; those at the right and at the bottom may be smaller.
    ///
    /// # Panics
    /// Where `width` or `rows` is 0.
    pub fn strips(self, width: u32, rows: u32) -> impl Iterator<Item = Self> {
        (0..self.height).step_by(rows as usize).flat_map(move |top| {
            (0..self.width).step_by(width as usize).map(move |left| Self {
                x: self.x + left,
                y: self.y + top,
                width: width.min(self.width - left),
                height: rows.min(self.height - top),
            })
        })
    }

    /// How many [`strips`](Self::strips) of that width and so many rows there are.
    #[must_use]
    pub const fn strip_count(self, width: u32, rows: u32) -> u64 {
        self.width.div_ceil(width) as u64 * self.height.div_ceil(rows) as u64
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
    fn strips_cover_each_pixel_once() {
        for (width, height, side, rows) in
            [(1, 1, 16, 16), (16, 16, 16, 16), (33, 17, 16, 4), (5, 40, 7, 16)]
        {
            let window = Window { x: 3, y: 2, width, height };
            let mut seen = vec![0_u8; (width * height) as usize];
            let mut count = 0;
            for strip in window.strips(side, rows) {
                count += 1;
                assert_eq!(strip.intersection(window), Some(strip));
                assert!(strip.width <= side && strip.height <= rows);
                for y in strip.y..strip.y + strip.height {
                    for x in strip.x..strip.x + strip.width {
                        seen[((y - 2) * width + (x - 3)) as usize] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|&n| n == 1), "{window} in strips of {side}x{rows}");
            assert_eq!(count, window.strip_count(side, rows));
        }
    }

    #[test]
    fn a_window_and_what_is_around_it_are_the_frame() {
        let frame = Size::new(7, 5);
        for (x, y, width, height) in
            [(0, 0, 7, 5), (2, 1, 3, 2), (0, 0, 1, 1), (6, 4, 1, 1), (0, 2, 7, 1), (3, 0, 2, 5)]
        {
            let window = Window { x, y, width, height };
            let mut seen = [[0_u8; 7]; 5];
            for part in std::iter::once(window).chain(window.around(frame)) {
                assert!(part.fits(frame));
                for y in part.y..part.y + part.height {
                    for x in part.x..part.x + part.width {
                        seen[y as usize][x as usize] += 1;
                    }
                }
            }
            assert_eq!(seen, [[1; 7]; 5], "{window}");
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
