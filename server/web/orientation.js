/**
 * How a ball is turned: its spin, summed up over its path.
 *
 * Spin has a closed form, the rotation it adds up to has none. It is summed in fixed steps from the start of each
 * stretch, so that the same time shows the same ball, whichever way it was reached.
 */

import { isOnTable } from "./motion.js";

/** @typedef {[number, number, number, number]} Quaternion w, x, y, z */

/** Summation step, s: at the fastest spin of a shot a third of a turn. */
const STEP = 1 / 120;

/** Number up, to be read where the table lies with its head string on the left. @type {Quaternion} */
export const UPRIGHT = [0, Math.SQRT1_2, 0, Math.SQRT1_2];

export class Orientations {
  /**
   * @param {import("./trace.js").Trace} trace
   * @param {Map<number, Quaternion>} [before] how the balls were turned before the stroke
   */
  constructor(trace, before = new Map()) {
    this.trace = trace;
    this.before = before;
    /** @type {Map<number, Quaternion[][]>} sums by ball, stretch and step */
    this.sums = new Map();
  }

  /** @param {number} ball @param {number} time @returns {Quaternion} */
  at(ball, time) {
    const { place } = this.trace.stretch(ball, time);
    return this.within(ball, place, time);
  }

  /** All balls at the end. @returns {Map<number, Quaternion>} */
  final() {
    return new Map(this.trace.balls.map((ball) => [ball, this.at(ball, this.trace.duration)]));
  }

  /** @param {number} ball @param {number} place @param {number} time @returns {Quaternion} */
  within(ball, place, time) {
    const stretch = (this.trace.stretches.get(ball) || [])[place];
    const sums = this.sumsOf(ball, place);
    if (stretch.state.motion === "stationary" || !isOnTable(stretch.state)) return sums[0];
    const step = Math.floor((time - stretch.time) / STEP);
    while (sums.length <= step) {
      const known = sums.length - 1;
      sums.push(this.turned(ball, sums[known], stretch.time + known * STEP, STEP));
    }
    const since = stretch.time + step * STEP;
    return this.turned(ball, sums[step], since, time - since);
  }

  /** @param {number} ball @param {number} place @returns {Quaternion[]} */
  sumsOf(ball, place) {
    const stretches = this.sums.get(ball) || [];
    this.sums.set(ball, stretches);
    for (let known = stretches.length; known <= place; known++) {
      const path = this.trace.stretches.get(ball) || [];
      const first = known === 0 ? this.before.get(ball) || UPRIGHT : this.within(ball, known - 1, path[known].time);
      stretches.push([first]);
    }
    return stretches[place];
  }

  /**
   * Turned on by the spin in the middle of a step.
   * @param {number} ball @param {Quaternion} from @param {number} time @param {number} dt
   * @returns {Quaternion}
   */
  turned(ball, from, time, dt) {
    if (dt <= 0) return from;
    const [wx, wy, wz] = this.trace.ball(ball, time + dt / 2).spin;
    return normalised(product(rotation(wx * dt, wy * dt, wz * dt), from));
  }
}

/** A rotation by a vector, in radians. @param {number} x @param {number} y @param {number} z @returns {Quaternion} */
function rotation(x, y, z) {
  const angle = Math.hypot(x, y, z);
  if (angle < 1e-12) return [1, 0, 0, 0];
  const scale = Math.sin(angle / 2) / angle;
  return [Math.cos(angle / 2), x * scale, y * scale, z * scale];
}

/** @param {Quaternion} p @param {Quaternion} q @returns {Quaternion} */
function product([a, b, c, d], [e, f, g, h]) {
  return [
    a * e - b * f - c * g - d * h,
    a * f + b * e + c * h - d * g,
    a * g - b * h + c * e + d * f,
    a * h + b * g - c * f + d * e,
  ];
}

/** @param {Quaternion} q @returns {Quaternion} */
function normalised([w, x, y, z]) {
  const size = Math.hypot(w, x, y, z);
  return [w / size, x / size, y / size, z / size];
}

/**
 * The rows of the matrix that takes a direction of the table into the ball's own axes.
 * @param {Quaternion} q @returns {number[]} nine numbers, row by row
 */
export function intoBall([w, x, y, z]) {
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y),
  ];
}
