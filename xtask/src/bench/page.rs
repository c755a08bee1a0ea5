//! What a part of the measurements has to say: text and tables, on the
//! terminal and as a section of docs/performance.md.

use crate::{Failure, fail};
use lancer_tests::paths;
use std::fmt;
use std::fs;
use std::path::PathBuf;

/// Rows of cells under a head.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new(head: &[&str]) -> Self {
        Self { rows: vec![head.iter().map(ToString::to_string).collect()] }
    }

    /// Adds a row with as many cells as the head has.
    pub(crate) fn row(&mut self, cells: Vec<String>) {
        assert_eq!(cells.len(), self.rows[0].len(), "a cell for each column");
        self.rows.push(cells);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.rows[0].len();
        let width = |column: usize| {
            self.rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0).max(3)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for (i, row) in self.rows.iter().enumerate() {
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                match column {
                    0 => write!(f, "| {cell:<width$} |")?,
                    _ => write!(f, " {cell:>width$} |")?,
                }
            }
            writeln!(f)?;
            if i == 0 {
                for (column, width) in widths.iter().enumerate() {
                    match column {
                        0 => write!(f, "|{}|", "-".repeat(width + 2))?,
                        _ => write!(f, "{}:|", "-".repeat(width + 1))?,
                    }
                }
                writeln!(f)?;
            }
        }
        Ok(())
    }
}

/// A section of the page.
#[derive(Debug, Clone)]
pub(crate) struct Section {
    title: &'static str,
    body: String,
}

impl Section {
    /// An empty section; `title` tells it from others.
    pub(crate) fn new(title: &'static str) -> Self {
        println!("## {title}\n");
        Self { title, body: String::new() }
    }

    /// Adds a paragraph or a table.
    pub(crate) fn add(&mut self, what: impl fmt::Display) {
        let text = what.to_string();
        println!("{}\n", text.trim_end());
        self.body.push_str(text.trim_end());
        self.body.push_str("\n\n");
    }
}

/// Titles in the order of the page.
pub(crate) const TITLES: &[&str] = &[
    super::pictures::TITLE,
    super::culling::TITLE,
    super::scaling::TITLE,
    super::triangles::TITLE,
    super::peers::TITLE,
];

const HEAD: &str = "\
# Performance

Written by `cargo run --release -p xtask -- bench --write`; each section names the command that made it, the machine and the day.
Times are medians over runs that were made in turn, so that what else the machine did slowed all of them alike; ratios are medians of the
ratios run by run.

";

/// Puts the sections into docs/performance.md in place of those with the same
/// titles.
pub(crate) fn write(sections: &[Section]) -> Result<(), Failure> {
    let path = path();
    let old = fs::read_to_string(&path).unwrap_or_default();
    fs::write(&path, replaced(&old, sections)).map_err(fail)
}

fn path() -> PathBuf {
    paths::top().join("docs/performance.md")
}

fn replaced(old: &str, sections: &[Section]) -> String {
    let mut page = HEAD.to_owned();
    for title in TITLES {
        let new = sections.iter().find(|section| section.title == *title);
        let heading = format!("## {title}\n\n");
        let body = match new {
            Some(section) => section.body.as_str(),
            None => match old.split_once(heading.as_str()) {
                Some((_, rest)) => rest.split("\n## ").next().unwrap_or_default(),
                None => continue,
            },
        };
        page.push_str(&heading);
        page.push_str(body.trim_end());
        page.push_str("\n\n");
    }
    page.truncate(page.trim_end().len());
    page.push('\n');
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(title: &'static str, body: &str) -> Section {
        Section { title, body: body.to_owned() }
    }

    #[test]
    fn tables_are_aligned() {
        let mut table = Table::new(&["engine", "ms"]);
        table.row(vec!["a".to_owned(), "12.5".to_owned()]);
        assert_eq!(table.to_string(), "| engine |   ms |\n|--------|-----:|\n| a      | 12.5 |\n");
    }

    #[test]
    fn sections_that_were_not_made_anew_are_kept() {
        let both = replaced("", &[section(TITLES[1], "old 1"), section(TITLES[0], "old 0")]);
        let page = replaced(&both, &[section(TITLES[1], "new 1\n\n")]);
        assert_eq!(page, replaced("", &[section(TITLES[0], "old 0"), section(TITLES[1], "new 1")]));
        assert!(page.ends_with("new 1\n"));
    }
}
