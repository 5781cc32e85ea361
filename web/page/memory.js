// Where the numbers are that the library writes into its memory.

/** A frame; see `Page::frame` of the library. */
export const FRAME = { attitude: 0, normal: 4, face: 7, rate: 10, cosTilt: 13, height: 14, length: 15 };

/** A point of the trace; see `Page::numbers` of the library. */
export const POINT = { time: 0, cosTilt: 1, height: 2, normal: 3, face: 6, rate: 9, length: 12 };
