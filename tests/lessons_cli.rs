//! `squeezefilm lessons`: what a teacher does with lessons, as a teacher does it.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use program::{done, err, out, refused, run};
use std::path::Path;

const GOOD: &str = include_str!("lessons/good.md");

/// A folder with one lesson.
fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    std::fs::write(folder.path().join("mine/lesson.md"), text).unwrap();
    folder
}

#[test]
fn every_task_of_the_built_in_lessons_is_done_by_try_and_not_by_wrong() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons");
    let output = run(&["lessons", "check", folder.to_str().unwrap()]);
    let told = out(&output);
    assert!(output.status.success() && !told.contains("error") && !told.contains("warning"), "{told}");
    assert_eq!(told.matches("all done by try, none by wrong").count(), squeezefilm::lessons::BUILT_IN.len(), "{told}");
}

#[test]
fn a_check_that_cannot_fail_or_cannot_hold_is_told() {
    let good = folder(GOOD);
    let output = run(&["lessons", "check", good.path().to_str().unwrap()]);
    assert!(output.status.success(), "{}", out(&output));
    assert!(out(&output).contains("mine: A lesson of my own, 1 step, 1 task: all done by try, none by wrong"));
    let changes = [
        (
            "check = \"mean_load_ratio > 2 and mean_load_ratio > 100 * start.mean_load_ratio\"",
            "check = \"mean_load_ratio > 0\"",
            2,
            "the check holds from the start",
        ),
        (
            "try = [\"plate.amplitude_um = 0.9\"]",
            "try = [\"plate.amplitude_um = 0.6\"]",
            2,
            "try does not fulfil the check: Mean load ratio is",
        ),
        ("try = [\"plate.amplitude_um = 0.9\"]", "try = [\"plate.amplitude_um = 0.97\"]", 2, "try goes too far"),
        (
            "wrong = [\"plate.amplitude_um = 0.5\"]",
            "wrong = [\"plate.amplitude_um = 0.9\"]",
            2,
            "wrong fulfils the check",
        ),
        ("{mean_load_ratio:2} atmospheres", "{startup.cycles} cycles", 2, "{startup.cycles} is not known in the run"),
        ("try = [\"plate.amplitude_um = 0.9\"]", "", 0, "warning: step 1, Push harder: no try"),
        ("wrong = [\"plate.amplitude_um = 0.5\"]", "", 0, "warning: step 1, Push harder: no wrong"),
        ("\"Pulling can take away one atmosphere at most.\"", "\"\"", 0, "choice 3 is wrong and has no reply"),
        ("check = ", "chek = ", 2, ""),
    ];
    for (from, to, status, words) in changes {
        assert_eq!(GOOD.matches(from).count(), 1, "{from}");
        let folder = folder(&GOOD.replacen(from, to, 1));
        let output = run(&["lessons", "check", folder.path().to_str().unwrap()]);
        let told = out(&output);
        assert_eq!(output.status.code(), Some(status), "{to}: {told}");
        assert!(told.contains(words), "{to}: {told}");
        if words.is_empty() {
            assert!(err(&output).contains("task.chek is not known"));
        }
    }
}

#[test]
fn lessons_are_printed_a_page_for_each() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("handouts");
    done(&["lessons", "print", "--out", out.to_str().unwrap()]);
    let lessons = squeezefilm::lessons::BUILT_IN.len();
    for name in ["worksheets", "answers"] {
        let pdf = std::fs::read(out.join(name).with_extension("pdf")).unwrap();
        let pages = pdf.windows(15).filter(|part| part.starts_with(b"/Type /Page") && part[11] != b's').count();
        assert_eq!(pages, lessons, "{name}");
        let html = std::fs::read_to_string(out.join(name).with_extension("html")).unwrap();
        assert_eq!(html.matches("<section").count(), lessons);
        assert!(html.contains("You push the plate quickly down to half of its gap"));
        // Numbers that a text quotes are those of runs.
        assert!(!html.contains('{') || !html.contains("load_ratio_max /"), "{name}");
    }
    // A folder without lessons leaves them as they are.
    let before = std::fs::read(out.join("worksheets.pdf")).unwrap();
    for nothing in [folder.path().join("no such folder"), out.clone()] {
        let output = run(&["lessons", "print", nothing.to_str().unwrap(), "--out", out.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(std::fs::read(out.join("worksheets.pdf")).unwrap(), before);
    }
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let (worksheets, answers) = (read("worksheets.html"), read("answers.html"));
    assert!(worksheets.contains("class=\"room\"") && !worksheets.contains("Boyle's law gives 203 kPa"));
    assert!(
        answers.contains("Boyle")
            && answers.contains("The program gives 241 kPa")
            && !answers.contains("class=\"room\"")
    );
    // Braces are those of the text, not marks of an index.
    let own = self::folder(&GOOD.replacen("pushes more strongly", r"\{the ratio\} at $h_0$", 1));
    done(&["lessons", "print", own.path().to_str().unwrap(), "--out", own.path().join("out").to_str().unwrap()]);
    let own = std::fs::read_to_string(own.path().join("out/answers.html")).unwrap();
    assert!(own.contains("{the ratio} at h_0"), "{own}");
    // The text of a step is on the worksheet.
    let body = "Here a plate lies on a film of air that is 1 µm thick";
    assert!(worksheets.contains(body) && !answers.contains(body), "{worksheets}");
    assert!(worksheets.contains("Sketch") && worksheets.contains("mean pressure"));
}

#[test]
fn a_place_that_is_not_there_and_a_step_without_a_lesson_are_refused() {
    refused(&["gui", "--step", "4"], 2, &["--lesson"]);
    refused(&["lessons", "summary", "absent.csv"], 2, &["absent.csv: cannot be read"]);
    refused(&["lessons", "summary", "-"], 2, &["- is no path"]);
}
