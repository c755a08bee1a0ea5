/// Where the files come from that a scene names.
///
/// ```
/// use lancer_xml::{Files, Options};
///
/// struct Here;
///
/// impl Files for Here {
///     fn read(&self, path: &str) -> Result<Vec<u8>, String> {
///         match path {
///             "triangle.obj" => Ok(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec()),
///             _ => Err("there is no such file".to_owned()),
///         }
///     }
/// }
///
/// let text = r#"<world>
///   <camera pxwidth="4" pxheight="3" fov="50">
///     <origin x="0" y="0" z="5"/> <target x="0" y="0" z="0"/>
///   </camera>
///   <lights><sun brightness="1"><point x="0" y="0" z="-1"/></sun></lights>
///   <shapes><mesh file="triangle.obj" color="teal"/></shapes>
/// </world>"#;
/// let scene = lancer_xml::parse_with(text.as_bytes(), &Options::default(), &Here)
///     .into_result()?;
/// assert_eq!(scene.shape_count(), 1);
/// # Ok::<(), lancer_xml::InvalidFile>(())
/// ```
pub trait Files {
    /// The bytes of a file. `path` is as the scene has it; what it is relative
    /// to, and whether it may be read at all, is for whoever implements this to
    /// say.
    ///
    /// # Errors
    /// Where there are none; with the reason, as short as "no such file".
    fn read(&self, path: &str) -> Result<Vec<u8>, String>;
}

/// No files at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str) -> Result<Vec<u8>, String> {
        Err("no files are read here".to_owned())
    }
}
