/** A ball as it is seen from above: colour, stripe and number turned with it, pixel by pixel. */

import { intoBall } from "./orientation.js";

const COLOURS = [
  [244, 240, 228], [240, 190, 30], [30, 70, 170], [200, 40, 40], [95, 45, 130],
  [230, 110, 30], [20, 110, 70], [120, 30, 40], [24, 24, 26],
];
const IVORY = [244, 240, 228];
const RED = [190, 30, 40];

/** Half the stripe's height and the number's disc, in radii. */
const STRIPE = 0.52;
const DISC = 0.56;
const DOT = 0.965;
/** Pixels of a number's square: about as many as are shown, so that its soft edges stay soft. */
const GLYPH = 24;
const NUMBERS = 15;
/** Numbers a pixel of a lit sphere. */
const PARTS = 6;
/** From ivory to black, by how much of a pixel is ink. */
const INKS = Array.from({ length: 16 }, (_, ink) => IVORY.map((part, place) => part + (ink / 15) * (COLOURS[8][place] - part)));

/** The plain colour of a ball. @param {number} ball @returns {number[]} red, green, blue */
export function colourOf(ball) {
  return COLOURS[ball > 8 ? ball - 8 : ball];
}

/** @param {number} ball */
export function cssColour(ball) {
  return `rgb(${colourOf(ball).join(" ")})`;
}

/** @param {number} ball */
export function isStriped(ball) {
  return ball > 8;
}

/**
 * What is the same for every ball of a size, by pixel: cover (0: beside the ball), right, up and towards the eye of the
 * surface in radii, factor and summand of its colour by the light.
 * @param {number} radius device pixels @param {number} size of the square
 * @returns {Float32Array} PARTS numbers a pixel
 */
function litSphere(radius, size) {
  const sphere = new Float32Array(PARTS * size * size);
  const middle = (size - 1) / 2;
  for (let row = 0, at = 0; row < size; row++) {
    for (let column = 0; column < size; column++, at += PARTS) {
      const right = (column - middle) / radius;
      const up = (middle - row) / radius;
      const distance = Math.sqrt(right * right + up * up);
      const cover = Math.min(1, Math.max(0, (1 - distance) * radius + 0.5));
      if (cover > 0) sphere.set([cover, right, up, ...lit(right, up, distance)], at);
    }
  }
  return sphere;
}

/** Light from the upper left, brightest where the surface faces it. @returns {number[]} towards the eye, factor, summand */
function lit(right, up, distance) {
  const z = Math.sqrt(Math.max(0, 1 - distance * distance));
  const light = 0.66 + 0.4 * Math.max(0, 0.8 * z - 0.35 * right + 0.45 * up);
  const shine = Math.max(0, 0.82 * z - 0.34 * right + 0.45 * up) ** 60 * 140;
  return [z, light, shine];
}

export class BallPictures {
  constructor() {
    /** @type {Map<number, {canvas: HTMLCanvasElement, key: string}>} */
    this.pictures = new Map();
    /** Of the last size asked for: all balls at rest have it. */
    this.sphere = { radius: 0, lit: new Float32Array(0) };
  }

  /**
   * The picture of a ball; the same canvas again while nothing has changed.
   * @param {number} ball @param {import("./orientation.js").Quaternion} turned
   * @param {number} radius device pixels @param {{right: number[], up: number[]}} axes of the projection
   * @returns {HTMLCanvasElement}
   */
  picture(ball, turned, radius, axes) {
    const size = 2 * Math.ceil(radius) + 2;
    const key = `${size} ${axes.right} ${turned.map((part) => part.toFixed(3))}`;
    let kept = this.pictures.get(ball);
    if (!kept) {
      kept = { canvas: document.createElement("canvas"), key: "" };
      this.pictures.set(ball, kept);
    }
    if (kept.key !== key) {
      kept.key = key;
      if (kept.canvas.width !== size) kept.canvas.width = kept.canvas.height = size;
      this.paint(kept.canvas, ball, turned, radius, axes);
    }
    return kept.canvas;
  }

  paint(canvas, ball, turned, radius, { right, up }) {
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    const { width } = canvas;
    if (this.sphere.radius !== radius) this.sphere = { radius, lit: litSphere(radius, width) };
    const sphere = this.sphere.lit;
    const image = context.createImageData(width, width);
    const { data } = image;
    const matrix = intoBall(turned);
    for (let at = 0, from = 0; at < data.length; at += 4, from += PARTS) {
      const cover = sphere[from];
      if (cover === 0) continue;
      const x = sphere[from + 1] * right[0] + sphere[from + 2] * up[0];
      const y = sphere[from + 1] * right[1] + sphere[from + 2] * up[1];
      const z = sphere[from + 3];
      const colour = this.colourAt(
        ball,
        matrix[0] * x + matrix[1] * y + matrix[2] * z,
        matrix[3] * x + matrix[4] * y + matrix[5] * z,
        matrix[6] * x + matrix[7] * y + matrix[8] * z,
      );
      const light = sphere[from + 4];
      const shine = sphere[from + 5];
      data[at] = colour[0] * light + shine;
      data[at + 1] = colour[1] * light + shine;
      data[at + 2] = colour[2] * light + shine;
      data[at + 3] = 255 * cover;
    }
    context.putImageData(image, 0, 0);
  }

  /** The colour of a point of the ball's surface, in the ball's own axes. */
  colourAt(ball, x, y, z) {
    if (ball === 0) return Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) > DOT ? RED : IVORY;
    const base = isStriped(ball) && Math.abs(z) > STRIPE ? IVORY : colourOf(ball);
    if (y * y + z * z > DISC * DISC || Math.abs(x) < 0.4) return base;
    return INKS[drawnNumbers()[pixel(ball, x > 0 ? y : -y, z)] >> 4];
  }
}

/** @type {Uint8ClampedArray | null} */
let numbers = null;

/** All numbers, side by side; the font is looked up for the first. @returns {Uint8ClampedArray} coverage, row by row */
export function drawnNumbers() {
  if (numbers) return numbers;
  const canvas = document.createElement("canvas");
  canvas.width = NUMBERS * GLYPH;
  canvas.height = GLYPH;
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { willReadFrequently: true }));
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (let ball = 1; ball <= NUMBERS; ball++) {
    context.font = `700 ${ball > 9 ? 18 : 22}px sans-serif`;
    context.fillText(String(ball), (ball - 0.5) * GLYPH, GLYPH / 2 + 1);
  }
  const { data } = context.getImageData(0, 0, canvas.width, GLYPH);
  numbers = Uint8ClampedArray.from({ length: NUMBERS * GLYPH * GLYPH }, (_, place) => data[4 * place + 3]);
  return numbers;
}

/** Where the coverage of a place on a number's disc stands. @param {number} ball @param {number} u @param {number} v */
function pixel(ball, u, v) {
  const column = Math.min(GLYPH - 1, Math.max(0, Math.round(((u / DISC + 1) / 2) * (GLYPH - 1))));
  const row = Math.min(GLYPH - 1, Math.max(0, Math.round(((1 - v / DISC) / 2) * (GLYPH - 1))));
  return (row * NUMBERS + ball - 1) * GLYPH + column;
}
