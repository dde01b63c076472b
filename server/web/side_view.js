/** A stroke from the side: how high balls fly over the way they go, to scale, and what they fly over. */

import { cssColour } from "./ball_picture.js";
import { el, fill, shape } from "./dom.js";
import { BALL_RADIUS } from "./motion.js";
import { ballName } from "./words.js";

/** @typedef {import("./trace.js").Trace} Trace */
/**
 * @typedef {object} Sample a moment of a ball's way
 * @property {number} time s
 * @property {number} along m, the way in plan that it has gone
 * @property {[number, number]} position m
 * @property {number} height m, of its centre over where it rests on the cloth
 */

/** Moments of a flight that are drawn, besides its ends; and of another stretch. */
const STEPS = 40;
const FEW = 4;
/** A ball that rises less is not drawn, m: every stroke with a raised cue makes the cue ball hop a little. */
const LEAST_HOP = 5e-4;
/** Balls drawn at most; m of way shown after the last landing, and at least. */
const MOST = 3;
const BEYOND = 0.12;
const LEAST_WIDTH = 1;
/** Units of the picture a metre, and heights with a line, m. */
const SCALE = 1000;
const LINES = [0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8];

/**
 * A ball's way, dense where it flies; every height is the closed form's.
 * @param {Trace} trace @param {number} ball @returns {Sample[]}
 */
export function profile(trace, ball) {
  const stretches = trace.stretches.get(ball) ?? [];
  /** @type {Sample[]} */
  const samples = [];
  let along = 0;
  const add = (time, { position, height = 0 }) => {
    const before = samples.at(-1);
    if (before) along += Math.hypot(position[0] - before.position[0], position[1] - before.position[1]);
    samples.push({ time, along, position, height });
  };
  stretches.forEach(({ time, state }, place) => {
    const end = stretches[place + 1]?.time ?? trace.duration;
    const steps = state.motion === "flying" ? STEPS : state.motion === "sliding" ? FEW : 1;
    for (let step = 0; step < steps; step++) {
      const moment = time + ((end - time) * step) / steps;
      add(moment, trace.ball(ball, moment));
    }
  });
  if (stretches.length) add(trace.duration, trace.ball(ball, trace.duration));
  return samples;
}

/**
 * Balls in the way that lie still as another passes over: where on its way, m.
 * @param {Trace} trace @param {number} ball the one that flies @param {Sample[]} samples
 * @returns {{ball: number, along: number}[]}
 */
export function passed(trace, ball, samples) {
  const found = [];
  for (const other of trace.balls) {
    if (other === ball) continue;
    const away = ({ time, position, height }) => {
      const { motion, position: [x, y] } = trace.ball(other, time);
      return motion === "stationary" && height > 0 ? Math.hypot(position[0] - x, position[1] - y) : Infinity;
    };
    const nearest = samples.reduce((one, two) => (away(one) <= away(two) ? one : two));
    if (away(nearest) < BALL_RADIUS) found.push({ ball: other, along: nearest.along });
  }
  return found;
}

export class SideView {
  constructor() {
    this.strips = el("div", {});
    this.element = el("figure", { class: "side-view", hidden: true }, this.strips,
      el("figcaption", {}, "From the side, to scale: the way in plan to the right, the height upwards. Thin circles: balls that are flown over."));
  }

  /** @param {Trace | null} trace */
  show(trace) {
    const flights = (trace?.balls ?? []).map((ball) => ({ ball, samples: profile(trace, ball) }))
      .map((one) => ({ ...one, highest: Math.max(0, ...one.samples.map(({ height }) => height)) }))
      .filter(({ highest }) => highest > LEAST_HOP).sort((one, two) => two.highest - one.highest).slice(0, MOST);
    this.element.hidden = flights.length === 0;
    fill(this.strips, flights.map((flight) => strip(/** @type {Trace} */ (trace), flight)));
  }
}

/** One ball from the side. @param {Trace} trace @param {{ball: number, samples: Sample[], highest: number}} flight */
function strip(trace, { ball, samples, highest }) {
  const last = samples.findLast(({ height }) => height > LEAST_HOP);
  const length = Math.min(samples.at(-1).along, Math.max(last.along + BEYOND, LEAST_WIDTH - 2 * BALL_RADIUS));
  const top = Math.max(highest + 2 * BALL_RADIUS, 5 * BALL_RADIUS);
  const right = (along) => (along + BALL_RADIUS) * SCALE;
  const up = (height) => (top - height - BALL_RADIUS) * SCALE; // of a centre
  const told = `${ballName(ball)}: ${(100 * highest).toFixed(1)} cm high at most`;
  const width = Math.max(LEAST_WIDTH, length + 2 * BALL_RADIUS);
  const size = { viewBox: `0 0 ${(width * SCALE).toFixed(1)} ${((top + 0.012) * SCALE).toFixed(1)}`, role: "img", "aria-label": told };
  const seen = samples.filter(({ along }) => along <= length);
  return el("div", {}, el("p", { class: "facts" }, told), shape("svg", size,
    ...LINES.filter((height) => height < top - 2 * BALL_RADIUS).flatMap((height) => [
      shape("line", { class: "grid", x1: 0, x2: width * SCALE, y1: up(height - BALL_RADIUS), y2: up(height - BALL_RADIUS) }),
      shape("text", { x: 4, y: up(height - BALL_RADIUS) - 4 }, `${Math.round(100 * height)} cm`),
    ]),
    shape("rect", { class: "cloth", x: 0, y: top * SCALE, width: width * SCALE, height: 0.012 * SCALE }),
    ...passed(trace, ball, samples).map((one) => shape("circle", {
      class: "passed", cx: right(one.along), cy: up(0), r: BALL_RADIUS * SCALE, stroke: cssColour(one.ball),
    })),
    shape("polyline", { class: "way", points: seen.map(({ along, height }) => `${right(along).toFixed(1)},${up(height).toFixed(1)}`).join(" ") }),
    ...[seen[0], seen.reduce((one, two) => (one.height >= two.height ? one : two)), seen.at(-1)].map(({ along, height }) => shape("circle", {
      class: "ball", cx: right(along), cy: up(height), r: BALL_RADIUS * SCALE, fill: cssColour(ball),
    }))));
}
