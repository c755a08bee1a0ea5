//! The sections of pages in docs that commands write: what stands between the lines
//! `<!-- generated: NAME -->` and `<!-- end -->`.

use crate::{Failure, fail};
use lancer_tests::paths;
use std::fs;
use std::io::ErrorKind;

/// Replaces a section of a page in docs, or adds it where there is none of that name.
pub(crate) fn write(page: &str, name: &str, text: &str) -> Result<(), Failure> {
    let path = paths::top().join("docs").join(page);
    let old = match fs::read_to_string(&path) {
        Err(e) if e.kind() == ErrorKind::NotFound => String::new(),
        read => read.map_err(fail)?,
    };
    fs::write(&path, with(&old, name, text)).map_err(fail)?;
    println!("wrote the section `{name}` of docs/{page}");
    Ok(())
}

/// Prints a section, and writes it into a page in docs if that is asked for.
pub(crate) fn show(text: &str, (page, name): (&str, &str), is_kept: bool) -> Result<(), Failure> {
    println!("{text}");
    if is_kept { write(page, name, text) } else { Ok(()) }
}

fn with(page: &str, name: &str, text: &str) -> String {
    const END: &str = "<!-- end -->";
    let begin = format!("<!-- generated: {name} -->\n");
    let section = format!("{begin}{}\n{END}", text.trim_end());
    let parts = page.split_once(&begin).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(END)?;
        Some(format!("{before}{section}{after}"))
    });
    parts.unwrap_or_else(|| format!("{}\n\n{section}\n", page.trim_end()))
}

#[cfg(test)]
mod tests {
    use super::with;

    #[test]
    fn a_section_is_replaced_or_added() {
        let page = with("# Page\n", "one", "a\n");
        assert_eq!(page, "# Page\n\n<!-- generated: one -->\na\n<!-- end -->\n");
        let page = with(&page, "two", "b");
        let page = with(&format!("{page}\nlast\n"), "one", "c");
        let two = "<!-- generated: two -->\nb\n<!-- end -->\n";
        assert_eq!(
            page,
            format!("# Page\n\n<!-- generated: one -->\nc\n<!-- end -->\n\n{two}\nlast\n")
        );
    }
}
