use super::figure::BAND;

/// What the scenes of a soak consist of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(
    missing_docs,
    reason = "the names say it; open ones have no lids or borders that others share"
)]
pub enum Kind {
    Sphere,
    Plane,
    Disc,
    Rectangle,
    Triangle,
    Cuboid,
    Cube,
    Tetrahedron,
    Cylinder,
    OpenCylinder,
    Cone,
    OpenCone,
    Frustum,
    OpenFrustum,
    Torus,
    ClosedMesh,
    OpenMesh,
    /// Several shapes of any kinds.
    Mixed,
}

impl Kind {
    /// Those of one kind of shape.
    pub(crate) const SHAPES: [Self; 17] = [
        Self::Sphere,
        Self::Plane,
        Self::Disc,
        Self::Rectangle,
        Self::Triangle,
        Self::Cuboid,
        Self::Cube,
        Self::Tetrahedron,
        Self::Cylinder,
        Self::OpenCylinder,
        Self::Cone,
        Self::OpenCone,
        Self::Frustum,
        Self::OpenFrustum,
        Self::Torus,
        Self::ClosedMesh,
        Self::OpenMesh,
    ];

    /// All kinds.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::SHAPES.into_iter().chain([Self::Mixed])
    }

    /// What it is called in tables and ids.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Plane => "plane",
            Self::Disc => "disc",
            Self::Rectangle => "rectangle",
            Self::Triangle => "triangle",
            Self::Cuboid => "box",
            Self::Cube => "cube",
            Self::Tetrahedron => "tetrahedron",
            Self::Cylinder => "cylinder",
            Self::OpenCylinder => "open-cylinder",
            Self::Cone => "cone",
            Self::OpenCone => "open-cone",
            Self::Frustum => "frustum",
            Self::OpenFrustum => "open-frustum",
            Self::Torus => "torus",
            Self::ClosedMesh => "closed-mesh",
            Self::OpenMesh => "open-mesh",
            Self::Mixed => "mixed",
        }
    }

    /// Which other answer may be found at most, as a share of the size of the scene seen
    /// from a ray: of what has no edges but its own, eight units in the last place; elsewhere
    /// lines of a thin or flat side, and of a ring where it is nearly flat, are found or not
    /// within the whole band.
    pub(crate) const fn widest(self) -> f64 {
        match self {
            Self::OpenCylinder | Self::OpenCone | Self::OpenFrustum => BAND,
            Self::Torus | Self::ClosedMesh | Self::OpenMesh | Self::Mixed => BAND,
            _ => 8.0 * f64::EPSILON,
        }
    }

    /// The one of that name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().find(|kind| kind.name() == name)
    }
}
