/** The strokes of a game as a list to choose from. */

import { el, fill } from "./dom.js";
import { percent } from "./chances.js";
import { describeAction } from "./words.js";

export class StrokeList {
  /** @param {(place: number) => void} choose */
  constructor(choose) {
    this.choose = choose;
    this.list = el("ol", { class: "strokes" });
    this.element = el("nav", { class: "stroke-list", "aria-label": "Strokes" }, el("h2", {}, "Strokes"), this.list,
      el("p", { class: "facts" }, "Pockets and cushions are called as on a map: N on the frame is north, where breaks are played from."));
    /** @type {HTMLElement[]} */
    this.rows = [];
    /** @type {HTMLElement[]} by stroke */
    this.tags = [];
    /** Of how many strokes it is told what came of them. */
    this.told = 0;
    /** @type {HTMLElement[]} by stroke: how much it changed its player's chance */
    this.swings = [];
    /** The row that is marked. */
    this.here = -1;
  }

  /** Mark the strokes that changed the chances most. @param {import("./chances.js").Swing[]} swings */
  markSwings(swings) {
    this.swings.forEach((one) => fill(one));
    for (const { place, gain } of swings) {
      if (this.swings[place]) fill(this.swings[place], el("span", { class: `tag ${gain > 0 ? "made" : "foul"}`, title: "Change of the player's chance to win" }, percent(gain)));
    }
    this.scroll();
  }

  /**
   * List so many strokes, and what came of them.
   * @param {import("./game_model.js").GameModel} model
   * @param {number} count strokes to be listed @param {number} rolling the last one, if its balls still roll: nothing is said of it
   */
  update(model, count = model.entries.length, rolling = -1) {
    for (let place = this.rows.length; place < count; place++) {
      const entry = model.entries[place];
      const tags = el("span", { class: "tags" });
      const swing = el("span", {});
      this.swings.push(swing);
      const button = el("button", { type: "button", class: "row", onclick: () => this.choose(place) },
        el("span", { class: "count" }, place), " ", el("span", {}, el("span", { class: "who" }, model.players[entry.seat]), " ", describeAction(entry)), " ", el("span", {}, swing, " ", tags));
      this.rows.push(button);
      this.list.append(el("li", {}, button));
      this.tags.push(tags);
    }
    for (; this.told < this.rows.length && this.told !== rolling; this.told++) this.tell(this.tags[this.told], model.entries[this.told]);
  }

  /** What came of a stroke. @param {HTMLElement} tags @param {Record<string, any>} entry */
  tell(tags, entry) {
    const said = entry.ruling.fouls.length ? "foul" : entry.ruling.made ? "made" : "";
    fill(tags, entry.miscue && el("span", { class: "tag" }, "miscue"), " ", said && el("span", { class: `tag ${said}` }, said));
  }

  /** @param {number} place */
  mark(place) {
    this.rows.forEach((row, index) => {
      if (index === place) row.setAttribute("aria-current", "true");
      else row.removeAttribute("aria-current");
    });
    this.here = place;
    this.scroll();
  }

  /** The marked row into sight. */
  scroll() {
    const row = this.rows[this.here];
    if (row) this.list.scrollTop = row.offsetTop - this.list.offsetTop - this.list.clientHeight / 2;
  }
}
