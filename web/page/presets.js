// Launches worth a look. Texts are as a person would type them; what a preset leaves out is as in `BLANK` of state.js.

export const PRESETS = [
  {
    name: "quarter",
    title: "A quarter as people flip it",
    words: "Its normal wobbles about the angular momentum by ψ = 81.2°. Over many such flips 50.8 % land as they started, as did the 350 757 flips of 48 people.",
    scene: { coin: "us-quarter", by: "turn", turn: "38rev/s", psi: "81.2deg", speed: "2.4m/s" },
    pace: 0.03,
  },
  {
    name: "cheated",
    title: "The paper's cheated toss",
    words: "The paper's coin, a rod three radii long, wobbles by ψ = 48.5°. It is caught before it turns over, and lands as it left.",
    scene: { coin: "paper", rate: ["1", "1", "2.5"], speed: "3" },
    pace: 0.1,
  },
  {
    name: "tails",
    title: "The paper's tails toss",
    words: "The same rod with less spin: its normal moves on a wide cone, and it is caught upside down.",
    scene: { coin: "paper", rate: ["2", "2", "0.5"], speed: "3" },
    pace: 0.1,
  },
  {
    name: "keller",
    title: "Keller's toss",
    words: "A half dollar without spin about its normal turns end over end. Only such a toss, thrown vigorously, is fair.",
    scene: { coin: "us-half", rate: ["38rev/s", "0", "0"], speed: "2.4m/s" },
    pace: 0.03,
  },
  {
    name: "racket",
    title: "Dzhanibekov's racket",
    words: "A racket in free fall, turned about the axis of its middle moment of inertia, flips over again and again.",
    scene: { body: "moments", moments: "0.016,0.0012,0.0172", rate: ["12", "0.05", "0.05"], flight: "time", time: "6" },
    pace: 1,
  },
];
