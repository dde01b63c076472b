/** A game: live by the server's events, over by its record's lines, or from a file; the same page for all. */

import { ProblemError, call, get, identity } from "./api.js";
import { Chances } from "./chances.js";
import { announce, el, facts, fill } from "./dom.js";
import { GameModel } from "./game_model.js";
import { watchGame } from "./live.js";
import { unratedMark } from "./match_row.js";
import { reducedMotion } from "./playback.js";
import { Scoreboard } from "./scoreboard.js";
import { sharing } from "./sharing.js";
import { labAddress } from "./snippets.js";
import { Stage } from "./stage.js";
import { StrokeList } from "./stroke_list.js";
import { StrokeStory } from "./stroke_story.js";
import { describeTable, isNamed } from "./tables.js";
import { describeAction, describeNoise } from "./words.js";

/** Strokes a live picture may lag behind before it jumps to the newest. */
const LAG = 2;
/** What a slider may lack of its end, s. */
const ALMOST = 1e-6;
/** How long a result is shown before the next game, and time between two looks for it, ms. */
const RESULT_SHOWN = 4000;
const AGAIN = 1000;

export class GameView {
  constructor() {
    this.stage = new Stage({ ended: () => this.goOn(), moved: (time) => this.moved(time) });
    this.board = new Scoreboard();
    this.story = new StrokeStory((time) => this.stage.seek(time));
    this.list = new StrokeList((place) => this.choose(place));
    this.title = el("h1", {}, "Game");
    this.connection = el("p", { class: "connection" });
    this.follow = /** @type {HTMLInputElement} */ (el("input", { type: "checkbox", checked: true, onchange: () => this.goOn() }));
    this.ghostButton = el("button", { type: "button", onclick: () => this.ghost() }, "Without noise");
    this.labLink = /** @type {HTMLAnchorElement} */ (el("a", { class: "button", hidden: true }, "In the laboratory"));
    this.links = el("span", { hidden: true });
    this.share = el("details", { class: "share" });
    this.chances = new Chances((place) => this.choose(place), (swings) => this.list.markSwings(swings));
    this.mark = unratedMark();
    this.mark.hidden = true;
    this.terms = el("div", { class: "terms" });
    this.own = el("p", { class: "own", hidden: true }, "You play in this game. ");
    this.heading = el("header", { class: "heading" }, this.title, this.terms);
    this.strokeButtons = el("div", { class: "controls" },
      el("button", { type: "button", onclick: () => this.choose(this.shown - 1) }, "◂ stroke"),
      el("button", { type: "button", onclick: () => this.choose(this.shown + 1) }, "stroke ▸"),
      this.ghostButton, this.labLink,
      el("label", { class: "check" }, this.follow, "follow the game"));
    this.element = el("article", { class: "game" }, this.heading, this.connection, this.board.element,
      el("div", { class: "columns" },
        el("div", { class: "main-column" }, this.stage.element, this.own, this.strokeButtons, this.chances.element, this.story.element),
        el("div", { class: "side-column" }, this.list.element, this.share)));
    /** @type {GameModel | null} */
    this.model = null;
    this.shown = -1;
    /** The stroke that rolls before somebody who has not seen its end; -1: none. */
    this.rolling = -1;
    /** Whether the past, which is told at once when the page is opened, has been passed. */
    this.begun = false;
    this.timer = setInterval(() => this.model && this.seen && this.board.tick(this.model), 250);
    this.stop = () => {};
    /** @type {number | null} */
    this.wanted = null;
    /** Called whenever every stroke told has been seen. */
    this.idle = () => {};
    /** Called when the game has a result; and when that may be shown. */
    this.ended = () => {};
    this.finished = () => {};
    /** Where a spectator is led when the next game begins. @type {((game: string) => void) | null} */
    this.goesOn = null;
    this.closed = false;
    /** When there is something to show: the game as it stands, or why there is none. @type {Promise<void>} */
    this.ready = new Promise((told) => { this.tell = told; });
    /** Whether the match counts, once that is known. @type {Promise<void>} */
    this.marked = Promise.resolve();
  }

  /** Whether everything told so far may be shown: nobody follows, or the picture has come as far. */
  get seen() {
    return !this.follow.checked || (this.rolling < 0 && this.shown >= (this.model?.entries.length ?? 0) - 1);
  }

  /** Show what the picture has come to, and nothing that it has not. */
  showSeen() {
    const { model } = this;
    if (!model) return;
    const following = this.follow.checked;
    if (!following) this.rolling = -1;
    this.list.update(model, following ? this.shown + 1 : model.entries.length, this.rolling);
    const over = this.seen && model.settle();
    this.board.show(model, this.shownState());
    this.showLab();
    this.chances.show(model, this.rolling >= 0 ? this.rolling - 1 : following ? this.shown : model.entries.length - 1, this.shown);
    if (over) this.over();
  }

