/** One stroke on the table: played, stopped, scrubbed; the cue before it, what was meant, the ghost without noise. */

import { drawnNumbers } from "./ball_picture.js";
import { isEmbedded } from "./api.js";
import { el, fill } from "./dom.js";
import { BALL_RADIUS, isOnTable } from "./motion.js";
import { Orientations } from "./orientation.js";
import { Playback, reducedMotion } from "./playback.js";
import { Projection } from "./projection.js";
import { TablePicture } from "./table_picture.js";
import { contactDistance } from "./tables.js";
import { Trace, traceOf } from "./trace.js";
import { describeEvent } from "./words.js";

/** Seconds the cue is seen before the stroke, and seconds a ball takes to sink. */
const LEAD = 0.7;
const SINK = 0.2;
const CUE_LENGTH = 1.45;
const MEANT = "#ffffff";
const PLAYED = "#ff9d45";
const GHOST = "#9bd7ff";
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

export class Stage {
  /**
   * @param {{ended?: () => void, moved?: (time: number) => void}} [told]
   */
  constructor({ ended = () => {}, moved = () => {} } = {}) {
    this.playWord = "Play";
    this.moved = moved;
    this.canvas = /** @type {HTMLCanvasElement} */ (el("canvas", { role: "img", "aria-label": "The table" }));
    this.holder = el("div", { class: "table" }, this.canvas);
    this.playback = new Playback((time) => this.show(time), () => { this.showPlaying(); ended(); });
    /** @type {TablePicture | null} */
    this.picture = null;
    /** @type {Trace | null} */
    this.trace = null;
    /** @type {Orientations | null} */
    this.orientations = null;
    /** @type {Trace | null} */
    this.ghost = null;
    /** @type {Record<string, any> | null} */
    this.entry = null;
    /** @type {import("./trace.js").Balls} */
    this.balls = {};
    this.turned = new Map();
    /** @type {(scene: import("./table_picture.js").Scene) => void} what a page adds to the scene */
    this.decorate = () => {};
    /** Called when another stroke, or none, is on the table. */
    this.changed = () => {};
    this.replay = this.controls();
    this.element = el("section", { class: "stage", "aria-label": "Table" }, this.holder, this.replay);
    setTimeout(drawnNumbers); // while the balls are still asked for
    this.observer = new ResizeObserver(() => this.fit());
    this.observer.observe(this.holder);
  }

  controls() {
    this.playButton = el("button", { type: "button", class: "play", onclick: () => this.toggle() }, "Play");
    const back = el("button", { type: "button", "aria-label": "Event before", onclick: () => this.stepEvent(-1) }, "◂ event");
    const on = el("button", { type: "button", "aria-label": "Next event", onclick: () => this.stepEvent(1) }, "event ▸");
    this.scrubber = /** @type {HTMLInputElement} */ (el("input", {
      type: "range", min: 0, max: 1, step: "any", value: 0, "aria-label": "Time of the stroke",
      oninput: () => this.seek(Number(this.scrubber.value)),
    }));
    this.speed = /** @type {HTMLSelectElement} */ (el("select", {
      "aria-label": "Speed", onchange: () => { this.playback.speed = Number(this.speed.value); },
    }, SPEEDS.map((speed) => el("option", { value: speed, selected: speed === 1 }, `${speed} ×`))));
    this.lines = /** @type {HTMLInputElement} */ (el("input", { type: "checkbox", checked: true, onchange: () => this.redraw() }));
    this.timeText = el("output", { class: "time" }, "");
    return el("div", { class: "controls" },
      this.playButton, back, on, this.scrubber, this.timeText, this.speed,
      el("label", { class: "check" }, this.lines, "aim lines"));
  }

  /** @param {Record<string, any>} table */
  useTable(table) {
    this.picture = new TablePicture(this.canvas, table, { changed: () => this.redraw() });
    this.fit();
  }

