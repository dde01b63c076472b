/** What happened, in words. */

export const POCKETS = ["south-west", "west", "north-west", "north-east", "east", "south-east"];
/** As the referee's sentences have them, in the same order. */
const SHORT = ["SW", "W", "NW", "NE", "E", "SE"];
const CUSHIONS = ["west", "east", "south", "north"];
const REASONS = {
  eight_made: "the 8 made as called",
  eight_with_foul: "the 8 pocketed with a foul",
  eight_too_early: "the 8 pocketed too early",
  eight_not_as_called: "the 8 pocketed other than called",
  eight_off_table: "the 8 left the table",
};

/** @type {Promise<Record<string, string>> | null} */
let catalogue = null;

/** Every rule id with its sentence, from the referee's own catalogue. */
export function rules() {
  catalogue ??= fetch("/web/rules.json").then((answer) => answer.json()).catch(forget);
  return catalogue;
}

/** The server could not be reached: the ids have to do, until the next time. */
function forget() {
  catalogue = null;
  return {};
}

/** The referee's sentence with the players' names, and pockets called as everywhere on the page. @param {string} words @param {string[]} players */
export function named(words, players) {
  const called = words.replace(/\bpocket ([NS]?[WE])\b/g, (_, short) => `the ${POCKETS[SHORT.indexOf(short)]} pocket`);
  return called.replace(/\b[Pp]layer ([01])\b/g, (_, seat) => players[Number(seat)]);
}

/** @param {number} ball */
export function ballName(ball) {
  return ball === 0 ? "cue ball" : `ball ${ball}`;
}

/** @param {import("./trace.js").TraceEvent} event */
export function describeEvent({ kind, ball, other }) {
  const name = ballName(ball);
  switch (kind) {
    case "cue_strike":
      return "the cue strikes the cue ball";
    case "ball_collision":
      return `${name} meets ${ballName(other)}`;
    case "rail_collision":
      return `${name} at the ${CUSHIONS[other]} cushion`;
    case "jaw_collision":
      return `${name} at a jaw of the ${POCKETS[other >> 1]} pocket`;
    case "landing":
      return `${name} lands on the cloth`;
    case "rail_top":
      return `${name} on the top of the ${CUSHIONS[other]} rail`;
    case "off_table":
      return `${name} leaves the table`;
    case "pocket_collision":
      return `${name} falls in the ${POCKETS[other]} pocket`;
    default:
      return `${name}: ${kind.replaceAll("_", " to ")}`;
  }
}

/** A stroke or decision as it was asked for. @param {Record<string, any>} entry */
export function describeAction(entry) {
  const { action } = entry;
  if (action.decision) return action.decision.replaceAll("_", " ");
  if (action.call === "safety") return "safety";
  if (action.call) return `ball ${action.call.ball} in the ${POCKETS[action.call.pocket]} pocket`;
  return "break";
}

/** @param {Record<string, any>} shot */
export function describeShot({ v, phi, theta, a, b }) {
  const side = Math.abs(a) < 0.05 ? "" : `, ${Math.abs(a).toFixed(1)} mm ${a > 0 ? "right" : "left"}`;
  const height = Math.abs(b) < 0.05 ? "" : `, ${Math.abs(b).toFixed(1)} mm ${b > 0 ? "high" : "low"}`;
  return `${v.toFixed(2)} m/s at ${(((phi % 360) + 360) % 360).toFixed(1)}°, cue raised ${theta.toFixed(1)}°${side}${height}`;
}

/** @param {{winner: number | null, reason: string}} outcome @param {string[]} players */
export function describeOutcome({ winner, reason }, players) {
  const why = REASONS[reason] || reason.replaceAll("_", " ");
  return winner === null ? `Drawn: ${why}` : `${players[winner]} wins: ${why}`;
}

/** How much noise a match has. @param {{level: number | null}} noise */
export function describeNoise({ level }) {
  if (level === null) return "noise not told";
  return level === 0 ? "no noise" : `noise ${level}`;
}

/** A clock. @param {number | null} seconds */
export function minutes(seconds) {
  if (seconds === null) return "no clock";
  const left = Math.max(0, seconds);
  return `${Math.floor(left / 60)}:${String(Math.floor(left % 60)).padStart(2, "0")}`;
}

/** So many seconds, as people say it. @param {number | null} seconds */
export function duration(seconds) {
  if (seconds === null) return "any time";
  const whole = seconds >= 120 && seconds % 60 === 0;
  return whole ? `${seconds / 60} minutes` : `${seconds} s`;
}
