// An instance of the library in WebAssembly: questions in JSON, and numbers read from its memory.
const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** What the library refused, in its words. */
export class Refused extends Error {
  constructor({ kind, message, field }) {
    super(message);
    this.kind = kind;
    this.field = field;
  }
}

/** An instance of the library. */
export class Instance {
  constructor(module) {
    this.module = module;
  }

  async start() {
    this.exported = (await WebAssembly.instantiate(this.module, {})).exports;
  }

  /** Asks a question, whose name is `ask`, and gives its answer. Throws `Refused` if it has none. */
  ask(question) {
    const answer = JSON.parse(this.raw(JSON.stringify(question)));
    if (answer.error) throw new Refused(answer.error);
    return answer;
  }

  raw(text) {
    const bytes = encoder.encode(text);
    const { exported } = this;
    try {
      const at = exported.question(bytes.length);
      new Uint8Array(exported.memory.buffer, at, bytes.length).set(bytes);
      const length = exported.ask();
      return decoder.decode(new Uint8Array(exported.memory.buffer, exported.answer(), length));
    } catch (error) {
      // A panic ends the instance; the next question finds a fresh one.
      this.start();
      throw new Refused({ kind: "panic", message: `the library stopped: ${error.message}` });
    }
  }
}
