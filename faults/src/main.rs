//! Faults planted in a copy of the source, to see which of them the tests notice. They are of the kinds of cargo-mutants: an operator in
//! place of another, a sign or a negation left out, a function that does nothing but return a constant. cargo-mutants builds the tests anew
//! for each; here all are built into one program at once, and the variable `FAULT` says which of them is there.
//!
//! ```text
//! faults plant SHARE SEED TREE LEFT_OUT FILE…    plants a random share of all faults in files of TREE, but for the numbers in LEFT_OUT; prints them
//! faults try TREE LIST TESTS                     runs the tests, one executable a line, with each fault of the list; prints what became of it
//! ```
//!
//! `faults/run` does all of it.

mod attempt;
mod plant;

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["plant", share, seed, tree, left_out, files @ ..] => {
            plant::plant(share.parse()?, seed.parse()?, tree, left_out, files)
        }
        ["try", tree, list, tests] => attempt::all(tree, list, tests),
        _ => Err("usage: faults plant SHARE SEED TREE LEFT_OUT FILE… | faults try TREE LIST TESTS".into()),
    }
}
