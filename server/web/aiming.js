/** A turn at the table: the cue ball in hand, the aim, the call, the preview; what is sent is an action. */

import { el, fill, labelled } from "./dom.js";
import { FineAim } from "./fine_aim.js";
import { handle } from "./handling.js";
import { freePlace, mayLie } from "./placement.js";
import { Preview } from "./preview.js";
import { ShotForm } from "./shot_form.js";
import { addSight } from "./sight.js";
import { SpinSheet } from "./spin_sheet.js";
import { cueOf } from "./stage.js";
import { Trace } from "./trace.js";
import { POCKETS, ballName } from "./words.js";

const MISCUE = "The tip would slip off the cue ball: a miscue.";
/** Least speed that a cue is pulled back for, m/s, and how far back it is drawn at the most, m. */
const SOFTEST = 0.1;
const DRAWN_BACK = 0.3;
/** From here on there is room for every number. */
const ROOMY = "(min-width: 1000px) and (min-height: 620px)";

export class Aiming {
  /**
   * @param {import("./stage.js").Stage} stage
   * @param {(action: Record<string, any>) => void} act
   */
  constructor(stage, act) {
    this.stage = stage;
    this.act = act;
    /** @type {Record<string, any> | null} the view of the turn at hand */
    this.view = null;
    /** @type {import("./trace.js").Balls} */
    this.balls = {};
    /** @type {Trace | null} */
    this.path = null;
    /** Whether the preview is that of the present aim; whether a stroke waits for it. */
    this.settled = false;
    this.waiting = false;
    /** @type {{v: number, part: number} | null} the cue is pulled back: the speed before, and how far */
    this.pulling = null;
    /** @type {Set<unknown>} advice given */
    this.advised = new Set();
    this.form = new ShotForm((byHand) => this.changed(byHand));
    this.preview = new Preview((answer, elevation, problem) => this.previewed(answer, elevation, problem));
    this.parts();
    handle(stage, this.hands());
    stage.decorate = (scene) => this.decorate(scene);
    stage.changed = () => this.showWhere();
  }

  /** The controls: few at hand, beside or below the table; the numbers for those who want them. */
  parts() {
    this.lowest = checkbox("as low as the cue can be", true, () => this.changed());
    this.ball = /** @type {HTMLSelectElement} */ (el("select", { onchange: () => this.stage.redraw() }));
    this.pocket = /** @type {HTMLSelectElement} */ (el("select", { onchange: () => this.stage.redraw() },
      POCKETS.map((name, number) => el("option", { value: number }, name))));
    this.safety = checkbox("safety", false, () => this.stage.redraw());
    this.call = el("div", { class: "call" }, labelled("Called ball", this.ball), labelled("Pocket", this.pocket), this.safety.element);
    this.coordinates = [this.placeField(0), this.placeField(1)];
    this.inHand = el("div", { class: "pair" }, labelled("Cue ball across, m", this.coordinates[0]), labelled("Cue ball along, m", this.coordinates[1]));
    this.problem = el("p", { class: "refusal", role: "alert" });
    this.hint = el("p", { class: "hint" });
    this.said = el("div", { class: "said-over" }, this.problem, this.hint);
    this.fine = new FineAim((degrees) => this.form.set({ phi: this.form.shot.phi + degrees }));
    this.spin = new SpinSheet(this.form, this.lowest.element);
    this.power = /** @type {HTMLInputElement} */ (el("input", { type: "range", min: 0, max: 10, step: 0.05, oninput: () => this.form.set({ v: Number(this.power.value) }) }));
    this.speed = el("output", { class: "speed" });
    this.shoot = /** @type {HTMLButtonElement} */ (el("button", { type: "button", class: "first shoot", onclick: () => this.send() }, "Shoot"));
    this.back = el("button", { type: "button", class: "first shoot", hidden: true, onclick: () => this.resume() }, "Back to your shot");
    this.decisions = el("div", { class: "choices" });
    this.numbers = el("details", { class: "numbers", open: matchMedia(ROOMY).matches }, el("summary", {}, "Numbers"), this.inHand, this.form.element);
    this.shotPart = el("div", { class: "shot-part" }, this.call,
      el("div", { class: "strip" }, this.spin.button, this.fine.element),
      el("label", { class: "power" }, el("span", {}, "Speed"), this.power, this.speed));
    this.element = el("section", { class: "turn", "aria-label": "Your turn", hidden: true },
      el("h2", {}, "Your turn"), this.decisions, this.shotPart, el("div", { class: "last" }, this.shoot, this.back), this.numbers);
  }

