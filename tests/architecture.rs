//! The order of the code map in ARCHITECTURE.md, kept: which file refers to which is read from the text of `solver/src/` and `src/`,
//! which has all modules of the solver under the same names.
//!
//! A reference is a path: `crate::…`, `super::…`, `self::…` or that of a child module, in a `use` or in the middle of code.
//! One to a name that a module re-exports is one to the file that the name comes from. Tests inside of files do not count.

#![allow(clippy::unwrap_used)] // helpers of tests are not tests to clippy

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Files that are known to refer to each other: to be mended, and then taken out of this list.
const KNOWN_CIRCLES: &[&[&str]] = &[];

/// Parts of the window that do not know each other, in whatever order the code map has them.
const STRANGERS: &[(&str, &str)] = &[("gui/ui/", "gui/update/"), ("gui/update/", "gui/ui/")];

/// What does not name egui: it is plain data.
const PLAIN: &[&str] = &["gui/derived/", "gui/state/", "gui/command.rs"];

/// A file of the program: its text without comments, texts and tests.
struct Source {
    /// Path below `solver/src/` or `src/`.
    name: String,
    /// Names of the modules from the root to it.
    module: Vec<String>,
    code: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

fn sources() -> Vec<Source> {
    ["solver/src", "src"].iter().flat_map(|folder| sources_of(&root().join(folder))).collect()
}

fn sources_of(base: &Path) -> Vec<Source> {
    let mut paths = Vec::new();
    files(base, &mut paths);
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.strip_prefix(base).unwrap().to_str().unwrap().replace('\\', "/");
        let stem = name.trim_end_matches(".rs").trim_end_matches("/mod");
        let module = if stem == "lib" { Vec::new() } else { stem.split('/').map(str::to_owned).collect() };
        let code = without_tests(&without_texts(&std::fs::read_to_string(&path).unwrap()));
        Source { name, module, code }
    };
    // What only puts the others together.
    let apart = |path: &PathBuf| path.ends_with("solver/src/lib.rs") || path.ends_with("src/main.rs");
    paths.into_iter().filter(|path| !apart(path) && !path.starts_with(base.join("bin"))).map(read).collect()
}

/// The code without comments and without the contents of texts.
fn without_texts(code: &str) -> String {
    let chars: Vec<char> = code.chars().collect();
    let mut kept = String::new();
    let mut i = 0;
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    while i < chars.len() {
        let word_before = i > 0 && (at(i - 1).is_alphanumeric() || at(i - 1) == '_');
        let hashes = (i + 1..).take_while(|j| at(*j) == '#').count();
        if at(i) == '/' && at(i + 1) == '/' {
            while i < chars.len() && at(i) != '\n' {
                i += 1;
            }
        } else if at(i) == 'r' && !word_before && at(i + 1 + hashes) == '"' {
            let end: Vec<char> = std::iter::once('"').chain(std::iter::repeat_n('#', hashes)).collect();
            i += 2 + hashes;
            while i < chars.len() && !chars[i..].starts_with(&end) {
                i += 1;
            }
            i += end.len();
        } else if at(i) == '"' {
            i += 1;
            while i < chars.len() && at(i) != '"' {
                i += if at(i) == '\\' { 2 } else { 1 };
            }
            i += 1;
        } else if at(i) == '\'' && at(i + 1) == '\\' {
            i += 3;
            while i < chars.len() && at(i) != '\'' {
                i += 1;
            }
            i += 1;
        } else if at(i) == '\'' && at(i + 2) == '\'' {
            i += 3;
        } else {
            kept.push(at(i));
            i += 1;
        }
    }
    kept
}

/// Without what follows `#[cfg(test)]`.
fn without_tests(code: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let mut kept = String::new();
    let mut rest = code;
    while let Some(start) = rest.find(MARK) {
        kept.push_str(&rest[..start]);
        let item = &rest[start + MARK.len()..];
        let mut depth = 0;
        let end = item.char_indices().find(|(_, c)| {
            depth += i32::from(*c == '{') - i32::from(*c == '}');
            depth == 0 && matches!(c, '}' | ';')
        });
        rest = end.map_or("", |(end, _)| &item[end + 1..]);
    }
    kept + rest
}

