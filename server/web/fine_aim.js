/** A strip to turn the cue by very little: drag along it, tap its ends, or use the arrow keys. */

import { el } from "./dom.js";

/** Degrees a CSS pixel of a drag turns the cue, a tap, an arrow key, and one with Shift. */
const DRAGGED = 0.02;
const TAPPED = 0.1;
const KEY = 0.05;
const FINER = 0.01;
/** Movement in CSS pixels that makes a tap a drag. */
const DRAG = 4;

export class FineAim {
  /** @param {(degrees: number) => void} turn by so much, counterclockwise */
  constructor(turn) {
    this.turn = turn;
    this.element = el("div", {
      class: "fine-aim", role: "slider", tabindex: 0, "aria-label": "Fine aim", "aria-valuemin": 0, "aria-valuemax": 360, "aria-valuenow": 0,
    }, el("span", { "aria-hidden": "true" }, "◂"), el("span", { "aria-hidden": "true", class: "said" }, "fine aim"), el("span", { "aria-hidden": "true" }, "▸"));
    /** @type {{x: number, moved: boolean} | null} */
    this.grip = null;
    this.element.addEventListener("pointerdown", (event) => this.down(event));
    this.element.addEventListener("pointermove", (event) => this.move(event));
    this.element.addEventListener("pointerup", (event) => this.up(event));
    this.element.addEventListener("pointercancel", () => { this.grip = null; });
    this.element.addEventListener("keydown", (event) => this.key(event));
  }

  /** @param {number} phi deg */
  show(phi) {
    this.element.setAttribute("aria-valuenow", phi.toFixed(2));
    this.element.setAttribute("aria-valuetext", `${phi.toFixed(2)} degrees`);
    this.element.style.backgroundPositionX = `${-phi / DRAGGED}px`;
  }

  down(event) {
    this.grip = { x: event.clientX, moved: false };
    this.element.setPointerCapture(event.pointerId);
  }

  move(event) {
    if (!this.grip) return;
    const by = event.clientX - this.grip.x;
    if (!this.grip.moved && Math.abs(by) < DRAG) return;
    this.grip = { x: event.clientX, moved: true };
    this.turn(-by * DRAGGED);
  }

  up(event) {
    const box = this.element.getBoundingClientRect();
    if (this.grip && !this.grip.moved) this.turn(event.clientX < box.left + box.width / 2 ? TAPPED : -TAPPED);
    this.grip = null;
  }

  key(event) {
    const step = { ArrowLeft: 1, ArrowDown: 1, ArrowRight: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    this.turn(step * (event.shiftKey ? FINER : KEY));
  }
}
