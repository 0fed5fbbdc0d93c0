//! The memory budget that all solves of the process share.
//!
//! Every solve first takes its share of this budget ([`take`]). A solve that needs more than the whole budget is refused; one that needs
//! more than is free waits until other solves end, so that the results of a sweep do not depend on how many threads share the budget. The
//! budget is a quarter of the machine's memory unless [`allow`] sets another, because results are kept, and drawn, in memory outside it.
//!
//! A rotor takes a share while it is resolved and returns it before the solve takes its own, so no solve waits while it holds a share.

use crate::control::Cancel;
use std::fmt;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The default budget is the machine's memory divided by this …
const SHARE: u64 = 4;
/// … or, where the machine's memory is not known, this number of bytes.
const UNKNOWN: u64 = 1_000_000_000;
/// How often a waiting solve checks whether it has been cancelled.
const LOOK: Duration = Duration::from_millis(50);

/// Memory that a solve needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Need {
    /// What the memory is for.
    pub what: MemoryUse,
    /// Bytes.
    pub bytes: u64,
}

/// What the memory is for, with the sizes that it follows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryUse {
    /// The film.
    Film {
        /// Film nodes of the finest grid along a tooth or plate …
        along: usize,
        /// … and across all of its width.
        across: usize,
        /// Time steps in a cycle.
        steps: usize,
        /// Teeth whose film is solved.
        teeth: usize,
    },
    /// The compliances of a ring.
    Ring {
        /// Elements of the finer mesh.
        elements: usize,
    },
}

/// More memory than is allowed. The message names the keys that determine the need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryExcess {
    /// The memory that is needed.
    pub need: Need,
    /// Memory allowed for all solves together \[bytes\].
    pub allowed: u64,
}

impl fmt::Display for MemoryExcess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (bytes, allowed) = (size(self.need.bytes), size(self.allowed));
        match self.need.what {
            MemoryUse::Film { along, across, steps, teeth } => {
                let teeth = if teeth > 1 { format!(" on {teeth} teeth") } else { String::new() };
                write!(
                    f,
                    "{along} × {across} film nodes{teeth} and {steps} steps a cycle need {bytes} of memory: allowed {allowed}; lower \
                     the accuracy, or numerics.film_nodes_along, numerics.film_nodes_across or numerics.steps_per_cycle if given, or allow \
                     more with --memory"
                )
            }
            MemoryUse::Ring { elements } => write!(
                f,
                "rotor.model = \"ring\": {elements} elements of its section need {bytes} of memory: allowed {allowed}; allow more with \
                 --memory, or take another rotor.model"
            ),
        }
    }
}

impl std::error::Error for MemoryExcess {}

/// `1.2 GB`, `350 MB`: bytes for people.
pub fn size(bytes: u64) -> String {
    let (value, unit) = match bytes {
        0..1_000_000 => (bytes as f64 / 1e3, "kB"),
        1_000_000..1_000_000_000 => (bytes as f64 / 1e6, "MB"),
        _ => (bytes as f64 / 1e9, "GB"),
    };
    if value < 10.0 { format!("{value:.1} {unit}") } else { format!("{value:.0} {unit}") }
}

/// A budget, and how much of it is in use.
#[derive(Debug)]
struct Pool {
    /// Bytes allowed, `None` until they are first asked for, and bytes in use.
    state: Mutex<(Option<u64>, u64)>,
    freed: Condvar,
}

static POOL: Pool = Pool::new(None);

/// A solve's share of the budget; given back on drop.
#[derive(Debug)]
pub struct Taken<'a> {
    pool: &'a Pool,
    bytes: u64,
}

impl Taken<'_> {
    /// Bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

impl Drop for Taken<'_> {
    fn drop(&mut self) {
        self.pool.lock().1 -= self.bytes;
        self.pool.freed.notify_all();
    }
}

impl Pool {
    const fn new(allowed: Option<u64>) -> Self {
        Self { state: Mutex::new((allowed, 0)), freed: Condvar::new() }
    }

