// The address bar. Browsers limit how often a page may write it: Safari throws after 100 times in 30 s. It is written as seldom
// as that needs, and what is shown never depends on it.

/** The time between two writes (ms), and after one that was refused. */
const PAUSE = 400;
const LONG_PAUSE = 5000;

let wanted = null;
let timer = 0;
let last = -Infinity;
/** The part behind the # as this page wrote or read it last. */
let known = location.hash;

/** Writes `text` behind the # of the address, now or a little later; of several, the last. */
export function write(text) {
  wanted = text;
  if (!timer) plan(Math.max(0, last + PAUSE - performance.now()));
}

function plan(wait) {
  if (wait > 0) timer = setTimeout(now, wait);
  else now();
}

/** Writes what is wanted, unless a person has just written another address, which is read next. */
function now() {
  timer = 0;
  if (wanted === null || location.hash !== known) return;
  last = performance.now();
  try {
    history.replaceState(null, "", `#${wanted}`);
    known = location.hash;
    wanted = null;
  } catch {
    plan(LONG_PAUSE);
  }
}

/** The part behind the # that a person wrote. What was to be written before is not. */
export function read() {
  clearTimeout(timer);
  timer = 0;
  wanted = null;
  known = location.hash;
  return known.slice(1);
}

// A reload, or another page, finds all of it.
addEventListener("pagehide", now);