  /** The picture has moved: the end of a stroke may be told. @param {number} time */
  moved(time) {
    if (this.rolling < 0 || this.rolling !== this.shown || time < this.stage.playback.duration - ALMOST) return;
    this.rolling = -1;
    this.tellStory();
    this.showSeen();
    queueMicrotask(() => this.goOn());
  }

  /** Whether strokes that led to a view are still to be shown. @param {Record<string, any>} view */
  isBehind(view) {
    const known = this.model?.entries.length ?? 0;
    if (known < view.version - 1) return true;
    return this.follow.checked && (this.shown < known - 1 || (this.rolling >= 0 && this.stage.playback.playing));
  }

  /** Show everything that has been told, at once. */
  catchUp() {
    this.follow.checked = true;
    this.rolling = -1;
    this.shown = this.model.entries.length - 1;
    if (this.shown >= 0) this.tellStory();
    this.showSeen();
    this.list.mark(this.shown);
  }

  /**
   * Lay the page out for a player: the table and what plays on it fill the screen, everything else is below.
   * @param {HTMLElement[]} over what lies over the table @param {HTMLElement} dock the controls beside or below it
   * @param {...HTMLElement} more beside the list
   */
  sitDown(over, dock, ...more) {
    const { stage } = this;
    stage.holder.classList.add("fills");
    stage.holder.append(...over);
    stage.playWord = "Replay";
    stage.showPlaying();
    this.element.classList.add("playing");
    this.screen = el("div", { class: "table-screen" }, el("div", { class: "board" }, this.board.element, this.connection), stage.holder, dock);
    fill(this.element, this.screen, el("div", { class: "columns" },
      el("div", { class: "main-column" }, this.heading, el("section", { "aria-label": "Replay" }, stage.replay, this.strokeButtons), this.chances.element, this.story.element),
      el("div", { class: "side-column" }, ...more, this.list.element)));
  }

  /** It is on the page: its first frame has the table as large as it stays. */
  placed() {
    this.stage.fit();
    this.list.scroll();
  }

  /** Watch a game of the server. @param {string} game @param {number | null} stroke to begin with */
  watch(game, stroke = null) {
    this.wanted = stroke;
    this.follow.checked = stroke === null;
    this.stop = watchGame(game, {
      told: (kind, data) => this.take(kind, data),
      connected: (said) => {
        fill(this.connection, said);
        if (said) this.tell();
      },
      refused: (why) => this.refused(why),
    });
  }

  /** There is nothing to watch. @param {string} why */
  refused(why) {
    this.close();
    fill(this.element, el("h1", {}, "No such game"), el("p", { class: "problem", role: "alert" }, why),
      el("p", {}, el("a", { href: "#/" }, "To the lobby")));
  }

  /** Show a record. @param {string} text */
  open(text) {
    this.model = GameModel.ofRecord(text);
    this.follow.checked = false;
    this.begin();
    this.choose(0);
    this.tell();
  }

  begin() {
    const { players, number, games, match, table, balls, noise } = this.model.terms;
    fill(this.title, `${players[0]} – ${players[1]}`);
    document.title = `${players[0]} – ${players[1]} · Pooliad`;
    this.stage.useTable(table);
    this.stage.rest(balls);
    fill(this.own, "You play in this game. ", el("a", { class: "button", href: `#/play/${this.model.terms.id}` }, "To the table"));
    const fromServer = games !== null;
    fill(this.terms, facts(`Game ${number + 1}${fromServer ? ` of ${games}` : ""}`,
      fromServer && match && el("a", { href: `#/matches/${match}` }, "the match"), describeTable(table), describeNoise(noise), this.mark, this.links));
    if (fromServer && match) this.marked = this.showMark(match);
    if (fromServer) fill(this.share, sharing(this.model.terms.id));
    this.share.hidden = !fromServer;
    this.showSeen();
  }

  /** Whether the match counts is said by the match alone. @param {string} match */
  async showMark(match) {
    const found = await get(`/v1/matches/${encodeURIComponent(match)}`).catch(() => null);
    this.mark.hidden = found === null || found.rated;
    if (found?.start) {
      this.model.startsFrom(found.start);
      this.showSeen();
    }
    this.own.hidden = !(found?.status === "running" && found.agents.includes(identity()?.id));
  }

  take(kind, data) {
    if (kind === "game") {
      if (this.model) return;
      this.model = GameModel.ofEvent(data);
      this.begin();
      queueMicrotask(() => this.caughtUp());
      return;
    }
    if (!this.model) return;
    this.model.take(kind, data);
    if (kind === "result") this.ended();
    if (kind === "clocks" || kind === "result") this.goOn();
    if (!this.begun) return; // the past: it is shown at once
    this.showSeen();
    if (kind === "connections" || kind === "result") this.marked.then(this.tell);
  }

