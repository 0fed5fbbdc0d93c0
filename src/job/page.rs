//! The background solver of a page: a worker, which is sent one fidelity after the other.
//!
//! A request that comes while the worker solves waits until that fidelity is solved, because a new worker takes time to start, and has no
//! fields to start from. If this takes too long, the worker is ended, and a new one is started.

use super::line::Line;
use super::work::{Posed, Sent, Work};
use super::{Event, Request, SolvedScene, Timed, failure, solved};
use crate::control::{Cancel, Progress};
use crate::fidelity::Fidelity;
use crate::motor::Warm;
use crate::platform::Instant;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::{HashMap, VecDeque};
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

/// How long a newer request waits for the solve that is running: longer than a worker takes to start.
const PATIENCE: Duration = Duration::from_millis(150);

thread_local! {
    /// In the worker: the fields of the last solve of each fidelity, from which the next one starts, because a slider moves in small steps.
    static WARM: RefCell<HashMap<Fidelity, Warm>> = RefCell::default();
}

/// One fidelity of a request, as it is sent.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct RequestStep {
    posed: Posed,
    fidelity: Fidelity,
    budget: Option<Duration>,
}

impl Work for RequestStep {
    const NAME: &'static str = "solve";
    type Message = Progress;
    type Output = Timed;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(Progress) + Sync)) -> Result<Option<Self::Output>, String> {
        WARM.with_borrow_mut(|warm| {
            let warm = warm.entry(self.fidelity).or_default();
            let effort = (self.fidelity, self.budget);
            solved(&self.posed.problem, effort, Instant::now, warm, cancel, |progress| tell(*progress))
        })
    }
}

/// A request that is being solved.
#[derive(Debug)]
struct Running {
    number: u64,
    request: Request,
    /// The fidelity that the worker solves, and the time when it was sent.
    at: (Fidelity, Instant),
    /// The fidelities that follow.
    left: VecDeque<Fidelity>,
    history: Vec<Progress>,
}

/// The state that the page and the listener share.
struct Shared {
    line: Option<Line>,
    running: Option<Running>,
    waiting: Option<(u64, Request)>,
    events: Vec<Event>,
    now: fn() -> Instant,
    wake: Box<dyn Fn()>,
}

/// The worker and the way to it.
pub struct Solver {
    shared: Rc<RefCell<Shared>>,
    next: u64,
}

impl std::fmt::Debug for Solver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solver").field("next", &self.next).finish_non_exhaustive()
    }
}

impl Solver {
    /// Starts the worker. The clock `now` measures the solves; `wake` is called after every event.
    pub fn start(now: fn() -> Instant, wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let (line, events) = (Some(Line::open()?), Vec::new());
        let shared = Shared { line, running: None, waiting: None, events, now, wake: Box::new(wake) };
        Ok(Self { shared: Rc::new(RefCell::new(shared)), next: 0 })
    }

    /// Solves `request` instead of whatever is running or waiting. Returns its number.
    pub fn submit(&mut self, request: Request) -> u64 {
        self.next += 1;
        self.shared.borrow_mut().waiting = Some((self.next, request));
        advance(&self.shared);
        self.next
    }

    /// Cancels what is running and forgets what is waiting.
    pub fn cancel(&self) {
        let mut shared = self.shared.borrow_mut();
        shared.waiting = None;
        shared.end();
    }

    /// The events since the last call, in order.
    pub fn drain(&self) -> impl Iterator<Item = Event> {
        advance(&self.shared);
        std::mem::take(&mut self.shared.borrow_mut().events).into_iter()
    }
}

impl Shared {
    fn tell(&mut self, event: Event) {
        self.events.push(event);
        (self.wake)();
    }

    /// Ends what is running, and its worker.
    fn end(&mut self) {
        if let Some(Running { number, .. }) = self.running.take() {
            self.line = None;
            self.tell(Event::Done { number });
        }
    }
}

/// Starts the request that is waiting, if the one that is running is done or has taken too long.
fn advance(shared: &Rc<RefCell<Shared>>) {
    let mut this = shared.borrow_mut();
    if this.waiting.is_none() {
        return;
    }
    if let Some(running) = &this.running {
        if (this.now)().duration_since(running.at.1) < PATIENCE {
            // This is checked again at the next redraw.
            (this.wake)();
            return;
        }
        this.end();
    }
    let Some((number, request)) = this.waiting.take() else { return };
    let left: VecDeque<Fidelity> = request.fidelities.iter().copied().collect();
    let at = (left.front().copied().unwrap_or_default(), (this.now)());
    this.running = Some(Running { number, request, at, left, history: Vec::new() });
    drop(this);
    step(shared);
}

/// Sends the next fidelity of the running request to the worker, or reports that the request is done.
fn step(shared: &Rc<RefCell<Shared>>) {
    let mut this = shared.borrow_mut();
    let now = (this.now)();
    let newer = this.waiting.is_some();
    let Some(running) = &mut this.running else { return };
    let number = running.number;
    let next = running.left.pop_front().filter(|_| !newer);
    let Some(fidelity) = next else {
        this.running = None;
        this.tell(Event::Done { number });
        drop(this);
        return advance(shared);
    };
    (running.at, running.history) = ((fidelity, now), Vec::new());
    let work = RequestStep { posed: running.request.posed.clone(), fidelity, budget: running.request.budget };
    let theirs = Rc::downgrade(shared);
    let told = move |told| {
        if let Some(shared) = theirs.upgrade() {
            hear(&shared, number, told);
        }
    };
    let asked = match &this.line {
        Some(line) => line.ask(&work, told),
        None => Line::open().and_then(|line| this.line.insert(line).ask(&work, told)),
    };
    if let Err(error) = asked {
        this.running = None;
        this.tell(Event::Failed { number, message: format!("there is no worker that solves: {error}") });
        this.tell(Event::Done { number });
    }
}

/// Handles a message of the worker about request `number`.
fn hear(shared: &Rc<RefCell<Shared>>, number: u64, told: Result<Sent<Progress, Timed>, String>) {
    let mut this = shared.borrow_mut();
    let Some(running) = this.running.as_mut().filter(|running| running.number == number) else { return };
    let fidelity = running.at.0;
    let failed = |message| Event::Failed { number, message };
    match told {
        Ok(Sent::Message(progress)) => {
            running.history.push(progress);
            return this.tell(Event::Progress { number, fidelity, progress });
        }
        Ok(Sent::End(Ok(Some(timed)))) => {
            let history = std::mem::take(&mut running.history);
            let run = SolvedScene::of(number, running.request.posed.clone(), fidelity, timed, history);
            this.tell(Event::Solved(Arc::new(run)));
        }
        // A worker is ended when it is cancelled.
        Ok(Sent::End(Ok(None))) => running.left.clear(),
        Ok(Sent::End(Err(message))) => {
            running.left.clear();
            this.tell(failed(message));
        }
        Err(panic) => {
            running.left.clear();
            this.line = None;
            this.tell(failed(failure(fidelity, &panic)));
        }
    }
    drop(this);
    step(shared);
}
