//! One page that shows which goldens failed and how.

use crate::golden::Verdict;
use std::fmt::Write;

/// A page with a row of pictures for each golden that is not the same. The
/// pictures lie beside it, as `Golden::leave_evidence` puts them.
#[must_use]
pub fn report<'a>(results: impl IntoIterator<Item = (&'a str, &'a Verdict)>) -> String {
    let mut page = String::from(
        "<!DOCTYPE html><meta charset=\"utf-8\"><title>Goldens</title>\n\
         <style>body{font:16px sans-serif;margin:2em;background:#eee}figure{display:inline-block;\
         margin:0 1em 1em 0}img{max-width:30vw;image-rendering:pixelated}</style>\n\
         <h1>Golden pictures that are not what they should be</h1>\n",
    );
    for (name, verdict) in results {
        let what = match verdict {
            Verdict::Same => continue,
            Verdict::Unusable(reason) => format!("The golden cannot be used: {reason}."),
            Verdict::Differs(c) => format!(
                "{} of {} pixels differ, by at most {} levels of 255 (first at {:?}); RMSE {:.4}, \
                 mean {:+.4}.",
                c.differing,
                c.pixels,
                c.largest,
                c.largest_at.unwrap_or_default(),
                c.rmse,
                c.mean_signed
            ),
        };
        let _ = writeln!(page, "<h2>{}</h2><p>{}</p>", escape(name), escape(&what));
        for kind in ["expected", "actual", "difference"] {
            let source = escape(&format!("{name}.{kind}.png"));
            let _ = writeln!(
                page,
                "<figure><img src=\"{source}\" alt=\"none\"><figcaption>{kind}</figcaption></figure>"
            );
        }
    }
    page
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_failures_are_shown() {
        let bad = Verdict::Unusable("<gone>".to_owned());
        let page = report([("a.classic", &Verdict::Same), ("b.direct", &bad)]);
        assert!(!page.contains("a.classic"));
        assert!(page.contains("<h2>b.direct</h2>") && page.contains("&lt;gone>"));
        assert!(page.contains("b.direct.difference.png"));
    }
}
