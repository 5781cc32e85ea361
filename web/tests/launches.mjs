// Launches that the page and the program have to answer alike: every way to give a body and a launch, flights of many turns,
// landings near the edge, ties.

export const LAUNCHES = [
  { rate: "1,1,2.5", speed: "3" },
  { rate: "2,2,0.5", speed: "3" },
  { rate: "-2,2,-0.5", speed: "3", tilt: "-15deg" },
  { coin: "us-half", rate: "38rev/s,0,0", speed: "2.4m/s" },
  { coin: "us-quarter", turn: "38rev/s", psi: "81.2deg", speed: "2.4m/s" },
  { coin: "us-quarter", turn: "600rpm", psi: "60deg", speed: "8ft/s", drop: "30cm" },
  { coin: "euro-2", rate: "230,0,20", speed: "2.45", gravity: "1.62" },
  { coin: "euro-1c", rate: "120rad/s,40rad/s,0", time: "0.5s" },
  { coin: "us-dime", rate: "5rev/s,0,360deg/s", speed: "9km/h" },
  { cylinder: "5.67g,12.13mm,1.75mm", rate: "200,10,30", speed: "2.2" },
  { cylinder: "0.008,0.0133,0.002", rate: "0,150,-15", speed: "250cm/s", tilt: "0.3" },
  { moments: "1.7g·cm²,3.3g·cm²", rate: "90,0,10", speed: "3" },
  { moments: "5e-7,2.5e-7", rate: "0,0,50", speed: "4" },
  { coin: "disc", rate: "10,0,5", speed: "3", drop: "-0.2" },
  { coin: "disc", rate: "1000,0,5", time: "100" },
  { coin: "paper", rate: "0,0,0", speed: "3" },
  { coin: "paper", rate: "44.73423581675463,44.73423581675463,30", speed: "4.422536153153389" },
  { coin: "paper", rate: "6.4199555540725495,0,0", speed: "1.2" },
  { coin: "us-nickel", rate: "250,-3,0.01", speed: "2.6", tilt: "0.25rev" },
  { coin: "euro-50c", rate: "1e-3,0,1e-3", speed: "5" },
  { coin: "us-dollar", rate: "12,7,0", speed: "0" },
];

/** Launches of bodies with I1 ≠ I2, whose margins take longer. */
export const OF_BODIES = [
  { moments: "0.016,0.0012,0.0172", rate: "12,0.05,0.05", time: "1" },
  { moments: "1,2,2.9", rate: "1,20,0.1", speed: "3" },
  { moments: "1.1g·cm²,2.3g·cm²,2.9g·cm²", rate: "30,2,1", speed: "2.4", drop: "0.5", tilt: "0.2" },
];

/** The launch as the part of the page's address behind the #. */
export const asAddress = (launch) => Object.entries(launch).map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join("&");

/** The launch as options of the program. */
export const asOptions = (launch) => Object.entries(launch).flatMap(([name, value]) => [`--${name}`, value]);
