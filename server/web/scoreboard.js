/** Who plays, what for, how long they have, whether they are there; and the result. */

import { el, fill } from "./dom.js";
import { describeOutcome, minutes } from "./words.js";

export class Scoreboard {
  constructor() {
    this.sides = [side(), side()];
    this.result = el("p", { class: "result", role: "status" });
    this.element = el("section", { class: "scoreboard", "aria-label": "Players" },
      this.sides[0].element, this.sides[1].element, this.result);
  }

  /** @param {import("./game_model.js").GameModel} model @param {Record<string, any> | null} state the referee's, as shown */
  show(model, state) {
    const over = model.result !== null;
    const turn = over ? null : (model.clocks?.turn ?? state?.turn ?? null);
    this.sides.forEach((one, seat) => {
      one.element.classList.toggle("turn", turn === seat);
      fill(one.name, model.players[seat]);
      const group = state?.groups?.[seat];
      fill(one.facts, [turn === seat ? "at the table" : "", group ?? ""].filter(Boolean).join(", "));
      fill(one.score, String(model.score?.[seat] ?? ""));
      const away = !over && model.connected !== null && !model.connected[seat];
      fill(one.presence, away ? "disconnected" : "");
    });
    fill(this.result, model.result?.outcome ? describeOutcome(model.result.outcome, model.players) : "");
    this.tick(model);
  }

  /** Let the clocks go on. @param {import("./game_model.js").GameModel} model */
  tick(model) {
    this.sides.forEach((one, seat) => {
      const left = model.secondsLeft(seat);
      const text = model.clocks ? minutes(left) : "";
      if (one.clock.textContent !== text) one.clock.textContent = text;
      one.clock.classList.toggle("running", Boolean(model.clocks?.clocks[seat].running) && model.result === null);
    });
  }
}

function side() {
  const name = el("strong", { class: "name" });
  const facts = el("span", { class: "facts" });
  const score = el("span", { class: "score", title: "games won" });
  const clock = el("span", { class: "clock" });
  const presence = el("span", { class: "presence" });
  return { name, facts, score, clock, presence, element: el("div", { class: "side" }, name, score, facts, clock, presence) };
}
