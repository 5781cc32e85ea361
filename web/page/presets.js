// Launches worth a look. Texts are as a person would type them; what a preset leaves out is as in `BLANK` of state.js.

export const PRESETS = [
  {
    name: "cheated",
    title: "The paper's cheated toss",
    words: "It wobbles, never turns over, and lands as it left: ψ is 48.5°.",
    scene: { coin: "paper", rate: ["1", "1", "2.5"], speed: "3" },
    pace: 0.1,
  },
  {
    name: "tails",
    title: "The paper's tails toss",
    words: "Less spin, a wide cone: it is caught upside down.",
    scene: { coin: "paper", rate: ["2", "2", "0.5"], speed: "3" },
    pace: 0.1,
  },
  {
    name: "keller",
    title: "Keller's toss",
    words: "No spin about its normal, so that it turns end over end; only here is a vigorous toss fair.",
    scene: { coin: "us-half", rate: ["38rev/s", "0", "0"], speed: "2.4m/s" },
    pace: 0.01,
  },
  {
    name: "quarter",
    title: "A quarter as people flip it",
    words: "With ψ = 81.2° it lands as it started in 50.8 % of all flips, as 48 people's 350 757 flips did.",
    scene: { coin: "us-quarter", by: "turn", turn: "38rev/s", wobble: "81.2deg", speed: "2.4m/s" },
    pace: 0.01,
  },
  {
    name: "racket",
    title: "Dzhanibekov's racket",
    words: "Weightless, turned about the axis of its middle moment: it flips over again and again.",
    scene: { body: "moments", moments: "0.016,0.0012,0.0172", rate: ["12", "0.05", "0.05"], flight: "time", time: "6" },
    pace: 1,
  },
];
