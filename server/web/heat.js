/** Where the balls may come to rest: noisy variants of a shot, and how densely their ends lie, as a picture. */

import { BALL_RADIUS } from "./motion.js";

/** Standard deviations at level 1: mm, mm, deg, deg, m/s (docs/protocol.md, Noise). */
const SIGMA = { a: 0.5, b: 0.5, theta: 0.1, phi: 0.125, v: 0.075 };
const CELL = 0.8 * BALL_RADIUS;

/**
 * A shot as noise could play it.
 * @param {import("./shot_form.js").Shot} shot @param {number} level @param {Record<string, any>} table
 * @returns {import("./shot_form.js").Shot}
 */
export function noisy(shot, level, table) {
  const off = (name) => shot[name] + level * SIGMA[name] * gaussian();
  return {
    a: off("a"), b: off("b"), phi: off("phi"),
    theta: Math.min(table.theta_max, Math.max(0, off("theta"))),
    v: Math.min(table.v_max, Math.max(0, off("v"))),
  };
}

/** Box and Muller's way. */
function gaussian() {
  return Math.sqrt(-2 * Math.log(1 - Math.random())) * Math.cos(2 * Math.PI * Math.random());
}

/**
 * How many ends lie in each cell of the table.
 * @param {{balls: import("./trace.js").Balls}[]} rows @param {import("./trace.js").Balls} before
 * @param {number | null} only one ball, or all that moved
 * @returns {Map<string, number>} cell to count
 */
export function density(rows, before, only) {
  const cells = new Map();
  for (const { balls } of rows) {
    for (const [ball, [x, y]] of Object.entries(balls)) {
      if (only !== null && Number(ball) !== only) continue;
      const start = before[ball];
      if (start && Math.hypot(start[0] - x, start[1] - y) < 1e-9) continue;
      const cell = `${Math.floor(x / CELL)} ${Math.floor(y / CELL)}`;
      cells.set(cell, (cells.get(cell) ?? 0) + 1);
    }
  }
  return cells;
}

/**
 * Paint a density on the cloth.
 * @param {Map<string, number>} cells
 * @returns {(context: CanvasRenderingContext2D, projection: import("./projection.js").Projection) => void}
 */
export function heatPainter(cells) {
  const most = Math.max(1, ...cells.values());
  return (context, projection) => {
    const size = CELL * projection.scale;
    for (const [cell, count] of cells) {
      const [column, row] = cell.split(" ").map(Number);
      const [px, py] = projection.place((column + 0.5) * CELL, (row + 0.5) * CELL);
      const part = Math.sqrt(count / most);
      context.fillStyle = `hsl(${60 - 60 * part} 95% ${70 - 15 * part}% / ${0.25 + 0.65 * part})`;
      context.fillRect(px - size / 2, py - size / 2, size, size);
    }
  };
}
