/** The lobby: live games in small, what comes next, matches, agents. */

import { get, identity } from "./api.js";
import { BestStrokes } from "./best_strokes.js";
import { el } from "./dom.js";
import { Ladder, agentRow } from "./ladder.js";
import { LastGames } from "./last_games.js";
import { watchGames } from "./live.js";
import { matchRow } from "./match_row.js";
import { PagedList } from "./paged.js";
import { tournamentRow } from "./view_tournament.js";
import { Gallery } from "./thumbnail.js";

const LIVE = 30;
const AGAIN = 5000;

export class LobbyView {
  constructor() {
    this.gallery = new Gallery();
    this.none = el("p", { class: "empty stand-in" }, "No game is being played. ",
      el("a", { href: "#/play" }, "Play one"), ", or try a shot in the ", el("a", { href: "#/lab" }, "laboratory"), ".");
    this.own = el("p", { class: "own", hidden: true }, "A game of yours is on. ", el("a", { class: "button", href: "#/play" }, "Back to the table"));
    this.ladder = new Ladder();
    this.last = new LastGames();
    this.best = new BestStrokes();
    this.next = new PagedList({
      title: "Challenges", path: "/v1/matches?status=challenged", member: "matches",
      row: matchRow, empty: "No challenge is open.",
    });
    this.matches = new PagedList({
      title: "Matches", path: "/v1/matches?limit=10", member: "matches",
      row: matchRow, empty: "No match yet.",
    });
    this.tournaments = new PagedList({
      title: "Tournaments", path: "/v1/tournaments?limit=20", member: "tournaments",
      row: tournamentRow, empty: "No tournament yet.",
    });
    this.agents = new PagedList({
      title: "Agents", path: "/v1/agents?limit=20", member: "agents",
      row: (agent) => agentRow(agent, this.ladder.rungs.get(agent.id)),
      empty: "No agent yet.",
    });
    this.file = /** @type {HTMLInputElement} */ (el("input", { type: "file", accept: ".jsonl,.json,.ndjson", id: "record-file" }));
    this.element = el("div", { class: "lobby" },
      el("h1", {}, "Lobby"), this.own,
      el("section", { "aria-label": "Live games" }, el("h2", { class: "live" }, "Live"), this.none, this.gallery.element), this.last.element, this.best.element,
      el("div", { class: "lists" }, el("div", {}, this.matches.element), el("div", {}, this.tournaments.element, this.next.element),
        el("div", {}, this.ladder.element, this.agents.element)),
      el("section", { class: "drop", "aria-label": "Record file" },
        el("label", { for: "record-file" }, "Look at a record: drop the file anywhere on this page, or choose it"), this.file));
    /** @type {string[] | null} the games that run; null until the server has said it */
    this.games = null;
    this.stop = () => {};
    this.closed = false;
  }

  async open() {
    await Promise.all([this.next.load(), this.matches.load(), this.tournaments.load(), this.loadAgents(), this.last.load(), this.best.load()]);
    while (!this.closed) {
      if (!document.hidden) await this.refresh();
      await new Promise((go) => setTimeout(go, AGAIN));
    }
  }

  /** The ladder first: the list of agents has its ratings. */
  async loadAgents() {
    await this.ladder.load();
    await this.agents.load();
  }

  /** The games that run now; one stream tells of all of them. */
  async refresh() {
    const running = await get(`/v1/matches?status=running&limit=${LIVE}`).catch(() => null);
    if (!running || this.closed) return;
    const me = identity();
    this.own.hidden = !(me && running.matches.some((match) => match.agents.includes(me.id)));
    const games = running.matches.flatMap((match) => match.played.filter((game) => game.status === "running").map((game) => game.id));
    if (games.join() === this.games?.join()) return;
    const first = this.games === null;
    this.games = games;
    this.stop();
    this.gallery.show(games);
    this.none.hidden = games.length > 0;
    this.stop = games.length ? watchGames(games, (game, kind, data) => this.gallery.take(game, kind, data)) : () => {};
    if (first) return;
    for (const list of [this.next, this.matches, this.tournaments]) list.refresh();
    for (const part of [this.last, this.best]) part.load();
    this.ladder.load().then(() => this.agents.redraw());
  }

  close() {
    this.closed = true;
    this.stop();
    this.gallery.close();
  }
}
