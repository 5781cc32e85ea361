// Numbers as texts, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { percent } from "../page/format.js";

test("a percentage is rounded once, from the decimal of the number", () => {
  for (const [part, expected] of [[0.000095, "0.010 %"], [0.000115, "0.012 %"], [0.000165, "0.017 %"], [0.680865, "68.087 %"]]) {
    assert.equal(percent(part, 5e-5), expected);
  }
  for (let millionths = 5; millionths < 999_995; millionths += 13) {
    const thousandths = String(Math.floor((millionths + 5) / 10)).padStart(4, "0");
    assert.equal(percent(millionths / 1e6, 5e-5), `${thousandths.slice(0, -3)}.${thousandths.slice(-3)} %`);
  }
  assert.equal(percent(0.25, 5e-3), "25.0 %");
});

test("certainty is never reached by rounding", () => {
  assert.deepEqual([0, 1].map((part) => percent(part)), ["0.000 %", "100.000 %"]);
  assert.deepEqual([1e-7, 0.999999, 0.9999].map((part) => percent(part, 0.01)), ["0.00001 %", "99.9999 %", "99.99 %"]);
  assert.deepEqual([5e-324, 1 - 2 ** -53].map((part) => percent(part)), ["below 0.000000000001 %", "above 99.999999999999 %"]);
});
