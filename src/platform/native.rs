//! A process of an operating system.

use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Whether there are files and folders. Without them what is written is handed to the user, and what is read was handed over by the user.
pub const HAS_FILES: bool = true;

/// Where it is solved, as the window says it: nothing, in a process.
pub const SOLVED_HERE: &str = "";

/// The font of figures: Liberation Sans 2.1.5, with the widths of Arial and Helvetica, so that an SVG looks alike where only those are.
pub fn liberation() -> &'static [u8] {
    static FONT: LazyLock<Vec<u8>> =
        LazyLock::new(|| unpacked(include_bytes!("../../assets/fonts/LiberationSans-Regular.ttf.gz")));
    &FONT
}

/// DejaVu Sans, for the glyphs that other fonts lack: most alphabets, but no pictures (emoji).
pub fn dejavu() -> &'static [u8] {
    static FONT: LazyLock<Vec<u8>> = LazyLock::new(|| unpacked(include_bytes!("../../assets/fonts/DejaVuSans.ttf.gz")));
    &FONT
}

fn unpacked(packed: &[u8]) -> Vec<u8> {
    let mut font = Vec::new();
    // What is built in can be unpacked: a test does.
    let _ = flate2::read::GzDecoder::new(packed).read_to_end(&mut font);
    font
}

/// Calls `handler` at every Ctrl-C, and whenever the program is asked to end.
pub fn on_interrupt(handler: impl FnMut() + Send + 'static) {
    // Without a handler Ctrl-C ends the program at once, which is all that would be lost.
    let _ = ctrlc::set_handler(handler);
}

/// Does what may block, on a thread of its own.
///
/// # Errors
/// If no thread can be started.
pub fn aside(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    std::thread::Builder::new().name(format!("squeezefilm-{name}")).spawn(work).map(|_| ())
}

/// What the user has handed over under this name: never anything where there are files.
pub fn handed_over(_: &Path) -> Option<Vec<u8>> {
    None
}

/// Hands files to the user: not needed where they can be written.
pub fn hand_out(_: &Path, _: Vec<(PathBuf, Vec<u8>)>) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// The window.
#[cfg(feature = "gui")]
pub mod window {
    use super::super::{Asked, FileDialog};
    use eframe::egui;
    use std::cell::Cell;
    use std::path::PathBuf;
    use std::rc::Rc;

    /// Opens the window and returns when it is closed. `storage`: the file in which it keeps what the next one begins with.
    ///
    /// It is drawn by OpenGL; where that is refused, by what else there is: on Windows, and where the feature `wgpu` is built in.
    ///
    /// # Errors
    /// If there is no display, or no way to draw on it.
    pub fn run(storage: Option<PathBuf>, start: eframe::AppCreator<'static>) -> Result<(), eframe::Error> {
        keep_freed_memory();
        let start = Rc::new(Cell::new(Some(start)));
        let open = |renderer| {
            let start = Rc::clone(&start);
            let once = move |context: &eframe::CreationContext<'_>| {
                start.take().ok_or("the window was opened already")?(context)
            };
            eframe::run_native("squeezefilm", options(storage.clone(), renderer), Box::new(once))
        };
        let opened = open(eframe::Renderer::Glow);
        #[cfg(any(windows, feature = "wgpu"))]
        let opened = opened.or_else(|no_opengl| {
            let Some(unused) = start.take() else { return Err(no_opengl) };
            start.set(Some(unused));
            open(eframe::Renderer::Wgpu).map_err(|_| no_opengl)
        });
        opened
    }

    fn options(storage: Option<PathBuf>, renderer: eframe::Renderer) -> eframe::NativeOptions {
        let icon = eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).unwrap_or_default();
        eframe::NativeOptions {
            renderer,
            // Costs a software renderer more than it is worth: nothing in here is a gradient over many pixels.
            dithering: false,
            viewport: egui::ViewportBuilder::default()
                .with_title("squeezefilm")
                .with_app_id("squeezefilm")
                .with_icon(icon)
                .with_inner_size([1400.0, 900.0])
                // Fits a screen of 1366 × 768 at 125 %, with its bars.
                .with_min_inner_size([800.0, 520.0])
                .with_drag_and_drop(true),
            persistence_path: storage,
            // The menu that winit makes on macOS ends the program at ⌘Q and asks nobody: without it ⌘Q is a shortcut of the window.
            #[cfg(target_os = "macos")]
            event_loop_builder: Some(Box::new(|builder| {
                use winit::platform::macos::EventLoopBuilderExtMacOS;
                builder.with_default_menu(false);
            })),
            ..Default::default()
        }
    }

    /// Has glibc keep what a redraw frees for the next one. It gives the end of the heap back to the system whenever 128 kB of it are free,
    /// dozens of times in a redraw, and every page of it is then paid for again: with software rendering a sixth of all time. A large piece that is
    /// freed raises that limit to twice its size (`mallopt`, dynamic threshold); the largest that does is 32 MiB. None of it is ever touched.
    fn keep_freed_memory() {
        drop(std::hint::black_box(Vec::<u8>::with_capacity(31 << 20)));
    }

    /// Whether the system asks for dark colours, if what that is is asked at all: a window begins dark, and stays as it was left.
    pub fn prefers_dark() -> Option<bool> {
        None
    }

    /// The address that links begin with: none, there is no page.
    pub fn page() -> String {
        String::new()
    }

    /// What follows the `#` of the page's address.
    pub fn fragment() -> String {
        String::new()
    }

    /// The folder for what windows keep.
    pub fn storage_folder() -> Option<PathBuf> {
        eframe::storage_dir("squeezefilm")
    }

    /// Files dropped on the window.
    pub fn dropped(ctx: &egui::Context) -> Vec<PathBuf> {
        let paths = ctx.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect());
        let paths: Vec<PathBuf> = paths;
        paths.into_iter().filter(|path| !path.as_os_str().is_empty()).collect()
    }

    /// Tells the page what is shown: there is none, and screen readers are told by the system.
    pub fn mirror(_: &egui::Context) {}

    /// Tells the page of the run on screen: there is none.
    pub fn publish(_: serde_json::Value) {}

    /// What file dialogs are shown over.
    #[derive(Clone, Debug)]
    pub struct Parent(rfd::FileDialog);

    impl Parent {
        /// The window.
        pub fn of(context: &eframe::CreationContext<'_>) -> Self {
            Self(rfd::FileDialog::new().set_parent(context))
        }

        /// Shows the system's own dialog; blocks until there is an answer. `None`: it was closed, or there is none.
        pub fn ask(&self, dialog: &FileDialog<'_>) -> Option<PathBuf> {
            let native = self.0.clone().set_title(dialog.title);
            let native = match dialog.filter {
                Some((kind, extensions)) => native.add_filter(kind, extensions),
                None => native,
            };
            match dialog.asked {
                Asked::File => native.pick_file(),
                Asked::Folder => native.pick_folder(),
                Asked::NewFile => native.set_file_name(dialog.name).save_file(),
            }
        }
    }
}
