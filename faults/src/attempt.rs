//! Which faults the tests notice.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// How long a test may take beyond its time without a fault, before the fault counts as noticed: as many times, and so much more.
const SLOWER: u32 = 6;
const GRACE: Duration = Duration::from_secs(20);

/// An executable of tests.
struct Tests<'a> {
    path: &'a str,
    /// Where it expects to be run.
    folder: String,
    limit: Duration,
}

/// Runs the tests without a fault, then with each, the quickest first and up to the first that fails. Those that fail without one are left
/// out.
pub fn all(tree: &str, list: &str, tests: &str) -> Result<(), Box<dyn Error>> {
    let (list, tests) = (fs::read_to_string(list)?, fs::read_to_string(tests)?);
    let mut known = Vec::new();
    for path in tests.lines() {
        // Tests run in the folder of their crate.
        let folder = if path.contains("squeezefilm_solver") { format!("{tree}/solver") } else { tree.to_owned() };
        let start = Instant::now();
        if fails(path, &folder, "0", Duration::from_secs(600))? {
            eprintln!("left out, since it fails without a fault: {path}");
            continue;
        }
        known.push(Tests { path, folder, limit: SLOWER * start.elapsed() + GRACE });
    }
    known.sort_by_key(|tests| tests.limit);
    let faults: Vec<&str> = list.lines().collect();
    let (next, missed) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || -> std::io::Result<()> {
        while let Some(fault) = faults.get(next.fetch_add(1, Ordering::Relaxed)) {
            let number = fault.split('\t').next().unwrap_or_default();
            let mut by = None;
            for tests in &known {
                if fails(tests.path, &tests.folder, number, tests.limit)? {
                    by = Path::new(tests.path).file_stem();
                    break;
                }
            }
            missed.fetch_add(usize::from(by.is_none()), Ordering::Relaxed);
            println!("{}\t{fault}", by.map_or_else(|| "MISSED".into(), |name| name.to_string_lossy()));
        }
        Ok(())
    };
    let workers = thread::available_parallelism()?.get();
    thread::scope(|scope| {
        let started: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        started.into_iter().try_for_each(|worker| worker.join().unwrap_or(Ok(())))
    })?;
    let missed = missed.into_inner();
    println!("{} of {} noticed", faults.len() - missed, faults.len());
    Ok(())
}

/// Whether the tests fail, or take longer than `limit`.
fn fails(tests: &str, folder: &str, fault: &str, limit: Duration) -> std::io::Result<bool> {
    let mut running = Command::new(tests)
        .args(["-q", "--test-threads=1"])
        .current_dir(folder)
        .env("FAULT", fault)
        .env("RAYON_NUM_THREADS", "1")
        // What fails with one fault is not tried with the others.
        .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "1")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()?;
    let start = Instant::now();
    loop {
        if let Some(status) = running.try_wait()? {
            return Ok(!status.success());
        }
        if start.elapsed() > limit {
            running.kill()?;
            running.wait()?;
            return Ok(true);
        }
        thread::sleep(Duration::from_millis(20));
    }
}
