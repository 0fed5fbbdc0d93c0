// Loads the program, shows how far that is, and opens the window. Says in words what a browser lacks.
import init, { open, told } from "./squeezefilm.js";

const size = "PROGRAM_BYTES"; // a number once it is built
const message = document.getElementById("message");
const progress = document.getElementById("progress");

function stop(why) {
  progress.hidden = true;
  message.textContent = why;
}

// The program, unpacked while it is loaded and compiled while it is unpacked.
async function program() {
  const answer = await fetch("./squeezefilm.bin");
  if (!answer.ok) throw new Error(`the program cannot be loaded: ${answer.status} ${answer.statusText}`);
  let loaded = 0;
  const counted = answer.body.pipeThrough(new TransformStream({
    transform(part, to) {
      loaded += part.length;
      progress.value = Math.min(loaded / size, 1);
      to.enqueue(part);
    },
  }));
  const unpacked = counted.pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compileStreaming(new Response(unpacked, { headers: { "Content-Type": "application/wasm" } }));
}

function webgl() {
  const canvas = document.createElement("canvas");
  return canvas.getContext("webgl2") || canvas.getContext("webgl");
}

async function start() {
  if (typeof WebAssembly !== "object" || typeof DecompressionStream !== "function") {
    return stop("This browser cannot run the program: it needs WebAssembly and DecompressionStream, which browsers have had since 2023.");
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
  window.squeezefilm = () => JSON.parse(told());
  const text = document.getElementById("told");
  setInterval(() => {
    const { nodes } = window.squeezefilm();
    const lines = nodes.map(({ label, value }) => [label, value].filter(Boolean).join(": "));
    const now = lines.join("\n");
    if (text.textContent !== now) text.textContent = now;
  }, 1000);
}

start().catch((error) => stop(`The program cannot be started: ${error.message ?? error}`));

if ("serviceWorker" in navigator && window.isSecureContext) {
  // Without it the page works as long as there is a network.
  navigator.serviceWorker.register("./offline.js").catch(() => {});
}