  hands() {
    return {
      active: () => this.canShoot && !this.stage.entry,
      balls: () => this.balls,
      movable: (ball) => ball === 0 && this.area !== null,
      move: (_, place) => this.place(place),
      aim: (phi) => this.form.set({ phi }),
      turn: (degrees) => this.form.set({ phi: this.form.shot.phi + degrees }),
      tapBall: (ball) => this.choose(this.ball, ball),
      tapPocket: (pocket) => this.choose(this.pocket, pocket),
      nudge: (right, up) => this.nudge(right, up),
      speed: (step) => this.form.set({ v: this.form.shot.v + step }),
      phi: () => this.form.shot.phi,
      pull: (part) => this.pull(part),
      release: () => this.release(),
    };
  }

  /** One coordinate of the cue ball in hand: dragging is not for everybody. @param {0 | 1} axis */
  placeField(axis) {
    const field = /** @type {HTMLInputElement} */ (el("input", { type: "number", step: "any" }));
    field.addEventListener("change", () => {
      const place = /** @type {[number, number]} */ ([...this.balls[0]]);
      place[axis] = Number(field.value);
      if (Number.isFinite(place[axis])) this.place(place);
    });
    return field;
  }

  get canShoot() {
    return Boolean(this.view?.allowed.actions.includes("shot"));
  }

  get area() {
    return this.view?.cue_ball_area ?? null;
  }

  /** Whether the terms let anybody simulate as often as they like; otherwise lines are drawn by geometry alone. */
  get mayPreview() {
    return !this.view?.budget;
  }

  /** Begin a turn. @param {Record<string, any>} view */
  begin(view) {
    this.view = view;
    this.balls = { ...view.balls };
    this.form.useTable(view.table);
    this.power.max = this.form.fields.v.slider.max;
    this.path = null;
    if (this.area && !(this.balls[0] && mayLie(view.table, this.balls, 0, this.balls[0], this.area))) {
      const place = freePlace(view.table, this.balls, 0, this.area);
      if (place) this.balls[0] = place;
    }
    fill(this.problem);
    fill(this.ball, view.callable_balls.map((ball) => el("option", { value: ball }, ballName(ball))));
    this.inHand.hidden = !this.area;
    this.call.hidden = !view.allowed.call_required;
    this.safety.input.checked = view.allowed.call_required && view.callable_balls.length === 0;
    for (const part of [this.shotPart, this.numbers, this.shoot]) part.hidden = !this.canShoot;
    fill(this.decisions, view.allowed.decisions.map((decision) => el("button", {
      type: "button", onclick: () => this.act({ decision }),
    }, decision.replaceAll("_", " "))));
    this.element.hidden = false;
    this.element.dataset.version = String(view.version);
    this.stage.rest(this.balls);
    if (this.canShoot) this.form.set({ phi: this.firstAim(), a: 0, b: 0, ...(view.phase === "break" && { v: 9 }) });
    if (this.canShoot) this.advise();
  }

  /** How it is done, each thing once; gone with the first touch. */
  advise() {
    const told = [
      this.area && "Drag the cue ball to its place.",
      "Drag on the table to aim; pull the cue back and let go, or press Shoot.",
      !this.mayPreview && "This game counts simulations: the lines are geometry alone.",
    ].filter((one) => one && !this.advised.has(one));
    for (const one of told) this.advised.add(one);
    fill(this.hint, told.join(" "));
  }

  /** The turn is over, or being carried out. */
  end() {
    this.view = null;
    this.path = null;
    this.pulling = null;
    this.preview.cancel();
    this.spin.close();
    fill(this.problem);
    fill(this.hint);
    this.element.hidden = true;
  }

  firstAim() {
    const { view, balls } = this;
    const target = balls[view.callable_balls[0]] ?? [view.table.width / 2, view.table.length / 4];
    return (Math.atan2(target[1] - balls[0][1], target[0] - balls[0][0]) * 180) / Math.PI;
  }

  choose(select, value) {
    if (![...select.options].some((option) => option.value === String(value))) return;
    select.value = String(value);
    this.safety.input.checked = false;
    this.stage.redraw();
  }

  /** @param {[number, number]} place */
  place(place) {
    this.balls = { ...this.balls, 0: place };
    this.changed();
  }

  nudge(right, up) {
    if (!this.area || !this.stage.picture) return;
    const { axes } = this.stage.picture.projection;
    const [x, y] = this.balls[0];
    this.place([x + right * axes.right[0] + up * axes.up[0], y + right * axes.right[1] + up * axes.up[1]]);
  }

