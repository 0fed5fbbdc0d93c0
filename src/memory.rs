//! Memory: what a solve needs, known from its plan before anything is allocated, and what all solves of this process may take
//! at the same time.
//!
//! An estimate counts the arrays that grow with the grid, family by family, where they are greatest together.
//! `tests/memory_needs.rs` compares it with what is allocated. Whoever solves takes his share of the one budget first
//! ([`take`]): what is more than all of it is refused, what is more than is left waits for others to end, so that the results of
//! a sweep do not depend on how many threads share the budget. It is a quarter of the machine's memory unless [`allow`] says
//! otherwise, because results are kept, and drawn, beside it.

use crate::control::Cancel;
use crate::plan::{Grid, Plan};
use crate::problem::{Flow, Motor, Plate};
use std::fmt;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The budget is the machine's memory over this …
const SHARE: u64 = 4;
/// … or, where nothing is known of the machine, so many bytes.
const UNKNOWN: u64 = 1_000_000_000;
/// Bytes up to which grids are refined beyond those of the plan, and up to which the states that a solve ends with are kept to start
/// the next from. A constant, since either changes results, which are not to depend on the machine.
pub const REFINED: u64 = 256_000_000;
/// How often whoever waits looks whether it is cancelled.
const LOOK: Duration = Duration::from_millis(50);

/// What a solve needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Need {
    /// Film nodes of the finest grid along a tooth or plate …
    pub along: usize,
    /// … and across all of its width.
    pub across: usize,
    /// Time steps in a cycle.
    pub steps: usize,
    /// Teeth whose film is solved.
    pub teeth: usize,
    /// Bytes.
    pub bytes: u64,
}

/// More memory than is allowed. The message names the keys that it follows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Excess {
    /// What is needed.
    pub need: Need,
    /// What is allowed \[bytes\].
    pub allowed: u64,
}

impl fmt::Display for Excess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Need { along, across, steps, teeth, bytes } = self.need;
        let teeth = if teeth > 1 { format!(" on {teeth} teeth") } else { String::new() };
        write!(
            f,
            "{along} × {across} film nodes{teeth} and {steps} steps a cycle need {} of memory: allowed {}; lower \
             numerics.film_nodes_along, numerics.film_nodes_across or numerics.steps_per_cycle, or allow more with --memory",
            size(bytes),
            size(self.allowed)
        )
    }
}

impl std::error::Error for Excess {}

/// `1.2 GB`, `350 MB`: bytes for people.
pub fn size(bytes: u64) -> String {
    let (value, unit) = match bytes {
        0..1_000_000 => (bytes as f64 / 1e3, "kB"),
        1_000_000..1_000_000_000 => (bytes as f64 / 1e6, "MB"),
        _ => (bytes as f64 / 1e9, "GB"),
    };
    if value < 10.0 { format!("{value:.1} {unit}") } else { format!("{value:.0} {unit}") }
}

// ---- what is needed, in numbers of eight bytes

/// Nodes of one film.
struct Film {
    along: u64,
    nodes: u64,
    rows: u64,
    columns: u64,
}

impl Film {
    fn of_motor(plan: &Plan, grid: &Grid) -> Self {
        let (along, across) = (grid.along as u64, grid.across as u64);
        let (ny, columns) = match plan.flow {
            Flow::Along => (1, 1),
            _ if plan.half_width => (across + 1, across),
            _ => (2 * across + 1, 2 * across - 1),
        };
        Self { along: along + 1, nodes: (along + 1) * ny, rows: along - 1, columns }
    }

    fn of_plate(plate: &Plate, grid: &Grid) -> Self {
        let (along, across) = (grid.along as u64, grid.across as u64);
        let (ny, columns) = if plate.width.is_some() { (across + 1, across) } else { (1, 1) };
        Self { along: along + 1, nodes: (along + 1) * ny, rows: along, columns }
    }

