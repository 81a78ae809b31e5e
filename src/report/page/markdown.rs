//! Pages as Markdown with tables, as GitHub and others show them.

use super::{Item, Page, Row, Table};
use std::fmt::Write as _;

// Writing to a String cannot fail.
impl Page {
    /// The page as Markdown. The same page gives the same bytes.
    pub(in crate::report) fn markdown(&self) -> String {
        let mut text = format!("# {}\n", escaped(&self.title));
        for line in &self.lead {
            let _ = writeln!(text, "\n{}", escaped(line));
        }
        if let Some(verdict) = &self.verdict {
            let _ = writeln!(text, "\n**{}**", escaped(verdict));
        }
        for section in &self.sections {
            let _ = write!(text, "\n## {}\n", escaped(&section.title));
            let mut last = None;
            for item in &section.items {
                let kind = std::mem::discriminant(item);
                let named = matches!(item, Item::Words { .. } | Item::Figure { .. });
                match item {
                    Item::Words { .. } | Item::Figure { .. } if last == Some((true, None)) => {}
                    Item::Words { .. } | Item::Figure { .. } => text += "\n| | |\n|---|---|\n",
                    Item::Table(_) => text += "\n",
                    Item::Remark { .. } if last == Some((false, Some(kind))) => {}
                    Item::Remark { .. } => text += "\n",
                }
                last = Some((named, (!named).then_some(kind)));
                add(&mut text, item);
            }
        }
        text
    }
}

fn add(text: &mut String, item: &Item) {
    let _ = match item {
        Item::Words { name, words } => writeln!(text, "| {} | {} |", self::name(name), escaped(words.trim())),
        Item::Figure { name, number, unit } => {
            let gap = if unit == "°" || unit.is_empty() { "" } else { " " };
            writeln!(text, "| {} | {}{gap}{} |", self::name(name), escaped(number), escaped(unit))
        }
        Item::Table(table) => {
            self::table(text, table);
            Ok(())
        }
        Item::Remark { words, below } => {
            let _ = writeln!(text, "* {}", begun(words));
            below.iter().try_for_each(|line| writeln!(text, "  * {}", begun(line)))
        }
    };
}

fn table(text: &mut String, table: &Table) {
    let columns = || table.groups.iter().flat_map(|group| group.columns.iter().map(|column| (group.title, column)));
    let names = columns().map(|(title, column)| format!(" {} |", escaped(format!("{title} {}", column.name).trim())));
    let lines = columns().map(|(_, column)| if column.left { "---|" } else { "---:|" });
    let _ = writeln!(text, "|{}\n|{}", names.collect::<String>(), lines.collect::<String>());
    let count = columns().count();
    let mut line = |mut cells: Vec<String>| {
        cells.resize(count, String::new());
        let cells = cells.iter().map(|cell| if cell.is_empty() { " |".to_owned() } else { format!(" {cell} |") });
        let _ = writeln!(text, "|{}", cells.collect::<String>());
    };
    for row in &table.rows {
        match row {
            Row::Cells(cells) => line(cells.iter().map(|cell| escaped(cell.trim())).collect()),
            Row::Heading(words) => line(vec![format!("**{}**", escaped(words.trim()))]),
            Row::Labelled(label, cells) => {
                let mut cells: Vec<String> = cells.iter().map(|cell| escaped(cell.trim())).collect();
                if let Some(first) = cells.first_mut() {
                    *first = format!("**{}**", escaped(label));
                }
                line(cells);
            }
        }
    }
}

/// A name; one that belongs to the one above begins with a dash.
fn name(name: &str) -> String {
    match name.strip_prefix("  ") {
        Some(rest) => format!("– {}", escaped(rest)),
        None => escaped(name),
    }
}

/// Words at the beginning of a line, where more characters have a meaning.
fn begun(words: &str) -> String {
    let words = escaped(words.trim());
    let digits = words.chars().take_while(char::is_ascii_digit).count();
    match words.chars().nth(digits) {
        Some('.' | ')') if digits > 0 => format!("{}\\{}", &words[..digits], &words[digits..]),
        Some('#' | '+' | '-' | '=' | ':') if digits == 0 => format!("\\{words}"),
        _ => words,
    }
}

/// Text in which no character has a meaning in Markdown, in HTML, or in formulas.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if "\\`*_[]<>|~&$".contains(c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_from_a_file_is_markup() {
        assert_eq!(
            escaped("a|b `c` <img src=x> *d* _e_ [f](g) \\ $h$"),
            r"a\|b \`c\` \<img src=x\> \*d\* \_e\_ \[f\](g) \\ \$h\$"
        );
        for (words, expected) in [("# a", r"\# a"), ("- a", r"\- a"), ("12. a", r"12\. a"), ("12 a", "12 a"), ("a-b", "a-b")] {
            assert_eq!(begun(words), expected);
        }
    }
}
