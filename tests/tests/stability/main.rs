//! Where ray tracing methods fail numerically, and that ours does not: one
//! named test for each known failure, with the right answer from a closed form,
//! from exact arithmetic or from a symmetry. Names begin with the group and the
//! number of the failure.

mod asked;
mod deferred;
mod directions;
mod doubtful;
mod films;
mod hierarchy;
mod leaving;
mod original_shapes;
mod ray_box;
mod ray_plane;
mod ray_sphere;
mod round;
mod torus;
mod triangle;

// Whole pictures.
mod averages;
mod camera;
mod media;
mod mirrors;
mod optics;
mod original_pictures;
mod output;
mod pictures;
mod range;
mod repeatable;
mod seen;
mod shadows;
mod textures;
