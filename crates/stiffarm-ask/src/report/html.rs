//! A report as one HTML file that needs nothing else: no request leaves it, and it is read without scripts.

use std::fmt::Write as _;

use crate::answer::{Headline, Table, Tone, tone_of};

use super::{Block, Figure, Listing, Report, Section};
use crate::answer::looks_like_a_number;
use crate::markup::escaped;

/// How it looks on a screen, in the dark and on A4.
const STYLE: &str = include_str!("report.css");
/// Sorts tables and enlarges figures.
const SCRIPT: &str = include_str!("report.js");
/// The digests of both, by which a browser knows them from anything that a name could bring in; a test computes them.
const DIGESTS: [&str; 2] =
    ["sha256-tIBmDe/LPM/L/Oyt/SjNrIKCfmT94FE+PabDb3aBhOA=", "sha256-ZQEZ2qitXVnxPRZH65+YbDurHFWJfYsUtoPPrfGv60c="];
/// Tables of more columns are printed smaller.
const MANY: usize = 8;
/// Tables of more rows may be broken over pages.
const SHORT: usize = 22;

impl Report {
    /// The page as HTML text.
    pub fn html(&self) -> String {
        let (title, asked) = (escaped(&self.title), escaped(&self.asked));
        let [style, script] = DIGESTS;
        let mut page = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src '{style}'; \
             script-src '{script}'; base-uri 'none'; form-action 'none'\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
             <meta name=\"generator\" content=\"stiffarm {}\"/>\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
             <header>\n<h1>{title}</h1>\n<p class=\"asked\">{asked}</p>\n</header>\n<main>\n",
            env!("CARGO_PKG_VERSION")
        );
        verdict(&mut page, &self.headline);
        self.contents(&mut page);
        let mut figures = 0;
        for (i, one) in self.sections.iter().enumerate() {
            section(&mut page, (i, one), &mut figures);
        }
        page += "<div class=\"sign\"><span>date</span><span>computed by</span><span>checked by</span></div>\n</main>\n";
        let _ = writeln!(page, "<script>{SCRIPT}</script>\n</body>\n</html>");
        page
    }

    /// Links to every section.
    fn contents(&self, page: &mut String) {
        *page += "<nav aria-label=\"Contents\">\n<h3>Contents</h3>\n<ul>\n";
        for (i, section) in self.sections.iter().enumerate() {
            let _ = writeln!(page, "<li><a href=\"#s{i}\">{}</a></li>", escaped(&section.title));
        }
        *page += "</ul>\n</nav>\n";
    }
}

fn verdict(page: &mut String, headline: &Headline) {
    let tone = match headline.outcome.tone() {
        Tone::Good => "good",
        Tone::Bad => "bad",
        Tone::Open => "open",
        Tone::Plain => "plain",
    };
    let word = headline.outcome.word();
    let _ = writeln!(
        page,
        "<section class=\"verdict {tone}\" aria-label=\"Verdict\"><strong class=\"word\">{word}</strong>"
    );
    for sentence in &headline.sentences {
        let _ = writeln!(page, "<p>{}</p>", escaped(sentence));
    }
    *page += "</section>\n<h3>What this rests on</h3>\n<ul class=\"rests\">\n";
    for sentence in &headline.rests_on {
        let _ = writeln!(page, "<li>{}</li>", escaped(sentence));
    }
    *page += "</ul>\n";
}

fn section(page: &mut String, (i, section): (usize, &Section), figures: &mut usize) {
    let class = if section.on_new_page { " class=\"page\"" } else { "" };
    let _ = writeln!(page, "<section>\n<h2 id=\"s{i}\"{class}>{}</h2>", escaped(&section.title));
    for block in &section.blocks {
        match block {
            Block::Text(text) => drop(writeln!(page, "<p>{}</p>", escaped(text))),
            Block::Heading(text) => drop(writeln!(page, "<h3>{}</h3>", escaped(text))),
            Block::Code(text) => drop(writeln!(page, "<pre>{}</pre>", escaped(text.trim_end()))),
            Block::Notes(lines) => {
                let items: String = lines.iter().map(|line| format!("<li>{}</li>\n", escaped(line))).collect();
                let _ = writeln!(page, "<ul class=\"notes\">\n{items}</ul>");
            }
            Block::Table(listing) => table(page, listing),
            Block::Figure(one) => {
                *figures += 1;
                figure(page, one, *figures);
            }
        }
    }
    *page += "</section>\n";
}

fn table(page: &mut String, Listing { table, is_sortable }: &Listing) {
    let Table { headings, rows, .. } = table;
    let columns = headings.len();
    let is_number: Vec<bool> = (0..columns).map(|i| rows.iter().all(|row| looks_like_a_number(&row[i]))).collect();
    let names_lines = columns == 2 && headings.iter().all(String::is_empty);
    let classes = [
        is_sortable.then_some("sortable"),
        (MANY < columns).then_some("many"),
        (rows.len() <= SHORT).then_some("short"),
    ];
    let classes: Vec<&str> = classes.into_iter().flatten().collect();
    let _ = writeln!(page, "<div class=\"wide\"><table class=\"{}\">", classes.join(" "));
    if !names_lines {
        *page += "<thead><tr>";
        for (heading, is_number) in headings.iter().zip(&is_number) {
            let class = if *is_number { " class=\"number\"" } else { "" };
            let _ = write!(page, "<th scope=\"col\"{class}>{}</th>", escaped(heading));
        }
        *page += "</tr></thead>\n";
    }
    *page += "<tbody>\n";
    for row in rows {
        *page += "<tr>";
        for (i, cell) in row.iter().enumerate() {
            if names_lines && i == 0 {
                let _ = write!(page, "<th scope=\"row\">{}</th>", escaped(cell));
                continue;
            }
            let _ = write!(page, "<td{}>{}</td>", classes_of(cell, is_number[i] && !names_lines), escaped(cell));
        }
        *page += "</tr>\n";
    }
    *page += "</tbody></table></div>\n";
}

/// How a cell looks: numbers stand to the right, verdicts have their colour.
fn classes_of(cell: &str, is_number: bool) -> String {
    let verdict = tone_of(cell).map(|tone| match tone {
        Tone::Good => "pass",
        Tone::Bad => "fail",
        Tone::Open | Tone::Plain => "unsure",
    });
    let classes: Vec<&str> = is_number.then_some("number").into_iter().chain(verdict).collect();
    if classes.is_empty() { String::new() } else { format!(" class=\"{}\"", classes.join(" ")) }
}

/// A picture as a part of the page, so that its texts are found and its marks tell their values.
fn figure(page: &mut String, Figure { svg, caption }: &Figure, number: usize) {
    // Clip paths are numbered in each figure anew.
    let svg = svg
        .replace("id=\"clip", &format!("id=\"f{number}clip"))
        .replace("\"url(#clip", &format!("\"url(#f{number}clip"));
    let caption = escaped(caption);
    let label = format!("<svg role=\"img\" aria-label=\"{caption}\" ");
    let svg = svg.replacen("<svg ", &label, 1);
    let _ = writeln!(
        page,
        "<figure><div class=\"plate\">{svg}</div><figcaption><span>Figure {number}. {caption}</span></figcaption></figure>"
    );
}
