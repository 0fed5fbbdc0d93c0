//! Pictures of the window: taken, and written.

use super::updater::Updater;
use crate::atomic::write_file;
use crate::gui::state::dialogs::{Picture, Purpose};
use crate::job::task::Task;
use std::io::Cursor;
use std::path::Path;
use std::time::Duration;

impl Updater {
    /// Takes a picture of the next frame.
    pub(super) fn take_picture(&self) {
        let (sender, wake) = (self.pictures.0.clone(), self.ctx.clone());
        self.ctx.request_screenshot(move |image| {
            // The window may be gone by now: then there is nobody to show it to.
            let _ = sender.send(image);
            wake.request_repaint();
        });
    }

    /// Asks for a file for each picture that was taken, and says what became of those that were written.
    pub(super) fn receive_pictures(&mut self) {
        while let Ok(image) = self.pictures.1.try_recv() {
            let rgba = image.pixels.iter().flat_map(|pixel| pixel.to_array()).collect();
            self.ask(Purpose::Picture(Picture { size: image.size, rgba }), Picture::FILE_NAME);
        }
        let mut failed = None;
        self.writing.retain(|task| {
            let end = task.drain().end;
            let running = end.is_none();
            failed = end.and_then(|end| end.and_then(|written| written).err()).or(failed.take());
            running
        });
        failed.into_iter().for_each(|error| self.state.fail(error));
    }

    /// Writes a picture to this file.
    pub(super) fn write_picture(&mut self, picture: Picture, path: &Path) {
        let path = match Picture::complete(path) {
            Ok(path) => path,
            Err(reason) => return self.state.fail(reason),
        };
        let task = Task::start("picture", self.wake(Duration::ZERO), move |_, _: &(dyn Fn(()) + Sync)| {
            write_png(&picture, &path).map_err(|error| error.to_string())
        });
        match task {
            Ok(task) => self.writing.push(task),
            Err(error) => self.state.fail(format!("The picture cannot be written: {error}")),
        }
    }
}

fn write_png(picture: &Picture, path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let [width, height] = picture.size.map(|pixels| pixels as u32);
    let mut encoded = Cursor::new(Vec::new());
    let buffer = image::ImageBuffer::<image::Rgba<u8>, _>::from_raw(width, height, &picture.rgba[..])
        .ok_or("the picture is incomplete")?;
    buffer.write_to(&mut encoded, image::ImageFormat::Png)?;
    Ok(write_file(path, |out| out.write_all(encoded.get_ref()))?)
}
