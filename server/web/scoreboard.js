/** Who plays, what for, how long they have, whether they are there; and the result. */

import { cssColour, isStriped } from "./ball_picture.js";
import { el, fill, shape } from "./dom.js";
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
      fill(one.balls, group ? chips(group, Object.keys(state.state).map(Number)) : "");
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
  const facts = el("span", { class: "seat-facts" });
  const balls = el("span", { class: "balls" });
  const score = el("span", { class: "score", title: "games won" });
  const clock = el("span", { class: "clock" });
  const presence = el("span", { class: "presence" });
  const element = el("div", { class: "side" }, name, score, facts, balls, presence, clock);
  return { name, facts, balls, score, clock, presence, element };
}

/**
 * The balls of a group that are still up, in small; the 8 when there are none.
 * @param {string} group solids or stripes @param {number[]} onTable
 */
function chips(group, onTable) {
  const own = onTable.filter((ball) => ball !== 0 && ball !== 8 && isStriped(ball) === (group === "stripes"));
  const shown = own.length ? own : onTable.filter((ball) => ball === 8);
  const picture = shape("svg", {
    viewBox: `0 0 ${14 * Math.max(1, shown.length)} 14`, height: 14, width: 14 * Math.max(1, shown.length), role: "img",
    "aria-label": own.length ? `${own.length} to make` : "the 8 to make",
  });
  shown.forEach((ball, place) => picture.append(
    shape("circle", { cx: 14 * place + 7, cy: 7, r: 5.5, fill: isStriped(ball) ? "#f4f0e4" : cssColour(ball), class: "chip" }),
    shape("circle", { cx: 14 * place + 7, cy: 7, r: isStriped(ball) ? 3.4 : 0, fill: cssColour(ball) }),
  ));
  return picture;
}
