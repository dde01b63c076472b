/** A stroke from its events: where every ball is at any time, exactly. */

import { advance, clothOf, isOnTable } from "./motion.js";

/** @typedef {import("./motion.js").BallState} BallState */
/** @typedef {Record<string, [number, number]>} Balls ball number to [x, y] */
/**
 * @typedef {object} TraceEvent
 * @property {number} index
 * @property {number} time s
 * @property {string} kind
 * @property {number} ball
 * @property {number} other
 * @property {(BallState & {ball: number})[]} states after the event
 */
/** @typedef {{time: number, state: BallState}} Stretch */

export class Trace {
  /**
   * @param {Record<string, any>} table
   * @param {Balls} before the table the stroke was played on
   * @param {TraceEvent[]} events
   * @param {number} duration s
   */
  constructor(table, before, events, duration) {
    this.cloth = clothOf(table);
    this.events = events;
    this.duration = duration;
    /** @type {Map<number, Stretch[]>} */
    this.stretches = new Map();
    for (const [ball, [x, y]] of Object.entries(before)) {
      const state = { position: [x, y], velocity: [0, 0], spin: [0, 0, 0], motion: "stationary" };
      this.stretches.set(Number(ball), [{ time: 0, state: /** @type {BallState} */ (state) }]);
    }
    for (const event of events) {
      for (const state of event.states) this.stretches.get(state.ball)?.push({ time: event.time, state });
    }
  }

  /** The numbers of the balls that were on the table. @returns {number[]} */
  get balls() {
    return [...this.stretches.keys()];
  }

  /**
   * One ball at a time in [0, duration]; at an event's time after it.
   * @param {number} ball @param {number} time @returns {BallState}
   */
  ball(ball, time) {
    const { stretch } = this.stretch(ball, time);
    return advance(this.cloth, stretch.state, time - stretch.time);
  }

  /**
   * The stretch of a ball's path that a time falls in, and its place among them.
   * @param {number} ball @param {number} time
   */
  stretch(ball, time) {
    const stretches = this.stretches.get(ball);
    if (!stretches) throw new RangeError(`ball ${ball} was not on the table`);
    let low = 0;
    let high = stretches.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (stretches[middle].time <= time) low = middle;
      else high = middle - 1;
    }
    return { stretch: stretches[low], place: low };
  }

  /** All balls at a time. @param {number} time @returns {Map<number, BallState>} */
  at(time) {
    return new Map(this.balls.map((ball) => [ball, this.ball(ball, time)]));
  }

  /**
   * The path of a ball as points, dense where it curves.
   * @param {number} ball @returns {[number, number][]}
   */
  path(ball) {
    const stretches = this.stretches.get(ball) || [];
    const points = [];
    stretches.forEach(({ time, state }, place) => {
      const end = place + 1 < stretches.length ? stretches[place + 1].time : this.duration;
      const steps = state.motion === "sliding" ? Math.max(2, Math.ceil((end - time) * 60)) : 1;
      for (let step = 0; step < steps && isOnTable(state); step++) {
        points.push(advance(this.cloth, state, ((end - time) * step) / steps).position);
      }
    });
    const last = this.ball(ball, this.duration);
    points.push(last.position);
    return points;
  }

  /** The event at or before a time, -1 before the first. @param {number} time */
  eventBefore(time) {
    let found = -1;
    for (const event of this.events) {
      if (event.time > time) break;
      found = event.index;
    }
    return found;
  }
}

/**
 * The trace of a stroke as records and answers write it; null for a decision.
 * @param {Record<string, any>} table @param {Record<string, any>} entry
 */
export function traceOf(table, entry) {
  if (!entry.before || !entry.events) return null;
  return new Trace(table, entry.before, entry.events, entry.duration ?? 0);
}
