/** A tournament: its standings, the ratings behind them, and every game of it. */

import { get } from "./api.js";
import { el, fill, when } from "./dom.js";
import { ratingPlot } from "./rating_plot.js";
import { describeOutcome } from "./words.js";

/** Time between two looks at a tournament that goes on, ms. */
const AGAIN = 5000;

/** @param {Record<string, any>} event */
export function tournamentRow(event) {
  return el("article", { class: "match" },
    el("a", { href: `#/tournaments/${event.id}` }, event.name), " ",
    el("span", { class: "facts" }, `${event.status}, ${event.format.replaceAll("_", " ")}, ${event.entrants.length} entrants, `,
      `${event.games} games, ${when(event.created_at)}`));
}

export class TournamentView {
  constructor() {
    this.element = el("article", {}, el("p", {}, "Loading …"));
    this.closed = false;
  }

  /** @param {string} id */
  async open(id) {
    const path = `/v1/tournaments/${encodeURIComponent(id)}`;
    while (!this.closed) {
      const [event, { standings, ratings, test }] = await Promise.all([get(path), get(`${path}/standings`)]);
      this.show(event, standings, test, ratings);
      if (!["running", "paused"].includes(event.status)) return;
      await new Promise((go) => setTimeout(go, AGAIN));
    }
  }

  show(event, standings, test, ratings) {
    if (this.closed) return;
    fill(this.element, el("h1", {}, event.name),
      el("p", {}, `${event.status}, ${event.format.replaceAll("_", " ")}, ${event.games} games played, ${event.due} to come`),
      test && el("p", {}, `Sequential test: ${test.verdict}, log-likelihood ratio ${test.llr.toFixed(2)} in (${test.bounds.map((bound) => bound.toFixed(2)).join(", ")}) after ${test.pairs} pairs`),
      standingsTable(standings),
      ratings.length > 1 && el("figure", {}, ratingPlot(ratings),
        el("figcaption", {}, "Ratings above the mean in Elo points (Bradley and Terry), with intervals of 95 % confidence")),
      el("h2", {}, "Games"), gameList(event.played));
  }

  close() {
    this.closed = true;
  }
}

function standingsTable(standings) {
  const columns = ["rank", "entrant", "points", "games", "won", "drawn", "lost"];
  return el("div", { class: "scroll" }, el("table", {}, el("caption", {}, "Standings"),
    el("thead", {}, el("tr", {}, columns.map((name) => el("th", { scope: "col" }, name)))),
    el("tbody", {}, standings.map((one) => el("tr", {},
      el("td", {}, one.rank),
      el("th", { scope: "row" }, el("a", { href: `#/agents/${one.agent}` }, one.name), one.withdrawn && " (withdrawn)"),
      [one.points, one.games, one.wins, one.draws, one.losses].map((value) => el("td", {}, value)))))));
}

function gameList(played) {
  return el("ul", { class: "rows" }, played.map((game) => el("li", {},
    game.match ? el("a", { href: `#/matches/${game.match}` }, game.players.join(" – ")) : game.players.join(" – "), " ",
    el("span", { class: "facts" }, `${game.pair}, ${game.outcome ? describeOutcome(game.outcome, game.players) : game.status}`))));
}