/// The paths of a tree of `use`, as `a::b` and `a::c` of `a::{b, c}`.
fn paths_of_tree(prefix: &[String], tree: &str, found: &mut Vec<Vec<String>>) {
    let tree = tree.trim();
    let (path, branches) = match tree.split_once('{') {
        Some((path, branches)) => (path, branches.trim_end().strip_suffix('}')),
        None => (tree.split(" as ").next().unwrap_or_default(), None),
    };
    let steps = path.split("::").map(str::trim).filter(|step| !step.is_empty() && *step != "self");
    let mut whole = prefix.to_vec();
    whole.extend(steps.map(str::to_owned));
    let Some(branches) = branches else {
        found.push(whole);
        return;
    };
    let (mut depth, mut start) = (0, 0);
    for (i, c) in branches.char_indices().chain([(branches.len(), ',')]) {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if c == ',' && depth == 0 {
            let branch = &branches[start..i];
            if !branch.trim().is_empty() {
                paths_of_tree(&whole, branch, found);
            }
            start = i + 1;
        }
    }
}

/// All of `use …;` in a file, each with whether it is a re-export; and the rest of the code.
fn uses(code: &str) -> (Vec<(bool, Vec<String>)>, String) {
    let (mut found, mut rest) = (Vec::new(), String::new());
    let mut lines = code.lines();
    while let Some(line) = lines.next() {
        let start = line.trim_start();
        let word = start.find("use ").filter(|at| *at == 0 || start.starts_with("pub"));
        let Some(at) = word.filter(|at| !start[..*at].contains(['(', '=', '{']) || start.starts_with("pub(")) else {
            rest.push_str(line);
            rest.push('\n');
            continue;
        };
        let mut statement = start[at + 4..].to_owned();
        while !statement.contains(';') {
            let Some(more) = lines.next() else { break };
            statement.push_str(more);
        }
        let mut paths = Vec::new();
        paths_of_tree(&[], statement.trim_end().trim_end_matches(';'), &mut paths);
        found.extend(paths.into_iter().map(|path| (at > 0, path)));
    }
    (found, rest)
}

/// The paths in the middle of code that begin with one of `heads`.
fn inline(code: &str, heads: &[String]) -> Vec<Vec<String>> {
    let name = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    for head in heads {
        for (start, _) in code.match_indices(&format!("{head}::")) {
            let before = code[..start].chars().next_back().unwrap_or(' ');
            // `pub(in …)` says who may look, not what is used.
            if !name(before) && before != ':' && before != '.' && !code[..start].ends_with("(in ") {
                let end = code[start..].find(|c: char| !name(c) && c != ':').map_or(code.len(), |end| start + end);
                let steps = code[start..end].split("::").filter(|step| !step.is_empty());
                found.push(steps.map(str::to_owned).collect());
            }
        }
    }
    found
}

/// The modules of the program, and what each re-exports.
struct Modules {
    /// Number of the file of each module.
    files: BTreeMap<Vec<String>, usize>,
    /// Names that a module re-exports, and the paths they stand for.
    exports: BTreeMap<(usize, String), Vec<String>>,
}

impl Modules {
    /// The path from the root, of one that is written in `module`.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Vec<String>> {
        let (first, rest) = path.split_first()?;
        let mut whole = match first.as_str() {
            "crate" => Vec::new(),
            "super" => module[..module.len().checked_sub(1)?].to_vec(),
            "self" => module.to_vec(),
            child => {
                let mut whole = module.to_vec();
                whole.push(child.to_owned());
                return self.files.contains_key(&whole).then(|| [whole, rest.to_vec()].concat());
            }
        };
        for step in rest {
            if step == "super" {
                whole.pop();
            } else {
                whole.push(step.clone());
            }
        }
        Some(whole)
    }

    /// The file that a path from the root leads to.
    fn file(&self, path: &[String]) -> Option<usize> {
        let length = (0..=path.len()).rev().find(|length| self.files.contains_key(&path[..*length]))?;
        let file = *self.files.get(&path[..length])?;
        match path.get(length).and_then(|name| self.exports.get(&(file, name.clone()))) {
            Some(origin) if *origin != path => self.file(origin),
            _ => Some(file),
        }
    }
}

