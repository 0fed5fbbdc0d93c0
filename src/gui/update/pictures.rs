//! Pictures of the window: taken, and written.

use super::updater::Updater;
use crate::gui::state::dialogs::Purpose;
use eframe::egui;
use std::path::Path;

/// What a picture is called at first.
pub(super) const PICTURE_NAME: &str = "squeezefilm.png";

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

    /// Asks for a file for each picture that was taken.
    pub(super) fn receive_pictures(&mut self) {
        while let Ok(picture) = self.pictures.1.try_recv() {
            self.picture = Some(picture);
            self.ask(Purpose::Screenshot, PICTURE_NAME);
        }
    }

    /// Writes the picture that was taken to this file.
    pub(super) fn write_picture(&mut self, path: &Path) {
        let Some(picture) = self.picture.take() else { return };
        if let Err(error) = write_png(&picture, path) {
            self.state.fail(format!("{}: the picture cannot be written: {error}", path.display()));
        }
    }
}

/// Writes a picture as PNG.
fn write_png(picture: &egui::ColorImage, path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let [width, height] = picture.size;
    let bytes: Vec<u8> = picture.pixels.iter().flat_map(|pixel| pixel.to_array()).collect();
    let buffer = image::RgbaImage::from_raw(width as u32, height as u32, bytes).ok_or("the picture is incomplete")?;
    let mut encoded = std::io::Cursor::new(Vec::new());
    buffer.write_to(&mut encoded, image::ImageFormat::Png)?;
    crate::atomic::write_file(path, |out| out.write_all(encoded.get_ref()))?;
    Ok(())
}
