//! Memory that a solve needs, estimated from its plan before anything is allocated.
//!
//! An estimate adds up the arrays that grow with the grid, at the moment when their total is largest. `tests/memory_needs.rs` compares it
//! with the memory that is actually allocated.

use crate::budget::MemoryUse;
pub use crate::budget::{MemoryExcess, Need, Taken, allow, allowed, check, size, take};
use crate::ladder::EXACTING;
use crate::numerics::system::MANY_COLUMNS;
use crate::plan::{Grid, Plan};
use crate::problem::{Flow, Motor, Plate};

/// Bytes up to which grids are refined beyond those of the plan, and up to which the final states of a solve are kept as a start for the
/// next one. It is a constant because both affect results, which must not depend on the machine.
pub const REFINED: u64 = 256_000_000;

// Below, memory is counted in numbers of eight bytes; only the public needs are in bytes.

/// Nodes of one film.
struct Film {
    along: u64,
    nodes: u64,
    rows: u64,
    columns: u64,
    /// Whether it is solved line by line.
    lines: bool,
}

impl Film {
    fn of_motor(plan: &Plan, grid: &Grid) -> Self {
        let (along, across) = (grid.along as u64, grid.across as u64);
        let (ny, columns) = match plan.flow {
            Flow::Along => (1, 1),
            _ if plan.half_width => (across + 1, across),
            _ => (2 * across + 1, 2 * across - 1),
        };
        Self { along: along + 1, nodes: (along + 1) * ny, rows: along - 1, columns, lines: lines(plan, columns) }
    }

    fn of_plate(plate: &Plate, plan: &Plan, grid: &Grid) -> Self {
        let halves = if plate.hole.is_some_and(|hole| hole > 0.0) { 2 } else { 1 };
        let (along, across) = (halves * grid.along as u64, grid.across as u64);
        let (ny, columns) = if plate.width.is_some() { (across + 1, across) } else { (1, 1) };
        Self { along: along + 1, nodes: (along + 1) * ny, rows: along, columns, lines: lines(plan, columns) }
    }

    fn unknowns(&self) -> u64 {
        self.rows * self.columns
    }

