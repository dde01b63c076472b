/** What was played last, each as it lay at the end: a lobby in which nothing happens is no empty one. */

import { get } from "./api.js";
import { ago, el, fill } from "./dom.js";
import { Latest } from "./latest.js";
import { describeOutcome } from "./words.js";

const SHOWN = 4;

export class LastGames {
  constructor() {
    this.gallery = el("div", { class: "gallery few" });
    this.latest = new Latest();
    this.element = el("section", { "aria-label": "Last games", hidden: true }, el("h2", {}, "Played last"), this.gallery);
  }

  async load() {
    const found = await get(`/v1/matches?status=finished&limit=${SHOWN}`, this.latest.ask()).catch(() => null);
    if (!found) return;
    const games = found.matches.map((match) => ({ match, game: match.played.at(-1) })).filter(({ game }) => game);
    this.element.hidden = games.length === 0;
    fill(this.gallery, games.map(({ match, game }) => el("a", { class: "thumbnail", href: `#/games/${game.id}` },
      el("img", { src: `/v1/games/${game.id}/position.svg`, alt: "", loading: "lazy", width: 232, height: 127 }),
      el("span", { class: "names" }, `${match.players[0]} – ${match.players[1]}`),
      el("span", { class: "words" }, game.outcome ? describeOutcome(game.outcome, match.players) : game.status, " · ", ago(game.started_at)))));
  }
}
