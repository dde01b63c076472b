/** Spin and elevation over the table: touch the ball where the tip is to strike it. */

import { el, labelled } from "./dom.js";

/** Size of the ball to touch and of the one on the button, px. */
const LARGE = 190;
const SMALL = 34;

export class SpinSheet {
  /**
   * @param {import("./shot_form.js").ShotForm} form
   * @param {HTMLElement} lowest the choice of a cue as low as it can be
   */
  constructor(form, lowest) {
    this.form = form;
    this.button = el("button", { type: "button", class: "spin", "aria-label": "Spin and elevation", "aria-expanded": "false", onclick: () => this.toggle() },
      form.cueBallToSee(SMALL));
    this.elevation = /** @type {HTMLInputElement} */ (el("input", {
      type: "range", min: 0, max: 70, step: 0.5, oninput: () => form.set({ theta: Number(this.elevation.value) }, true),
    }));
    this.element = el("div", { class: "spin-sheet", hidden: true, role: "group", "aria-label": "Where the tip strikes the cue ball" },
      form.cueBall(LARGE), labelled("Cue raised", this.elevation), lowest,
      el("div", { class: "choices" },
        el("button", { type: "button", onclick: () => form.set({ a: 0, b: 0 }) }, "Centre"),
        el("button", { type: "button", class: "first", onclick: () => this.close() }, "Done")));
    this.element.addEventListener("keydown", (event) => event.key === "Escape" && this.close());
  }

  toggle() {
    if (this.element.hidden) this.open();
    else this.close();
  }

  open() {
    this.element.hidden = false;
    this.button.setAttribute("aria-expanded", "true");
    this.show();
  }

  close() {
    if (this.element.contains(document.activeElement)) this.button.focus();
    this.element.hidden = true;
    this.button.setAttribute("aria-expanded", "false");
  }

  /** Follow the shot. */
  show() {
    this.elevation.max = this.form.fields.theta.slider.max;
    this.elevation.value = String(this.form.shot.theta);
  }
}
