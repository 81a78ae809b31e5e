//! Pages as plain text, for a terminal.

use super::{Column, Item, NAME, NUMBER, Page, Row, Table};
use std::fmt::Write as _;

/// Columns of a terminal that are used; only names and words of files that cannot be broken go beyond.
const WIDTH: usize = 100;
/// Widest column of words: a longer one pushes only its own row aside.
const WIDEST: usize = 40;
/// Blanks before the lines below a remark.
const BELOW: usize = 4;

// Writing to a String cannot fail.
impl Page {
    /// The page as plain text. The same page gives the same bytes.
    pub(in crate::report) fn plain(&self) -> String {
        let mut text = format!("{}\n{}\n", self.title, self.lead.join("\n"));
        if let Some(verdict) = &self.verdict {
            let _ = writeln!(text, "\n{verdict}");
        }
        for section in &self.sections {
            let _ = writeln!(text, "\n{}", section.title);
            for item in &section.items {
                add(&mut text, item);
            }
        }
        text
    }
}

fn add(text: &mut String, item: &Item) {
    match item {
        Item::Words { name, words } => {
            // Names longer than their column push the words away.
            let indent = NAME + 2;
            wrap(text, &format!("  {name:NAME$}{}", words.trim_start()), indent);
        }
        Item::Figure { name, number, unit } => {
            let gap = if unit == "°" || unit.is_empty() { "" } else { " " };
            let _ = writeln!(text, "  {name:NAME$}{number:>NUMBER$}{gap}{unit}");
        }
        Item::Table(table) => self::table(text, table),
        Item::Remark { words, below } => {
            wrap(text, &format!("  {words}"), BELOW);
            below.iter().for_each(|line| wrap(text, &format!("{:BELOW$}{line}", ""), BELOW));
        }
    }
}

/// Adds a line, broken between words where it is too long; what follows the break is indented.
fn wrap(text: &mut String, line: &str, indent: usize) {
    let mut width = 0;
    let mut rest = line.trim_end();
    while rest.chars().count() + width > WIDTH {
        // The last blank that leaves something before it, and fits; else the next there is.
        let end = rest.char_indices().nth(WIDTH - width + 1).map_or(rest.len(), |(at, _)| at);
        let start = rest.len() - rest.trim_start().len();
        // The name of words ends with blanks: what stands before them is never alone on a line.
        let start = if width == 0 { rest.char_indices().nth(indent).map_or(rest.len(), |(at, _)| at).max(start) } else { start };
        let fits = rest.get(start..end).and_then(|part| part.rfind(' ')).map(|at| start + at);
        let Some(at) = fits.or_else(|| rest.get(start..).and_then(|part| part.find(' ')).map(|at| start + at)) else { break };
        let _ = writeln!(text, "{:width$}{}", "", rest[..at].trim_end());
        rest = rest[at..].trim_start();
        width = indent;
    }
    let _ = writeln!(text, "{:width$}{rest}", "");
}

/// A table. One that is too wide is continued below, with its first columns again.
fn table(text: &mut String, table: &Table) {
    let columns = || table.groups.iter().flat_map(|group| &group.columns);
    let mut widths: Vec<usize> = columns().map(|column| column.least.max(column.name.chars().count())).collect();
    for row in &table.rows {
        let (Row::Cells(cells) | Row::Labelled(_, cells)) = row else { continue };
        for (width, cell) in widths.iter_mut().zip(cells) {
            *width = (*width).max(cell.chars().count());
        }
    }
    for (width, _) in widths.iter_mut().zip(columns()).filter(|(_, column)| column.left) {
        *width = (*width).min(WIDEST);
    }
    // First column of each group, and the end.
    let mut firsts = vec![0];
    for group in &table.groups {
        firsts.push(firsts[firsts.len() - 1] + group.columns.len());
    }
    for (i, group) in table.groups.iter().enumerate() {
        // A title that is wider than its columns widens the first.
        let width = across(&widths[firsts[i]..firsts[i + 1]]);
        if let Some(first) = widths.get_mut(firsts[i]) {
            *first += group.title.chars().count().saturating_sub(width);
        }
    }
    let of = |i: usize| across(&widths[firsts[i]..firsts[i + 1]]) + 2;
    let mut begin = 1;
    loop {
        // The groups of this part: the first, and as many as fit, but one.
        let mut end = (begin + 1).min(table.groups.len());
        let mut sum = of(0) + (begin..end).map(of).sum::<usize>();
        while end < table.groups.len() && sum + of(end) <= WIDTH {
            sum += of(end);
            end += 1;
        }
        let parts: Vec<usize> = std::iter::once(0).chain(begin..end).collect();
        part(text, table, &parts, &firsts, &widths);
        if end >= table.groups.len() {
            break;
        }
        text.push('\n');
        begin = end;
    }
}