    fn unknowns(&self) -> u64 {
        self.rows * self.columns
    }

    /// Inverses of the diagonal blocks of one linear solver, with its matrix across (`numerics::rows`).
    fn blocks(&self) -> u64 {
        (self.rows + 2) * self.columns * self.columns.next_multiple_of(4)
    }

    /// A step of the film (`film::stepper`): fields, right-hand side, Jacobian, blocks.
    fn step(&self) -> u64 {
        2 * self.nodes + 8 * self.unknowns() + self.blocks() + self.columns * self.columns
    }

    /// A cycle of the film (`film::cycle`): pressure of every step, averaged operator, its blocks; and the state.
    fn cycle(&self, steps: u64) -> u64 {
        steps * self.unknowns() + self.step() + self.blocks() + 8 * self.unknowns()
    }
}

/// Vectors of the unknowns that an acceleration of this depth keeps once it has gone on for as many rounds, its caller's two
/// included (`numerics::anderson`). Most solves end before.
fn accelerated(depth: u64) -> u64 {
    2 * depth + 4
}

/// The fields of a cycle (`recording`), in lines of the finest grid and in pressure maps: those that are kept, with what their
/// errors come from, and all of them while they are extrapolated.
const KEPT_LINES: u64 = 10;
const EXTRAPOLATED_LINES: u64 = 16;
/// What does not grow with the grid, and nodes across that are found wanting on the coarsest one.
const FIXED: u64 = 8192;
/// The same as `EXTRAPOLATED_LINES` of a motor, whose contact is integrated for its torque, on what its errors come from as well (`drive`).
const MOTOR_LINES: u64 = 40;
const EXTRAPOLATED_MAPS: u64 = 2;

/// All grids of a plan, those included to which it may be refined.
fn grids(plan: &Plan) -> Vec<Grid> {
    let grown = |grid: &Grid| if plan.spectral { (grid.across + 1).min(plan.most_across) } else { grid.across };
    let mut grids: Vec<Grid> = plan.grids.iter().map(|grid| Grid { across: grown(grid), ..*grid }).collect();
    while let Some(finest) = grids.last().filter(|_| grids.len() < plan.most_grids) {
        grids.push(finest.finer(plan.spectral));
    }
    grids
}

/// `plan`, refined no further than [`REFINED`] and the budget allow, whatever that leaves of its accuracy: of the grids that were
/// asked for there is none less.
pub fn within(mut plan: Plan, need: impl Fn(&Plan) -> Need) -> Plan {
    while plan.most_grids > plan.grids.len() && need(&plan).bytes > REFINED.min(allowed()) {
        plan.most_grids -= 1;
    }
    plan
}

/// One grid of a motor (`motor::level`).
fn level(motor: &Motor, plan: &Plan, grid: &Grid) -> u64 {
    let film = Film::of_motor(plan, grid);
    let (teeth, steps) = (motor.teeth as u64, grid.steps as u64);
    let (stored, instants) = if plan.every_tooth { (teeth, steps) } else { (1, steps / teeth) };
    let harmonics = plan.harmonics(grid) as u64;
    let nodes = teeth * film.along;
    let films = stored * film.cycle(steps) + if plan.trapped { film.step() + steps * film.unknowns() } else { 0 };
    let lines = (6 + u64::from(plan.shear)) * stored * steps * film.along;
    let stator = instants * nodes;
    let modes = 4 * harmonics * nodes + 8 * nodes;
    let shapes = 2 * harmonics * instants;
    films + lines + stator + modes + shapes
}

fn need(numbers: u64, (along, across, steps, teeth): (usize, usize, usize, usize)) -> Need {
    Need { along, across, steps, teeth, bytes: numbers * size_of::<f64>() as u64 }
}

