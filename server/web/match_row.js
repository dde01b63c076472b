/** A match in a list, and its games. */

import { ago, el, facts } from "./dom.js";
import { describeOutcome } from "./words.js";

/** @param {Record<string, any>} match */
export function matchRow(match) {
  const [first, second] = match.players;
  return el("article", { class: "match" },
    el("a", { href: `#/matches/${match.id}` }, `${first} – ${second}`),
    el("span", { class: "score" }, `${match.score[0]} : ${match.score[1]}`),
    facts(stateMark(match.status), match.games === 1 ? "1 game" : `${match.games} games`, !match.rated && unratedMark(),
      match.foreseeable && foreseeableMark(), ago(match.created_at)));
}

/** How something stands: running, finished, … @param {string} status */
export function stateMark(status) {
  return el("span", { class: `state ${status}` }, status);
}

/** Says of a match or game that it counts for no rating. */
export function unratedMark() {
  return el("span", { class: "mark", title: "It counts for no rating." }, "unrated");
}

/** Says of a match or tournament that somebody chose its seed. */
export function foreseeableMark() {
  const title = "Its seed was chosen: racks and noise can be known in advance. It counts for no rating.";
  return el("span", { class: "mark", title }, "foreseeable");
}

/** @param {Record<string, any>} match @param {Record<string, any>} game */
export function gameRow(match, game) {
  const told = game.outcome ? describeOutcome(game.outcome, match.players) : game.status;
  return el("article", { class: "match" },
    el("a", { href: `#/games/${game.id}` }, `Game ${game.number + 1}`),
    facts(game.outcome ? told : stateMark(told), `${game.strokes} strokes`, ago(game.started_at)));
}
