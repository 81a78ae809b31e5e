//! The rules of docs/architecture.md, checked on the source text.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules of the library. Each uses only itself and those before it.
const ORDER: [&str; 19] = [
    "kernel",
    "model",
    "read",
    "validate",
    "formation",
    "sheet",
    "slope",
    "mesh",
    "surface",
    "terrain",
    "overlay",
    "ground",
    "setout",
    "write",
    "plot",
    "report",
    "pipeline",
    "selftest",
    "cli",
];

/// Packages that stay at the edge, with the modules that may name them.
const EDGE: [(&str, &[&str]); 14] = [
    ("anyhow", &["cli", "main"]),
    ("clap", &["cli", "main"]),
    ("indicatif", &["cli"]),
    ("ctrlc", &["cli"]),
    ("signal_hook", &["cli"]),
    ("rustix", &["cli"]),
    ("geojson", &["read", "write"]),
    ("csv", &["read", "report"]),
    ("spade", &["mesh", "terrain"]),
    ("tobj", &["read"]),
    ("tempfile", &["write"]),
    ("robust", &["kernel"]),
    ("maud", &["report"]),
    // Beyond `read` in tests only: what is written can be read.
    ("quick_xml", &["read", "write", "plot"]),
];

/// The one file that may turn doubles into single-precision numbers, for formats that hold no others.
const SINGLE_PRECISION: &str = "write/single.rs";

/// The one file with unsafe code: a global allocator cannot be had without.
const UNSAFE: &str = "heap.rs";

/// Lines of [`UNSAFE`]: each of them is read by everybody who trusts the program.
const LONGEST_UNSAFE: usize = 50;

/// Lines of a file, its tests not counted, beyond which it must be split.
const LONGEST_FILE: usize = 800;

/// A source file without comments.
struct Source {
    path: PathBuf,
    /// Top-level module it belongs to; `main` and `lib` are their own.
    module: String,
    /// Whether it is the file of the module itself, whose parent is the crate.
    is_root: bool,
    /// Whether it is for tests only.
    is_test: bool,
    /// Lines by number, without comments.
    lines: Vec<(usize, String)>,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn sources() -> Vec<Source> {
    let mut sources = Vec::new();
    collect(&root().join("src"), &mut sources);
    sources.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(sources.len() > 40, "the source was not found");
    sources
}

fn collect(folder: &Path, out: &mut Vec<Source>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let path = path.strip_prefix(root().join("src")).unwrap().to_owned();
            let first = path.iter().next().unwrap().to_str().unwrap();
            let module = first.trim_end_matches(".rs").to_owned();
            let name = path.file_stem().unwrap().to_str().unwrap();
            let depth = path.iter().count();
            let lines = text.lines().map(without_comment).map(str::to_owned).enumerate().map(|(i, l)| (i + 1, l)).collect();
            let is_test = ["tests", "testing"].contains(&name);
            out.push(Source { is_root: depth == 1 || (depth == 2 && name == "mod"), is_test, path, module, lines });
        }
    }
}

fn without_comment(line: &str) -> &str {
    let code = line.trim_start();
    if code.starts_with("//") { "" } else { line.split(" // ").next().unwrap_or(line) }
}

/// The lines before the tests at the end of a file.
fn shipped(source: &Source) -> &[(usize, String)] {
    let test = |l: &(usize, String)| l.1.trim_end() == "#[cfg(test)]";
    let is_module = |i: usize| source.lines.get(i + 1).is_some_and(|l| l.1.starts_with("mod ") && l.1.ends_with('{'));
    let end = (0..source.lines.len()).find(|&i| test(&source.lines[i]) && is_module(i));
    if source.is_test { &[] } else { &source.lines[..end.unwrap_or(source.lines.len())] }
}

/// Names that follow each `prefix` in a line: `crate::a`, `crate::{a, b::c}`.
fn named_after(line: &str, prefix: &str) -> Vec<String> {
    let word = |text: &str| text.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut names = Vec::new();
    for (at, _) in line.match_indices(prefix) {
        let before = line[..at].chars().next_back();
        let rest = &line[at + prefix.len()..];
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
            continue;
        }
        match rest.strip_prefix('{') {
            None => names.push(word(rest)),
            Some(group) => {
                let mut depth = 0;
                let mut start = 0;
                for (i, c) in group.char_indices() {
                    match c {
                        '{' => depth += 1,
                        '}' if depth > 0 => depth -= 1,
                        ',' | '}' if depth == 0 => {
                            names.push(word(&group[start..i]));
                            start = i + 1;
                            if c == '}' {
                                break;
                            }
                        }
                        _ => {}
                    }
                }
            }
        }
    }
    names
}

/// Whether `word` stands in the line as a whole word.
fn has_word(line: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(at, _)| {
        !line[..at].chars().next_back().is_some_and(part) && !line[at + word.len()..].chars().next().is_some_and(part)
    })
}