  /** The past has been told, or is about to be: the first clocks come right after it. */
  caughtUp() {
    if (this.wanted !== null && this.model?.entries.length > this.wanted) this.choose(this.wanted);
  }

  over() {
    const { id } = this.model.terms;
    this.links.hidden = false;
    fill(this.links, el("a", { href: `/v1/games/${id}/record`, download: `${id}.jsonl` }, "record"));
    this.finished();
    if (this.goesOn) this.followMatch();
  }

  /** The next game of the match, once there is one, for whoever still follows. */
  async followMatch() {
    const { match, number, games } = this.model.terms;
    if (games === null || number + 1 >= games) return;
    fill(this.connection, "The next game comes by itself.");
    const noSooner = performance.now() + RESULT_SHOWN;
    while (!this.closed) {
      const found = await get(`/v1/matches/${encodeURIComponent(match)}`).catch(() => null);
      const next = found?.played.find((game) => game.number === number + 1);
      if ((found && found.status !== "running" && !next) || !this.follow.checked) break;
      if (next && performance.now() >= noSooner && !this.closed) return this.goesOn(next.id);
      await new Promise((go) => setTimeout(go, AGAIN));
    }
    if (!this.closed) fill(this.connection);
  }

  /** Following: the next stroke when one is over; the newest when too many wait. */
  goOn() {
    const { model } = this;
    if (!model) return;
    const last = model.entries.length - 1;
    const first = !this.begun;
    this.begun = true;
    if (this.wanted !== null && this.wanted <= last) return this.choose(this.wanted);
    if (!this.follow.checked) return this.showSeen();
    if (this.rolling >= 0 && this.stage.playback.playing) return;
    if (this.shown >= last) return this.idle();
    const next = first || last - this.shown > LAG || reducedMotion() ? last : this.shown + 1;
    this.choose(next, { play: !first, atEnd: first || reducedMotion(), following: true });
    if (this.rolling < 0 && this.shown >= last) this.idle();
  }

  /**
   * Show a stroke.
   * @param {number} place @param {{play?: boolean, atEnd?: boolean, following?: boolean}} [how]
   */
  choose(place, { play = false, atEnd = false, following = false } = {}) {
    const entry = this.model?.entries[place];
    if (!entry) return;
    this.wanted = null;
    if (!following && place !== this.model.entries.length - 1) this.follow.checked = false;
    this.shown = place;
    this.rolling = following && play && entry.events && !reducedMotion() ? place : -1;
    this.stage.load(entry, this.model.ballsBefore(place), { play, atEnd });
    this.tellStory();
    this.showSeen();
    this.list.mark(place);
  }

  /** The way to the laboratory with the position on the table, and the stroke as it was meant. */
  showLab() {
    const { table } = this.model.terms;
    const entry = this.model.entries[this.shown];
    const balls = entry ? this.model.ballsBefore(this.shown) : this.model.terms.balls;
    this.labLink.hidden = !isNamed(table) || !balls?.[0];
    if (!this.labLink.hidden) this.labLink.href = labAddress(table.name, balls, entry?.action.shot ?? undefined);
  }

  /** The sentence of a stroke, once its end is no secret. */
  tellStory() {
    const entry = this.model.entries[this.shown];
    if (this.rolling < 0) this.story.show(entry, this.model.players);
    else this.story.await(`${this.model.players[entry.seat]} plays: ${describeAction(entry)} …`);
  }

  /** The referee's state as far as it may be shown. */
  shownState() {
    const place = this.rolling >= 0 ? this.rolling - 1 : this.shown;
    return this.model.entries[place]?.game ?? this.model.first;
  }

  /** The same stroke as it was meant: simulated by the server, laid over the picture. */
  async ghost() {
    const entry = this.model?.entries[this.shown];
    if (!entry?.before) return announce("A decision has no stroke to simulate.");
    if (this.stage.ghost) return this.stage.setGhost(null);
    try {
      const body = { table: this.model.terms.table, balls: entry.before, shot: entry.action.shot, trace: true };
      const answer = await call("POST", "/v1/simulate", { body });
      if (this.closed || this.stage.entry !== entry) return; // another stroke is on the table by now
      this.stage.setGhost(answer);
      announce("The stroke without noise is drawn in light blue.");
    } catch (error) {
      announce(error instanceof ProblemError ? error.message : "The server cannot be reached.");
    }
  }

  close() {
    this.closed = true;
    this.tell();
    this.stop();
    clearInterval(this.timer);
    this.stage.close();
  }
}
