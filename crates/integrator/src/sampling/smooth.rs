//! Pixels whose neighbours' first samples met the same, and those whose did not.
//!
//! Around a smooth pixel a plane is fitted to the nine first samples, which are anywhere in
//! their pixels. The pixel's value is its own sample, put to the centre along the slope of that plane:
//! what a smooth function has there differs from its mean over the pixel by a 24th of its
//! second derivative.

use super::tile::{Pixel, TILE, Tile};
use crate::{Rgb, TILE_SIDE};
use lancer_kernel::lanes::{Lanes, Width, Work, dispatch};

/// The side of a tile with a pixel more on each side.
const SIDE: usize = TILE_SIDE as usize + 2;
const AREA: usize = SIDE * SIDE;
/// The pixels around one, from its place in rows of [`SIDE`].
const AROUND: [isize; 8] = {
    let side = SIDE as isize;
    [-side - 1, -side, -side + 1, -1, 1, side - 1, side, side + 1]
};

/// The mean square of what a smooth pixel is off, over that of the residuals of the plane.
///
/// For z = a x^2 / 2 the residuals over three pixels have a variance of 0.1125 a^2; the
/// sample put to the centre is off from the mean over the pixel by 0.00139 a^2, mean of squares, and by
/// a 12th of the variance of the slope, about a seventh of that of the residuals.
const OF_RESIDUALS: f64 = 0.025;

/// The mean square of what a pixel with an edge is off, seen once, over the variance among
/// its neighbours, about.
const OF_CONTRAST: f32 = 0.25;

/// All sums over nine pixels that a plane needs: the number, place, products of the
/// place, and of each component the sum and the products with the place; at last the sum of squares.
const MOMENTS: usize = 16;
const COUNT: usize = 0;
const PLACE: usize = 1;
const SQUARES: usize = 3;
const COLOUR: usize = 6;
const ALONG: usize = 9;
const COLOURS: usize = 15;

/// What was found of a tile.
pub(super) struct Analysis {
    /// The values of smooth pixels; of others as they were.
    pub(super) colour: [Rgb; TILE],
    /// The expected squares of their errors.
    pub(super) error: [f32; TILE],
    /// Those to be refined.
    pub(super) edges: Vec<Pixel>,
}

/// The tile and those around it, row by row.
pub(super) struct Neighbours<'a> {
    pub(super) tiles: &'a [Tile],
    /// How many tiles there are in a row.
    pub(super) across: usize,
    /// The number of the tile.
    pub(super) index: usize,
}

impl Neighbours<'_> {
    /// The pixel at a place relative to the tile's first one.
    pub(super) fn find(&self, x: isize, y: isize) -> Option<(usize, usize)> {
        let side = TILE_SIDE as isize;
        let (column, row) = (self.index % self.across, self.index / self.across);
        let column = (column as isize).checked_add(x.div_euclid(side))?;
        let row = (row as isize).checked_add(y.div_euclid(side))?;
        if column < 0 || row < 0 || column >= self.across as isize {
            return None;
        }
        let index = row as usize * self.across + column as usize;
        let window = self.tiles.get(index)?.window;
        let (x, y) = (x.rem_euclid(side) as u32, y.rem_euclid(side) as u32);
        let is_inside = x < window.width && y < window.height;
        is_inside.then_some((index, (y * window.width + x) as usize))
    }
}

impl Neighbours<'_> {
    /// The pixels around one of the tile.
    pub(super) fn beside(&self, index: usize) -> impl Iterator<Item = (usize, usize)> {
        let width = self.tiles[self.index].window.width as usize;
        let (x, y) = ((index % width) as isize, (index / width) as isize);
        let around = (-1..=1).flat_map(|down| (-1..=1).map(move |right| (right, down)));
        let around = around.filter(|step| *step != (0, 0));
        around.filter_map(move |(right, down)| self.find(x + right, y + down))
    }
}

/// The samples of a tile and of the pixels around it, side by side.
struct Halo {
    is_there: [u32; AREA],
    signature: [u32; AREA],
    /// In pixels from the tile's middle.
    x: [f64; AREA],
    y: [f64; AREA],
    colour: [[f64; AREA]; 3],
}

impl Halo {
    fn new(around: &Neighbours<'_>, exposure: f64) -> Self {
        let mut halo = Self {
            is_there: [0; AREA],
            signature: [0; AREA],
            x: [0.0; AREA],
            y: [0.0; AREA],
            colour: [[0.0; AREA]; 3],
        };
        let width = around.tiles[around.index].window.width as isize;
        for row in 0..SIDE {
            let y = row as isize - 1;
            for (x, count) in [(-1, 1), (0, width), (width, 1)] {
                let Some((tile, k)) = around.find(x, y) else { continue };
                let tile = &around.tiles[tile];
                if !tile.is_seen {
                    continue;
                }
                for step in 0..count as usize {
                    halo.put(row * SIDE + (x + 1) as usize + step, tile, k + step, exposure);
                }
            }
        }
        halo
    }

