// The library of the page: questions in JSON, and numbers read from its memory.
import compressed from "library.wasm.lzma";
// The decoder alone: the package's own entry brings the encoder along.
import { Decoder } from "../node_modules/lzma1/lib/decoder.js";
import { InputBuffer, OutputBuffer } from "../node_modules/lzma1/lib/streams.js";
import { Instance } from "./instance.js";
import { FRAME, POINT } from "./memory.js";

let library = null;

/** Unpacks and starts the library. */
export async function start() {
  const unpacked = new OutputBuffer(4 * compressed.length);
  new Decoder().decompress(new InputBuffer(compressed), unpacked);
  library = new Instance(await WebAssembly.compile(unpacked.toArray()));
  await library.start();
}

/** Asks a question; see `Instance.ask`. */
export const ask = (question) => library.ask(question);

/** The compiled library, for another instance. */
export const compiled = () => library.module;

const memory = () => library.exported.memory.buffer;

/** The frame of the flight at `time` (s). The view is valid until the next call of the library. */
export const frame = (time) => new Float64Array(memory(), library.exported.frame(time), FRAME.length);

/** A copy of the trace of `points` points. */
export const numbers = (points) => new Float64Array(memory(), library.exported.numbers(), points * POINT.length).slice();

/** The cells of the map, a view that is valid until the next call of the library. */
export const cells = (count) => new Uint8Array(memory(), library.exported.cells(), count);
