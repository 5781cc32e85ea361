// The library, in WebAssembly: questions in JSON, and numbers read from its memory.
import compressed from "library.wasm.lzma";
import { decompress } from "lzma1";
import { FRAME, POINT } from "./memory.js";

const encoder = new TextEncoder();
const decoder = new TextDecoder();
let module = null;
let exported = null;

/** What the library refused, in its words. */
export class Refused extends Error {
  constructor({ kind, message, field }) {
    super(message);
    this.kind = kind;
    this.field = field;
  }
}

/** Unpacks and starts the library. */
export async function start() {
  module = await WebAssembly.compile(decompress(compressed));
  await restart();
}

async function restart() {
  exported = (await WebAssembly.instantiate(module, {})).exports;
}

/** Asks the question called `ask`, with what else it takes, and gives its answer. Throws `Refused` if it has none. */
export function ask({ ask: name, ...rest }) {
  const answer = JSON.parse(raw(JSON.stringify(Object.keys(rest).length > 0 ? { [name]: rest } : name)));
  if (answer.error) throw new Refused(answer.error);
  return answer;
}

function raw(text) {
  const bytes = encoder.encode(text);
  try {
    const at = exported.question(bytes.length);
    new Uint8Array(exported.memory.buffer, at, bytes.length).set(bytes);
    const length = exported.ask();
    return decoder.decode(new Uint8Array(exported.memory.buffer, exported.answer(), length));
  } catch (error) {
    // A panic ends the instance; the next question finds a fresh one.
    restart();
    throw new Refused({ kind: "panic", message: `the library stopped: ${error.message}` });
  }
}

/** The frame of the flight at `time` (s). The view is valid until the next call of the library. */
export const frame = (time) => new Float64Array(exported.memory.buffer, exported.frame(time), FRAME.length);

/** A copy of the trace of `points` points. */
export const numbers = (points) =>
  new Float64Array(exported.memory.buffer, exported.numbers(), points * POINT.length).slice();

/** The cells of the map, a view that is valid until the next call of the library. */
export const cells = (count) => new Uint8Array(exported.memory.buffer, exported.cells(), count);