    #[inline]
    fn put(&mut self, at: usize, tile: &Tile, k: usize, exposure: f64) {
        self.is_there[at] = u32::MAX;
        self.signature[at] = tile.signature[k];
        let [u, v] = tile.place[k];
        // From the middle of a tile.
        self.x[at] = (at % SIDE) as f64 - 9.0 + f64::from(u);
        self.y[at] = (at / SIDE) as f64 - 9.0 + f64::from(v);
        for (to, from) in self.colour.iter_mut().zip(tile.colour[k]) {
            to[at] = f64::from(from) * exposure;
        }
    }

    /// How near to the pixel's centre a neighbour's sample has met something else: 0 where that
    /// is hardly outside of the pixel, 3 where it is farthest.
    fn nearness(&self, at: usize) -> u8 {
        let (x, y) = ((at % SIDE) as f64 - 8.5, (at / SIDE) as f64 - 8.5);
        let others = AROUND.iter().map(|step| at.wrapping_add_signed(*step));
        let others = others.filter(|other| {
            self.is_there[*other] != 0 && self.signature[*other] != self.signature[at]
        });
        let distance = |other: usize| (self.x[other] - x).abs().max((self.y[other] - y).abs());
        let nearest = others.map(distance).fold(1.5, f64::min);
        (4.0 * (nearest - 0.5)).clamp(0.0, 3.0) as u8
    }

    /// Whether a neighbour of each pixel has met something else.
    fn edges(&self) -> [u32; AREA] {
        let mut differs = [0; AREA];
        for step in AROUND {
            let inside = SIDE + 1..AREA - SIDE - 1;
            for (at, differs) in inside.clone().zip(&mut differs[inside]) {
                let other = at.wrapping_add_signed(step);
                *differs |= (self.signature[at] ^ self.signature[other]) & self.is_there[other];
            }
        }
        differs
    }

    /// Whether all neighbours of a pixel have met the same.
    fn neighbours_agree(&self, at: usize) -> bool {
        let mut others = AROUND
            .iter()
            .map(|step| at.wrapping_add_signed(*step))
            .filter(|other| self.is_there[*other] != 0)
            .map(|other| self.signature[other]);
        let first = others.next();
        others.all(|other| Some(other) == first)
    }

    /// The variance, mean of the components, of a pixel and its neighbours, clipped. Without
    /// itself, a black pixel among white ones would have none.
    fn contrast(&self, at: usize) -> f64 {
        let (mut count, mut sums, mut squares) = (0.0, [0.0; 3], 0.0);
        let around = AROUND.iter().map(|step| at.wrapping_add_signed(*step));
        for other in around.chain([at]) {
            if self.is_there[other] == 0 {
                continue;
            }
            count += 1.0;
            for (sum, colour) in sums.iter_mut().zip(&self.colour) {
                let shown = colour[other].clamp(0.0, 1.0);
                *sum += shown;
                squares += shown * shown;
            }
        }
        if count < 2.0 {
            return 1.0;
        }
        let of_means = sums.iter().map(|sum| sum * sum).sum::<f64>() / count;
        ((squares - of_means) / (3.0 * (count - 1.0))).max(0.0)
    }
}

/// Looks at the first samples of a tile.
pub(super) fn analyse(around: &Neighbours<'_>, exposure: f64, width: Width) -> Analysis {
    let tile = &around.tiles[around.index];
    let halo = Halo::new(around, exposure);
    let differs = halo.edges();
    let (mut colour, mut error, mut edges) = (tile.colour, [0.0; TILE], Vec::new());
    let mut fits = Fits { values: [[0.0; TILE]; 3], residual: [0.0; TILE] };
    dispatch(width, Fit { halo: &halo, fits: &mut fits });
    for k in 0..tile.pixels() {
        let (column, row) = (k % tile.window.width as usize, k / tile.window.width as usize);
        let at = (row + 1) * SIDE + column + 1;
        if differs[at] == 0 {
            let place = row * TILE_SIDE as usize + column;
            let values = fits.values.each_ref().map(|values| values[place]);
            // A plane may go below black.
            colour[k] = values.map(|v| (v / exposure).max(0.0) as f32);
            error[k] = (fits.residual[place] * OF_RESIDUALS) as f32;
            continue;
        }
        let is_odd = halo.neighbours_agree(at);
        let contrast = if is_odd {
            // Between it and the others, as if the edge were amid them.
            let other = at - 1 + 2 * usize::from(halo.is_there[at - 1] == 0);
            let squares = halo.colour.each_ref().map(|colour| {
                let d = colour[at].clamp(0.0, 1.0) - colour[other].clamp(0.0, 1.0);
                d * d / 4.0
            });
            squares.iter().sum::<f64>() / 3.0
        } else {
            halo.contrast(at)
        };
        error[k] = contrast as f32 * OF_CONTRAST;
        let mut pixel = Pixel::new(k, if is_odd { 2 } else { 0 }, tile.colour[k], contrast as f32);
        pixel.is_odd = is_odd;
        pixel.nearness = if is_odd { 0 } else { halo.nearness(at) };
        edges.push(pixel);
    }
    Analysis { colour, error, edges }
}

