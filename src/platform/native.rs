//! A process of an operating system.

use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Whether there are files and folders. Without them the program offers what it writes as downloads, and reads only files that the user has
/// opened or dropped on the page.
pub const HAS_FILES: bool = true;

/// The words by which the window says where scenes are solved; empty in a process.
pub const SOLVED_HERE: &str = "";

/// The font of figures: Liberation Sans 2.1.5. It has the widths of Arial and Helvetica, so that an SVG looks alike where only those are
/// installed.
pub fn liberation() -> &'static [u8] {
    static FONT: LazyLock<Vec<u8>> =
        LazyLock::new(|| unpacked(include_bytes!("../../assets/fonts/LiberationSans-Regular.ttf.gz")));
    &FONT
}

/// DejaVu Sans, for glyphs that other fonts lack. It has most alphabets, but no emoji.
pub fn dejavu() -> &'static [u8] {
    static FONT: LazyLock<Vec<u8>> = LazyLock::new(|| unpacked(include_bytes!("../../assets/fonts/DejaVuSans.ttf.gz")));
    &FONT
}

fn unpacked(packed: &[u8]) -> Vec<u8> {
    let mut font = Vec::new();
    // The fonts are built in, and a test unpacks them: there is no error here.
    let _ = flate2::read::GzDecoder::new(packed).read_to_end(&mut font);
    font
}

/// Calls `handler` at every Ctrl-C, and whenever the program is asked to end.
pub fn on_interrupt(handler: impl FnMut() + Send + 'static) {
    // If there can be no handler, Ctrl-C ends the program at once.
    let _ = ctrlc::set_handler(handler);
}

/// Does work that may block on a thread of its own.
pub fn aside(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    std::thread::Builder::new().name(format!("squeezefilm-{name}")).spawn(work).map(|_| ())
}

/// The content of the file that the user has opened or dropped under this name: `None` in a process, where files are read from disk.
pub fn handed_over(_: &Path) -> Option<Vec<u8>> {
    None
}

/// Offers files as downloads. This is an error in a process, where they are written to disk.
pub fn hand_out(_: &Path, _: Vec<(PathBuf, Vec<u8>)>) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// The window.
#[cfg(feature = "gui")]
pub mod window {
    use super::super::{DialogKind, FileDialog};
    use eframe::egui;
    use std::cell::Cell;
    use std::path::PathBuf;
    use std::rc::Rc;

    /// Opens the window and returns when it is closed. In the file `storage` it keeps its size and place; without one it keeps nothing.
    ///
    /// It is drawn by OpenGL. Where there is no OpenGL, it is drawn by Direct3D on Windows, and elsewhere by Vulkan or Metal if the feature
    /// `wgpu` is built in.
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
            // No dithering: it costs a software renderer much time, and the window has no gradients over many pixels.
            dithering: false,
            viewport: egui::ViewportBuilder::default()
                .with_title("squeezefilm")
                .with_app_id("squeezefilm")
                .with_icon(icon)
                .with_inner_size([1400.0, 900.0])
                // This fits on a screen of 1366 × 768 at 125 %, beside the bars of the system.
                .with_min_inner_size([800.0, 520.0])
                .with_drag_and_drop(true),
            persist_window: storage.is_some(),
            persistence_path: storage,
            // With the menu that winit makes on macOS, ⌘Q ends the program without a question. Without it ⌘Q is a shortcut of the window.
            #[cfg(target_os = "macos")]
            event_loop_builder: Some(Box::new(|builder| {
                use winit::platform::macos::EventLoopBuilderExtMacOS;
                builder.with_default_menu(false);
            })),
            ..Default::default()
        }
    }

    /// Makes glibc keep the memory that a redraw frees for the next redraw. By default it returns the end of the heap to the system whenever
    /// 128 kB there are free, which happens dozens of times in a redraw; the system then has to map every page again, which takes a sixth of the
    /// time with software rendering. Freeing a large block raises this limit to twice its size (`mallopt`, dynamic threshold), for blocks of up
    /// to 32 MiB. The memory of the block is never touched.
    fn keep_freed_memory() {
        drop(std::hint::black_box(Vec::<u8>::with_capacity(31 << 20)));
    }

    /// Whether the system prefers dark colours: `None`, because a process does not ask. The first window is dark, later ones are as the last one
    /// was.
    pub fn prefers_dark() -> Option<bool> {
        None
    }

    /// The address that links begin with: empty, because there is no page.
    pub fn page() -> String {
        String::new()
    }

    /// The part of the page's address after `#`: empty, because there is no page.
    pub fn fragment() -> String {
        String::new()
    }

    /// The folder in which windows keep their state.
    pub fn storage_folder() -> Option<PathBuf> {
        eframe::storage_dir("squeezefilm")
    }

    /// Files dropped on the window.
    pub fn dropped(ctx: &egui::Context) -> Vec<PathBuf> {
        let paths = ctx.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect());
        let paths: Vec<PathBuf> = paths;
        paths.into_iter().filter(|path| !path.as_os_str().is_empty()).collect()
    }

    /// Gives the page the content of the window, for screen readers. In a process the system does this.
    pub fn mirror(_: &egui::Context) {}

    /// Gives the page the run on screen. In a process there is no page.
    pub fn publish(_: serde_json::Value) {}

    /// The window over which file dialogs are shown.
    #[derive(Clone, Debug)]
    pub struct Parent(rfd::FileDialog);

    impl Parent {
        /// That of a new window.
        pub fn of(context: &eframe::CreationContext<'_>) -> Self {
            Self(rfd::FileDialog::new().set_parent(context))
        }

        /// Shows the system's own dialog, and blocks until there is an answer. `None` if the dialog was closed, or if there is none.
        pub fn ask(&self, dialog: &FileDialog<'_>) -> Option<PathBuf> {
            let native = self.0.clone().set_title(dialog.title);
            let native = match dialog.filter {
                Some((kind, extensions)) => native.add_filter(kind, extensions),
                None => native,
            };
            match dialog.asked {
                DialogKind::File => native.pick_file(),
                DialogKind::Folder => native.pick_folder(),
                DialogKind::NewFile => native.set_file_name(dialog.name).save_file(),
            }
        }
    }
}
