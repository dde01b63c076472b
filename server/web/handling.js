/** Hands on the table: mouse, touch and keys aim the cue, move balls, point at balls and pockets. */

import { BALL_RADIUS } from "./motion.js";
import { pockets } from "./projection.js";

/** How near a pointer has to be, m: a fingertip's size on a phone. */
const NEAR = 1.6 * BALL_RADIUS;
const POCKET = 0.075;
/** Movement in CSS pixels that makes a tap a drag. */
const DRAG = 6;

/**
 * @typedef {object} Hands
 * @property {() => boolean} active whether the table listens
 * @property {() => import("./trace.js").Balls} balls
 * @property {(ball: number) => boolean} movable whether this ball may be moved now
 * @property {(ball: number, place: [number, number]) => void} move
 * @property {(phi: number) => void} aim
 * @property {(degrees: number) => void} turn
 * @property {(ball: number) => void} tapBall
 * @property {(pocket: number) => void} tapPocket
 * @property {(dx: number, dy: number) => void} nudge move the ball in hand by metres
 * @property {(steps: number) => void} speed
 */

/** @param {import("./stage.js").Stage} stage @param {Hands} hands */
export function handle(stage, hands) {
  const { canvas } = stage;
  canvas.tabIndex = 0;
  stage.holder.classList.add("aiming");
  /** @type {{ball: number | null, from: [number, number], moved: boolean} | null} */
  let grip = null;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return stage.picture.projection.unplace(event.clientX - box.left, event.clientY - box.top);
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (!hands.active()) return;
    const ball = nearest(hands.balls(), place(event));
    grip = { ball: ball !== null && hands.movable(ball) ? ball : null, from: [event.clientX, event.clientY], moved: false };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!grip || !hands.active()) return;
    grip.moved ||= Math.hypot(event.clientX - grip.from[0], event.clientY - grip.from[1]) > DRAG;
    if (!grip.moved) return;
    if (grip.ball !== null) hands.move(grip.ball, place(event));
    else aimAt(hands, place(event));
  });
  canvas.addEventListener("pointerup", (event) => {
    if (grip && !grip.moved && hands.active()) tap(stage, hands, place(event));
    grip = null;
  });
  canvas.addEventListener("pointercancel", () => { grip = null; });
  canvas.addEventListener("keydown", (event) => key(event, hands));
}

/** @param {import("./trace.js").Balls} balls @param {[number, number]} place */
function nearest(balls, [x, y]) {
  let found = null;
  let least = NEAR;
  for (const [ball, [bx, by]] of Object.entries(balls)) {
    const distance = Math.hypot(x - bx, y - by);
    if (distance < least) [found, least] = [Number(ball), distance];
  }
  return found;
}

/** @param {Hands} hands @param {[number, number]} place */
function aimAt(hands, [x, y]) {
  const cueBall = hands.balls()[0];
  if (cueBall) hands.aim((Math.atan2(y - cueBall[1], x - cueBall[0]) * 180) / Math.PI);
}

function tap(stage, hands, place) {
  const at = ({ mouth, hole }) => [mouth, hole].some(([x, y]) => Math.hypot(x - place[0], y - place[1]) < POCKET);
  const pocket = pockets(stage.picture.table).findIndex(at);
  const ball = nearest(hands.balls(), place);
  if (ball !== null && ball !== 0) hands.tapBall(ball);
  else if (pocket >= 0) hands.tapPocket(pocket);
  else if (ball === null) aimAt(hands, place);
}

/** Arrows turn the cue and change its speed, finer with Shift; with Alt they move the ball in hand. */
function key(event, hands) {
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
  if (!step || !hands.active()) return;
  event.preventDefault();
  const [right, up] = step;
  if (event.altKey) hands.nudge(right * (event.shiftKey ? 0.001 : 0.01), up * (event.shiftKey ? 0.001 : 0.01));
  else if (right) hands.turn(-right * (event.shiftKey ? 0.05 : 1));
  else hands.speed(up * (event.shiftKey ? 0.05 : 0.25));
}
