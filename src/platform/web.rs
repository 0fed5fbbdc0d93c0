//! A page in a browser, or one of its workers.
//!
//! There are no files. A file that the user opens or drops is kept in memory under its name, and files that are written become downloads.
//! There are no threads that share memory either, because they need HTTP headers that a plain file host does not send. [`worker`] sends bytes
//! to workers and back.

use js_sys::{Array, Uint8Array};
use std::cell::RefCell;
use std::collections::HashMap;
use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, BlobPropertyBag, HtmlAnchorElement, Url};

/// Whether there are files and folders. Without them the program offers what it writes as downloads, and reads only files that the user has
/// opened or dropped on the page.
pub const HAS_FILES: bool = false;

/// The words by which the window says where scenes are solved.
pub const SOLVED_HERE: &str = " in this browser";

/// The font of figures, reduced to the glyphs that texts of the program use.
pub fn liberation() -> &'static [u8] {
    include_bytes!("../../assets/fonts/reduced/LiberationSans-Regular.ttf")
}

/// DejaVu Sans, for glyphs that other fonts lack. It is reduced to the glyphs that texts of the program use, because a browser has to load it.
pub fn dejavu() -> &'static [u8] {
    include_bytes!("../../assets/fonts/reduced/DejaVuSans.ttf")
}

thread_local! {
    /// Files that the user has opened or dropped, under their names.
    static HANDED_OVER: RefCell<HashMap<PathBuf, Vec<u8>>> = RefCell::default();
    /// The names of those that have not been handled yet.
    static ARRIVED: RefCell<Vec<PathBuf>> = RefCell::default();
}

