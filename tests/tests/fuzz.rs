//! No file, however malformed, makes the check panic or its report unprintable.

use fastrand::Rng;
use lancer_tests::paths::{files_with_extension, scenes};
use lancer_xml::{Options, Severity};
use std::time::Instant;

const CASES: u64 = 20_000;

/// Pieces that a mutation may insert.
const PIECES: &[&str] = &[
    "<",
    ">",
    "/>",
    "</",
    "\"",
    "'",
    "&",
    "&lt;",
    "&#0;",
    "&#x1F600;",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?x?>",
    "<!DOCTYPE a>",
    "<sphere>",
    "</sphere>",
    "<point x=\"1\"",
    "xmlns:a=\"b\"",
    "a:b",
    "x=\"1\"",
    "gloss=\"",
    "1e999",
    "-1e-999",
    "nan",
    "\u{1f600}",
    "\u{2212}",
    "\u{feff}",
    "\t",
    "\r\n",
    "\n",
    "\0",
    "\u{1b}[31m",
    "\u{85}",
    "\u{202e}",
    "e\u{301}",
    "=",
    " ",
    "99999999999",
];

fn mutate(rng: &mut Rng, bytes: &mut Vec<u8>) {
    let place = |rng: &mut Rng, bytes: &[u8]| rng.usize(0..=bytes.len());
    match rng.u8(0..8) {
        0 => {
            let at = place(rng, bytes);
            let piece = PIECES[rng.usize(0..PIECES.len())];
            bytes.splice(at..at, piece.bytes());
        }
        1 => {
            let (a, b) = (place(rng, bytes), place(rng, bytes));
            let end = a.max(b).min(a.min(b) + 40);
            bytes.drain(a.min(b)..end);
        }
        2 => bytes.truncate(place(rng, bytes)),
        3 if !bytes.is_empty() => {
            let at = rng.usize(0..bytes.len());
            bytes[at] = rng.u8(..);
        }
        4 if !bytes.is_empty() => {
            let at = rng.usize(0..bytes.len());
            bytes[at] ^= 1 << rng.u8(0..8);
        }
        5 => {
            // A piece of the file again somewhere else.
            let (a, b) = (place(rng, bytes), place(rng, bytes));
            let piece = bytes[a.min(b)..a.max(b).min(a.min(b) + 200)].to_vec();
            let at = place(rng, bytes);
            bytes.splice(at..at, piece);
        }
        6 => {
            // Another digit, letter or mark in the place of one.
            let marks: Vec<usize> =
                (0..bytes.len()).filter(|&i| bytes[i].is_ascii_graphic()).collect();
            if !marks.is_empty() {
                bytes[marks[rng.usize(0..marks.len())]] = rng.u8(b'!'..=b'~');
            }
        }
        _ => {
            let at = place(rng, bytes);
            let run = rng.usize(1..600);
            bytes.splice(at..at, std::iter::repeat_n(rng.u8(b' '..=b'~'), run));
        }
    }
}

/// The bytes of a case, from nothing but its number.
fn case(seeds: &[Vec<u8>], number: u64) -> Vec<u8> {
    let mut rng = Rng::with_seed(number);
    let mut bytes = seeds[rng.usize(0..seeds.len())].clone();
    if rng.u8(0..4) == 0 {
        // Gently: what the XML parser does not mind.
        let digits: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit()).collect();
        for _ in 0..rng.usize(1..4) {
            if !digits.is_empty() {
                bytes[digits[rng.usize(0..digits.len())]] = b"0123456789-.e+ "[rng.usize(0..15)];
            }
        }
        return bytes;
    }
    for _ in 0..rng.usize(1..8) {
        mutate(&mut rng, &mut bytes);
    }
    bytes
}

