/** One match: its terms and its games. */

import { get } from "./api.js";
import { el, fill } from "./dom.js";
import { gameRow } from "./match_row.js";

export class MatchView {
  constructor() {
    this.element = el("article", {}, el("p", {}, "Loading …"));
  }

  /** @param {string} id */
  async open(id) {
    const match = await get(`/v1/matches/${encodeURIComponent(id)}`);
    const noise = match.noise.level === null ? "not told" : match.noise.level;
    fill(this.element,
      el("h1", {}, `${match.players[0]} – ${match.players[1]}`),
      el("p", {}, `${match.status}, score ${match.score[0]} : ${match.score[1]}, noise ${noise}, ${match.clock.seconds} s each and game`),
      el("p", {}, match.agents.map((agent, seat) => [el("a", { href: `#/agents/${agent}` }, match.players[seat]), " "]).flat()),
      el("ul", { class: "rows" }, match.played.map((game) => el("li", {}, gameRow(match, game)))));
  }

  close() {}
}