/// Calls `handler` at every Ctrl-C. On a page there is no Ctrl-C.
pub fn on_interrupt(_: impl FnMut() + Send + 'static) {}

/// Does work that may block. On a page nothing blocks, and it is done at once.
pub fn aside(_: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    work();
    Ok(())
}

/// The content of the file that the user has opened or dropped under this name.
pub fn handed_over(path: &Path) -> Option<Vec<u8>> {
    HANDED_OVER.with_borrow(|files| files.get(path).cloned())
}

/// Offers files as downloads: one file as it is, several in an archive with the name of their folder.
///
/// # Errors
/// The browser refuses, or an archive cannot be made.
pub fn hand_out(folder: &Path, files: Vec<(PathBuf, Vec<u8>)>) -> io::Result<()> {
    let (name, bytes) = match <[_; 1]>::try_from(files) {
        Ok([(path, bytes)]) => (path, bytes),
        Err(files) => {
            let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
            for (path, bytes) in files {
                let name = path.strip_prefix(folder).unwrap_or(&path).to_string_lossy().into_owned();
                archive.start_file(name, zip::write::SimpleFileOptions::default())?;
                archive.write_all(&bytes)?;
            }
            (folder.with_extension("zip"), archive.finish()?.into_inner())
        }
    };
    let name = name.file_name().unwrap_or(name.as_os_str()).to_string_lossy().into_owned();
    if web_sys::window().is_some() { download(&name, &bytes).map_err(refused) } else { worker::hand_out(&name, &bytes) }
}

fn refused(error: JsValue) -> io::Error {
    io::Error::other(format!("the browser refuses: {error:?}"))
}

fn download(name: &str, bytes: &[u8]) -> Result<(), JsValue> {
    let Some(document) = web_sys::window().and_then(|window| window.document()) else { return Ok(()) };
    let properties = BlobPropertyBag::new();
    properties.set_type("application/octet-stream");
    let parts = Array::of1(&Uint8Array::from(bytes));
    let url = Url::create_object_url_with_blob(&Blob::new_with_u8_array_sequence_and_options(&parts, &properties)?)?;
    let link: HtmlAnchorElement = document.create_element("a")?.unchecked_into();
    link.set_href(&url);
    link.set_download(name);
    link.click();
    Url::revoke_object_url(&url)
}

/// Workers. Each is another instance of this program, which receives work and sends back its result. Messages are bytes.
pub mod worker {
    use super::{Uint8Array, io, refused};
    use wasm_bindgen::prelude::Closure;
    use wasm_bindgen::{JsCast, JsValue};
    use web_sys::{DedicatedWorkerGlobalScope, ErrorEvent, MessageEvent, WorkerOptions, WorkerType};

    /// The script that begins a worker, beside the page.
    const SCRIPT: &str = "./worker.js";

    /// A message from a worker.
    #[derive(Debug)]
    pub enum News {
        /// A message, as bytes.
        Message(Vec<u8>),
        /// The worker has failed, and has stopped.
        Failed(String),
    }

    /// A worker. On drop it is ended at once.
    #[derive(Debug)]
    pub struct Worker {
        worker: web_sys::Worker,
        _message: Closure<dyn FnMut(MessageEvent)>,
        _error: Closure<dyn FnMut(ErrorEvent)>,
    }

    impl Worker {
        /// Starts a worker. `told` is called with everything that it sends.
        pub fn start(told: impl Fn(News) + Clone + 'static) -> io::Result<Self> {
            let options = WorkerOptions::new();
            options.set_type(WorkerType::Module);
            let worker = web_sys::Worker::new_with_options(SCRIPT, &options).map_err(refused)?;
            let failed = told.clone();
            let message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
                let data = event.data();
                if let Some(bytes) = data.dyn_ref::<Uint8Array>() {
                    told(News::Message(bytes.to_vec()));
                } else if let Some(text) = data.as_string() {
                    // Sent by the worker's panic hook.
                    told(News::Failed(text));
                } else if let Some(file) = data.dyn_ref::<js_sys::Array>() {
                    let (name, bytes) = (file.get(0).as_string(), file.get(1).dyn_into::<Uint8Array>());
                    if let (Some(name), Ok(bytes)) = (name, bytes) {
                        // If the browser refuses a download, it tells the user itself.
                        let _ = super::download(&name, &bytes.to_vec());
                    }
                }
            });
            let error = Closure::<dyn FnMut(ErrorEvent)>::new(move |event: ErrorEvent| {
                failed(News::Failed(event.message()));
            });
            worker.set_onmessage(Some(message.as_ref().unchecked_ref()));
            worker.set_onerror(Some(error.as_ref().unchecked_ref()));
            // The worker gets the program that the page has compiled.
            worker.post_message(&wasm_bindgen::module()).map_err(refused)?;
            Ok(Self { worker, _message: message, _error: error })
        }

        /// Sends it `bytes`.
        pub fn send(&self, bytes: &[u8]) -> io::Result<()> {
            self.worker.post_message(&Uint8Array::from(bytes)).map_err(refused)
        }
    }

    impl Drop for Worker {
        fn drop(&mut self) {
            self.worker.set_onmessage(None);
            self.worker.set_onerror(None);
            self.worker.terminate();
        }
    }

    /// In a worker: calls `asked` with every message of the page from now on.
    pub fn serve(mut asked: impl FnMut(Vec<u8>) + 'static) {
        let message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
            if let Ok(bytes) = event.data().dyn_into::<Uint8Array>() {
                asked(bytes.to_vec());
            }
        });
        here().set_onmessage(Some(message.as_ref().unchecked_ref()));
        // It lives as long as the worker.
        message.forget();
        std::panic::set_hook(Box::new(|panic| post(&JsValue::from_str(&panic.to_string()))));
    }

    /// In a worker: sends the page `bytes`.
    pub fn reply(bytes: &[u8]) {
        post(&Uint8Array::from(bytes));
    }

    /// In a worker: makes the page offer a file as a download.
    pub(super) fn hand_out(name: &str, bytes: &[u8]) -> io::Result<()> {
        post(&js_sys::Array::of2(&JsValue::from_str(name), &Uint8Array::from(bytes)));
        Ok(())
    }

    fn here() -> DedicatedWorkerGlobalScope {
        js_sys::global().unchecked_into()
    }

    fn post(message: &JsValue) {
        // If the page is gone, nobody receives the message.
        let _ = here().post_message(message);
    }
}

