//! A motor from its data sheet, in the background: a few solves find its friction and its amplitude.

use super::work::Work;
use crate::analysis::data_sheet::agreeing;
use crate::control::Cancel;
use crate::scene::Scene;
use crate::scene::new_motor::Answers;
use serde::{Deserialize, Serialize};

/// The answers to the questions about it, as they are sent to the thread or worker that makes it.
#[derive(Debug, Serialize, Deserialize)]
pub struct NewMotorWork(pub Answers);

impl Work for NewMotorWork {
    const NAME: &'static str = "new-motor";
    type Message = ();
    type Output = Scene;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        agreeing(&self.0, cancel).map(|motor| Some(motor.scene))
    }
}
