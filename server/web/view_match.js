/** One match: its terms and its games. */

import { get } from "./api.js";
import { el, facts, fill } from "./dom.js";
import { foreseeableMark, gameRow, stateMark, unratedMark } from "./match_row.js";
import { describeTable } from "./tables.js";
import { describeNoise, duration } from "./words.js";

export class MatchView {
  constructor() {
    this.element = el("article", {}, el("p", {}, "Loading …"));
  }

  /** @param {string} id */
  async open(id) {
    const match = await get(`/v1/matches/${encodeURIComponent(id)}`);
    const player = (seat) => el("a", { href: `#/agents/${match.agents[seat]}` }, match.players[seat]);
    fill(this.element,
      el("header", { class: "heading" }, el("h1", {}, `${match.players[0]} – ${match.players[1]}`),
        facts(stateMark(match.status), describeTable(match.table), describeNoise(match.noise), `${duration(match.clock.seconds)} a player and game`,
          match.start && "from a position", !match.rated && unratedMark(), match.foreseeable && foreseeableMark())),
      el("p", { class: "total panel" }, player(0), el("strong", {}, `${match.score[0]} : ${match.score[1]}`), player(1)),
      el("h2", {}, "Games"),
      match.played.length ? el("ul", { class: "rows panel" }, match.played.map((game) => el("li", {}, gameRow(match, game)))) :
        el("p", { class: "empty" }, "No game has begun."));
  }

  close() {}
}
