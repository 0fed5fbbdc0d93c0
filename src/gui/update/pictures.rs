//! Takes and writes pictures of the window.

use super::updater::Updater;
use crate::gui::state::dialogs::{self, Purpose};
use crate::job::export::{Content, Files, Picture};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

impl Updater {
    pub(super) fn take_picture(&self) {
        let (sender, wake) = (self.pictures.0.clone(), self.ctx.clone());
        self.ctx.request_screenshot(move |image| {
            // The window may be closed by now; then the picture is dropped.
            let _ = sender.send(image);
            wake.request_repaint();
        });
    }

    /// Asks for a file for each picture that was taken, and reports the outcome of those that were written.
    pub(super) fn receive_pictures(&mut self) {
        while let Ok(image) = self.pictures.1.try_recv() {
            let size = image.size.map(|pixels| pixels as u32);
            let rgb = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
            self.ask(Purpose::Picture(Picture { size, rgb: Arc::new(rgb) }));
        }
        let now = self.now();
        let Self { writing, state, .. } = self;
        writing.retain(|task| {
            match task.drain().end {
                None => return true,
                Some(Ok(paths)) => paths.into_iter().for_each(|paths| state.exports.written = Some((paths, now))),
                Some(Err(error)) => state.fail(error),
            }
            false
        });
    }

    pub(super) fn write_picture(&mut self, picture: Picture, path: &Path) {
        let path = match dialogs::complete(path.to_owned(), "picture of the window", &["png"]) {
            Ok(path) => path,
            Err(reason) => return self.fail_at(Purpose::Picture(picture), path, reason),
        };
        let work = Files { path, content: Content::Picture(picture) };
        let task = self.start_work("The picture cannot be written", work, Duration::ZERO);
        self.writing.extend(task);
    }
}