fn of_motor(motor: &Motor, plan: &Plan, numbers: u64) -> Need {
    let Some(grid) = plan.grids.last() else { return need(0, (0, 0, 0, 0)) };
    let across = if plan.flow == Flow::Along { 1 } else { 2 * grid.across + 1 };
    let teeth = if plan.every_tooth { motor.teeth } else { 1 };
    need(numbers + FIXED, (grid.along + 1, across, grid.steps, teeth))
}

fn of_plate(plate: &Plate, plan: &Plan, numbers: u64) -> Need {
    let Some(grid) = plan.grids.last() else { return need(0, (0, 0, 0, 0)) };
    let across = if plate.width.is_some() { 2 * grid.across + 1 } else { 1 };
    need(numbers + FIXED, (2 * grid.along + 1, across, grid.steps, 1))
}

/// Of a motor's periodic state: all grids are kept to the end; beside them there is the acceleration of the finest, and then the
/// fields.
pub fn motor(motor: &Motor, plan: &Plan) -> Need {
    let grids = grids(plan);
    let levels: u64 = grids.iter().map(|grid| level(motor, plan, grid)).sum();
    let stored = if plan.every_tooth { motor.teeth as u64 } else { 1 };
    let beside = grids.last().map_or(0, |grid| {
        let (film, steps) = (Film::of_motor(plan, grid), grid.steps as u64);
        let unknowns = stored * (steps * film.rows + 2 * film.unknowns());
        let maps = if plan.maps { EXTRAPOLATED_MAPS * stored * steps * film.nodes } else { 0 };
        (accelerated(16) * unknowns).max(MOTOR_LINES * stored * steps * film.along + maps)
    });
    of_motor(motor, plan, levels + beside)
}

/// One grid of a plate (`plate`).
fn plate_level(plate: &Plate, plan: &Plan, grid: &Grid) -> u64 {
    let (film, steps) = (Film::of_plate(plate, grid), grid.steps as u64);
    film.cycle(steps) + 2 * steps * film.along + 3 * steps * plan.frames_per_step as u64
}

/// Of a plate's periodic state, likewise.
pub fn plate(plate: &Plate, plan: &Plan) -> Need {
    let grids = grids(plan);
    let levels: u64 = grids.iter().map(|grid| plate_level(plate, plan, grid)).sum();
    let beside = grids.last().map_or(0, |grid| {
        let (film, frames) = (Film::of_plate(plate, grid), (grid.steps * plan.frames_per_step) as u64);
        let maps = if plan.maps || plan.turned { EXTRAPOLATED_MAPS * frames * film.nodes } else { 0 };
        (accelerated(8) * 2 * film.unknowns()).max(EXTRAPOLATED_LINES * frames * film.along + maps)
    });
    of_plate(plate, plan, levels + beside)
}

/// Fields of a transient's cycle: those that are being made, and so many cycles that whoever asked for them keeps.
fn transient(film: &Film, stored: u64, steps: u64, maps: bool, kept: usize) -> u64 {
    let (lines, maps) = (stored * steps * film.along, if maps { stored * steps * film.nodes } else { 0 });
    3 * EXTRAPOLATED_LINES / 2 * lines + EXTRAPOLATED_MAPS * maps + kept as u64 * (KEPT_LINES * lines + maps)
}

/// Of a motor's transient from rest (`startup`), every tooth on all grids of the plan, of whose cycles so many are kept.
pub fn motor_startup(motor: &Motor, plan: &Plan, kept: usize) -> Need {
    let plan = Plan { every_tooth: true, trapped: false, ..plan.clone() };
    let levels: u64 = plan.grids.iter().map(|grid| level(motor, &plan, grid)).sum();
    let fields =
        |grid: &Grid| transient(&Film::of_motor(&plan, grid), motor.teeth as u64, grid.steps as u64, plan.maps, kept);
    of_motor(motor, &plan, levels + plan.grids.last().map_or(0, fields))
}

