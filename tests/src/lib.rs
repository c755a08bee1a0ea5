//! What the tests of the whole program share.
#![forbid(unsafe_code)]

pub mod plain;