fn complain(rule: &str, found: &[String]) {
    assert!(found.is_empty(), "{rule}:\n{}", found.join("\n"));
}

#[test]
fn modules_use_only_those_before_them() {
    let place = |name: &str| ORDER.iter().position(|m| *m == name);
    let mut found = Vec::new();
    let mut uses = 0;
    for source in sources() {
        let Some(own) = place(&source.module) else {
            assert!(["main", "lib", "heap"].contains(&source.module.as_str()), "module `{}` is not in the order", source.module);
            continue;
        };
        for (number, line) in &source.lines {
            let mut names = named_after(line, "crate::");
            if source.is_root && !line.starts_with(' ') {
                names.extend(named_after(line, "super::").into_iter().filter(|n| place(n).is_some()));
            }
            for name in names {
                uses += 1;
                match place(&name) {
                    Some(other) if other <= own => {}
                    _ => found.push(format!("src/{}:{number}: {}", source.path.display(), line.trim())),
                }
            }
        }
    }
    complain("a module uses one that does not stand before it", &found);
    assert!(uses > 50, "only {uses} uses were found: the search is broken");
}

#[test]
fn the_document_gives_the_same_order() {
    let document = fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    assert!(document.contains(&ORDER.join(" → ")), "docs/architecture.md does not give the order of this test");
    for module in ORDER {
        assert!(document.contains(&format!("| `{module}` |")), "docs/architecture.md does not describe `{module}`");
    }
}

#[test]
fn the_document_names_every_package() {
    let document = fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let mut section = "";
    let mut packages = 0;
    for line in manifest.lines() {
        if line.starts_with('[') {
            section = line;
        } else if section.ends_with("dependencies]")
            && let Some((name, _)) = line.split_once(" = ")
        {
            packages += 1;
            assert!(document.contains(&format!("`{name}`")), "docs/architecture.md does not say what `{name}` is for");
        }
    }
    assert!(packages > 10, "only {packages} packages were found: the search is broken");
}

#[test]
fn every_package_is_used() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let sources = sources();
    // Also those for some systems only.
    let sections = manifest.split("dependencies]\n").collect::<Vec<_>>();
    let shipped_only = sections.windows(2).filter(|pair| !pair[0].ends_with("[dev-"));
    let dependencies: String = shipped_only.map(|pair| pair[1].split("\n[").next().unwrap()).collect();
    for name in dependencies.lines().filter_map(|line| line.split_once(" = ")).map(|(name, _)| name.replace('-', "_")) {
        let used = |source: &Source| shipped(source).iter().any(|l| has_word(&l.1, &name));
        assert!(sources.iter().any(used), "the program does not use `{name}`: drop it, or move it to [dev-dependencies]");
    }
}

#[test]
fn packages_stay_where_they_belong() {
    let mut found = Vec::new();
    let mut uses = 0;
    for source in sources() {
        for (number, line) in &source.lines {
            for (package, allowed) in EDGE {
                let used = line.contains(&format!("{package}::")) || has_word(line, package) && line.trim().starts_with("use ");
                // A module may have a child of the same name.
                if !used || !has_word(line, package) {
                    continue;
                }
                uses += 1;
                if !allowed.contains(&source.module.as_str()) {
                    found.push(format!("src/{}:{number}: {}", source.path.display(), line.trim()));
                }
            }
        }
    }
    complain("a package is used where it does not belong", &found);
    assert!(uses > 10, "only {uses} uses were found: the search is broken");
}

#[test]
fn numbers_are_double_and_nothing_prints() {
    let mut found = Vec::new();
    for source in sources() {
        for (number, line) in &source.lines {
            let converts = source.path == Path::new(SINGLE_PRECISION);
            let single = ["f32", "Vec2", "Vec3", "Vec4", "Mat3", "Mat4"]
                .iter()
                .any(|word| has_word(line, word) && !(converts && *word == "f32"));
            let prints = ["println!", "print!", "eprintln!", "eprint!", "dbg!"].iter().any(|word| has_word(line, word));
            if single || prints {
                found.push(format!("src/{}:{number}: {}", source.path.display(), line.trim()));
            }
        }
    }
    complain("single precision, or text printed by the library", &found);
}

#[test]
fn no_panic_is_written_into_shipped_code() {
    const PANICS: [&str; 7] = [".unwrap()", ".expect(", "panic!(", "unreachable!(", "todo!(", "unimplemented!(", "unsafe "];
    let mut found = Vec::new();
    for source in sources() {
        for (number, line) in shipped(&source) {
            let sound = source.path == Path::new(UNSAFE);
            if PANICS.iter().any(|panic| line.contains(panic) && !(sound && *panic == "unsafe ")) {
                found.push(format!("src/{}:{number}: {}", source.path.display(), line.trim()));
            }
        }
    }
    complain("a panic that input might reach", &found);
}