/// Width of columns with the gaps between them.
fn across(widths: &[usize]) -> usize {
    widths.iter().sum::<usize>() + 2 * widths.len().saturating_sub(1)
}

/// Some groups of a table.
fn part(text: &mut String, table: &Table, groups: &[usize], firsts: &[usize], widths: &[usize]) {
    let columns: Vec<&Column> = table.groups.iter().flat_map(|group| &group.columns).collect();
    let chosen: Vec<usize> = groups.iter().flat_map(|&g| firsts[g]..firsts[g + 1]).collect();
    if groups.iter().any(|&g| !table.groups[g].title.is_empty()) {
        let titles =
            groups.iter().map(|&g| format!("  {:>1$}", table.groups[g].title, across(&widths[firsts[g]..firsts[g + 1]])));
        let _ = writeln!(text, "{}", titles.collect::<String>().trim_end());
    }
    let line = |cell: &dyn Fn(usize) -> String| {
        let cells = chosen.iter().map(|&c| {
            let (cell, width) = (cell(c), widths[c]);
            if columns[c].left { format!("  {cell:width$}") } else { format!("  {cell:>width$}") }
        });
        cells.collect::<String>().trim_end().to_owned()
    };
    let of = |cells: &[String]| line(&|c| cells.get(c).cloned().unwrap_or_default());
    let _ = writeln!(text, "{}", line(&|c| columns[c].name.to_owned()));
    for row in &table.rows {
        let _ = match row {
            Row::Cells(cells) => writeln!(text, "{}", of(cells)),
            Row::Labelled(label, cells) => {
                let width = across(&widths[..firsts[1]]);
                let cells = of(cells);
                writeln!(text, "{}", format!("  {label:width$}{}", cells.get(width + 2..).unwrap_or_default()).trim_end())
            }
            Row::Heading(words) => writeln!(text, "  {words}"),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::page::Group;

    #[test]
    fn long_lines_are_broken_between_words() {
        let item = |words: &str| {
            let mut text = String::new();
            add(&mut text, &Item::Words { name: "name".into(), words: words.into() });
            text
        };
        // 78 columns are left for words.
        let fits = format!("{} {}", "a".repeat(40), "b".repeat(37));
        assert_eq!(item(&fits), format!("  name                {fits}\n"));
        let long = format!("{} {}", "a".repeat(40), "b".repeat(38));
        let blank = " ".repeat(22);
        assert_eq!(item(&long), format!("  name                {}\n{blank}{}\n", "a".repeat(40), "b".repeat(38)));
        // What cannot be broken stays whole.
        let path = "p".repeat(150);
        assert_eq!(item(&format!("{path} (obj)")), format!("  name                {path}\n{blank}(obj)\n"));
        assert_eq!(item(&path), format!("  name                {path}\n"));
        let many = "word ".repeat(100);
        assert!(item(&many).lines().all(|l| l.chars().count() <= WIDTH) && item(&many).matches("word").count() == 100);
    }

    #[test]
    fn a_long_name_does_not_widen_the_other_rows() {
        let columns = vec![Column::words("name"), Column::numbers("count", 6)];
        let rows = ["a".to_owned(), "b".repeat(5000)].map(|name| Row::Cells(vec![name, "7".to_owned()]));
        let mut text = String::new();
        table(&mut text, &Table { groups: vec![Group { title: "", columns }], rows: rows.into() });
        let widths: Vec<usize> = text.lines().map(str::len).collect();
        assert_eq!(widths, [50, 50, 5010], "{text}");
    }

    #[test]
    fn wide_tables_are_continued() {
        let groups = vec![
            Group::numbers("", &["from"], 6),
            Group::numbers("exact", &["cut", "fill"], 40),
            Group::numbers("other", &["cut", "fill"], 40),
        ];
        let row = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect();
        let rows = vec![Row::Cells(row(&["0", "1", "2", "3", "4"])), Row::Labelled("total", row(&["", "5", "6", "7", "8"]))];
        let mut text = String::new();
        table(&mut text, &Table { groups, rows });
        let words: Vec<String> = text.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        let expected = ["exact", "from cut fill", "0 1 2", "total 5 6", "", "other", "from cut fill", "0 3 4", "total 7 8"]
            .map(str::to_owned);
        assert_eq!(words, expected, "{text}");
        assert!(text.lines().all(|l| l.len() <= WIDTH));
    }
}