    fn lock(&self) -> MutexGuard<'_, (Option<u64>, u64)> {
        // Two plain numbers: a panic cannot leave them half-updated, so a poisoned lock is still good.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn allowed(&self) -> u64 {
        *self.lock().0.get_or_insert_with(|| of_this_machine().map_or(UNKNOWN, |all| all / SHARE))
    }

    fn take(&self, need: Need, cancel: &Cancel) -> Result<Taken<'_>, MemoryExcess> {
        self.check(need)?;
        let bytes = need.bytes;
        let mut state = self.lock();
        while state.1.saturating_add(bytes) > state.0.unwrap_or(bytes) && state.1 > 0 {
            if cancel.is_cancelled() {
                // The cancelled solve ends at its first check, so it needs no memory.
                return Ok(Taken { pool: self, bytes: 0 });
            }
            state = self.freed.wait_timeout(state, LOOK).unwrap_or_else(PoisonError::into_inner).0;
        }
        state.1 += bytes;
        Ok(Taken { pool: self, bytes })
    }

    fn check(&self, need: Need) -> Result<(), MemoryExcess> {
        let allowed = self.allowed();
        if need.bytes > allowed { Err(MemoryExcess { need, allowed }) } else { Ok(()) }
    }
}

/// Sets the number of bytes that all solves of this process may take together from now on.
pub fn allow(bytes: u64) {
    POOL.lock().0 = Some(bytes);
}

/// Number of bytes that all solves of this process may take together.
pub fn allowed() -> u64 {
    POOL.allowed()
}

/// Whether `need` is within what is allowed.
///
/// # Errors
/// [`MemoryExcess`] if it is not.
pub fn check(need: Need) -> Result<(), MemoryExcess> {
    POOL.check(need)
}

/// Takes the memory that a solve needs, as soon as other solves have left enough.
///
/// # Errors
/// [`MemoryExcess`] if it is more than the whole budget.
pub fn take(need: Need, cancel: &Cancel) -> Result<Taken<'static>, MemoryExcess> {
    POOL.take(need, cancel)
}

/// Bytes of memory of this machine, or the limit of the control group in which this process runs if that is smaller; `None` if the system
/// does not report it.
fn of_this_machine() -> Option<u64> {
    let mut system = sysinfo::System::new().ok()?;
    system.refresh_memory_specifics(sysinfo::MemoryRefreshKind::nothing().with_ram());
    let group = system.cgroup_limits().map(|group| group.total_memory);
    [Some(system.total_memory()), group].into_iter().flatten().filter(|bytes| *bytes > 0).min()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    fn of(bytes: u64) -> Need {
        Need { what: MemoryUse::Ring { elements: 3 }, bytes }
    }

    #[test]
    fn what_is_left_is_shared_and_what_is_too_much_is_refused() {
        let pool = Pool::new(Some(100));
        assert_eq!(pool.take(of(101), &Cancel::new()).unwrap_err(), MemoryExcess { need: of(101), allowed: 100 });
        let first = pool.take(of(60), &Cancel::new()).unwrap();
        let second = pool.take(of(40), &Cancel::new()).unwrap();
        assert_eq!(pool.lock().1, 100);
        std::thread::scope(|scope| {
            let (tell, told) = channel();
            scope.spawn({
                let pool = &pool;
                move || {
                    let _taken = pool.take(of(70), &Cancel::new()).unwrap();
                    tell.send(pool.lock().1).unwrap();
                }
            });
            // The second solve does not fit beside the first and begins once that has ended.
            drop(second);
            assert!(told.try_recv().is_err());
            drop(first);
            assert_eq!(told.recv(), Ok(70));
        });
        assert_eq!(pool.lock().1, 0);
    }

    #[test]
    fn whoever_waits_can_be_cancelled() {
        let pool = Pool::new(Some(100));
        let _first = pool.take(of(60), &Cancel::new()).unwrap();
        let cancel = Cancel::new();
        cancel.cancel();
        assert_eq!(pool.take(of(60), &cancel).unwrap().bytes(), 0);
    }

    #[test]
    fn the_machine_is_known_here() {
        let all = of_this_machine().unwrap();
        assert!((1 << 28..1 << 50).contains(&all), "{all}");
    }

    #[test]
    fn sizes_are_for_people() {
        assert_eq!(
            [350_000, 12_300_000, 1_240_000_000, 400_000_000_000].map(size),
            ["350 kB", "12 MB", "1.2 GB", "400 GB"]
        );
    }
}
