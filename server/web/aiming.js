/** A turn at the table: the cue ball in hand, the aim, the call, the preview; what is sent is an action. */

import { el, fill, labelled } from "./dom.js";
import { handle } from "./handling.js";
import { freePlace, mayLie } from "./placement.js";
import { Preview } from "./preview.js";
import { ShotForm } from "./shot_form.js";
import { cueOf } from "./stage.js";
import { Trace } from "./trace.js";
import { POCKETS, ballName } from "./words.js";

const PATH = "#9bd7ff";
const MISCUE = "The tip would slip off the cue ball: a miscue.";

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
    this.form = new ShotForm(() => this.changed());
    this.preview = new Preview((answer, elevation, problem) => this.previewed(answer, elevation, problem));
    this.lowest = checkbox("as low as the cue can be", true, () => this.changed());
    this.ball = /** @type {HTMLSelectElement} */ (el("select", { onchange: () => this.stage.redraw() }));
    this.pocket = /** @type {HTMLSelectElement} */ (el("select", { onchange: () => this.stage.redraw() },
      POCKETS.map((name, number) => el("option", { value: number }, name))));
    this.safety = checkbox("safety", false, () => this.stage.redraw());
    this.call = el("div", { class: "choices" }, labelled("Called ball", this.ball), labelled("Pocket", this.pocket), this.safety.element);
    this.coordinates = [this.placeField(0), this.placeField(1)];
    this.inHand = el("div", { class: "pair" }, labelled("Cue ball across, m", this.coordinates[0]), labelled("Cue ball along, m", this.coordinates[1]));
    this.problem = el("p", { class: "refusal", role: "alert" });
    this.hint = el("p", { class: "facts" });
    this.shoot = el("button", { type: "button", class: "first", onclick: () => this.send() }, "Shoot");
    this.decisions = el("div", { class: "choices" });
    this.shotPart = el("div", { class: "panel" }, this.inHand, this.form.element, this.lowest.element, this.call, this.shoot);
    this.element = el("section", { class: "turn", "aria-label": "Your turn", hidden: true },
      el("h2", {}, "Your turn"), this.hint, this.problem, this.decisions, this.shotPart);
    handle(stage, this.hands());
    stage.decorate = (scene) => this.decorate(scene);
  }

  hands() {
    return {
      active: () => this.canShoot,
      balls: () => this.balls,
      movable: (ball) => ball === 0 && this.area !== null,
      move: (_, place) => this.place(place),
      aim: (phi) => this.form.set({ phi }),
      turn: (degrees) => this.form.set({ phi: this.form.shot.phi + degrees }),
      tapBall: (ball) => this.choose(this.ball, ball),
      tapPocket: (pocket) => this.choose(this.pocket, pocket),
      nudge: (right, up) => this.nudge(right, up),
      speed: (step) => this.form.set({ v: this.form.shot.v + step }),
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

  /** Begin a turn. @param {Record<string, any>} view */
  begin(view) {
    this.view = view;
    this.balls = { ...view.balls };
    this.form.useTable(view.table);
    this.path = null;
    if (this.area && !(this.balls[0] && mayLie(view.table, this.balls, 0, this.balls[0], this.area))) {
      const place = freePlace(view.table, this.balls, 0, this.area);
      if (place) this.balls[0] = place;
    }
    fill(this.problem);
    fill(this.hint, this.area ? "The cue ball is in hand: drag it, or move it with Alt and the arrow keys." :
      "Drag on the table to aim, or turn the cue with the arrow keys.");
    fill(this.ball, view.callable_balls.map((ball) => el("option", { value: ball }, ballName(ball))));
    this.inHand.hidden = !this.area;
    this.call.hidden = !view.allowed.call_required;
    this.safety.input.checked = view.allowed.call_required && view.callable_balls.length === 0;
    this.shotPart.hidden = !this.canShoot;
    fill(this.decisions, view.allowed.decisions.map((decision) => el("button", {
      type: "button", onclick: () => this.act({ decision }),
    }, decision.replaceAll("_", " "))));
    this.element.hidden = false;
    this.element.dataset.version = String(view.version);
    this.stage.rest(this.balls);
    if (this.canShoot) this.form.set({ phi: this.firstAim(), ...(view.phase === "break" && { v: 9 }) });
  }

  /** The turn is over, or being carried out. */
  end() {
    this.view = null;
    this.path = null;
    this.preview.cancel();
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

  get legalPlace() {
    return !this.area || mayLie(this.view.table, this.balls, 0, this.balls[0], this.area);
  }

  /** The aim or the place has changed: ask the server where that leads. */
  changed() {
    if (!this.canShoot) return;
    this.path = null;
    this.settled = this.waiting = false;
    this.coordinates.forEach((field, axis) => { field.value = String(this.balls[0][axis]); });
    fill(this.problem, this.legalPlace ? "" : "The cue ball may not lie there.");
    /** @type {HTMLButtonElement} */ (this.shoot).disabled = !this.legalPlace;
    if (this.legalPlace) this.preview.ask(this.view.table, this.balls, this.form.shot, this.lowest.input.checked);
    this.stage.rest(this.balls);
  }

  previewed(answer, elevation, problem) {
    if (!this.view || !this.legalPlace) return; // asked before the ball was dragged to where it may not lie
    this.settled = true;
    fill(this.problem, problem || (answer?.facts.miscue ? MISCUE : ""));
    if (elevation !== null && this.lowest.input.checked) this.form.raise(elevation);
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
    scene.cue = cueOf(this.balls[0], this.form.shot, -0.2);
    scene.lines?.push({ points: this.stage.ray(this.balls[0], this.form.shot.phi), colour: "#ffffff", dash: [6, 5], alpha: 0.6 });
    for (const ball of this.path?.balls ?? []) {
      const points = this.path.path(ball);
      if (points.length > 2) scene.lines?.push({ points, colour: PATH, alpha: 0.9 });
    }
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
