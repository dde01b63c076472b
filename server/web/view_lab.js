/** The laboratory: any position, any shot; what it does, how far noise spreads it, and how to say it elsewhere. */

import { ProblemError, call, token } from "./api.js";
import { announce, el, fill, labelled } from "./dom.js";
import { handle } from "./handling.js";
import { density, heatPainter, noisy } from "./heat.js";
import { Latest } from "./latest.js";
import { mayLie } from "./placement.js";
import { Preview } from "./preview.js";
import { ShotForm } from "./shot_form.js";
import { SideView } from "./side_view.js";
import { addSight } from "./sight.js";
import { asCurl, asJson, asPython, labAddress, notation, readAddress, readNotation } from "./snippets.js";
import { Stage, cueOf } from "./stage.js";
import { namedTable, tableNames, tableTitle } from "./tables.js";
import { Trace } from "./trace.js";
import { POCKETS, ballName, describeEvent } from "./words.js";

const VARIANTS = 200;
/** Variants at once for those without a token, who may not send them in one request. */
const AT_ONCE = 8;
/** Time after the last change before the address follows, ms. */
const PAUSE = 300;
const RACKS = 10;
const START = { 0: [0.5, 1.7], 3: [0.4, 0.6], 8: [0.7, 0.9] };
const WRITERS = {
  Notation: (balls) => notation(balls),
  Python: asPython,
  JSON: asJson,
  curl: (balls, shot, table) => asCurl(balls, shot, table, location.origin),
};

export class LabView {
  constructor() {
    this.element = el("article", { class: "lab" });
    /** @type {import("./trace.js").Balls} */
    this.balls = structuredClone(START);
    /** @type {Stage | null} */
    this.stage = null;
    /** @type {any} */
    this.answer = null;
    /** @type {((context: any, projection: any) => void) | null} */
    this.heat = null;
    this.paths = null;
    /** @type {any[] | null} the shot as noise played it */
    this.rows = null;
    this.spreading = new Latest();
    /** Whether somebody has written a text that is not set up yet. */
    this.typed = false;
    this.closed = false;
  }

  /** @param {string} query of the address: a position and a shot, or a rack */
  async open(query) {
    this.racks = await fetch("/web/racks.json").then((answer) => answer.json()).catch(() => ({}));
    if (this.closed) return; // somebody went on: the address is another page's by now
    this.stage = new Stage();
    this.form = new ShotForm(() => this.changed());
    this.preview = new Preview((answer, elevation, problem) => this.previewed(answer, elevation, problem));
    this.problem = el("p", { class: "refusal", role: "alert" });
    this.misread = el("p", { class: "refusal", role: "alert" });
    this.outcome = el("p", { role: "status", class: "outcome" });
    this.events = el("ol", { class: "events" });
    this.side = new SideView();
    this.back = /** @type {HTMLButtonElement} */ (el("button", { type: "button", onclick: () => this.changed() }, "Back to the position"));
    this.lowest = /** @type {HTMLInputElement} */ (el("input", { type: "checkbox", checked: true, onchange: () => this.changed() }));
    fill(this.element, el("h1", {}, "Laboratory"),
      el("div", { class: "columns" },
        el("div", { class: "main-column" }, this.stage.element,
          el("div", { class: "controls" },
            el("button", { type: "button", class: "first", onclick: () => this.play() }, "Play the shot"), this.back),
          this.misread, this.problem, this.outcome, this.side.element),
        el("div", { class: "side-column" }, this.tablePart(), this.ballPart(), this.form.element,
          el("label", { class: "check" }, this.lowest, "cue as low as it can be")),
        el("div", { class: "more" }, this.spreadPart(), this.textPart(), el("details", {}, el("summary", {}, "Events"), this.events))));
    this.stage.decorate = (scene) => this.decorate(scene);
    this.stage.changed = () => this.showPlayed();
    handle(this.stage, this.hands());
    const misread = this.setUp(query);
    this.changed();
    fill(this.misread, misread);
  }

