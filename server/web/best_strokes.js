/** Strokes of the last games that raised their player's chance to win the most, each with its picture. */

import { get } from "./api.js";
import { percent } from "./chances.js";
import { el, fill } from "./dom.js";
import { Latest } from "./latest.js";
import { named } from "./words.js";

const SHOWN = 4;

export class BestStrokes {
  constructor() {
    this.gallery = el("div", { class: "gallery few" });
    this.latest = new Latest();
    this.element = el("section", { "aria-label": "Best strokes", hidden: true }, el("h2", {}, "Best strokes of the last games"), this.gallery);
  }

  async load() {
    const found = await get("/v1/best-strokes", this.latest.ask()).catch(() => null);
    if (!found) return;
    this.element.hidden = found.strokes.length === 0;
    fill(this.gallery, found.strokes.slice(0, SHOWN).map((one) => el("a", { class: "thumbnail", href: `#/games/${one.game}/strokes/${one.number}` },
      el("img", { src: `/v1/games/${one.game}/shots/${one.number}.svg`, alt: "", loading: "lazy", width: 232, height: 127 }),
      el("span", { class: "names" }, `${one.players[one.seat]}, `, el("span", { class: "gain", title: "Change of the chance to win" }, percent(one.after - one.before))),
      el("span", { class: "words" }, named(one.words, one.players)))));
  }
}
