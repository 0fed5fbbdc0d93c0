//! The worker of a page: it receives work with its name, does it, and sends back messages and the result.

use super::drop::Dropping;
use super::export::Files;
use super::face::Heights;
use super::fit::Asked;
use super::line::{end, message};
use super::page::Step;
use super::pin::Compared;
use super::rotor::Alone;
use super::sensitivity::{Derivatives, Draws};
use super::startup::FromRest;
use super::sweep::Points;
use super::torque::Curves;
use super::tradeoff::Measurement;
use super::work::Work;
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
    (Step::NAME, run::<Step>),
    (Compared::NAME, run::<Compared>),
    (Curves::NAME, run::<Curves>),
    (FromRest::NAME, run::<FromRest>),
    (Dropping::NAME, run::<Dropping>),
    (Points::NAME, run::<Points>),
    (Measurement::NAME, run::<Measurement>),
    (Alone::NAME, run::<Alone>),
    (Asked::NAME, run::<Asked>),
    (Derivatives::NAME, run::<Derivatives>),
    (Draws::NAME, run::<Draws>),
    (Files::NAME, run::<Files>),
    (Heights::NAME, run::<Heights>),
];

fn run<W: Work>(bytes: &[u8]) {
    match postcard::from_bytes::<W>(bytes) {
        Ok(work) => {
            let found = work.run(&Cancel::new(), &|told| message(&told).iter().for_each(|bytes| reply(bytes)));
            end(&found).iter().for_each(|bytes| reply(bytes));
        }
        // The page receives the text as that of any panic.
        Err(error) => std::panic::panic_any(error.to_string()),
    }
}
