//! Work that can be carried to where it is done: to a thread as it is, to a worker of a page as bytes.

use crate::control::Cancel;
use crate::problem::Problem;
use crate::scene::Scene;
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Work, with all that it needs.
pub trait Work: Serialize + DeserializeOwned + Send + 'static {
    /// What it is called.
    const NAME: &'static str;
    /// So many of its messages may wait to be taken; a thread that is further ahead waits, a worker does not.
    const AHEAD: Option<usize> = None;
    /// What it tells on the way.
    type Message: Serialize + DeserializeOwned + Send + 'static;
    /// What comes of it.
    type Found: Serialize + DeserializeOwned + Send + 'static;

    /// Does it. It looks at the flag, and sends messages through the function that it is given.
    fn run(self, cancel: &Cancel, tell: &(dyn Fn(Self::Message) + Sync)) -> Self::Found;

    /// What comes of it if it is ended before it has found anything.
    fn ended() -> Self::Found;
}

/// A scene and what it means. In bytes it is the scene as a file has it.
#[derive(Clone, Debug)]
pub struct Posed {
    /// What a person has edited.
    pub scene: Scene,
    /// The same, checked and in SI units.
    pub problem: Problem,
}

impl Serialize for Posed {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.scene.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Posed {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let scene = Scene::deserialize(from)?;
        let problem = Problem::new(&scene).map_err(Error::custom)?;
        Ok(Self { scene, problem })
    }
}

/// What is shared, in bytes: as what is owned.
pub(super) mod shared {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::sync::Arc;

    pub(in crate::job) fn serialize<T: Serialize, S: Serializer>(shared: &Arc<T>, to: S) -> Result<S::Ok, S::Error> {
        T::serialize(shared, to)
    }

    pub(in crate::job) fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Arc<T>, D::Error> {
        T::deserialize(from).map(Arc::new)
    }
}
