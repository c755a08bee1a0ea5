//! The rays that an engine follows for one pixel, as plain data.

use crate::Rgb;

/// All rays of a pixel and what they bring it.
///
/// The contributions of all of them ([`TracedRay::background`], [`MetSurface::glow`] and
/// [`LightAnswer::contribution`]) add up to [`radiance`](Self::radiance), but for rounding to
/// single precision, and unless colours are no finite numbers, where it is black.
///
/// ```
/// use lancer_integrator::{KernelSettings, RayKind, Whitted};
/// use lancer_scene::{Camera, Colour, Light, Scene, Shape, Surface};
///
/// let scene = Scene::builder()
///     .camera(Camera::new([0.0, -4.0, 0.0], [0.0, -3.0, 0.0], 1.0, [32, 24]))
///     .light(Light::sun([0.0, 1.0, 0.0], 1.0))
///     .shape(Shape::sphere([0.0; 3], 1.0, Surface::new(Colour::RED).gloss(0.5)?))
///     .build()?;
/// let tree = Whitted::new().explain_pixel(&scene, &KernelSettings::default(), (16, 12));
/// let [primary, reflected] = &tree.rays[..] else { panic!("a mirror sends one back") };
/// assert_eq!(primary.surfaces[0].shape.kind, "sphere");
/// assert_eq!((reflected.kind, reflected.share), (RayKind::Reflected, [0.5; 3]));
/// assert_eq!(reflected.background, Some([0.0; 3]), "it is dark there");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RayTree {
    /// Column and row of the pixel, from 0; row 0 is at the top.
    pub pixel: [u32; 2],
    /// What the pixel is: red, green and blue in linear light.
    pub radiance: Rgb,
    /// All rays. The first is the primary one; each comes after the one that it leaves from.
    pub rays: Vec<TracedRay>,
}

impl RayTree {
    /// The sum of all contributions.
    #[must_use]
    pub fn sum(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for part in self.rays.iter().map(TracedRay::contribution) {
            (0..3).for_each(|i| sum[i] += part[i]);
        }
        sum
    }
}

/// A ray that was followed, or why it was not.
#[derive(Debug, Clone, PartialEq)]
pub struct TracedRay {
    /// The ray that it leaves from: its place in [`RayTree::rays`]; none of the primary one.
    pub parent: Option<usize>,
    /// The rays that leave from what it met: their places, in the order in which they left.
    pub children: Vec<usize>,
    /// What it comes from.
    pub kind: RayKind,
    /// What became of it.
    pub fate: RayFate,
    /// How many places rays met something at before.
    pub depth: u32,
    /// Where it starts.
    pub origin: [f64; 3],
    /// Where it goes; of length 1.
    pub direction: [f64; 3],
    /// The share that what it sees has in the pixel, from 0 to 1 in each component.
    pub share: [f64; 3],
    /// What of the share is left where it ends, after what the medium takes away; as
    /// [`share`](Self::share) where it was not followed.
    pub left: [f64; 3],
    /// The medium that it is in.
    pub medium: InMedium,
    /// How far it goes until it meets something, above 0; none where it was not followed, or sees
    /// the background.
    pub distance: Option<f64>,
    /// The surfaces that it met there, in the order in which they count. It is mostly one: several
    /// where they lie so near together that no double tells them apart; none where it only
    /// touched something, or crossed what lies inside of a medium.
    pub surfaces: Vec<MetSurface>,
    /// What the background adds to the pixel; none where the ray met something.
    pub background: Option<[f64; 3]>,
}

impl TracedRay {
    /// The share of the component that it matters most for.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.share[0].max(self.share[1]).max(self.share[2])
    }

    /// Where it ends; none where it was not followed, or sees the background.
    #[must_use]
    pub fn end(&self) -> Option<[f64; 3]> {
        let distance = self.distance?;
        Some([0, 1, 2].map(|i| self.origin[i] + distance * self.direction[i]))
    }

    /// What it alone adds to the pixel, without the rays that leave from it.
    #[must_use]
    pub fn contribution(&self) -> [f64; 3] {
        let mut sum = self.background.unwrap_or_default();
        for surface in &self.surfaces {
            let lights = surface.lights.iter().map(|light| light.contribution);
            for part in lights.chain([surface.glow]) {
                (0..3).for_each(|i| sum[i] += part[i]);
            }
        }
        sum
    }
}