  /** As large as there is room, turned whichever way that is. */
  fit() {
    if (!this.picture || !this.holder.clientWidth) return;
    const { clientWidth: width, clientHeight } = this.holder;
    const height = this.fills ? clientHeight : isEmbedded() ? Math.max(180, window.innerHeight * 0.5) : Math.max(280, window.innerHeight * 0.66);
    if (!height) return;
    const scale = (lying) => new Projection(this.picture.table, width, height, lying).scale;
    this.picture.lying = scale(true) > scale(false);
    this.picture.fit(width, height);
    this.redraw();
  }

  /** Whether the table has a place of a size of its own to fill. */
  get fills() {
    return this.holder.classList.contains("fills");
  }

  /** Show balls at rest. @param {import("./trace.js").Balls} balls */
  rest(balls) {
    this.entry = this.trace = this.orientations = this.ghost = null;
    this.balls = balls;
    this.playback.load(0, 0);
    this.redraw();
    this.showPlaying();
    this.changed();
  }

  /**
   * Show a stroke or a decision.
   * @param {Record<string, any>} entry @param {import("./trace.js").Balls} before
   * @param {{play?: boolean, atEnd?: boolean}} [how]
   */
  load(entry, before, { play = false, atEnd = false } = {}) {
    if (!this.picture) return;
    if (this.orientations) this.turned = this.orientations.final();
    this.entry = entry;
    this.ghost = null;
    this.trace = traceOf(this.picture.table, entry);
    this.balls = this.trace ? before : entry.game?.state ?? before;
    this.orientations = this.trace && new Orientations(this.trace, this.turned);
    this.playback.load(this.trace ? -LEAD : 0, this.trace?.duration ?? 0);
    this.scrubber.min = String(this.playback.start);
    this.scrubber.max = String(this.playback.duration);
    this.scrubber.disabled = !this.trace;
    if (atEnd || !this.trace) this.playback.seek(this.playback.duration);
    else if (play && !reducedMotion()) this.playback.play();
    this.redraw();
    this.showPlaying();
    this.changed();
  }

  /** Lay the same stroke, played otherwise, over the picture. @param {Record<string, any> | null} answer of a simulation */
  setGhost(answer) {
    const table = this.picture?.table;
    this.ghost = answer && table && this.trace ? new Trace(table, this.entry?.before, answer.events, answer.duration) : null;
    this.redraw();
  }

  toggle() {
    if (this.playback.playing) this.playback.pause();
    else this.playback.play();
    this.showPlaying();
  }

  showPlaying() {
    fill(this.playButton, this.playback.playing ? "Pause" : this.playWord);
  }

  /** @param {number} time */
  seek(time) {
    this.playback.pause();
    this.showPlaying();
    this.playback.seek(time);
  }

  /** To the next event at another time, or the one before. @param {1 | -1} direction */
  stepEvent(direction) {
    if (!this.trace) return;
    const times = this.trace.events.map((event) => event.time);
    const now = this.playback.time;
    const next = direction > 0 ? times.find((time) => time > now) : times.findLast((time) => time < now);
    this.seek(next ?? (direction > 0 ? this.playback.duration : this.playback.start));
  }

  redraw() {
    this.show(this.playback.time);
  }

  /** @param {number} time */
  show(time) {
    if (!this.picture) return;
    this.scrubber.value = String(time);
    const event = this.trace?.eventBefore(time) ?? -1;
    const said = this.trace && event >= 0 ? describeEvent(this.trace.events[event]) : "before the stroke";
    this.timeText.textContent = this.trace ? `${Math.max(0, time).toFixed(2)} s` : "";
    this.scrubber.setAttribute("aria-valuetext", `${Math.max(0, time).toFixed(2)} seconds, ${said}`);
    this.picture.draw(this.scene(time));
    this.moved(time);
  }

  /** @param {number} time @returns {import("./table_picture.js").Scene} */
  scene(time) {
    /** @type {import("./table_picture.js").Scene} */
    const scene = { balls: new Map(), lines: [], over: [], cue: null };
    if (this.trace) this.addMoving(scene, this.trace, Math.max(0, time));
    else for (const [ball, position] of Object.entries(this.balls)) scene.balls.set(Number(ball), { position });
    if (this.entry?.shot) this.addStroke(scene, time);
    if (this.ghost) this.addGhost(scene, Math.max(0, time));
    this.decorate(scene);
    return scene;
  }

