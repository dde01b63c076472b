/** Where a ball may lie: inside the cushion lines, in front of the mouths, clear of the others. */

import { BALL_RADIUS } from "./motion.js";

/** Distance kept from whatever a ball may just touch, m. */
const SLACK = 1e-6;

/** @param {Record<string, any>} table @param {number} x @param {number} y */
export function isInside(table, x, y) {
  const { width, length } = table;
  const fromSide = Math.min(x, width - x);
  const fromEnd = Math.min(y, length - y);
  const corner = table.corner_mouth / Math.SQRT2 + BALL_RADIUS;
  const inMouth = fromSide < BALL_RADIUS + SLACK && Math.abs(y - length / 2) < table.side_mouth / 2;
  return fromSide >= BALL_RADIUS && fromEnd >= BALL_RADIUS && fromSide + fromEnd > corner && !inMouth;
}

/**
 * The ball that is in the way, or null.
 * @param {import("./trace.js").Balls} balls @param {number} ball the one to be placed @param {number} x @param {number} y
 */
export function blockedBy(balls, ball, x, y) {
  for (const [other, [ox, oy]] of Object.entries(balls)) {
    if (Number(other) !== ball && Math.hypot(x - ox, y - oy) < 2 * BALL_RADIUS) return Number(other);
  }
  return null;
}

/**
 * Whether a ball may be put there.
 * @param {Record<string, any>} table @param {import("./trace.js").Balls} balls @param {number} ball
 * @param {[number, number]} place @param {{name: string, x: number[], y: number[]} | null} [area]
 */
export function mayLie(table, balls, ball, [x, y], area = null) {
  const strict = area?.name === "kitchen";
  const within = !area || (x >= area.x[0] && x <= area.x[1] && (strict ? y > area.y[0] : y >= area.y[0]) && y <= area.y[1]);
  return within && isInside(table, x, y) && blockedBy(balls, ball, x, y) === null;
}

/**
 * A free place, the nearest to the area's middle.
 * @param {Record<string, any>} table @param {import("./trace.js").Balls} balls @param {number} ball
 * @param {{name: string, x: number[], y: number[]}} area @returns {[number, number] | null}
 */
export function freePlace(table, balls, ball, area) {
  const middle = [(area.x[0] + area.x[1]) / 2, (area.y[0] + area.y[1]) / 2];
  /** @type {[number, number][]} */
  const places = [];
  for (let x = area.x[0]; x <= area.x[1]; x += 0.02) for (let y = area.y[0]; y <= area.y[1]; y += 0.02) places.push([x, y]);
  places.unshift([middle[0], middle[1]]);
  places.sort((p, q) => Math.hypot(p[0] - middle[0], p[1] - middle[1]) - Math.hypot(q[0] - middle[0], q[1] - middle[1]));
  return places.find((place) => mayLie(table, balls, ball, place, area)) ?? null;
}
