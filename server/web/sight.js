/** Along the cue: the ghost ball, the line of the ball that is hit, the cue ball's own, and where they come to rest. */

import { BALL_RADIUS, isOnTable } from "./motion.js";
import { alongRay, circle } from "./stage.js";

/** @typedef {import("./trace.js").Balls} Balls */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {[number, number]} Point */

export const CUE_BALL = "#9bd7ff";
export const STRUCK = "#ffc04d";
const OTHERS = "#e6dcc3";
const AIM = "#ffffff";
/** The cue ball's line is dashed, so that colour is not all that tells it from the others. */
const DASH = [7, 4];
/** Length of the lines after a contact that is not simulated, m. */
const REACH = 0.45;
/** A ball that moved less has not moved, m. */
const MOVED = 1e-6;

/**
 * Where the cue ball first touches another one on its straight way.
 * @param {Balls} balls @param {number} phi deg
 * @returns {{ball: number, ghost: Point, line: Point} | null} the ball, the cue ball's centre then, and the
 *   direction in which the ball goes
 */
export function firstContact(balls, phi) {
  const angle = (phi * Math.PI) / 180;
  const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
  const [x, y] = balls[0];
  let found = null;
  let nearest = Infinity;
  for (const [name, [bx, by]] of Object.entries(balls)) {
    if (name === "0") continue;
    const along = (bx - x) * dx + (by - y) * dy;
    const beside = (bx - x) * dy - (by - y) * dx;
    const room = 4 * BALL_RADIUS ** 2 - beside ** 2;
    const distance = along - Math.sqrt(Math.max(0, room));
    if (along <= 0 || room <= 0 || distance >= nearest) continue;
    nearest = distance;
    const ghost = /** @type {Point} */ ([x + distance * dx, y + distance * dy]);
    found = { ball: Number(name), ghost, line: /** @type {Point} */ ([(bx - ghost[0]) / (2 * BALL_RADIUS), (by - ghost[1]) / (2 * BALL_RADIUS)]) };
  }
  return found;
}

/**
 * Add all of it to a scene.
 * @param {import("./table_picture.js").Scene} scene @param {Record<string, any>} table @param {Balls} balls
 * @param {number} phi deg @param {Trace | null} trace what the server says; without it the lines are the geometry's
 */
export function addSight(scene, table, balls, phi, trace) {
  const lines = /** @type {import("./table_picture.js").Line[]} */ (scene.lines ??= []);
  const over = /** @type {import("./table_picture.js").Line[]} */ (scene.over ??= []);
  const cueBall = balls[0];
  const end = alongRay(cueBall, phi, table);
  const length = (point) => Math.hypot(point[0] - cueBall[0], point[1] - cueBall[1]);
  const contact = firstContact(balls, phi);
  const hit = contact && length(contact.ghost) <= length(end) ? contact : null;
  lines.push({ points: [cueBall, hit?.ghost ?? end], colour: AIM, dash: [6, 5], alpha: 0.7 });
  if (hit) over.push({ points: circle(hit.ghost), colour: AIM, dash: [3, 3], alpha: 0.9 });
  if (trace) addWays(lines, over, trace, struckFirst(trace) ?? hit?.ball ?? null);
  else if (hit) lines.push(...geometry(balls, phi, hit));
}

/** The lines of centres and its perpendicular. @returns {import("./table_picture.js").Line[]} */
function geometry(balls, phi, { ball, ghost, line: [lx, ly] }) {
  const angle = (phi * Math.PI) / 180;
  const along = Math.cos(angle) * lx + Math.sin(angle) * ly;
  const [tx, ty] = [Math.cos(angle) - along * lx, Math.sin(angle) - along * ly];
  const [x, y] = balls[ball];
  return [
    { points: [[x, y], [x + REACH * along * lx, y + REACH * along * ly]], colour: STRUCK, width: 2 },
    { points: [ghost, [ghost[0] + REACH * tx, ghost[1] + REACH * ty]], colour: CUE_BALL, width: 2, dash: DASH },
  ];
}

function addWays(lines, over, trace, struck) {
  for (const ball of trace.balls) {
    const points = trace.path(ball);
    const end = trace.ball(ball, trace.duration);
    const [start] = points;
    if (points.length < 3 || Math.hypot(end.position[0] - start[0], end.position[1] - start[1]) < MOVED) continue;
    const look = ball === 0 ? { colour: CUE_BALL, width: 2, dash: DASH } : ball === struck ? { colour: STRUCK, width: 2 } : { colour: OTHERS, width: 1.2, alpha: 0.75 };
    lines.push({ points, ...look });
    if (isOnTable(end)) over.push({ points: circle(end.position), ...look, dash: [], width: 1.5, alpha: 0.35, filled: true }, { points: circle(end.position), ...look, dash: [], width: 1.5 });
  }
}

/** @param {Trace} trace */
function struckFirst(trace) {
  const first = trace.events.find((event) => event.kind === "ball_collision" && (event.ball === 0 || event.other === 0));
  return first ? (first.ball === 0 ? first.other : first.ball) : null;
}