/// Of a plate's transient from rest, likewise.
pub fn plate_startup(plate: &Plate, plan: &Plan, kept: usize) -> Need {
    let plan = &plan.even_steps();
    let levels: u64 = plan.grids.iter().map(|grid| plate_level(plate, plan, grid)).sum();
    let fields = |grid: &Grid| transient(&Film::of_plate(plate, grid), 1, grid.steps as u64, plan.maps, kept);
    of_plate(plate, plan, levels + plan.grids.last().map_or(0, fields))
}

/// Of the paper's method, on so many film nodes along and across, contact spacings and steps: a recording of every tooth, films
/// and mesh of one instant, and the matrix of the nodes in contact.
pub fn paper(motor: &Motor, (along, across, contact, steps): (usize, usize, usize, usize)) -> Need {
    let teeth = motor.teeth as u64;
    let nodes = (along * across) as u64;
    let tops = teeth * ((contact as f64 * motor.tooth_width / motor.wavelength()) as u64 + 1);
    let recording = steps as u64 * (12 * tops + nodes);
    let instant = (4 * teeth + 5) * nodes + teeth * along as u64 * 10;
    need(recording + instant + tops * tops + 6 * contact as u64 + 20 * tops, (along, across, steps, motor.teeth))
}

// ---- what is allowed

/// What is left of a budget.
#[derive(Debug)]
struct Pool {
    /// Allowed, once it is known, and taken \[bytes\].
    state: Mutex<(Option<u64>, u64)>,
    freed: Condvar,
}

static POOL: Pool = Pool::new(None);

/// What a solve has taken of the budget; given back on drop.
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
        // Two numbers, never left half-changed.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn allowed(&self) -> u64 {
        *self.lock().0.get_or_insert_with(|| of_this_machine().map_or(UNKNOWN, |all| all / SHARE))
    }

    fn take(&self, need: Need, cancel: &Cancel) -> Result<Taken<'_>, Excess> {
        let bytes = self.check(need)?;
        let mut state = self.lock();
        while state.1.saturating_add(bytes) > state.0.unwrap_or(bytes) && state.1 > 0 {
            if cancel.is_cancelled() {
                // It ends at its first look at this.
                return Ok(Taken { pool: self, bytes: 0 });
            }
            state = self.freed.wait_timeout(state, LOOK).unwrap_or_else(PoisonError::into_inner).0;
        }
        state.1 += bytes;
        Ok(Taken { pool: self, bytes })
    }

    fn check(&self, need: Need) -> Result<u64, Excess> {
        let allowed = self.allowed();
        if need.bytes > allowed { Err(Excess { need, allowed }) } else { Ok(need.bytes) }
    }
}

/// Allows all solves of this process together so many bytes from now on.
pub fn allow(bytes: u64) {
    POOL.lock().0 = Some(bytes);
}

/// Bytes that all solves of this process may take together.
pub fn allowed() -> u64 {
    POOL.allowed()
}

/// Whether `need` is within what is allowed.
///
/// # Errors
/// [`Excess`] if it is not.
pub fn check(need: Need) -> Result<(), Excess> {
    POOL.check(need).map(|_| ())
}

/// Takes what a solve needs, as soon as others have left so much.
///
/// # Errors
/// [`Excess`] if it is more than all that is allowed.
pub fn take(need: Need, cancel: &Cancel) -> Result<Taken<'static>, Excess> {
    POOL.take(need, cancel)
}

/// Bytes of memory that this machine has, or that the group of processes in which this one runs may use; `None` where the system
/// does not tell.
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
        Need { along: 3, across: 5, steps: 8, teeth: 1, bytes }
    }

    #[test]
    fn what_is_left_is_shared_and_what_is_too_much_is_refused() {
        let pool = Pool::new(Some(100));
        assert_eq!(pool.take(of(101), &Cancel::new()).unwrap_err(), Excess { need: of(101), allowed: 100 });
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
            // It cannot begin beside the first, and begins once that has ended.
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
