// Loads the program, shows how far that is, and opens the window. Says in words what a browser lacks.
import init, { open, told } from "./squeezefilm.js";
import { mirror } from "./mirror.js";
import unpacker, { Unpacker } from "./unpack.js";

const size = "PROGRAM_BYTES"; // a number once it is built
const message = document.getElementById("message");
const progress = document.getElementById("progress");

function stop(why) {
  progress.hidden = true;
  message.textContent = why;
}

// The program: unpacked and compiled while it is loaded.
async function program() {
  const ready = unpacker();
  const answer = await fetch("./squeezefilm.bin");
  if (!answer.ok) throw new Error(`the program cannot be loaded: ${answer.status} ${answer.statusText}`);
  await ready;
  const packed = new Unpacker();
  let loaded = 0;
  const unpacked = new TransformStream({
    transform(piece, to) {
      loaded += piece.length;
      progress.value = loaded / size;
      to.enqueue(packed.push(piece));
    },
    flush() {
      if (!packed.is_finished()) throw new Error("the program was not loaded to its end");
      message.textContent = "Starting…";
    },
  });
  return WebAssembly.compileStreaming(new Response(answer.body.pipeThrough(unpacked), { headers: { "Content-Type": "application/wasm" } }));
}

// Whether the browser knows vector instructions: a program of one function that makes a vector.
function vectors() {
  const code = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11];
  return WebAssembly.validate(new Uint8Array(code));
}

function webgl() {
  const canvas = document.createElement("canvas");
  return canvas.getContext("webgl2") || canvas.getContext("webgl");
}

async function start() {
  if (typeof WebAssembly !== "object") {
    return stop("This browser cannot run the program: it needs WebAssembly, which every current browser has unless it was switched off.");
  }
  if (!vectors()) {
    return stop("This browser is too old for the program. Chrome and Edge from version 91, Firefox from 89 and Safari from 16.4 run it.");
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