#[test]
fn mutated_scenes_never_panic() {
    let valid = files_with_extension(&scenes(), "xml");
    let invalid = files_with_extension(&scenes().join("invalid"), "xml");
    let seeds: Vec<_> = valid
        .iter()
        // The valid ones more often, for mutations that get past the XML parser.
        .flat_map(|path| std::iter::repeat_n(path, 20))
        .chain(&invalid)
        .map(|path| std::fs::read(path).expect("the file is there"))
        .collect();
    let mut still_valid = 0;
    let mut mistakes = 0;
    for number in 0..CASES {
        let bytes = case(&seeds, number);
        let result = std::panic::catch_unwind(|| {
            let parsed = lancer_xml::parse(&bytes, &Options::default());
            let report = lancer::report::to_text("mutated.xml", &parsed);
            (parsed, report)
        });
        let Ok((parsed, report)) = result else {
            panic!("case {number} panics: {}", String::from_utf8_lossy(&bytes));
        };
        let errors = parsed.diagnostics.iter().any(|d| d.severity == Severity::Error);
        assert_eq!(errors, parsed.scene.is_none(), "case {number}");
        for diagnostic in &parsed.diagnostics {
            let span = &diagnostic.span;
            assert!(span.start <= span.end && span.end <= parsed.source.text().len(), "{number}");
            assert!(report.len() > diagnostic.message.len(), "case {number}");
        }
        assert!(
            !report.chars().any(|c| c.is_control() && !"\n\t\r".contains(c)),
            "case {number} prints control characters: {report:?}"
        );
        still_valid += usize::from(parsed.scene.is_some());
        mistakes += parsed.diagnostics.len();
    }
    // The mutations are neither all harmless nor all stopped by the XML parser.
    assert!(still_valid > CASES as usize / 100, "{still_valid} of {CASES} were still valid");
    assert!(mistakes > CASES as usize, "{mistakes} mistakes in {CASES} files");
}

#[test]
fn large_and_hostile_files_are_answered_soon() {
    let begin = "<world><camera pxwidth=\"4\" pxheight=\"3\" width=\"1\"><origin x=\"0\" y=\"0\" \
                 z=\"0\"/><target x=\"1\" y=\"0\" z=\"0\"/></camera><lights/><shapes>";
    let files = [
        // A million levels deep.
        "<a>".repeat(1_000_000),
        // A line of many mistakes, in characters of several bytes.
        format!("{begin}{}</shapes></world>", "<sphere/><!-- \u{2212} -->".repeat(20_000)),
        // Unknown elements, one to a line.
        format!("{begin}{}</shapes></world>", "<a/>\n".repeat(200_000)),
        // The same attribute again and again, and unknown entities.
        format!("{begin}<sphere {}/></shapes></world>", "a=\"\" ".repeat(900)),
        format!("{begin}<sphere color=\"{}\"/></shapes></world>", "&a;".repeat(1_000_000)),
        // Fifty thousand attributes of one element.
        format!(
            "{begin}<sphere {}/></shapes></world>",
            (0..50_000).map(|i| format!("a{i}=\"\" ")).collect::<String>()
        ),
        // A long text, a long name, a long value.
        format!("{begin}{}</shapes></world>", "x".repeat(10_000_000)),
        format!("<{}>", "x".repeat(10_000_000)),
        format!("{begin}<sphere color=\"{}\"/></shapes></world>", "red ".repeat(2_000_000)),
        format!("{begin}<sphere size=\"{}\"/></shapes></world>", "1".repeat(5_000_000)),
        "&".repeat(1_000_000),
        "\n".repeat(5_000_000),
    ];
    for (number, file) in files.iter().enumerate() {
        let begun = Instant::now();
        let mut parsed = lancer_xml::parse(file.as_bytes(), &Options::default());
        assert!(parsed.scene.is_none(), "file {number} is no scene");
        for diagnostic in &parsed.diagnostics {
            assert!(diagnostic.message.len() < 300, "file {number}: a message of any length");
        }
        // As many as the program shows.
        parsed.diagnostics.truncate(1000);
        let report = lancer::report::to_text("hostile.xml", &parsed);
        let bytes = report.len();
        assert!(bytes < 2_000_000, "file {number}: {bytes} bytes of report");
        // Seconds even here; what grows with the square of the size takes minutes.
        let seconds = begun.elapsed().as_secs();
        assert!(seconds < 20, "file {number} took {seconds} s");
    }
}
