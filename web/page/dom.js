// Small helpers for the document.

/** The element with this id. */
export const byId = (id) => document.getElementById(id);

/** A new element: `make("p", { class: "note" }, "text", child)`. Keys that begin with "on" are listeners. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child != null));
  return element;
}

/** A new element of a drawing. */
export function svg(tag, attributes = {}, text = null) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== null) element.textContent = text;
  return element;
}

/** Puts `children` in place of what `element` holds. */
export const fill = (element, ...children) => element.replaceChildren(...children.filter((child) => child != null));

/** Calls `act` once, when nothing has called it for `wait` milliseconds. Its `drop` takes a call back. */
export function later(wait, act) {
  let timer = 0;
  const call = (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => act(...given), wait);
  };
  return Object.assign(call, { drop: () => clearTimeout(timer) });
}

let isInFrame = false;

/**
 * Calls `act` at most once a frame, with what was given last. What is called in a frame by another such function is done in
 * that frame, so that no frame shows one without the other.
 */
export function onceAFrame(act) {
  let pending = null;
  return (...given) => {
    if (isInFrame && !pending) return act(...given);
    if (!pending) requestAnimationFrame(() => {
      const last = pending;
      pending = null;
      isInFrame = true;
      try {
        act(...last);
      } finally {
        isInFrame = false;
      }
    });
    pending = given;
  };
}

/** Options of a select: pairs of value and text. */
export function options(select, pairs, chosen) {
  fill(select, ...pairs.map(([value, text]) => make("option", { value, selected: value === chosen }, text)));
}

/** Lets the reader keep `content`, a blob, as a file. */
export function save(name, content) {
  const url = URL.createObjectURL(content);
  make("a", { href: url, download: name }).click();
  // The browser reads it after the click.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** A finger that has moved so far across (pixels) does not scroll the page. */
const FAR = 10;

/**
 * Lets `moved` follow a pointer that is pressed on `element`, to where it is released; then calls `ended`. A finger that scrolls
 * the page does not count.
 */
export function follow(element, moved, ended = () => {}) {
  element.addEventListener("pointerdown", (first) => {
    element.setPointerCapture(first.pointerId);
    const until = new AbortController();
    let isHeld = first.pointerType !== "touch";
    const act = { signal: until.signal };
    const end = () => {
      until.abort();
      ended();
    };
    element.addEventListener("pointermove", (next) => {
      isHeld ||= Math.abs(next.clientX - first.clientX) > Math.max(FAR, Math.abs(next.clientY - first.clientY));
      if (isHeld) moved(next);
    }, act);
    element.addEventListener("pointerup", (last) => {
      moved(last);
      end();
    }, act);
    element.addEventListener("pointercancel", end, act);
    if (isHeld) moved(first);
  });
}
