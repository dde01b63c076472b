/** The strokes of a game as a list to choose from. */

import { el } from "./dom.js";
import { describeAction } from "./words.js";

export class StrokeList {
  /** @param {(place: number) => void} choose */
  constructor(choose) {
    this.choose = choose;
    this.list = el("ol", { class: "strokes" });
    this.element = el("nav", { class: "stroke-list", "aria-label": "Strokes" }, el("h2", {}, "Strokes"), this.list);
    /** @type {HTMLElement[]} */
    this.rows = [];
  }

  /** @param {import("./game_model.js").GameModel} model */
  update(model) {
    for (let place = this.rows.length; place < model.entries.length; place++) {
      const entry = model.entries[place];
      const said = entry.ruling.fouls.length ? "foul" : entry.ruling.made ? "made" : "";
      const button = el("button", { type: "button", class: "row", onclick: () => this.choose(place) },
        el("span", { class: "count" }, place), " ", el("span", {}, el("span", { class: "who" }, model.players[entry.seat]), " ",
          describeAction(entry)), " ", entry.miscue && el("span", { class: "tag" }, "miscue"), " ", said && el("span", { class: `tag ${said}` }, said));
      this.rows.push(button);
      this.list.append(el("li", {}, button));
    }
  }

  /** @param {number} place */
  mark(place) {
    this.rows.forEach((row, index) => {
      if (index === place) row.setAttribute("aria-current", "true");
      else row.removeAttribute("aria-current");
    });
    const row = this.rows[place];
    if (row) this.list.scrollTop = row.offsetTop - this.list.offsetTop - this.list.clientHeight / 2;
  }
}