/// Which file refers to which.
fn references(sources: &[Source]) -> Vec<BTreeSet<usize>> {
    let files = sources.iter().enumerate().map(|(i, source)| (source.module.clone(), i)).collect();
    let mut modules = Modules { files, exports: BTreeMap::new() };
    let read: Vec<_> = sources.iter().map(|source| uses(&source.code)).collect();
    for (i, (uses, _)) in read.iter().enumerate() {
        for (_, path) in uses.iter().filter(|(exports, _)| *exports) {
            if let (Some(name), Some(origin)) = (path.last(), modules.absolute(&sources[i].module, path)) {
                modules.exports.insert((i, name.clone()), origin);
            }
        }
    }
    let to = |i: usize| {
        let source = &sources[i];
        let (uses, rest) = &read[i];
        let mut heads = ["crate", "super", "self"].map(str::to_owned).to_vec();
        let inside = |module: &&Vec<String>| {
            module.len() == source.module.len() + 1 && module.starts_with(&source.module) && !source.module.is_empty()
        };
        heads.extend(modules.files.keys().filter(inside).filter_map(|module| module.last().cloned()));
        // A re-export alone is a sign on a door: it counts if the file needs the name itself.
        let needed = |(exports, path): &&(bool, Vec<String>)| {
            !exports
                || path
                    .last()
                    .is_some_and(|name| rest.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == name))
        };
        let paths = uses.iter().filter(needed).map(|(_, path)| path.clone()).chain(inline(rest, &heads));
        let written = paths.filter_map(|path| modules.absolute(&source.module, &path));
        // Of a module that is imported, what is named through it.
        let modules_used = uses.iter().filter_map(|(_, path)| modules.absolute(&source.module, path));
        let through = modules_used.filter(|path| modules.files.contains_key(path)).flat_map(|module| {
            let named = inline(rest, &module.last().cloned().into_iter().collect::<Vec<_>>());
            named.into_iter().map(move |path| [&module, &path[1..]].concat()).collect::<Vec<_>>()
        });
        let found = written.chain(through).filter_map(|path| modules.file(&path));
        found.filter(|other| *other != i).collect()
    };
    (0..sources.len()).map(to).collect()
}

/// The modules of the code map, from the top to the bottom; those of one row have the same number.
fn code_map() -> Vec<(String, usize)> {
    let page = std::fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let section = page.split("## Code map").nth(1).unwrap().split("\n## ").next().unwrap().to_owned();
    let rows = section.lines().filter(|line| line.starts_with("| `")).enumerate();
    rows.flat_map(|(row, line)| {
        let first = line.split('|').nth(1).unwrap_or_default();
        first.split('`').skip(1).step_by(2).map(|name| (name.to_owned(), row)).collect::<Vec<_>>()
    })
    .collect()
}

/// The row of a file; of several that fit the most particular one.
fn row(map: &[(String, usize)], file: &str) -> Option<usize> {
    let fits = |entry: &&(String, usize)| file == entry.0 || (entry.0.ends_with('/') && file.starts_with(&entry.0));
    map.iter().filter(fits).max_by_key(|(name, _)| name.len()).map(|(_, row)| *row)
}

/// Whether `from` leads to `to`.
fn leads(references: &[BTreeSet<usize>], from: usize, to: usize) -> bool {
    let (mut seen, mut next) = (BTreeSet::new(), vec![from]);
    while let Some(file) = next.pop() {
        if file == to {
            return true;
        }
        next.extend(references[file].iter().filter(|other| seen.insert(**other)));
    }
    false
}

#[test]
fn the_code_map_holds_every_file() {
    let (map, sources) = (code_map(), sources());
    let missing = sources.iter().filter(|source| !source.module.is_empty() && row(&map, &source.name).is_none());
    let missing: Vec<&str> = missing.map(|source| source.name.as_str()).collect();
    assert!(missing.is_empty(), "not in the code map of ARCHITECTURE.md: {missing:?}");
    for (name, _) in &map {
        let there = sources.iter().any(|source| source.name == *name || source.name.starts_with(name.as_str()));
        assert!(there, "{name} is in the code map of ARCHITECTURE.md, but there is no such file");
    }
}

