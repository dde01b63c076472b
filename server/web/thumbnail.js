/** A live game in small: a picture, the score, and the strokes as they are played. */

import { el, fill } from "./dom.js";
import { GameModel } from "./game_model.js";
import { isOnTable } from "./motion.js";
import { TablePicture } from "./table_picture.js";
import { traceOf } from "./trace.js";
import { describeOutcome, named } from "./words.js";

const WIDTH = 232;

export class Thumbnail {
  /** @param {string} game */
  constructor(game) {
    this.game = game;
    this.canvas = /** @type {HTMLCanvasElement} */ (el("canvas", { role: "img", "aria-label": "The table" }));
    this.names = el("span", { class: "names" });
    this.words = el("span", { class: "words" });
    this.element = el("a", { class: "thumbnail", href: `#/games/${game}` }, this.canvas, this.names, this.words);
    /** @type {GameModel | null} */
    this.model = null;
    /** @type {TablePicture | null} */
    this.picture = null;
    /** @type {import("./trace.js").Trace | null} */
    this.trace = null;
    this.began = 0;
    /** @type {import("./trace.js").Balls} */
    this.balls = {};
    this.visible = true;
    /** What is said of the last stroke, or of the result. */
    this.told = "";
  }

  /** @param {string} kind @param {any} data */
  take(kind, data) {
    if (kind === "game") {
      this.model = GameModel.ofEvent(data);
      this.picture = new TablePicture(this.canvas, this.model.terms.table, { plain: true, lying: true, changed: () => this.redraw() });
      this.picture.fit(WIDTH, WIDTH);
      fill(this.names, this.model.players.join(" – "));
      this.rest(this.model.terms.balls);
      fill(this.words, named(data.view.why, this.model.players));
    } else if (this.model && (kind === "stroke" || kind === "decision")) {
      this.play(data);
      this.tell(named(data.ruling.words, this.model.players));
    } else if (this.model && kind === "result") {
      this.tell(describeOutcome(data.outcome, this.model.players));
    }
  }

  /** Say something, once the balls that led to it have come to rest before whoever looks. @param {string} words */
  tell(words) {
    this.told = words;
    if (!this.trace || !this.visible) fill(this.words, words);
  }

  /** @param {Record<string, any>} entry */
  play(entry) {
    this.trace = traceOf(this.model.terms.table, entry);
    this.after = entry.game.state;
    this.began = performance.now();
    if (!this.trace) this.rest(this.after);
  }

  /** The shape of the table has become known. */
  redraw() {
    if (!this.trace) this.rest(this.balls);
  }

  rest(balls) {
    this.trace = null;
    this.balls = balls;
    const places = Object.entries(balls).map(([ball, position]) => [Number(ball), { position }]);
    this.picture?.draw({ balls: new Map(/** @type {any} */ (places)) });
  }

  /** Draw what has moved. @param {number} now ms @returns {boolean} whether it goes on moving, to be seen by somebody */
  tick(now) {
    if (!this.trace || !this.visible) return false;
    const time = (now - this.began) / 1000;
    if (time >= this.trace.duration) {
      this.rest(this.after);
      fill(this.words, this.told);
      return false;
    }
    const balls = new Map();
    for (const [ball, state] of this.trace.at(time)) if (isOnTable(state)) balls.set(ball, { position: state.position });
    this.picture?.draw({ balls });
    return true;
  }
}

/** Time between two pictures, ms: small ones need no more, and thirty of them must stay cheap. */
const PERIOD = 1000 / 15;

/** Draws the thumbnails that move; while none does, nothing runs. */
export class Gallery {
  constructor() {
    /** @type {Map<string, Thumbnail>} */
    this.thumbnails = new Map();
    this.element = el("div", { class: "gallery" });
    this.seen = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        for (const one of this.thumbnails.values()) if (one.element === target) one.visible = isIntersecting;
      }
      this.wake();
    });
    this.timer = 0;
    this.closed = false;
  }

  /** An event of a game. @param {string} game @param {string} kind @param {any} data */
  take(game, kind, data) {
    this.thumbnails.get(game)?.take(kind, data);
    this.wake();
  }

  /** Draw in a moment; a page that is not seen waits until it is. */
  wake() {
    this.timer ||= setTimeout(() => requestAnimationFrame((now) => this.tick(now)), PERIOD);
  }

  /** Show these games. @param {string[]} games */
  show(games) {
    for (const [game, one] of this.thumbnails) {
      if (games.includes(game)) continue;
      this.seen.unobserve(one.element);
      this.thumbnails.delete(game);
    }
    for (const game of games) {
      if (this.thumbnails.has(game)) continue;
      const one = new Thumbnail(game);
      this.thumbnails.set(game, one);
      this.seen.observe(one.element);
    }
    fill(this.element, [...this.thumbnails.values()].map((one) => one.element));
  }

  tick(now) {
    if (this.closed) return;
    this.timer = 0;
    const moving = [...this.thumbnails.values()].filter((one) => one.tick(now));
    if (moving.length) this.wake();
  }

  close() {
    this.closed = true;
    clearTimeout(this.timer);
    this.seen.disconnect();
  }
}
