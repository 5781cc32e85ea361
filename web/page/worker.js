// Answers one question by an instance of its own, beside the page. The page ends it when nobody wants the answer any more.
import { Instance } from "./instance.js";

onmessage = async ({ data: { module, question } }) => {
  try {
    const library = new Instance(module);
    await library.start();
    postMessage({ answer: library.ask(question) });
  } catch ({ kind, message, field }) {
    postMessage({ refusal: { kind, message, field } });
  }
};
