//! What the usual engine shows, against closed forms, series and symmetries,
//! through the interface that programs use.
//!
//! No number that is expected here is worked out by the engine's own code. Most
//! pictures have one pixel, so that what is computed is one line of formula.

mod absorption;
mod balls;
mod camera;
mod closed;
mod contact;
mod everything;
mod exposure;
mod glass;
mod help;
mod lens;
mod light;
mod mirrors;
mod overlaps;
mod paths;
mod rooms;
mod samples;
mod shadows;
mod sheets;
mod smooth;
mod spots;
mod symmetry;
mod troubles;