#[test]
fn files_stay_short() {
    for source in sources() {
        let length = shipped(&source).len();
        assert!(length <= LONGEST_FILE, "src/{} has {length} lines: split it", source.path.display());
        if source.module == "main" {
            assert!(length <= 30, "main.rs does too much");
        }
        if source.path == Path::new(UNSAFE) {
            assert!(length <= LONGEST_UNSAFE, "{UNSAFE} does too much");
        }
    }
}

/// Code spans of a document that name something in the source: paths, types, constants, functions with an underscore.
fn names_in(document: &str) -> Vec<String> {
    let spans = document.split('`').skip(1).step_by(2);
    let is_name = |span: &&str| {
        let plain = span.chars().all(|c| c.is_alphanumeric() && c.is_ascii() || c == '_' || c == ':');
        let starts = span.starts_with(|c: char| c.is_ascii_alphabetic());
        let telling = span.contains("::") || span.contains('_') || span.chars().filter(char::is_ascii_uppercase).count() > 1;
        let long_type = span.len() > 3 && span.starts_with(|c: char| c.is_ascii_uppercase());
        plain && starts && (telling || long_type)
    };
    spans.filter(is_name).map(str::to_owned).collect()
}

#[test]
fn documents_speak_of_what_there_is() {
    let sources = sources();
    let mut found = Vec::new();
    let mut names = 0;
    for name in ["architecture.md", "theory.md", "glossary.md"] {
        let document = fs::read_to_string(root().join("docs").join(name)).unwrap();
        // Formulas stand in fenced blocks.
        let text: String = document.split("```").step_by(2).collect();
        for path in names_in(&text) {
            names += 1;
            // Symbols of formulas such as `z_A` are no names; a name of the source has three letters in a row.
            let last = path.rsplit("::").next().unwrap().trim_end_matches('_');
            let letters = last.split(|c: char| !c.is_ascii_alphabetic()).map(str::len).max().unwrap_or(0);
            let known = |source: &Source| source.lines.iter().any(|l| has_word(&l.1, last));
            let module = |source: &Source| source.path.iter().any(|p| p.to_str().unwrap().trim_end_matches(".rs") == last);
            let prefix = path.ends_with('_') && sources.iter().any(|s| s.lines.iter().any(|l| l.1.contains(last)));
            let package = fs::read_to_string(root().join("Cargo.toml")).unwrap().contains(last);
            if letters > 2 && !(prefix || package || sources.iter().any(|s| known(s) || module(s))) {
                found.push(format!("docs/{name}: `{path}`"));
            }
        }
    }
    complain("a document names what the source does not have", &found);
    assert!(names > 60, "only {names} names were found: the search is broken");
}

#[test]
fn tolerances_are_those_of_the_source() {
    let theory = fs::read_to_string(root().join("docs/theory.md")).unwrap();
    let mut checked = 0;
    for row in theory.lines().filter(|line| line.starts_with("| `")) {
        let mut cells = row.split('|').map(str::trim).skip(1);
        let (path, value) = (cells.next().unwrap().trim_matches('`'), cells.next().unwrap());
        let Some((module, name)) = path.rsplit_once("::").filter(|(_, name)| has_word(&name.to_uppercase(), name)) else {
            continue;
        };
        let file = root().join("src").join(module.replace("::", "/"));
        let text = fs::read_to_string(file.with_extension("rs")).or_else(|_| fs::read_to_string(file.join("mod.rs"))).unwrap();
        let written = text.split(&format!("const {name}: f64 = ")).nth(1).and_then(|rest| rest.split(';').next());
        let written = written.unwrap_or_else(|| panic!("`{path}` is not in the source"));
        let (ours, theirs) = (sum_of(value), sum_of(&written.replace('_', "").replace(" - ", " − ")));
        assert_eq!(ours, theirs, "`{path}` is {written} in the source, {value} in docs/theory.md");
        checked += 1;
    }
    assert!(checked > 12, "only {checked} tolerances were found: the search is broken");
}

/// The value of `1 − 10⁻⁹`, `2·10⁻⁸`, `0.115 rad`, `1e-6`.
fn sum_of(text: &str) -> f64 {
    let factor = |text: &str| -> f64 {
        let text = text.trim().trim_end_matches(" rad");
        let digit = |c: char| {
            "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|s| s == c).map_or(if c == '⁻' { '-' } else { c }, |d| (b'0' + d as u8) as char)
        };
        match text.strip_prefix("10") {
            Some(power) if !power.is_empty() && !power.starts_with('.') => {
                format!("1e{}", power.chars().map(digit).collect::<String>()).parse().unwrap()
            }
            _ => text.parse().unwrap_or_else(|e| panic!("`{text}`: {e}")),
        }
    };
    let term = |text: &str| text.split('·').map(factor).product::<f64>();
    let mut terms = text.split(" − ").map(term);
    let first = terms.next().unwrap();
    terms.fold(first, |sum, term| sum - term)
}
