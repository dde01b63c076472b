/** A match in a list, and its games. */

import { el, when } from "./dom.js";
import { describeOutcome } from "./words.js";

/** @param {Record<string, any>} match */
export function matchRow(match) {
  const [first, second] = match.players;
  return el("article", { class: "match" },
    el("a", { href: `#/matches/${match.id}` }, `${first} – ${second}`),
    el("span", { class: "score" }, ` ${match.score[0]} : ${match.score[1]} `),
    el("span", { class: "facts" }, `${match.status}, ${match.games === 1 ? "1 game" : `${match.games} games`}, ${when(match.created_at)}`));
}

/** @param {Record<string, any>} match */
export function matchText(match) {
  return `${match.players.join(" ")} ${match.status} ${match.id}`;
}

/** @param {Record<string, any>} match @param {Record<string, any>} game */
export function gameRow(match, game) {
  const told = game.outcome ? describeOutcome(game.outcome, match.players) : game.status;
  return el("article", { class: "match" },
    el("a", { href: `#/games/${game.id}` }, `Game ${game.number + 1}`),
    el("span", { class: "facts" }, ` ${told}, ${game.strokes} strokes, ${when(game.started_at)}`));
}