/// What a ray comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RayKind {
    /// The eye.
    Primary,
    /// A mirror, or what of a clear surface mirrors.
    Reflected,
    /// A clear surface that it went through.
    Transmitted,
}

impl RayKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Primary, Self::Reflected, Self::Transmitted];

    /// In a word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Reflected => "reflected",
            Self::Transmitted => "transmitted",
        }
    }
}

/// What became of a ray.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RayFate {
    /// It was followed.
    Followed,
    /// It was not, since the shares of all such rays together are no more than the cutoff.
    CutOff,
    /// It was not, although it matters: there were too many surfaces before it, or too many rays.
    GivenUp,
    /// Its share is no finite number, so that the pixel is black.
    NotFinite,
}

impl RayFate {
    /// In a few words.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Followed => "followed",
            Self::CutOff => "cut off",
            Self::GivenUp => "given up",
            Self::NotFinite => "not finite",
        }
    }
}

/// Which shape of the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedShape {
    /// Its number in the description, from 1, as layers of pictures have it: first the shapes
    /// that stand by themselves, then those of groups, each where its group stands first.
    pub number: u32,
    /// Its number among all shapes that are shown, from 1: those of groups count wherever the
    /// group stands.
    pub item: u32,
    /// What kind of shape it is, as the scene language calls it.
    pub kind: String,
}

/// A medium that a ray is in.
#[derive(Debug, Clone, PartialEq)]
pub struct InMedium {
    /// The shape that is filled with it; none for the air.
    pub shape: Option<NamedShape>,
    /// Its index of refraction, above 0; 1 for the air.
    pub ior: f64,
}

/// A surface that a ray met.
#[derive(Debug, Clone, PartialEq)]
pub struct MetSurface {
    /// Whose it is.
    pub shape: NamedShape,
    /// Where.
    pub point: [f64; 3],
    /// The normal that it is shaded with, of length 1, on the side from which the ray comes.
    pub normal: [f64; 3],
    /// Whether the ray comes from the side that the shape's own normal points away from.
    pub from_behind: bool,
    /// The shares of red, green and blue light that its matte part throws back here.
    pub albedo: [f64; 3],
    /// Column and row of the cell of its checker; none where it has no checker.
    pub cell: Option<[f64; 2]>,
    /// What its emission adds to the pixel.
    pub glow: [f64; 3],
    /// What each light gives there, in the order of the file; none of them where nothing of the
    /// pixel is matte there.
    pub lights: Vec<LightAnswer>,
}

/// What a light gives to a place on a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct LightAnswer {
    /// Which light, from 1 in the order of the file.
    pub light: usize,
    /// What becomes of its light.
    pub fate: LightFate,
    /// What it adds to the pixel.
    pub contribution: [f64; 3],
    /// The ray that looked for what hides it; none where there was no need.
    pub shadow: Option<ShadowRay>,
}

/// What becomes of a light's light on the way to a surface.
#[derive(Debug, Clone, PartialEq)]
pub enum LightFate {
    /// It arrives: these shares of it, after what clear things take away.
    Arrives([f64; 3]),
    /// It is hidden by this shape, the nearest of those that are in the way.
    Hidden(NamedShape),
    /// Media on the way take it all away.
    Absorbed,
    /// It is behind the surface.
    Behind,
    /// Nothing shines this way: its beam points elsewhere, or it is dark.
    Elsewhere,
}

impl LightFate {
    /// In a word.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Arrives(_) => "arrives",
            Self::Hidden(_) => "hidden",
            Self::Absorbed => "absorbed",
            Self::Behind => "behind",
            Self::Elsewhere => "elsewhere",
        }
    }
}

/// A ray from a surface to a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadowRay {
    /// Where it starts.
    pub origin: [f64; 3],
    /// Where it goes; of length 1.
    pub direction: [f64; 3],
    /// How far it goes, above 0: to the light, or to what hides it; none to a sun.
    pub length: Option<f64>,
}
