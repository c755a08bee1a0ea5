//! Pictures as they are judged, and how far they are from each other.

use lancer_film::{Film, Size};

/// Red, green and blue in exposed linear units: 0 is black and 1 display white, and nothing is
/// outside. Exposing and clipping come after the averaging of samples.
pub type Exposed = [f64; 3];

/// A picture as it is judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    size: Size,
    pixels: Vec<Exposed>,
}

impl Picture {
    /// Multiplies linear values, row by row from the top, by the factor of the exposure, and
    /// clips them; what is not a number is black. `None` where there are not as many as pixels.
    #[must_use]
    pub fn new(size: Size, linear: impl Iterator<Item = Exposed>, factor: f64) -> Option<Self> {
        let pixels: Vec<_> = linear.map(|pixel| exposed(pixel, factor)).collect();
        (pixels.len() as u64 == size.pixels()).then_some(Self { size, pixels })
    }

    /// The film's picture, exposed by that factor. `None` where the film is only a part of its
    /// frame.
    #[must_use]
    pub fn of_film(film: &Film, factor: f64) -> Option<Self> {
        let linear = film.pixels().iter().map(|pixel| pixel.map(f64::from));
        Self::new(film.frame(), linear, factor)
    }

    /// Its pixels, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[Exposed] {
        &self.pixels
    }

    /// Its width and height.
    #[must_use]
    pub const fn size(&self) -> Size {
        self.size
    }

    /// The root of the mean square over pixels and channels of the differences to another
    /// picture. `None` where their sizes differ.
    #[must_use]
    pub fn error(&self, other: &Self) -> Option<f64> {
        let sum: f64 = self.pixel_errors(other)?.iter().map(|error| error * error).sum();
        Some((sum / self.pixels.len() as f64).sqrt())
    }

    /// The same of each pixel alone, over its channels.
    #[must_use]
    pub fn pixel_errors(&self, other: &Self) -> Option<Vec<f64>> {
        let error = |(a, b): (&Exposed, &Exposed)| {
            let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
            (squares.sum::<f64>() / 3.0).sqrt()
        };
        let pairs = self.pixels.iter().zip(&other.pixels);
        (self.size == other.size).then(|| pairs.map(error).collect())
    }

    /// The mean over pixels and channels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.pixels.iter().flatten().sum();
        sum / (3 * self.pixels.len()) as f64
    }
}

/// As in [`Picture::new`].
pub(crate) fn exposed(linear: Exposed, factor: f64) -> Exposed {
    // Both comparisons are false for what is not a number.
    linear.map(|v| v * factor).map(|v| match v {
        v if v >= 1.0 => 1.0,
        v if v > 0.0 => v,
        _ => 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_film::Display;

    const SIZE: Size = Size::new(2, 1);

    fn picture(pixels: [Exposed; 2], factor: f64) -> Picture {
        Picture::new(SIZE, pixels.into_iter(), factor).expect("two pixels")
    }

    #[test]
    fn pictures_are_exposed_and_then_clipped() {
        let bright = picture([[0.125, 0.5, 3.0], [f64::NAN, f64::INFINITY, -1.0]], 2.0);
        assert_eq!(bright.pixels(), [[0.25, 1.0, 1.0], [0.0, 1.0, 0.0]]);
        assert_eq!(bright.mean(), 3.25 / 6.0);
        assert_eq!(Picture::new(SIZE, std::iter::once([0.0; 3]), 1.0), None);
    }

    #[test]
    fn errors_are_roots_of_mean_squares() {
        let a = picture([[0.0, 0.5, 1.0], [0.2; 3]], 1.0);
        let b = picture([[0.3, 0.5, 1.0], [0.2; 3]], 1.0);
        let error = a.error(&b).expect("one size");
        assert!((error - (0.09_f64 / 6.0).sqrt()).abs() < 1e-15, "{error}");
        let errors = a.pixel_errors(&b).expect("one size");
        assert!((errors[0] - (0.09_f64 / 3.0).sqrt()).abs() < 1e-15 && errors[1] == 0.0);
        assert_eq!(a.error(&a), Some(0.0));
        let other = Picture::new(Size::new(1, 2), [[0.0; 3]; 2].into_iter(), 1.0);
        assert_eq!(a.error(&other.expect("two pixels")), None);
    }

    /// Nothing above white counts: both are as white as can be shown.
    #[test]
    fn what_is_over_exposed_is_no_error() {
        let pair = [3.0, 70.0].map(|v| picture([[v; 3], [0.5; 3]], 1.0));
        assert_eq!(pair[0].error(&pair[1]), Some(0.0));
    }

    #[test]
    fn a_film_is_judged_whole() {
        let film = |window| {
            let mut film = Film::new(SIZE, window, Display::Exposed).expect("a small film");
            film.put(window, &[[0.25, 0.5, 2.0]; 2][..window.pixels() as usize]);
            film
        };
        let whole = Picture::of_film(&film(SIZE.window()), 0.5).expect("it is whole");
        assert_eq!(whole.pixels(), [[0.125, 0.25, 1.0]; 2]);
        let part = lancer_film::Window { x: 0, y: 0, width: 1, height: 1 };
        assert_eq!(Picture::of_film(&film(part), 0.5), None);
    }
}