/// What comes of planes through the pixels of a tile and their neighbours, in rows of
/// [`TILE_SIDE`].
struct Fits {
    /// At the pixels' centres.
    values: [[f64; TILE]; 3],
    /// The mean of the squares of the residuals.
    residual: [f64; TILE],
}

struct Fit<'a> {
    halo: &'a Halo,
    fits: &'a mut Fits,
}

impl Work for Fit<'_> {
    type Output = ();

    /// Plain loops, which are compiled for the lanes that there are.
    #[inline(always)]
    fn run<L: Lanes>(self, _: L) {
        let Self { halo, fits } = self;
        let mut moments = [[0.0; AREA]; MOMENTS];
        for (at, is_there) in halo.is_there.iter().enumerate() {
            moments[COUNT][at] = if *is_there == 0 { 0.0 } else { 1.0 };
        }
        for (at, (&x, &y)) in halo.x.iter().zip(&halo.y).enumerate() {
            moments[PLACE][at] = x;
            moments[PLACE + 1][at] = y;
            moments[SQUARES][at] = x * x;
            moments[SQUARES + 1][at] = x * y;
            moments[SQUARES + 2][at] = y * y;
        }
        for (i, colour) in halo.colour.iter().enumerate() {
            for at in 0..AREA {
                let c = colour[at];
                moments[COLOUR + i][at] = c;
                moments[ALONG + 2 * i][at] = halo.x[at] * c;
                moments[ALONG + 2 * i + 1][at] = halo.y[at] * c;
                moments[COLOURS][at] += c * c;
            }
        }
        for moment in &mut moments {
            sum_of_nine(moment);
        }
        fit(halo, &moments, fits);
    }
}

/// Each number becomes the sum over the 3 x 3 around it, but at the margins.
#[inline(always)]
fn sum_of_nine(of: &mut [f64; AREA]) {
    let mut rows = [0.0; AREA];
    for at in 1..AREA - 1 {
        rows[at] = of[at - 1] + of[at] + of[at + 1];
    }
    for at in SIDE..AREA - SIDE {
        of[at] = rows[at - SIDE] + rows[at] + rows[at + SIDE];
    }
}

#[inline(always)]
fn fit(halo: &Halo, moments: &[[f64; AREA]; MOMENTS], fits: &mut Fits) {
    const TILE_SIDE: usize = crate::TILE_SIDE as usize;
    for row in 0..TILE_SIDE {
        for column in 0..TILE_SIDE {
            let (at, to) = ((row + 1) * SIDE + column + 1, row * TILE_SIDE + column);
            let n = moments[COUNT][at];
            let (x, y) = (moments[PLACE][at] / n, moments[PLACE + 1][at] / n);
            let xx = moments[SQUARES][at] - moments[PLACE][at] * x;
            let xy = moments[SQUARES + 1][at] - moments[PLACE][at] * y;
            let yy = moments[SQUARES + 2][at] - moments[PLACE + 1][at] * y;
            let determinant = xx * yy - xy * xy;
            // Where all are in a line there is no slope.
            let inverse = if determinant > 1e-3 * xx * yy { 1.0 / determinant } else { 0.0 };
            let right = column as f64 - 7.5 - halo.x[at];
            let down = row as f64 - 7.5 - halo.y[at];
            let mut squares = moments[COLOURS][at];
            for i in 0..3 {
                let sum = moments[COLOUR + i][at];
                let xc = moments[ALONG + 2 * i][at] - x * sum;
                let yc = moments[ALONG + 2 * i + 1][at] - y * sum;
                let across = (xc * yy - yc * xy) * inverse;
                let along = (yc * xx - xc * xy) * inverse;
                fits.values[i][to] = halo.colour[i][at] + across * right + along * down;
                squares -= sum * sum / n + across * xc + along * yc;
            }
            let freedom = if n > 4.0 { n - 3.0 } else { 1.0 };
            let residual = squares / (3.0 * freedom);
            fits.residual[to] = if residual > 0.0 { residual } else { 0.0 };
        }
    }
}
