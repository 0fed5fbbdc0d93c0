// The files of a folder, as any file host serves them: compressed, but for what is packed already.
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".svg": "image/svg+xml", ".wasm": "application/wasm" };

// The server, and its address.
export async function serve(folder) {
  const server = createServer(async (request, answer) => {
    const path = normalize(new URL(request.url, "http://x").pathname.replace(/\/$/, "/index.html"));
    try {
      const body = await readFile(join(folder, path));
      const type = { "Content-Type": types[extname(path)] ?? "application/octet-stream" };
      if (extname(path) === ".bin") answer.writeHead(200, type).end(body);
      else answer.writeHead(200, { ...type, "Content-Encoding": "gzip" }).end(gzipSync(body));
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  return { server, address: `http://127.0.0.1:${server.address().port}/` };
}
