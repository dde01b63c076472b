/** Chances to win over a game: the value before each stroke that the luck report uses, and where it jumped. */

import { isStriped } from "./ball_picture.js";
import { el, fill, shape } from "./dom.js";

/** @typedef {{place: number, gain: number}} Swing a stroke, and by how much it changed its player's chance */

/** A stroke that changed its player's chance by so much is marked. */
const JUMP = 0.08;
/** Marks shown at most: the largest. */
const MOST = 8;

/** @type {Promise<{weights: Record<string, number>, source: string}> | null} */
let asked = null;

/** The weights, from the luck report's own module. */
function model() {
  asked ??= fetch("/web/value.json").then((answer) => answer.json()).catch(() => { asked = null; return null; });
  return asked;
}

export class Chances {
  /** @param {(place: number) => void} choose @param {(swings: Swing[]) => void} marked told which strokes are marked */
  constructor(choose, marked) {
    this.choose = choose;
    this.marked = marked;
    this.plot = shape("svg", { viewBox: "0 0 100 100", preserveAspectRatio: "none", role: "img" });
    this.ends = el("p", { class: "ends" });
    this.marks = el("ul", { class: "marks" });
    this.element = el("figure", { class: "chances", hidden: true }, this.ends, this.plot, this.marks,
      el("figcaption", {}, "Chance to win before each stroke: the value that the luck report uses. It counts balls, turns and fouls, not how the balls lie. ",
        "▲ the stroke raised its player's chance much, by skill or luck; ▼ it cost much, a mistake or bad luck. The luck report tells which."));
    /** Called of the last question alone. */
    this.turn = 0;
  }

  /**
   * @param {import("./game_model.js").GameModel} game @param {number} last the newest stroke that may be told @param {number} here the one on show
   */
  async show(game, last, here) {
    const turn = ++this.turn;
    const value = await model();
    if (turn !== this.turn || !value || !game.first?.state) return;
    const level = game.terms.noise?.level ?? 0;
    const states = [game.first, ...game.entries.slice(0, last + 1).map((entry) => entry.game)];
    const chances = states.map((state) => chanceOfFirst(value.weights, state, level));
    this.element.hidden = chances.length < 2;
    if (this.element.hidden) return;
    const swings = swingsOf(game, chances);
    this.draw(game, chances, here, swings);
    this.mark(game, swings);
    this.marked(swings);
  }

  draw(game, chances, here, swings) {
    const across = (place) => (100 * place) / (chances.length - 1);
    const points = chances.map((chance, place) => `${across(place).toFixed(2)},${(100 * (1 - chance)).toFixed(2)}`);
    const now = Math.round(100 * chances[chances.length - 1]);
    this.plot.setAttribute("aria-label", `Chance of ${game.players[0]} to win over ${chances.length - 1} strokes; now ${now} %`);
    fill(this.plot,
      shape("polygon", { class: "area", points: `0,100 ${points.join(" ")} 100,100` }),
      shape("line", { class: "middle", x1: 0, x2: 100, y1: 50, y2: 50 }),
      ...swings.map(({ place, gain }) => shape("line", {
        class: gain > 0 ? "swing better" : "swing worse", x1: across(place), y1: 100 * (1 - chances[place]), x2: across(place + 1), y2: 100 * (1 - chances[place + 1]),
      })),
      shape("polyline", { class: "line", points: points.join(" ") }),
      shape("line", { class: "here", x1: across(Math.max(0, here)), x2: across(Math.max(0, here)), y1: 0, y2: 100 }));
    fill(this.ends, el("span", {}, `${game.players[0]} ${now} %`), el("span", {}, `${game.players[1]} ${100 - now} %`));
  }

  mark(game, swings) {
    fill(this.marks, swings.map(({ place, gain }) => el("li", { class: gain > 0 ? "better" : "worse" },
      el("button", { type: "button", onclick: () => this.choose(place) },
        `${gain > 0 ? "▲" : "▼"} stroke ${place}, ${game.players[game.entries[place].seat]} ${percent(gain)}`))));
  }
}

/** A change of a chance, with its sign. @param {number} gain */
export function percent(gain) {
  return `${gain > 0 ? "+" : "−"}${Math.round(100 * Math.abs(gain))} %`;
}

/** The strokes that changed the chance of their player most. @param {number[]} chances of seat 0, before each stroke and at last @returns {Swing[]} */
function swingsOf(game, chances) {
  const jumps = chances.slice(1).map((chance, place) => {
    const gain = (chance - chances[place]) * (game.entries[place].seat === 0 ? 1 : -1);
    return { place, gain };
  }).filter(({ place, gain }) => Math.abs(gain) >= JUMP && game.entries[place].events);
  return jumps.sort((one, two) => Math.abs(two.gain) - Math.abs(one.gain)).slice(0, MOST).sort((one, two) => one.place - two.place);
}

/**
 * The chance of seat 0, as `tournament.luck.value` computes it.
 * @param {Record<string, number>} weights @param {Record<string, any>} game the referee's @param {number} noise level
 */
export function chanceOfFirst(weights, game, noise) {
  if (game.outcome) return game.outcome.winner === null ? 0.5 : game.outcome.winner === 0 ? 1 : 0;
  const logit = Object.entries(features(game, noise)).reduce((sum, [name, value]) => sum + weights[name] * value, 0);
  const chance = 1 / (1 + Math.exp(-logit));
  return game.turn === 0 ? chance : 1 - chance;
}

function features(game, noise) {
  if (game.phase === "break" || game.phase === "rerack") return { breaking: 1 };
  if (game.phase === "decision") return { deciding: 1 };
  const groups = game.groups;
  const left = (group) => Object.keys(game.state).map(Number).filter((ball) => ball !== 0 && ball !== 8 && isStriped(ball) === (group === "stripes")).length;
  const values = {
    shooting: 1, shooting_noise: noise,
    in_hand: Number(game.cue_ball_in_hand === "anywhere"), in_kitchen: Number(game.cue_ball_in_hand === "kitchen"),
    open_table: Number(!groups),
  };
  if (!groups) return values;
  const own = left(groups[game.turn]);
  const theirs = left(groups[1 - game.turn]);
  return { ...values, ahead: theirs - own, ahead_noise: noise * (theirs - own), at_eight: Number(own === 0), opponent_at_eight: Number(theirs === 0) };
}
