/** The five parameters of a shot: numbers and sliders, and a picture of the cue ball for side and height. */

import { el, labelled, shape } from "./dom.js";
import { BALL_RADIUS } from "./motion.js";

/** @typedef {{v: number, phi: number, theta: number, a: number, b: number}} Shot m/s, deg, deg, mm, mm */

/** Farthest the tip may be from the centre here, mm: beyond it every stroke is a miscue waiting to happen. */
const REACH = Math.floor(BALL_RADIUS * 1000 * 0.75);

export class ShotForm {
  /** @param {(byHand: Partial<Shot>) => void} changed told what somebody has set, of what changed */
  constructor(changed) {
    this.changed = changed;
    /** @type {SVGElement[]} where the tip is, on every picture of the cue ball */
    this.dots = [];
    /** @type {Shot} */
    this.shot = { v: 2, phi: 270, theta: 5, a: 0, b: 0 };
    this.fields = {
      v: this.field("v", "Cue speed, m/s", 0, 10, 0.05), // until a table says how fast, and how steep
      phi: this.field("phi", "Direction, degrees", 0, 360, 0.05),
      theta: this.field("theta", "Cue raised, degrees", 0, 70, 0.1),
      a: this.field("a", "Side, mm (right is positive)", -REACH, REACH, 0.5),
      b: this.field("b", "Height, mm (up is positive)", -REACH, REACH, 0.5),
    };
    this.picture = this.cueBall(120);
    this.element = el("fieldset", { class: "panel shot-form" }, el("legend", {}, "Shot"),
      this.fields.phi.element, this.fields.v.element, this.fields.theta.element,
      el("div", { class: "picker" }, this.picture, el("div", {}, this.fields.a.element, this.fields.b.element)));
    this.write();
  }

  field(name, label, least, most, step) {
    const set = (event) => this.set({ [name]: Number(/** @type {HTMLInputElement} */ (event.target).value) }, true);
    const slider = /** @type {HTMLInputElement} */ (el("input", {
      type: "range", min: least, max: most, step, oninput: set, "aria-label": `${label}, slider`,
    }));
    const number = /** @type {HTMLInputElement} */ (el("input", { type: "number", min: least, max: most, step: "any", onchange: set, name }));
    return { slider, number, element: el("div", { class: "number-field" }, labelled(label, number), slider) };
  }

  /** The cue ball as the player sees it: a touch puts the tip there; keys do it by the two numbers. @param {number} size px */
  cueBall(size) {
    const picture = this.cueBallToSee(size);
    const pick = (event) => {
      if (!event.buttons) return;
      const box = picture.getBoundingClientRect();
      const a = (((event.clientX - box.left) / box.width) * 100 - 50) / 48 * BALL_RADIUS * 1000;
      const b = (50 - ((event.clientY - box.top) / box.height) * 100) / 48 * BALL_RADIUS * 1000;
      const shrink = Math.min(1, REACH / Math.hypot(a, b));
      this.set({ a: round(a * shrink), b: round(b * shrink) });
    };
    picture.addEventListener("pointerdown", pick);
    picture.addEventListener("pointermove", pick);
    return picture;
  }

  /** The same, to look at. @param {number} size px */
  cueBallToSee(size) {
    const dot = shape("circle", { r: size < 60 ? 9 : 5, class: "dot", fill: "#b3202c" });
    this.dots.push(dot);
    return shape("svg", { viewBox: "-50 -50 100 100", width: size, height: size, "aria-hidden": "true" },
      shape("circle", { r: 48, fill: "#f4f0e4", stroke: "#555" }), shape("path", { d: "M-48 0H48M0 -48V48", stroke: "#bbb" }), dot);
  }

  /** Change some of the parameters. @param {Partial<Shot>} changes @param {boolean} [byHand] in a field of their own */
  set(changes, byHand = false) {
    for (const [name, value] of Object.entries(changes)) {
      if (Number.isFinite(value)) this.shot = { ...this.shot, [name]: this.allowed(name, value) };
    }
    this.write();
    this.changed(byHand ? changes : {});
  }

  /** Take the ranges of a table. @param {{v_max: number, theta_max: number}} table */
  useTable({ v_max, theta_max }) {
    for (const [name, most] of Object.entries({ v: v_max, theta: theta_max })) {
      for (const input of [this.fields[name].slider, this.fields[name].number]) input.max = String(most);
      this.shot = { ...this.shot, [name]: this.allowed(name, this.shot[name]) };
    }
    this.write();
  }

  allowed(name, value) {
    if (name === "phi") return ((value % 360) + 360) % 360;
    const { slider } = this.fields[name];
    return Math.min(Number(slider.max), Math.max(Number(slider.min), value));
  }

  /** Raise the cue so far. What somebody writes into the other fields meanwhile is left alone. @param {number} theta deg */
  raise(theta) {
    this.shot = { ...this.shot, theta };
    this.writeField("theta");
  }

  writeField(name) {
    const { slider, number } = this.fields[name];
    slider.value = String(this.shot[name]);
    const rounded = Math.round(this.shot[name] * 1000) / 1000;
    number.value = String(name === "phi" ? rounded % 360 : rounded);
  }

  write() {
    for (const name of Object.keys(this.fields)) this.writeField(name);
    const scale = 48 / (BALL_RADIUS * 1000);
    for (const dot of this.dots) {
      dot.setAttribute("cx", String(this.shot.a * scale));
      dot.setAttribute("cy", String(-this.shot.b * scale));
    }
  }
}

function round(value) {
  return Math.round(value * 2) / 2;
}
