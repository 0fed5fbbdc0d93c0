// Loads the program, shows how far that is, and opens the window. Says in words what a browser lacks.
import init, { open, told } from "./squeezefilm.js";
import { mirror } from "./mirror.js";
import unpacker, { unpack } from "./unpack.js";

const size = "PROGRAM_BYTES"; // a number once it is built
const message = document.getElementById("message");
const progress = document.getElementById("progress");

function stop(why) {
  progress.hidden = true;
  message.textContent = why;
}

// The program: loaded, unpacked and compiled.
async function program() {
  const ready = unpacker();
  const answer = await fetch("./squeezefilm.bin");
  if (!answer.ok) throw new Error(`the program cannot be loaded: ${answer.status} ${answer.statusText}`);
  const packed = new Uint8Array(size);
  let loaded = 0;
  for (const reader = answer.body.getReader(); ;) {
    const { done, value } = await reader.read();
    if (done) break;
    packed.set(value, loaded);
    loaded += value.length;
    progress.value = loaded / size;
  }
  await ready;
  message.textContent = "Starting…";
  return WebAssembly.compile(unpack(packed));
}

function webgl() {
  const canvas = document.createElement("canvas");
  return canvas.getContext("webgl2") || canvas.getContext("webgl");
}

async function start() {
  if (typeof WebAssembly !== "object") {
    return stop("This browser cannot run the program: it needs WebAssembly, which every current browser has unless it was switched off.");
  }
  if (!webgl()) {
    return stop("This browser does not draw with WebGL. Switch hardware acceleration on in its settings, or use another browser.");
  }
  window.addEventListener("squeezefilm", ({ detail }) => {
    if (detail) return stop(`The window cannot be opened: ${detail}`);
    document.getElementById("loading").remove();
    const canvas = document.getElementById("squeezefilm");
    canvas.hidden = false;
    canvas.focus();
  });
  await init({ module_or_path: await program() });
  open();
  // For screen readers, and for tests.
  window.shown = () => JSON.parse(told());
  mirror(told, ...["squeezefilm", "told", "said", "lesson"].map((id) => document.getElementById(id)));
}

// Keeps the page for work without a network, which it needs until then. Not before it is loaded: what is kept is asked for once more.
function keep() {
  if ("serviceWorker" in navigator && window.isSecureContext) navigator.serviceWorker.register("./offline.js").catch(() => {});
}

start().then(() => setTimeout(keep, 2000)).catch((error) => stop(`The program cannot be started: ${error.message ?? error}`));