  /** @param {import("./table_picture.js").Scene} scene @param {Trace} trace @param {number} time */
  addMoving(scene, trace, time) {
    for (const ball of trace.balls) {
      const { stretch } = trace.stretch(ball, time);
      const turned = this.orientations?.at(ball, time);
      if (isOnTable(stretch.state)) {
        const { position, height } = trace.ball(ball, time);
        scene.balls.set(ball, { position, height, turned });
      } else if (time - stretch.time < SINK) {
        scene.balls.set(ball, { position: stretch.state.position, turned, alpha: 1 - (time - stretch.time) / SINK });
      }
    }
  }

  addStroke(scene, time) {
    const { action, shot, before } = this.entry;
    const cueBall = before?.[0];
    if (!cueBall) return;
    if (action.call && action.call !== "safety") {
      scene.calledBall = action.call.ball;
      scene.calledPocket = action.call.pocket;
    }
    if (this.lines.checked) {
      scene.lines.push({ points: this.ray(cueBall, action.shot.phi), colour: MEANT, dash: [6, 5], alpha: 0.8 });
      scene.lines.push({ points: this.ray(cueBall, shot.phi), colour: PLAYED, alpha: 0.9 });
    }
    if (time < 0.12) scene.cue = cueOf(cueBall, shot, time);
  }

  addGhost(scene, time) {
    const { ghost } = this;
    for (const ball of ghost.balls) {
      const state = ghost.ball(ball, Math.min(time, ghost.duration));
      const path = ghost.path(ball);
      if (path.length > 2) scene.lines.push({ points: path, colour: GHOST, dash: [2, 3], alpha: 0.8 });
      if (isOnTable(state)) scene.over.push({ points: circle(state.position), colour: GHOST, width: 1.5 });
    }
  }

  /** From a ball in a direction to the cushion line. @param {[number, number]} from @param {number} phi deg */
  ray(from, phi) {
    return [from, alongRay(from, phi, /** @type {TablePicture} */ (this.picture).table)];
  }

  /** Stop everything. */
  close() {
    this.playback.pause();
    this.observer.disconnect();
  }
}

/** Where a ray from a ball reaches the lines of the cushions. */
export function alongRay([x, y], phi, table) {
  const { width, length } = table;
  const near = contactDistance(table, BALL_RADIUS);
  const angle = (phi * Math.PI) / 180;
  const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
  const room = [
    dx > 0 ? (width - near - x) / dx : dx < 0 ? (near - x) / dx : Infinity,
    dy > 0 ? (length - near - y) / dy : dy < 0 ? (near - y) / dy : Infinity,
  ];
  const reach = Math.max(0, Math.min(...room));
  return /** @type {[number, number]} */ ([x + reach * dx, y + reach * dy]);
}

/** The cue at a time: drawn back before the stroke, at the ball at 0. */
export function cueOf([x, y], { phi, theta, a }, time) {
  const angle = (phi * Math.PI) / 180;
  const back = BALL_RADIUS + 0.004 + (time < 0 ? 0.16 * Math.sin(Math.min(1, -time / LEAD) * Math.PI * 0.5) : -0.03);
  const side = a / 1000;
  const tip = [x - back * Math.cos(angle) + side * Math.sin(angle), y - back * Math.sin(angle) - side * Math.cos(angle)];
  return { tip: /** @type {[number, number]} */ (tip), phi, length: CUE_LENGTH * Math.cos((theta * Math.PI) / 180) };
}

/** The outline of a ball. @param {[number, number]} centre @returns {[number, number][]} */
export function circle([x, y]) {
  return Array.from({ length: 25 }, (_, part) => {
    const angle = (part * Math.PI) / 12;
    return [x + BALL_RADIUS * Math.cos(angle), y + BALL_RADIUS * Math.sin(angle)];
  });
}
