//! "Did you mean": the nearest known name.

/// Longer names are neither compared nor suggested.
const LONGEST: usize = 40;

/// The name most like `found`, where one is like enough to be what was meant.
pub(crate) fn nearest<'a>(
    found: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    // Long rubbish is like nothing, and comparing takes the product of lengths.
    if found.chars().count() > LONGEST {
        return None;
    }
    let folded = found.trim().to_lowercase();
    let length = folded.chars().count();
    names
        .into_iter()
        .filter_map(|name| {
            if name.len() > LONGEST {
                return None;
            }
            let most = name.len().max(length) / 3;
            // Abbreviations and longer forms ("col", "colour") are often farther.
            let prefix = folded.len() >= 3
                && name.len() >= 3
                && (name.starts_with(&folded) || folded.starts_with(name));
            let distance = match prefix {
                true => usize::from(folded != name),
                // Names that differ so much in length need no comparing.
                false if name.chars().count().abs_diff(length) > most => return None,
                false => strsim::damerau_levenshtein(&folded, name),
            };
            (distance <= most).then_some((distance, name))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// A help line for a name that is not known: the nearest one, or all there are.
pub(crate) fn help<'a>(
    found: &str,
    names: impl IntoIterator<Item = &'a str> + Clone,
    what: &str,
) -> Option<String> {
    if let Some(name) = nearest(found, names.clone()) {
        return Some(format!("did you mean `{name}`?"));
    }
    let all: Vec<_> = names.into_iter().map(|name| format!("`{name}`")).collect();
    (!all.is_empty()).then(|| format!("{what}: {}", all.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLOURS: [&str; 5] = ["red", "green", "grey", "dark green", "white"];

    #[test]
    fn slips_are_recognised_and_rubbish_is_not() {
        for (found, expected) in [
            ("gray", Some("grey")),
            ("Red", Some("red")),
            (" red ", Some("red")),
            ("darkgreen", Some("dark green")),
            ("whiet", Some("white")),
            ("mauve", None),
            ("\u{6a59}\u{8272}\u{6a59}\u{8272}", None),
            ("", None),
        ] {
            assert_eq!(nearest(found, COLOURS), expected, "{found:?}");
        }
        assert_eq!(nearest(&"red".repeat(100_000), COLOURS), None);
    }
}
