// A worker of the page: the same program in an instance of its own. The first message is the program, compiled by the page.
import { initSync, serve } from "./squeezefilm.js";

self.onmessage = ({ data }) => {
  initSync({ module: data });
  // It listens itself from now on.
  serve();
};
