/** The lobby: live games in small, what comes next, matches, agents. */

import { get } from "./api.js";
import { el } from "./dom.js";
import { watchGames } from "./live.js";
import { matchRow, matchText } from "./match_row.js";
import { PagedList } from "./paged.js";
import { tournamentRow } from "./view_tournament.js";
import { Gallery } from "./thumbnail.js";

const LIVE = 30;
const AGAIN = 5000;

export class LobbyView {
  constructor() {
    this.gallery = new Gallery();
    this.none = el("p", { class: "empty" }, "No game is being played.");
    this.next = new PagedList({
      title: "Next", path: "/v1/matches?status=challenged", member: "matches",
      row: matchRow, text: matchText, empty: "No challenge is open.",
    });
    this.matches = new PagedList({
      title: "Matches", path: "/v1/matches?limit=20", member: "matches",
      row: matchRow, text: matchText, empty: "No match yet.",
    });
    this.tournaments = new PagedList({
      title: "Tournaments", path: "/v1/tournaments?limit=20", member: "tournaments",
      row: tournamentRow, text: (event) => `${event.name} ${event.entrants.join(" ")} ${event.status}`, empty: "No tournament yet.",
    });
    this.agents = new PagedList({
      title: "Agents", path: "/v1/agents?limit=50", member: "agents",
      row: (agent) => el("a", { href: `#/agents/${agent.id}` }, agent.name),
      text: (agent) => `${agent.name} ${agent.id}`, empty: "No agent yet.",
    });
    this.file = /** @type {HTMLInputElement} */ (el("input", { type: "file", accept: ".jsonl,.json,.ndjson", id: "record-file" }));
    this.element = el("div", { class: "lobby" },
      el("h1", {}, "Lobby"),
      el("section", { "aria-label": "Live games" }, el("h2", {}, "Live"), this.none, this.gallery.element),
      el("div", { class: "lists" }, this.next.element, this.matches.element,
        this.tournaments.element, this.agents.element),
      el("section", { class: "drop", "aria-label": "Record file" },
        el("label", { for: "record-file" }, "Look at a record: drop the file anywhere on this page, or choose it"), this.file));
    /** @type {string[]} */
    this.games = [];
    this.stop = () => {};
    this.closed = false;
  }

  async open() {
    await Promise.all([this.next.load(), this.matches.load(), this.tournaments.load(), this.agents.load()]);
    while (!this.closed) {
      await this.refresh();
      await new Promise((go) => setTimeout(go, AGAIN));
    }
  }

  /** The games that run now; one stream tells of all of them. */
  async refresh() {
    const running = await get(`/v1/matches?status=running&limit=${LIVE}`).catch(() => null);
    if (!running || this.closed) return;
    const games = running.matches.flatMap((match) => match.played.filter((game) => game.status === "running").map((game) => game.id));
    if (games.join() === this.games.join()) return;
    this.games = games;
    this.stop();
    this.gallery.show(games);
    this.none.hidden = games.length > 0;
    this.stop = games.length ? watchGames(games, (game, kind, data) => this.gallery.thumbnails.get(game)?.take(kind, data)) : () => {};
  }

  close() {
    this.closed = true;
    this.stop();
    this.gallery.close();
  }
}
