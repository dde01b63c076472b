/** A tournament: its standings, the ratings behind them, and every game of it. */

import { get } from "./api.js";
import { ago, el, facts, fill } from "./dom.js";
import { foreseeableMark, stateMark } from "./match_row.js";
import { ratingPlot } from "./rating_plot.js";
import { describeTable } from "./tables.js";
import { describeOutcome } from "./words.js";

/** Time between two looks at a tournament that is not over, ms. */
const AGAIN = 5000;
/** How a tournament stands that stays as it is. */
const OVER = ["finished", "aborted"];

/** @param {Record<string, any>} event */
export function tournamentRow(event) {
  return el("article", { class: "match" },
    el("a", { href: `#/tournaments/${event.id}` }, event.name),
    facts(stateMark(event.status), event.format.replaceAll("_", " "), `${event.entrants.length} entrants`, `${event.games} games`,
      event.foreseeable && foreseeableMark(), ago(event.created_at)));
}

export class TournamentView {
  constructor() {
    this.element = el("article", {}, el("p", {}, "Loading …"));
    this.closed = false;
  }

  /** @param {string} id */
  async open(id) {
    const path = `/v1/tournaments/${encodeURIComponent(id)}`;
    let status = await this.look(path);
    while (!OVER.includes(status)) {
      await new Promise((go) => setTimeout(go, AGAIN));
      if (this.closed) return;
      status = await this.look(path).catch(() => status); // a server that restarts is back soon
    }
  }

  /** Show how it stands now. @param {string} path @returns {Promise<string>} its status */
  async look(path) {
    const [event, { standings, ratings, test }] = await Promise.all([get(path), get(`${path}/standings`)]);
    this.show(event, standings, test, ratings);
    return event.status;
  }

  show(event, standings, test, ratings) {
    if (this.closed) return;
    fill(this.element, el("header", { class: "heading" }, el("h1", {}, event.name),
      facts(stateMark(event.status), event.format.replaceAll("_", " "), describeTable(event.terms.table), `${event.games} games played`, `${event.due} to come`,
        event.foreseeable && foreseeableMark())),
      test && el("p", {}, `Sequential test: ${test.verdict}, log-likelihood ratio ${test.llr.toFixed(2)} in (${test.bounds.map((bound) => bound.toFixed(2)).join(", ")}) after ${test.pairs} pairs`),
      el("div", { class: "halves" }, standingsTable(standings), ratings.length > 1 && el("figure", { class: "panel" }, ratingPlot(ratings),
        el("figcaption", {}, "Ratings above the mean in Elo points (Bradley and Terry), with intervals of 95 % confidence"))),
      el("h2", {}, "Games"), gameList(event.played));
  }

  close() {
    this.closed = true;
  }
}

function standingsTable(standings) {
  const columns = ["rank", "entrant", "points", "games", "won", "drawn", "lost"];
  return el("div", { class: "scroll panel" }, el("table", {}, el("caption", {}, "Standings"),
    el("thead", {}, el("tr", {}, columns.map((name) => el("th", { scope: "col", class: name === "entrant" ? null : "number" }, name)))),
    el("tbody", {}, standings.map((one) => el("tr", {},
      el("td", { class: "number" }, one.rank),
      el("th", { scope: "row" }, el("a", { href: `#/agents/${one.agent}` }, one.name), one.withdrawn && " (withdrawn)"),
      [one.points, one.games, one.wins, one.draws, one.losses].map((value) => el("td", { class: "number" }, value)))))));
}

/** Which game of which pair: both have the same racks, the break exchanged. */
function pairInWords({ pair, leg }) {
  const number = /-p(\d+)$/.exec(pair);
  return `${number ? `pair ${Number(number[1]) + 1}` : `pair ${pair}`}, ${leg === 0 ? "first" : "second"} game`;
}

function gameList(played) {
  if (!played.length) return el("p", { class: "empty" }, "No game has begun.");
  return el("ul", { class: "rows panel" }, played.map((game) => el("li", {}, el("article", { class: "match" },
    game.match ? el("a", { href: `#/matches/${game.match}` }, game.players.join(" – ")) : el("span", {}, game.players.join(" – ")),
    facts(`round ${game.round + 1}`, pairInWords(game),
      game.outcome ? describeOutcome(game.outcome, game.players) : stateMark(game.status))))));
}
