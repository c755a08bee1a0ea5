//! What is thinner than a pixel is followed from pixel to pixel.

use super::rounds::Picture;
use super::smooth::Neighbours;
use super::tile::{Pixel, Tile};
use crate::TILE_SIDE;
use rayon::prelude::*;

impl Picture {
    fn around(&self, index: usize) -> Neighbours<'_> {
        Neighbours { tiles: &self.tiles, across: self.across, index }
    }

    /// What is beside a pixel whose first sample alone met what it met may have more of it.
    pub(super) fn mark_thin_ones(&mut self) {
        let mut beside = Vec::new();
        for (index, tile) in self.tiles.iter().enumerate() {
            for k in &tile.odd {
                let pixel = &tile.refined[usize::from(*k)];
                beside.extend(self.around(index).beside(usize::from(pixel.index)));
            }
        }
        for (tile, k) in beside {
            self.tiles[tile].is_thin.put(k);
        }
    }

    /// Pixels beside one in which a second signature was found are refined, too. What was found
    /// alone is counted as many times as it would have been missed. Whether there are any.
    pub(super) fn follow_contours(&mut self) -> bool {
        let beside = |index: usize| {
            let tile = &self.tiles[index];
            let new = tile.is_mixed.without(&tile.is_followed);
            let mut beside = Vec::new();
            if new.is_empty() {
                return beside;
            }
            let around = self.around(index);
            for pixel in tile.refined.iter().filter(|p| new.has(usize::from(p.index))) {
                let all = around.beside(usize::from(pixel.index));
                let all = all.filter(|(other, k)| !self.tiles[*other].is_refined.has(*k));
                beside.extend(all.map(|(other, k)| (other, k, pixel.contrast)));
            }
            beside
        };
        let beside: Vec<_> = (0..self.tiles.len()).into_par_iter().map(beside).collect();
        for tile in &mut self.tiles {
            tile.is_followed = tile.is_mixed;
        }
        let mut is_longer = false;
        for (tile, k, contrast) in beside.into_iter().flatten() {
            is_longer = true;
            let tile = &mut self.tiles[tile];
            if !tile.is_refined.has(k) {
                tile.refine(Pixel::new(k, 2, tile.colour[k], contrast));
            }
        }
        // Added up in order, however many threads have found them.
        let missed = (0..self.tiles.len()).into_par_iter().map(|index| self.missed_near(index));
        self.missed = missed.collect::<Vec<f64>>().iter().sum();
        is_longer
    }

    /// The squared error of what may have been missed, by the tile's pixels that were found alone:
    /// nothing where what is around them has been looked through.
    fn missed_near(&self, index: usize) -> f64 {
        if self.tiles[index].is_searched {
            return 0.0;
        }
        let around = self.around(index);
        let tile = &self.tiles[index];
        let odd = tile.odd.iter().map(|k| &tile.refined[usize::from(*k)]);
        let is_alone = |pixel: &&Pixel| {
            let mut all = around.beside(usize::from(pixel.index));
            !all.any(|(other, k)| self.tiles[other].is_mixed.has(k))
        };
        odd.filter(is_alone).map(Pixel::missed).sum()
    }

    /// Says that pixels beside what was found between samples are to have as many samples as that
    /// has. There a pixel that seems empty may be one in which the same thin thing was not met
    /// yet: so whether it goes on depends on the others, and it is right in the mean. Whether
    /// there are any.
    pub(super) fn lead_thin_ones(&mut self) -> bool {
        let leaders = |index: usize| {
            let tile = &self.tiles[index];
            let lead = tile.is_mixed.and(&tile.is_thin);
            let around = self.around(index);
            let mut beside = Vec::new();
            if !lead.is_empty() {
                for (pixel, standing) in tile.refined.iter().zip(&tile.standing) {
                    let k = usize::from(pixel.index);
                    if lead.has(k) {
                        let all = around.beside(k).map(|(tile, k)| (tile, k, standing.count));
                        beside.extend(all);
                    }
                }
            }
            beside
        };
        let ahead: Vec<_> = (0..self.tiles.len()).into_par_iter().map(leaders).collect();
        let mut any = false;
        for (tile, k, count) in ahead.into_iter().flatten() {
            let tile = &mut self.tiles[tile];
            if tile.least.is_empty() {
                tile.least.resize(tile.pixels(), 0);
            }
            tile.least[k] = tile.least[k].max(count);
            any = true;
        }
        any
    }

    /// Has all pixels refined that are near one that was found alone; whether there are any.
    pub(super) fn look_around(&mut self) -> bool {
        let mut near = vec![false; self.tiles.len()];
        for index in 0..self.tiles.len() {
            if self.tiles[index].odd.is_empty() {
                continue;
            }
            self.tiles[index].is_searched = true;
            let side = TILE_SIDE as isize;
            let around = self.around(index);
            for (x, y) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx * side, dy * side))) {
                if let Some((tile, _)) = around.find(x, y) {
                    near[tile] = true;
                }
            }
        }
        let mut is_new = false;
        for (tile, _) in self.tiles.iter_mut().zip(near).filter(|(_, near)| *near) {
            let odd = tile.odd.iter().map(|k| tile.refined[usize::from(*k)].contrast);
            let contrast = odd.fold(0.0, f32::max);
            for k in 0..tile.pixels() {
                if !tile.is_refined.has(k) {
                    is_new = true;
                    tile.refine(Pixel::new(k, 2, tile.colour[k], contrast));
                }
            }
        }
        is_new
    }
}

impl Tile {
    /// How many samples a refined pixel should have because of its neighbours.
    pub(super) fn least(&self, which: usize) -> u32 {
        let k = usize::from(self.refined[which].index);
        let least = self.least.get(k).copied().unwrap_or(0);
        if self.is_thin.has(k) { least } else { 0 }
    }
}

impl Pixel {
    /// The squared error of what was missed, for each pixel of which a single sample has
    /// found what few would: of 1 / p such pixels one is found, where p is the part of the pixel
    /// that shows it (Horvitz and Thompson, 1952).
    fn missed(&self) -> f64 {
        let n = f64::from(self.count());
        let part = (f64::from(self.same) + 0.5) / (n + 1.0);
        // The contrast is a quarter of the squared difference.
        part * (1.0 - part) * 4.0 * f64::from(self.contrast)
    }
}