  /** Begin as the address says. @param {string} query @returns {string} what is wrong with it */
  setUp(query) {
    this.useTable(tableNames()[0]);
    try {
      const { table, balls, shot, rack, lowest } = readAddress(query);
      if (table !== null && !tableNames().includes(table)) throw new Error(`There is no table ${table}.`);
      if (table !== null) this.useTable(table);
      if (balls && !balls[0]) throw new Error("The address names no cue ball, 0.");
      if (rack !== null) this.rackUp(rack);
      if (balls) this.balls = balls;
      if (!shot) return "";
      this.lowest.checked = lowest;
      this.form.set(shot);
      return "";
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
  }

  /** The balls as for a break. @param {number} number which of the racks */
  rackUp(number) {
    const balls = this.racks[this.table.name]?.[number];
    if (!balls) return;
    this.rack = number;
    this.balls = structuredClone(balls);
    this.form.set({ v: 9, phi: 270, a: 0, b: 0 });
  }

  /** The address has the position and the shot: it can be sent, and comes back to them. */
  writeAddress() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => history.replaceState(null, "", this.address), PAUSE);
  }

  get address() {
    return labAddress(this.table.name, this.balls, this.form.shot, this.lowest.checked);
  }

  /** @param {string} name */
  useTable(name) {
    this.table = namedTable(name);
    this.kind.value = name;
    this.stage.useTable(this.table);
    this.form.useTable(this.table);
    const lying = Object.entries(this.balls).every(([ball, place]) => mayLie(this.table, this.balls, Number(ball), place));
    if (!lying) this.balls = structuredClone(START);
  }

  tablePart() {
    const choice = this.kind = /** @type {HTMLSelectElement} */ (el("select", {
      onchange: () => { this.useTable(choice.value); this.changed(); },
    }, tableNames().map((name) => el("option", { value: name }, tableTitle(name)))));
    return el("p", { class: "one-line" }, labelled("Kind of table", choice),
      el("button", { type: "button", onclick: () => { this.rackUp(((this.rack ?? -1) + 1) % RACKS); this.changed(); } }, "Rack"),
      el("button", { type: "button", onclick: () => this.share() }, "Copy link"));
  }

  ballPart() {
    const balls = Array.from({ length: 16 }, (_, ball) => ball);
    this.which = /** @type {HTMLSelectElement} */ (el("select", {}, balls.map((ball) => el("option", { value: ball }, ballName(ball)))));
    return el("fieldset", { class: "panel" }, el("legend", {}, "Balls"),
      el("p", { class: "facts" }, "Drag balls on the table; drag beside them to aim."),
      el("div", { class: "choices" }, labelled("Ball", this.which),
        el("button", { type: "button", onclick: () => this.add() }, "Put on the table"),
        el("button", { type: "button", onclick: () => this.remove() }, "Take away")));
  }

  spreadPart() {
    this.level = /** @type {HTMLInputElement} */ (el("input", { type: "number", min: 0, max: 5, step: 0.1, value: 1 }));
    this.shownBall = /** @type {HTMLSelectElement} */ (el("select", { onchange: () => this.drawHeat() },
      el("option", { value: "" }, "all that moved"), Array.from({ length: 16 }, (_, ball) => el("option", { value: ball }, ballName(ball)))));
    this.fallen = el("p", { class: "facts", role: "status" });
    return el("fieldset", { class: "panel" }, el("legend", {}, "Spread by noise"),
      el("div", { class: "choices" }, labelled("Level of noise", this.level), labelled("Ends of", this.shownBall),
        el("button", { type: "button", onclick: () => this.spread() }, `Play it ${VARIANTS} times`)), this.fallen);
  }

  textPart() {
    this.format = /** @type {HTMLSelectElement} */ (el("select", { onchange: () => this.writeText() },
      Object.keys(WRITERS).map((name) => el("option", { value: name }, name))));
    this.text = /** @type {HTMLTextAreaElement} */ (el("textarea", {
      class: "code", spellcheck: "false", "aria-label": "Text", oninput: () => { this.typed = true; },
    }));
    this.unread = el("p", { class: "refusal", role: "alert" });
    return el("fieldset", { class: "panel" }, el("legend", {}, "As text"),
      el("div", { class: "choices" }, labelled("Format", this.format),
        el("button", { type: "button", onclick: () => this.copy() }, "Copy"),
        el("button", { type: "button", onclick: () => this.readText() }, "Set up from the notation")), this.text, this.unread);
  }

  hands() {
    return {
      active: () => !this.stage.entry,
      balls: () => this.balls,
      movable: () => true,
      move: (ball, place) => this.put(ball, place),
      aim: (phi) => this.form.set({ phi }),
      turn: (degrees) => this.form.set({ phi: this.form.shot.phi + degrees }),
      tapBall: (ball) => { this.which.value = String(ball); },
      tapPocket: () => {},
      nudge: (right, up) => this.nudge(right, up),
      speed: (step) => this.form.set({ v: this.form.shot.v + step }),
    };
  }

  /** @param {number} ball @param {[number, number]} place */
  put(ball, place) {
    if (!mayLie(this.table, this.balls, ball, place)) return;
    this.balls = { ...this.balls, [ball]: place };
    this.which.value = String(ball);
    this.changed();
  }

  nudge(right, up) {
    const ball = Number(this.which.value);
    const { axes } = this.stage.picture.projection;
    const place = this.balls[ball];
    if (place) this.put(ball, [place[0] + right * axes.right[0] + up * axes.up[0], place[1] + right * axes.right[1] + up * axes.up[1]]);
  }

  add() {
    const ball = Number(this.which.value);
    for (let y = this.table.length / 2; y > 0.1; y -= 0.07) {
      for (let x = 0.1; x < this.table.width; x += 0.07) if (mayLie(this.table, this.balls, ball, [x, y])) return this.put(ball, [x, y]);
    }
  }

  remove() {
    const { [this.which.value]: gone, ...rest } = this.balls;
    if (!gone || this.which.value === "0") return announce("The cue ball stays on the table.");
    this.balls = rest;
    this.changed();
  }

  changed() {
    this.heat = this.paths = this.answer = this.rows = null;
    this.spreading.withdraw();
    for (const said of [this.misread, this.problem, this.fallen, this.unread]) fill(said);
    this.stage.rest(this.balls);
    this.outcome.setAttribute("aria-busy", "true"); // it is that of the shot before
    this.preview.ask(this.table, this.balls, this.form.shot, this.lowest.checked);
    this.writeText();
    this.writeAddress();
  }

  /** What plays a stroke on the table is there while one is. */
  showPlayed() {
    this.stage.replay.hidden = this.back.disabled = !this.stage.entry;
  }

  async share() {
    history.replaceState(null, "", this.address);
    await navigator.clipboard?.writeText(location.href).catch(() => {});
    announce("The address has this position and shot; it is copied.");
  }

  previewed(answer, elevation, problem) {
    fill(this.problem, problem);
    if (elevation !== null && this.lowest.checked) {
      this.form.raise(elevation);
      this.writeAddress();
    }
    this.answer = answer;
    this.paths = answer?.events ? new Trace(this.table, this.balls, answer.events, answer.duration) : null;
    this.side.show(this.paths);
    const fallen = answer?.events?.filter((event) => event.kind === "pocket_collision").map(describeEvent) ?? [];
    if (answer?.facts.miscue) fallen.unshift("miscue: the tip slips off the cue ball");
    this.outcome.removeAttribute("aria-busy");
    fill(this.outcome, answer ? [`${answer.n_events} events in ${answer.duration.toFixed(2)} s`, ...fallen].join("; ") : "");
    fill(this.events, (answer?.events ?? []).slice(0, 400).map((event) => el("li", { value: event.index }, `${event.time.toFixed(4)} s  ${describeEvent(event)}`)));
    this.stage.redraw();
    if (!this.typed) this.writeText();
  }

  /** @param {import("./table_picture.js").Scene} scene */
  decorate(scene) {
    if (this.heat) scene.under = this.heat;
    if (this.stage.entry || !this.balls[0]) return;
    scene.cue = cueOf(this.balls[0], this.form.shot, -0.2);
    addSight(scene, this.table, this.balls, this.form.shot.phi, this.paths);
  }

  play() {
    if (!this.answer?.events) return;
    const { events, duration } = this.answer;
    const { shot } = this.form;
    this.stage.load({ before: this.balls, events, duration, shot, action: { shot, call: null } }, this.balls, { play: true });
  }

  async spread() {
    const shots = Array.from({ length: VARIANTS }, () => noisy(this.form.shot, Number(this.level.value) || 0, this.table));
    const signal = this.spreading.ask();
    try {
      const results = await (token() ? this.inOne(shots, signal) : this.oneByOne(shots, signal));
      signal.throwIfAborted();
      this.rows = results;
      this.drawHeat();
      fill(this.fallen, this.fallenText(results));
    } catch (error) {
      if (signal.aborted) return;
      fill(this.fallen, el("span", { class: "refusal" }, error instanceof ProblemError ? error.message : "The server cannot be reached."));
    }
  }

  async inOne(shots, signal) {
    const body = { table: this.table.name, balls: this.balls, shots };
    return (await call("POST", "/v1/simulate/batch", { body, signal })).results;
  }

  /** Without a token: some at a time. */
  async oneByOne(shots, signal) {
    const left = [...shots];
    const rows = [];
    const { table, balls } = this;
    const work = async () => {
      for (let shot = left.pop(); shot; shot = left.pop()) {
        const answer = await call("POST", "/v1/simulate", { body: { table: table.name, balls, shot, trace: false }, signal });
        rows.push({ balls: answer.balls, pocketed: Object.fromEntries(Object.entries(answer.facts.pocket).filter(([, pocket]) => pocket >= 0)) });
      }
    };
    await Promise.all(Array.from({ length: AT_ONCE }, work));
    return rows;
  }

  fallenText(results) {
    const counts = new Map();
    for (const { pocketed } of results) {
      for (const [ball, pocket] of Object.entries(pocketed)) {
        const name = `${ballName(Number(ball))} ${POCKETS[pocket]}`;
        counts.set(name, (counts.get(name) ?? 0) + 1);
      }
    }
    const parts = [...counts].sort((one, two) => two[1] - one[1]).map(([name, count]) => `${name} ${Math.round((100 * count) / results.length)} %`);
    return parts.length ? `Pocketed: ${parts.join(", ")}` : "No ball is pocketed.";
  }

  drawHeat() {
    if (!this.rows) return;
    const only = this.shownBall.value === "" ? null : Number(this.shownBall.value);
    this.heat = heatPainter(density(this.rows, this.balls, only));
    this.stage.redraw();
  }

  /** Write the position and the shot over whatever stands there. */
  writeText() {
    this.typed = false;
    this.text.value = WRITERS[this.format.value](this.balls, this.form.shot, this.table.name);
  }

  async copy() {
    this.text.select();
    await navigator.clipboard?.writeText(this.text.value).catch(() => {});
    announce("Copied.");
  }

  readText() {
    try {
      const balls = readNotation(this.text.value);
      if (!balls[0]) throw new Error("The notation names no cue ball, 0.");
      this.balls = balls;
      this.format.value = "Notation";
      this.changed();
    } catch (error) {
      fill(this.unread, error instanceof Error ? error.message : String(error));
    }
  }

  close() {
    this.closed = true;
    clearTimeout(this.timer);
    this.preview?.cancel();
    this.spreading.withdraw();
    this.stage?.close();
  }
}
