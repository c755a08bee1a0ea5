use crate::grid::Grid;
use crate::{FilmError, Size, Strip, Window};

/// What the ray through the middle of a pixel meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerPixel {
    /// How far it is along the camera's axis (that of the plane through it that
    /// is parallel to the picture), in scene lengths.
    pub axis_depth: f32,
    /// How far it is along the ray, in scene lengths.
    pub ray_depth: f32,
    /// Its normal in the world: of length 1, on the side that the ray comes
    /// from.
    pub normal: [f32; 3],
    /// Its own colour, linear: the share of red, green and blue light, from 0
    /// to 1, that it does not swallow.
    pub albedo: [f32; 3],
    /// The number of its shape, from 1; 0 where there is nothing.
    pub shape: u32,
    /// The number of its instance (one placing of a shape), from 1; 0 where
    /// there is nothing.
    pub instance: u32,
}

impl LayerPixel {
    /// Where the ray meets nothing: infinitely far, without direction, black,
    /// and number 0.
    pub const MISS: Self = Self {
        axis_depth: f32::INFINITY,
        ray_depth: f32::INFINITY,
        normal: [0.0; 3],
        albedo: [0.0; 3],
        shape: 0,
        instance: 0,
    };
}

/// A part of a [`LayerPixel`], or of a [`PixelQuality`](crate::PixelQuality), that a picture file
/// may hold, or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerKind {
    /// Both depths.
    Depth,
    /// The normal.
    Normal,
    /// The albedo.
    Albedo,
    /// The number of the shape.
    Shape,
    /// The number of the instance.
    Instance,
    /// The error that is expected of the pixel, and what it hardly exceeds.
    Error,
    /// How many samples the pixel has.
    Samples,
}

impl LayerKind {
    /// All kinds.
    pub const ALL: &[Self] = &[
        Self::Depth,
        Self::Normal,
        Self::Albedo,
        Self::Shape,
        Self::Instance,
        Self::Error,
        Self::Samples,
    ];

    /// Whether it is about what the pixel's ray meets, and not about its quality.
    #[must_use]
    pub const fn is_of_first_hit(self) -> bool {
        !matches!(self, Self::Error | Self::Samples)
    }

    /// Its name, in small letters.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Albedo => "albedo",
            Self::Shape => "shape",
            Self::Instance => "instance",
            Self::Error => "error",
            Self::Samples => "samples",
        }
    }

    /// The kind of that name, in capitals or not.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.name().eq_ignore_ascii_case(name))
    }
}

/// First hits for each pixel of a window of a frame. They are kept beside a
/// film; programs that remove noise, add fog or cut out shapes read them.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    grid: Grid<LayerPixel>,
}

impl Layers {
    /// Layers in which nothing is hit.
    ///
    /// # Errors
    /// Where `window` does not fit in `frame`, or memory does not suffice.
    pub fn new(frame: Size, window: Window) -> Result<Self, FilmError> {
        Ok(Self { grid: Grid::new(frame, window, LayerPixel::MISS)? })
    }

    /// The size of the frame that they are of a window of.
    #[must_use]
    pub const fn frame(&self) -> Size {
        self.grid.frame()
    }

    /// The window of the frame that they are of.
    #[must_use]
    pub const fn window(&self) -> Window {
        self.grid.window()
    }

    /// The window's pixels, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[LayerPixel] {
        self.grid.values()
    }

    /// The pixel at column `x` and row `y` of the frame.
    ///
    /// # Panics
    /// Where that pixel is not in the window.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> LayerPixel {
        self.grid.get(x, y)
    }

    /// The layers in strips of that width and of `ROWS` rows, as those of
    /// [`Film::strips_mut`](crate::Film::strips_mut).
    ///
    /// # Panics
    /// Where `width` or `ROWS` is 0.
    pub fn strips_mut<const ROWS: usize>(
        &mut self,
        width: u32,
    ) -> impl Iterator<Item = Strip<'_, LayerPixel, ROWS>> {
        self.grid.strips_mut(width)
    }

    /// Writes `values`, row by row, to the pixels of `tile` (in the frame's
    /// coordinates).
    ///
    /// # Panics
    /// Where `tile` reaches out of the window, or `values` has another number
    /// of pixels.
    pub fn put(&mut self, tile: Window, values: &[LayerPixel]) {
        self.grid.put(tile, values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit(number: u8) -> LayerPixel {
        LayerPixel {
            axis_depth: f32::from(number),
            ray_depth: f32::from(number) * 1.25,
            normal: [0.0, 0.6, -0.8],
            albedo: [0.5, 0.25, 1.0],
            shape: u32::from(number),
            instance: u32::MAX - u32::from(number),
        }
    }

    #[test]
    fn pixels_are_where_they_were_put() {
        let frame = Size::new(7, 5);
        let window = Window { x: 2, y: 1, width: 4, height: 3 };
        let mut layers = Layers::new(frame, window).expect("it fits");
        assert_eq!((layers.frame(), layers.window()), (frame, window));
        assert!(layers.pixels().iter().all(|pixel| *pixel == LayerPixel::MISS));
        let tile = Window { x: 3, y: 2, width: 2, height: 2 };
        layers.put(tile, &[hit(1), hit(2), hit(3), hit(4)]);
        assert_eq!(layers.pixel(3, 2), hit(1));
        assert_eq!(layers.pixel(4, 3), hit(4));
        assert_eq!(layers.pixel(2, 2), LayerPixel::MISS);
        assert_eq!(layers.pixels()[5..7], [hit(1), hit(2)]);
        assert_eq!(layers.pixels().len(), 12);
    }

    #[test]
    #[should_panic(expected = "pixel 1,1 is outside the window 2,1,4,3")]
    fn pixels_outside_are_not_there() {
        let window = Window { x: 2, y: 1, width: 4, height: 3 };
        let layers = Layers::new(Size::new(7, 5), window).expect("it fits");
        let _ = layers.pixel(1, 1);
    }

    #[test]
    fn impossible_layers_are_refused() {
        let huge = Size::new(u32::MAX, u32::MAX);
        let pixels = huge.pixels();
        let bytes = pixels.saturating_mul(40);
        assert_eq!(Layers::new(huge, huge.window()), Err(FilmError::OutOfMemory { pixels, bytes }));
        let window = Window { x: 0, y: 0, width: 3, height: 1 };
        let frame = Size::new(2, 2);
        assert_eq!(Layers::new(frame, window), Err(FilmError::WindowOutside { window, frame }));
    }

    #[test]
    fn kinds_have_names() {
        for kind in LayerKind::ALL {
            assert_eq!(LayerKind::from_name(kind.name()), Some(*kind));
            assert_eq!(LayerKind::from_name(&kind.name().to_uppercase()), Some(*kind));
        }
        let names: Vec<_> = LayerKind::ALL.iter().map(|kind| kind.name()).collect();
        assert_eq!(names, ["depth", "normal", "albedo", "shape", "instance", "error", "samples"]);
        assert_eq!(LayerKind::from_name("all"), None);
        assert_eq!(LayerKind::from_name(""), None);
    }
}
