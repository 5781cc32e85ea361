// Builds the page: `node build.mjs LIBRARY.wasm FOLDER`. The folder then works from a disk, without a server: scripts are
// classic ones, because modules cannot be loaded from file:, and the library is inside of its script, compressed.
import { build } from "esbuild";
import { copyFileSync, mkdirSync, readFileSync, rmSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { Encoder } from "./node_modules/lzma1/lib/encoder.js";
import { MODES } from "./node_modules/lzma1/lib/lzma.js";
import { InputBuffer, OutputBuffer } from "./node_modules/lzma1/lib/streams.js";

const here = dirname(fileURLToPath(import.meta.url));
const [wasm, folder] = process.argv.slice(2);
if (!wasm || !folder) {
  console.error("usage: node build.mjs LIBRARY.wasm FOLDER");
  process.exit(2);
}

/** The settings for WebAssembly, whose bytes depend on those before them and on no alignment. */
class WasmEncoder extends Encoder {
  configure(mode) {
    super.configure(mode);
    Object.assign(this, { _numLiteralContextBits: 4, _posStateBits: 0, _posStateMask: 0 });
  }
}

function compress(bytes) {
  const compressed = new OutputBuffer(bytes.length);
  new WasmEncoder().compress(new InputBuffer(bytes), compressed, MODES[9]);
  return compressed.toArray();
}

/** Makes the import "library.wasm.lzma" the compressed library, as a Uint8Array. */
const library = {
  name: "library",
  setup(of) {
    of.onResolve({ filter: /^library\.wasm\.lzma$/ }, () => ({ path: wasm, namespace: "library" }));
    of.onLoad({ filter: /.*/, namespace: "library" }, () => ({
      contents: compress(readFileSync(wasm)),
      loader: "binary",
    }));
  },
};

/** Makes the import "worker.js as text" the text of that script, with what it imports. */
const worker = {
  name: "worker",
  setup(of) {
    of.onResolve({ filter: /^worker\.js as text$/ }, () => ({ path: join(here, "page/worker.js"), namespace: "worker" }));
    of.onLoad({ filter: /.*/, namespace: "worker" }, async ({ path }) => {
      const built = await build({ ...script, entryPoints: [path], write: false });
      return { contents: built.outputFiles[0].text, loader: "text" };
    });
  },
};

const script = { bundle: true, format: "iife", target: "es2022", minify: true, legalComments: "eof", logLevel: "warning" };

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const size = {};
for (const [entry, file] of [["main.js", "page.js"], ["scene/index.js", "scene.js"]]) {
  await build({ ...script, entryPoints: [join(here, "page", entry)], outfile: join(folder, file), plugins: [library, worker] });
}
await build({ ...script, entryPoints: [join(here, "page/style.css")], outfile: join(folder, "style.css") });
copyFileSync(join(here, "page/index.html"), join(folder, "index.html"));
for (const file of ["index.html", "style.css", "page.js", "scene.js"]) {
  size[file] = gzipSync(readFileSync(join(folder, file)), { level: 9 }).length;
}
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(0)} kB`;
const own = size["index.html"] + size["style.css"] + size["page.js"];
console.log(`${folder}: ${kilobytes(own)} gzipped, and three.js with the scene ${kilobytes(size["scene.js"])}`);