/// The window, which fills the page.
#[cfg(feature = "gui")]
pub mod window {
    use super::super::{DialogKind, FileDialog};
    use super::{ARRIVED, HANDED_OVER};
    use eframe::egui;
    use eframe::egui::accesskit::{Role, Toggled};
    use std::cell::RefCell;
    use std::collections::HashMap;
    use std::path::PathBuf;
    use wasm_bindgen::{JsCast, JsValue};
    use wasm_bindgen_futures::spawn_local;
    use web_sys::HtmlCanvasElement;

    /// The identifier of the canvas that the window is drawn on.
    const CANVAS: &str = "squeezefilm";

    thread_local! {
        static RUNNER: RefCell<Option<eframe::WebRunner>> = const { RefCell::new(None) };
        /// The tree for screen readers of the last frame, and its zoom factor.
        static SHOWN: RefCell<Option<(egui::accesskit::TreeUpdate, f64)>> = const { RefCell::new(None) };
        static RUN: RefCell<serde_json::Value> = const { RefCell::new(serde_json::Value::Null) };
    }

    /// Opens the window in the page. It keeps its state in the browser's storage. When the window is open, or cannot be opened, the page gets an
    /// event `squeezefilm`, whose detail is empty or the reason.
    pub fn run(_: Option<PathBuf>, start: eframe::AppCreator<'static>) -> Result<(), eframe::Error> {
        let document = web_sys::window().and_then(|window| window.document());
        let canvas =
            document.and_then(|document| document.get_element_by_id(CANVAS)?.dyn_into::<HtmlCanvasElement>().ok());
        let canvas = canvas.ok_or_else(|| eframe::Error::AppCreation("the page has no canvas".into()))?;
        spawn_local(async move {
            let runner = eframe::WebRunner::new();
            let options =
                eframe::WebOptions { renderer: eframe::Renderer::Glow, dithering: false, ..Default::default() };
            let started = runner.start(canvas, options, start).await;
            RUNNER.set(Some(runner));
            let why = started.err().map(|error| error.as_string().unwrap_or_else(|| format!("{error:?}")));
            say("squeezefilm", why.as_deref().unwrap_or_default());
        });
        Ok(())
    }

    fn say(name: &str, detail: &str) {
        let about = web_sys::CustomEventInit::new();
        about.set_detail(&JsValue::from_str(detail));
        if let (Some(window), Ok(event)) =
            (web_sys::window(), web_sys::CustomEvent::new_with_event_init_dict(name, &about))
        {
            // The result only says whether a listener cancelled the event, which has no effect.
            let _ = window.dispatch_event(&event);
        }
    }

    /// Whether the system prefers dark colours.
    pub fn prefers_dark() -> Option<bool> {
        let asked = web_sys::window()?.match_media("(prefers-color-scheme: dark)").ok()??;
        Some(asked.matches())
    }

    fn location() -> Option<web_sys::Location> {
        web_sys::window().map(|window| window.location())
    }

    /// The address that links begin with.
    pub fn page() -> String {
        let address = location().and_then(|location| location.href().ok()).unwrap_or_default();
        address.split('#').next().unwrap_or_default().to_owned()
    }

    /// The part of the page's address after `#`.
    pub fn fragment() -> String {
        location().and_then(|location| location.hash().ok()).unwrap_or_default()
    }

    /// The folder in which windows keep their state: `None`, because the browser has a storage of its own.
    pub fn storage_folder() -> Option<PathBuf> {
        None
    }

    fn arrive(name: PathBuf, bytes: Vec<u8>) {
        ARRIVED.with_borrow_mut(|arrived| arrived.push(name.clone()));
        HANDED_OVER.with_borrow_mut(|files| files.insert(name, bytes));
    }

    /// Files that were dropped on the page or chosen in a dialog, and that have been read.
    pub fn dropped(ctx: &egui::Context) -> Vec<PathBuf> {
        for file in ctx.input(|input| input.raw.dropped_files.clone()) {
            let ctx = ctx.clone();
            spawn_local(async move {
                if let Ok(bytes) = file.bytes_async().await {
                    arrive(file.path().to_owned(), bytes);
                    ctx.request_repaint();
                }
            });
        }
        ARRIVED.take()
    }

