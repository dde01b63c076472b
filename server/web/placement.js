/** Where a ball may lie: inside the cushion lines, in front of the mouths or in the jaws, clear of the others. */

import { BALL_RADIUS } from "./motion.js";
import { hasJaws, shapeOf } from "./tables.js";

/** Distance kept from whatever a ball may just touch, m. */
const SLACK = 1e-6;

/** @param {Record<string, any>} table @param {number} x @param {number} y */
export function isInside(table, x, y) {
  const { width, length } = table;
  const fromSide = Math.min(x, width - x);
  const fromEnd = Math.min(y, length - y);
  const shape = shapeOf(table);
  if (shape) return isWithin(shape, [x, y], Math.min(fromSide, fromEnd));
  const corner = table.corner_mouth / Math.SQRT2 + BALL_RADIUS;
  const inMouth = fromSide < BALL_RADIUS + SLACK && Math.abs(y - length / 2) < table.side_mouth / 2;
  return fromSide >= BALL_RADIUS && fromEnd >= BALL_RADIUS && fromSide + fromEnd > corner && !inMouth;
}

/**
 * The same on a table with jaws: in front of the noses, or in a mouth, clear of its jaws and its hole.
 * @param {import("./tables.js").Description} shape @param {[number, number]} place @param {number} near m, to the nearest nose line
 */
function isWithin(shape, place, near) {
  const { contact_distance: rho, pockets } = shape;
  if (near >= rho) return true;
  const middle = ({ mouth: [one, two] }) => Math.hypot((one[0] + two[0]) / 2 - place[0], (one[1] + two[1]) / 2 - place[1]);
  const { jaws, hole_centre, hole_radius } = pockets.reduce((one, two) => (middle(one) <= middle(two) ? one : two));
  return distance(place, hole_centre) > hole_radius && jaws.every((jaw) => isClearOf(jaw, rho, place));
}

/** Whether a centre in a mouth is no nearer than rho to one of its jaws, nor beyond the end of its facing. */
function isClearOf({ tip, nose_end, horn_centre, horn_radius, facing_start, facing_end, facing_normal }, rho, place) {
  const along = dot(from(tip, nose_end), from(nose_end, place));
  const facing = from(facing_start, facing_end);
  const foot = dot(facing, from(facing_start, place));
  const onFacing = foot >= 0 && (foot > dot(facing, facing) || dot(facing_normal, from(facing_start, place)) < rho);
  return along < 0 && !onFacing && distance(place, horn_centre) >= horn_radius + rho;
}

const from = ([x0, y0], [x1, y1]) => [x1 - x0, y1 - y0];
const dot = ([x0, y0], [x1, y1]) => x0 * x1 + y0 * y1;
const distance = (one, two) => Math.hypot(one[0] - two[0], one[1] - two[1]);

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
  const mouths = hasJaws(table) && (!strict || y > area.y[0]); // where the area goes on beyond its rectangle
  const within = !area || mouths || (x >= area.x[0] && x <= area.x[1] && (strict ? y > area.y[0] : y >= area.y[0]) && y <= area.y[1]);
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
