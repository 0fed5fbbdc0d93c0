//! The worker of a page: it receives work with its name, does it, and sends back messages and the result.

use super::export::Files;
use super::fit::FitWork;
use super::page::RequestStep;
use super::sensitivity::{Derivatives, Draws};
use super::single::{FaceWork, NewMotorWork, PinWork, RotorWork, TorqueWork};
use super::sweep::SweepWork;
use super::tradeoff::TradeoffWork;
use super::transient::{DropWork, StartupWork};
use super::work::{Sent, Work};
use crate::control::Cancel;
use crate::platform::worker::{reply, serve};

/// Does the work that the page sends, from now on.
pub fn start() {
    serve(|asked| {
        let Some(line) = asked.iter().position(|byte| *byte == b'\n') else { return };
        let (name, work) = (&asked[..line], &asked[line + 1..]);
        for (known, run) in WORKS {
            if known.as_bytes() == name {
                run(work);
            }
        }
    });
}

type Serve = fn(&[u8]);

/// All kinds of work that a worker can do.
const WORKS: &[(&str, Serve)] = &[
    (RequestStep::NAME, run::<RequestStep>),
    (PinWork::NAME, run::<PinWork>),
    (TorqueWork::NAME, run::<TorqueWork>),
    (StartupWork::NAME, run::<StartupWork>),
    (DropWork::NAME, run::<DropWork>),
    (SweepWork::NAME, run::<SweepWork>),
    (TradeoffWork::NAME, run::<TradeoffWork>),
    (RotorWork::NAME, run::<RotorWork>),
    (FitWork::NAME, run::<FitWork>),
    (Derivatives::NAME, run::<Derivatives>),
    (Draws::NAME, run::<Draws>),
    (Files::NAME, run::<Files>),
    (FaceWork::NAME, run::<FaceWork>),
    (NewMotorWork::NAME, run::<NewMotorWork>),
];

fn run<W: Work>(bytes: &[u8]) {
    match postcard::from_bytes::<W>(bytes) {
        Ok(work) => {
            let send = |sent: Sent<W::Message, W::Output>| {
                postcard::to_stdvec(&sent).iter().for_each(|bytes| reply(bytes));
            };
            let found = work.run(&Cancel::new(), &|told| send(Sent::Message(told)));
            send(Sent::End(found));
        }
        // The page receives the text as that of any panic.
        Err(error) => std::panic::panic_any(error.to_string()),
    }
}