#[test]
fn dependencies_run_downwards_in_the_code_map() {
    let (map, sources) = (code_map(), sources());
    let references = references(&sources);
    let mut wrong = Vec::new();
    for (source, others) in sources.iter().zip(&references) {
        for other in others.iter().map(|other| &sources[*other]) {
            let upwards = row(&map, &source.name) < row(&map, &other.name) && !source.module.is_empty();
            let pair = |(a, b): &(&str, &str)| source.name.starts_with(a) && other.name.starts_with(b);
            if upwards || STRANGERS.iter().any(pair) {
                wrong.push(format!("{} uses {}", source.name, other.name));
            }
        }
    }
    assert!(wrong.is_empty(), "against the order of ARCHITECTURE.md:\n{}", wrong.join("\n"));
}

#[test]
fn no_files_refer_to_each_other_in_a_circle() {
    let sources = sources();
    let references = references(&sources);
    let mut circles = Vec::new();
    for (i, others) in references.iter().enumerate() {
        let back = others.iter().filter(|other| leads(&references, **other, i));
        circles.extend(back.map(|other| (sources[i].name.as_str(), sources[*other].name.as_str())));
    }
    let known = |(a, b): &&(&str, &str)| KNOWN_CIRCLES.iter().any(|known| known.contains(a) && known.contains(b));
    let unknown: Vec<String> =
        circles.iter().filter(|pair| !known(pair)).map(|(a, b)| format!("{a} uses {b}")).collect();
    assert!(unknown.is_empty(), "these close circles:\n{}", unknown.join("\n"));
    for file in KNOWN_CIRCLES.iter().copied().flatten() {
        let there = circles.iter().any(|(from, _)| from == file);
        assert!(there, "{file} is in no circle any more: take it out of KNOWN_CIRCLES");
    }
}

#[test]
fn the_state_of_the_window_is_plain_data_and_no_file_goes_round_the_map() {
    for source in sources() {
        // What the solver has is in the program under the same names: by those its files are told apart.
        let named = source.code.contains("squeezefilm_solver") && !source.module.is_empty();
        assert!(!named, "{} names the crate of the solver", source.name);
        for word in ["egui", "eframe"] {
            let named = PLAIN.iter().any(|plain| source.name.starts_with(plain)) && source.code.contains(word);
            assert!(!named, "{} names {word}", source.name);
        }
    }
}

#[test]
fn references_are_found_wherever_they_are_written() {
    let source = |name: &str, code: &str| Source {
        name: name.to_owned(),
        module: name.trim_end_matches(".rs").trim_end_matches("/mod").split('/').map(str::to_owned).collect(),
        code: without_tests(&without_texts(code)),
    };
    let sources = [
        source("a/mod.rs", "pub mod x;\nmod y;\npub use y::Named;\n"),
        source("a/x.rs", "use super::{y::{self, Other}, Named as N};\nfn f() { let _ = \"crate::b\"; /* no */ }\n"),
        source("a/y.rs", "// crate::b\npub struct Named;\n#[cfg(test)]\nmod tests { use crate::b; }\nfn g() {}\n"),
        source("b.rs", "fn f() -> crate::a::Named { r#\"crate::c\"#; 'c'; '\\''; crate::a::x::f() }\n"),
        source("c/mod.rs", "mod d;\nfn f() { d::g() }\n"),
        source("c/d.rs", "use crate::{a, b::{\n    Thing,\n}};\nfn h() { a::x::f() }\n"),
    ];
    let found = references(&sources);
    let expected: [&[usize]; 6] = [&[], &[2], &[], &[1, 2], &[5], &[0, 1, 3]];
    for (i, expected) in expected.into_iter().enumerate() {
        assert_eq!(found[i].iter().copied().collect::<Vec<_>>(), expected, "{}", sources[i].name);
    }
    assert!(leads(&found, 4, 2) && !leads(&found, 2, 4));
}
