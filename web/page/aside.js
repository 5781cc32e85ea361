// Answers that take longer than a frame. A worker computes them, so that the page lives on.
import script from "worker.js as text";
import { Refused } from "./instance.js";
import { compiled } from "./library.js";

let worker = null;
// From file: a worker can only be started from a blob.
const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));

/** Ends the question that is computed, if there is one. */
export function dropAside() {
  worker?.terminate();
  worker = null;
}

/** Asks a question in place of the last one, and calls `answered` or `refused` when there is an answer. */
export function askAside(question, answered, refused) {
  dropAside();
  const own = (worker = new Worker(url));
  own.onmessage = ({ data: { answer, refusal } }) => {
    if (own !== worker) return;
    dropAside();
    if (refusal) refused(new Refused(refusal));
    else answered(answer);
  };
  own.onerror = ({ message }) => own === worker && refused(new Error(message || "no worker can be started here"));
  own.postMessage({ module: compiled(), question });
}