    /// Keeps the tree for screen readers for the page, where eframe does not use it.
    struct Mirror;

    impl egui::Plugin for Mirror {
        fn debug_name(&self) -> &'static str {
            "mirror"
        }

        fn setup(&mut self, ctx: &egui::Context) {
            ctx.enable_accesskit();
        }

        fn output_hook(&mut self, ctx: &egui::Context, output: &mut egui::FullOutput) {
            if let Some(tree) = output.platform_output.accesskit_update.take() {
                SHOWN.set(Some((tree, f64::from(ctx.zoom_factor()))));
            }
        }
    }

    /// Gives the page the content of the window, for screen readers, from now on.
    pub fn mirror(ctx: &egui::Context) {
        ctx.add_plugin(Mirror);
    }

    /// Gives the page the run on screen.
    pub fn publish(run: serde_json::Value) {
        RUN.set(run);
    }

    /// The content of the window as JSON: the run on screen, the element that has the keyboard focus, and all elements in reading order, each
    /// with its role, label, value, state and position \[CSS pixels\].
    pub fn told() -> String {
        let (focus, nodes) = SHOWN.with_borrow(|shown| {
            let Some((tree, zoom)) = shown else { return (None, Vec::new()) };
            let known: HashMap<_, _> = tree.nodes.iter().map(|(id, node)| (*id, node)).collect();
            let mut left: Vec<_> = tree.tree.iter().map(|tree| tree.root).collect();
            let mut told = Vec::new();
            while let Some(id) = left.pop() {
                // Lines of a text are left out, because the element around them has the whole text.
                let Some(node) = known.get(&id).filter(|node| node.role() != Role::TextRun) else { continue };
                left.extend(node.children().iter().rev());
                let said = |id| known.get(id).and_then(|node| node.label().or(node.value()));
                let label = node.label().or_else(|| node.labelled_by().iter().find_map(said));
                if label.is_some() || node.value().is_some() {
                    let place = node.bounds().map(|b| [b.x0, b.y0, b.x1, b.y1].map(|length| length * zoom));
                    told.push(serde_json::json!({
                        // A text, because a number in JavaScript has too few digits.
                        "id": id.0.to_string(),
                        "role": format!("{:?}", node.role()),
                        "label": label,
                        "value": node.value(),
                        "number": node.numeric_value(),
                        "range": [node.min_numeric_value(), node.max_numeric_value()],
                        "on": node.toggled().map(|toggled| toggled == Toggled::True),
                        "disabled": node.is_disabled(),
                        "box": place,
                    }));
                }
            }
            (Some(tree.focus.0.to_string()), told)
        });
        RUN.with_borrow(|run| serde_json::json!({ "run": run, "focus": focus, "nodes": nodes }).to_string())
    }

    /// The window over which file dialogs are shown.
    #[derive(Clone, Debug)]
    pub struct Parent(egui::Context);

    impl Parent {
        /// The page.
        pub fn of(context: &eframe::CreationContext<'_>) -> Self {
            Self(context.egui_ctx.clone())
        }

        /// The answer to a file dialog. Files that are written become downloads, and need no dialog. A file that is chosen arrives later, like
        /// one that is dropped on the page.
        pub fn ask(&self, dialog: &FileDialog<'_>) -> Option<PathBuf> {
            match dialog.asked {
                DialogKind::NewFile | DialogKind::Folder => Some(PathBuf::from(dialog.name)),
                DialogKind::File => {
                    let asked = rfd::AsyncFileDialog::new().set_title(dialog.title);
                    let asked = match dialog.filter {
                        Some((kind, extensions)) => asked.add_filter(kind, extensions),
                        None => asked,
                    };
                    let ctx = self.0.clone();
                    spawn_local(async move {
                        if let Some(file) = asked.pick_file().await {
                            arrive(PathBuf::from(file.file_name()), file.read().await);
                            ctx.request_repaint();
                        }
                    });
                    None
                }
            }
        }
    }
}