    /// One linear solver: inverses of the diagonal blocks and its matrix across (`numerics::rows`), or the lines of its levels
    /// (`numerics::lines`).
    fn blocks(&self) -> u64 {
        if self.lines {
            18 * self.unknowns()
        } else {
            (self.rows + 2) * self.columns * self.columns.next_multiple_of(4)
        }
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

/// Whether a film with so many unknown nodes across is solved line by line.
fn lines(plan: &Plan, columns: u64) -> bool {
    !plan.spectral && columns >= MANY_COLUMNS as u64
}

/// Number of vectors of unknowns that an acceleration of this depth keeps once as many rounds are done, including the two of its caller
/// (`numerics::anderson`). Most solves end before that.
fn accelerated(depth: u64) -> u64 {
    2 * depth + 4
}

/// The fields of a cycle (`recording`), as a number of lines of the finest grid and of pressure maps: those that are kept, with the
/// yardsticks of their errors, and the total while they are extrapolated.
const KEPT_LINES: u64 = 10;
const EXTRAPOLATED_LINES: u64 = 16;
/// Numbers that do not grow with the grid, including those of the coarsest grid with one node fewer across.
const FIXED: u64 = 8192;
/// As `EXTRAPOLATED_LINES`, for a motor: its torque and the error of its torque are integrals of the contact on several grids (`drive`).
const MOTOR_LINES: u64 = 40;
const EXTRAPOLATED_MAPS: u64 = 2;

/// All grids of a plan, including those to which it may be refined.
fn grids(plan: &Plan) -> Vec<Grid> {
    let more = 1 + usize::from(plan.target_error < EXACTING);
    let grown = |grid: &Grid| if plan.spectral { (grid.across + more).min(plan.most_across) } else { grid.across };
    let mut grids: Vec<Grid> = plan.grids.iter().map(|grid| Grid { across: grown(grid), ..*grid }).collect();
    while let Some(finest) = grids.last().filter(|_| grids.len() < plan.most_grids) {
        grids.push(finest.finer(plan.spectral));
    }
    grids
}

/// `plan`, with no more additional grids than [`REFINED`] and the budget allow, even if its accuracy suffers; the grids of the plan itself
/// are all kept.
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
    // Matrices of a Newton step: the equations, their factors, and their parts.
    let matrices = 3 * nodes.min(2 * harmonics).pow(2);
    let shapes = 2 * harmonics * instants;
    films + lines + stator + modes + matrices + shapes
}

fn need(numbers: u64, (along, across, steps, teeth): (usize, usize, usize, usize)) -> Need {
    Need { what: MemoryUse::Film { along, across, steps, teeth }, bytes: numbers * size_of::<f64>() as u64 }
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

/// Memory that a motor's periodic state needs: all its grids, and beside them the larger of the acceleration's history on the
/// finest grid and the recorded fields.
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
    let (film, steps) = (Film::of_plate(plate, plan, grid), grid.steps as u64);
    film.cycle(steps) + 2 * steps * film.along + 3 * steps * plan.frames_per_step as u64
}

/// Memory that a plate's periodic state needs, likewise.
pub fn plate(plate: &Plate, plan: &Plan) -> Need {
    let grids = grids(plan);
    let levels: u64 = grids.iter().map(|grid| plate_level(plate, plan, grid)).sum();
    let beside = grids.last().map_or(0, |grid| {
        let (film, frames) = (Film::of_plate(plate, plan, grid), (grid.steps * plan.frames_per_step) as u64);
        let maps = if plan.maps || plan.turned { EXTRAPOLATED_MAPS * frames * film.nodes } else { 0 };
        (accelerated(8) * 2 * film.unknowns()).max(EXTRAPOLATED_LINES * frames * film.along + maps)
    });
    of_plate(plate, plan, levels + beside)
}

/// Fields of a transient's cycle: those in progress, and the number of cycles that the caller keeps.
fn transient(film: &Film, stored: u64, steps: u64, maps: bool, kept: usize) -> u64 {
    let (lines, maps) = (stored * steps * film.along, if maps { stored * steps * film.nodes } else { 0 });
    3 * EXTRAPOLATED_LINES / 2 * lines + EXTRAPOLATED_MAPS * maps + kept as u64 * (KEPT_LINES * lines + maps)
}

/// Memory that a motor's transient from rest (`startup`) needs: every tooth on all grids of the plan, and the `kept` cycles.
pub fn motor_startup(motor: &Motor, plan: &Plan, kept: usize) -> Need {
    let plan = Plan { every_tooth: true, trapped: false, ..plan.clone() };
    let levels: u64 = plan.grids.iter().map(|grid| level(motor, &plan, grid)).sum();
    let fields =
        |grid: &Grid| transient(&Film::of_motor(&plan, grid), motor.teeth as u64, grid.steps as u64, plan.maps, kept);
    of_motor(motor, &plan, levels + plan.grids.last().map_or(0, fields))
}

/// Memory that a plate's transient from rest needs, likewise.
pub fn plate_startup(plate: &Plate, plan: &Plan, kept: usize) -> Need {
    let plan = &plan.even_steps();
    let levels: u64 = plan.grids.iter().map(|grid| plate_level(plate, plan, grid)).sum();
    let fields = |grid: &Grid| transient(&Film::of_plate(plate, plan, grid), 1, grid.steps as u64, plan.maps, kept);
    of_plate(plate, plan, levels + plan.grids.last().map_or(0, fields))
}

/// Memory that the paper's method needs, on so many film nodes along and across, contact spacings and steps: a recording of
/// every tooth, films and mesh of one instant, and the matrix of the nodes in contact.
pub fn paper(motor: &Motor, (along, across, contact, steps): (usize, usize, usize, usize)) -> Need {
    let teeth = motor.teeth as u64;
    let nodes = (along * across) as u64;
    let tops = teeth * ((contact as f64 * motor.tooth_width / motor.wavelength()) as u64 + 1);
    let recording = steps as u64 * (12 * tops + nodes);
    let instant = (4 * teeth + 5) * nodes + teeth * along as u64 * 10;
    need(recording + instant + tops * tops + 6 * contact as u64 + 20 * tops, (along, across, steps, motor.teeth))
}
