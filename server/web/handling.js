/** Hands on the table: mouse, touch and keys aim the cue, pull it back, move balls, point at balls and pockets. */

import { BALL_RADIUS } from "./motion.js";
import { pockets } from "./projection.js";

/** How near a pointer has to be to a ball or the cue, m, and a finger at least, CSS pixels. */
const NEAR = 1.6 * BALL_RADIUS;
const FINGER = 22;
const POCKET = 0.075;
/** Movement in CSS pixels that makes a tap a drag. */
const DRAG = 6;
/** CSS pixels that the cue may be pulled back before that means a stroke, and those that mean the fastest. */
const IDLE_PULL = 14;
const FULL_PULL = 190;
/** A soft stroke is most of the way, so that it is easy to meter. */
const CURVE = 1.6;

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
 * @property {() => number} [phi] where the cue points, deg; without it the cue cannot be pulled
 * @property {(part: number | null) => void} [pull] pulled back by so much of the way, 0 to 1; null: let go at the ball
 * @property {() => void} [release] let go with the cue pulled back
 */

/** @param {import("./stage.js").Stage} stage @param {Hands} hands */
export function handle(stage, hands) {
  const { canvas } = stage;
  canvas.tabIndex = 0;
  stage.holder.classList.add("aiming");
  /** @type {{ball: number | null, cue: boolean, part: number | null, from: [number, number], moved: boolean} | null} */
  let grip = null;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return stage.picture.projection.unplace(event.clientX - box.left, event.clientY - box.top);
  };
  const near = (event) => (event.pointerType === "touch" ? Math.max(NEAR, FINGER / stage.picture.projection.scale) : NEAR);
  canvas.addEventListener("pointerdown", (event) => {
    if (!hands.active()) return;
    const at = place(event);
    const ball = nearest(hands.balls(), at, near(event));
    const held = ball !== null && hands.movable(ball) ? ball : null;
    const cue = held === null && Boolean(hands.phi) && (ball === 0 || (ball === null && isOnCue(hands, at, near(event))));
    grip = { ball: held, cue, part: null, from: [event.clientX, event.clientY], moved: false };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!grip || !hands.active()) return;
    grip.moved ||= Math.hypot(event.clientX - grip.from[0], event.clientY - grip.from[1]) > DRAG;
    if (!grip.moved) return;
    if (grip.cue) hands.pull?.(grip.part = pulled(stage, hands, grip.from, event));
    else if (grip.ball !== null) hands.move(grip.ball, place(event));
    else aimAt(hands, place(event));
  });
  canvas.addEventListener("pointerup", (event) => {
    const held = grip;
    grip = null;
    if (!held || !hands.active()) return;
    if (!held.moved) tap(stage, hands, place(event), near(event));
    else if (held.cue && held.part !== null) hands.release?.();
  });
  canvas.addEventListener("pointercancel", () => {
    if (grip?.cue) hands.pull?.(null);
    grip = null;
  });
  canvas.addEventListener("keydown", (event) => key(event, hands));
}

/** How far the cue is pulled back, 0 to 1; null when so little that nothing is meant. */
function pulled(stage, hands, [x, y], event) {
  const { right, up } = stage.picture.projection.axes;
  const angle = (hands.phi() * Math.PI) / 180;
  const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
  const forward = (event.clientX - x) * (dx * right[0] + dy * right[1]) - (event.clientY - y) * (dx * up[0] + dy * up[1]);
  return -forward < IDLE_PULL ? null : Math.min(1, (-forward - IDLE_PULL) / (FULL_PULL - IDLE_PULL)) ** CURVE;
}

/** Whether a place is on the cue, which lies behind the cue ball. */
function isOnCue(hands, [x, y], near) {
  const cueBall = hands.balls()[0];
  if (!cueBall) return false;
  const angle = (hands.phi() * Math.PI) / 180;
  const [fromX, fromY] = [x - cueBall[0], y - cueBall[1]];
  const along = -(fromX * Math.cos(angle) + fromY * Math.sin(angle));
  const beside = fromX * Math.sin(angle) - fromY * Math.cos(angle);
  return along > 0 && Math.abs(beside) < 0.7 * near;
}

/** @param {import("./trace.js").Balls} balls @param {[number, number]} place @param {number} near m */
function nearest(balls, [x, y], near) {
  let found = null;
  let least = near;
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

function tap(stage, hands, place, near) {
  const at = ({ mouth, hole }) => [mouth, hole].some(([x, y]) => Math.hypot(x - place[0], y - place[1]) < POCKET);
  const pocket = pockets(stage.picture.table).findIndex(at);
  const ball = nearest(hands.balls(), place, near);
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