  /** The cue is pulled back, or held at the ball again. @param {number | null} part 0 to 1 */
  pull(part) {
    this.pulling = { v: this.pulling?.v ?? this.form.shot.v, part: part ?? 0 };
    this.form.set({ v: part === null ? this.pulling.v : Math.max(SOFTEST, part * Number(this.power.max)) });
    fill(this.hint, part === null ? "At the ball: nothing is played." : `Let go to shoot at ${this.form.shot.v.toFixed(2)} m/s; push forward to keep it.`);
    if (part === null) this.pulling = null;
    this.stage.redraw();
  }

  release() {
    this.pulling = null;
    if (!this.shoot.disabled) this.send();
  }

  /** An earlier stroke is looked at in the middle of the turn: there is a way back, and no stroke until then. */
  showWhere() {
    const away = Boolean(this.view && this.canShoot && this.stage.entry);
    this.back.hidden = !away;
    this.shoot.hidden = away || !this.canShoot;
    this.said.hidden = away;
  }

  /** To the aim, from whatever was looked at. */
  resume() {
    this.stage.rest(this.balls);
    this.shoot.focus();
  }

  get legalPlace() {
    return !this.area || mayLie(this.view.table, this.balls, 0, this.balls[0], this.area);
  }

  /** The aim or the place has changed: ask the server where that leads. @param {Partial<import("./shot_form.js").Shot>} [byHand] */
  changed(byHand = {}) {
    if (!this.canShoot) return;
    if (!this.pulling) fill(this.hint);
    if ("theta" in byHand) this.lowest.input.checked = false;
    this.path = null;
    this.settled = this.waiting = false;
    this.coordinates.forEach((field, axis) => { field.value = String(this.balls[0][axis]); });
    fill(this.problem, this.legalPlace ? "" : "The cue ball may not lie there.");
    this.shoot.disabled = !this.legalPlace;
    if (this.legalPlace) this.ask();
    this.showShot();
    if (this.stage.entry || this.stage.balls !== this.balls) this.stage.rest(this.balls);
    else this.stage.redraw();
  }

  ask() {
    const { table } = this.view;
    this.preview.ask(table, this.balls, this.form.shot, this.lowest.input.checked, this.mayPreview);
  }

  /** The controls at hand follow the numbers. */
  showShot() {
    const { phi, v } = this.form.shot;
    this.fine.show(phi);
    this.spin.show();
    this.power.value = String(v);
    this.speed.textContent = `${v.toFixed(2)} m/s`;
  }

  previewed(answer, elevation, problem) {
    if (!this.view || !this.legalPlace) return; // asked before the ball was dragged to where it may not lie
    this.settled = true;
    fill(this.problem, problem || (answer?.facts.miscue ? MISCUE : ""));
    if (elevation !== null && this.lowest.input.checked) this.form.raise(elevation);
    this.spin.show();
    this.path = answer && answer.events ? new Trace(this.view.table, this.balls, answer.events, answer.duration) : null;
    this.stage.redraw();
    if (this.waiting) this.send();
  }

  /** @param {import("./table_picture.js").Scene} scene */
  decorate(scene) {
    if (!this.canShoot || this.stage.entry || !this.balls[0]) return;
    scene.area = this.area;
    if (this.area) scene.held = { position: this.balls[0], legal: this.legalPlace };
    if (this.view.allowed.call_required && !this.safety.input.checked) {
      scene.calledBall = Number(this.ball.value);
      scene.calledPocket = Number(this.pocket.value);
    }
    const { shot } = this.form;
    scene.cue = cueOf(this.balls[0], shot, -0.2);
    if (this.pulling) {
      const angle = (shot.phi * Math.PI) / 180;
      const [x, y] = scene.cue.tip;
      const back = DRAWN_BACK * this.pulling.part;
      scene.cue = { ...scene.cue, tip: [x - back * Math.cos(angle), y - back * Math.sin(angle)] };
    }
    addSight(scene, this.view.table, this.balls, shot.phi, this.path);
  }

  /** Shoot, once the server has said how far the cue must be raised for the aim as it is now. */
  send() {
    this.waiting = this.lowest.input.checked && !this.settled;
    if (this.waiting) return;
    const called = this.safety.input.checked ? "safety" : { ball: Number(this.ball.value), pocket: Number(this.pocket.value) };
    this.act({
      shot: this.form.shot,
      call: this.view.allowed.call_required ? called : null,
      cue_ball: this.area ? this.balls[0] : null,
    });
  }

  /** Say why an action was not accepted. @param {string} words */
  refuse(words) {
    fill(this.problem, words);
  }
}

/** @param {string} label @param {boolean} checked @param {() => void} changed */
function checkbox(label, checked, changed) {
  const input = /** @type {HTMLInputElement} */ (el("input", { type: "checkbox", checked, onchange: changed }));
  return { input, element: el("label", { class: "check" }, input, label) };
}
