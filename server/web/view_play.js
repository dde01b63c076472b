/** Play: sign in, find an opponent, and take turns until the match is over. */

import { ProblemError, call, command, get, identity, newKey, newSeed, signOut, token } from "./api.js";
import { Aiming } from "./aiming.js";
import { announce, el, fill, labelled } from "./dom.js";
import { Latest } from "./latest.js";
import { linkTo } from "./sharing.js";
import { signInPanel, tokenPanel } from "./sign_in.js";
import { TableFileError, readTableFile } from "./table_file.js";
import { describeTable, tableNames, tableTitle } from "./tables.js";
import { GameView } from "./view_game.js";

const AGAIN = 2000;
const SECONDS = 900;
/** How long a match may wait for the players' seeds, s: this page and shipped agents add theirs at once. */
const SEEDS_WITHIN = 15;
/** How much later than the news of what follows a game's result may come, ms. */
const RESULT_WITHIN = 3000;
/** The choice of a table that a file holds. */
const FROM_FILE = "file";
/** A match that has no rack yet, so that seeds still count. */
const WAITING = ["challenged", "opening"];

export class PlayView {
  constructor() {
    this.top = el("div", {});
    this.gamePart = el("div", {});
    this.element = el("article", { class: "play" }, this.top, this.gamePart);
    /** @type {GameView | null} */
    this.game = null;
    /** @type {Aiming | null} */
    this.aiming = null;
    /** @type {any} the view of a turn that waits until the picture has caught up */
    this.turn = null;
    this.closed = false;
    this.resized = () => this.measure();
    addEventListener("resize", this.resized);
    this.polls = new AbortController();
    /** The choice of an opponent on show: withdrawn by a match, and by the next. */
    this.choice = new Latest();
    /** @type {string | null} */
    this.match = null;
    /** The table of a file, once one was chosen. @type {{title: string, values: Record<string, any>} | null} */
    this.fileTable = null;
  }

  /** @param {string | null} game the address of a game: its players go on with it, everybody else watches */
  async open(game = null) {
    if (this.closed) return null;
    const me = identity();
    if (game) {
      const match = me && (await matchOf(game));
      if (this.closed) return null;
      if (match?.status !== "running" || !match.agents.includes(me.id)) return location.replace(`#/games/${game}`);
      return this.enter(match.id);
    }
    if (!me) return fill(this.top, el("h1", {}, "Play"), signInPanel(() => this.open()));
    return this.continueMatch(me, this.chooseOpponent(me));
  }

  /** A match that is on already, of this tab or another. @param {AbortSignal} choice for which it is asked */
  async continueMatch(me, choice) {
    const { matches } = await get(`/v1/matches?agent=${me.id}&status=running`);
    if (matches.length && !choice.aborted) this.enter(matches[0].id);
  }

  /** @returns {AbortSignal} aborted once this choice is over */
  chooseOpponent(me) {
    const choice = this.choice.ask();
    this.problem = el("p", { class: "refusal", role: "alert" });
    this.noise = /** @type {HTMLSelectElement} */ (el("select", {},
      [["0", "none"], ["0.5", "half"], ["1", "as in tournaments"]].map(([value, name]) => el("option", { value, selected: value === "0.5" }, name))));
    this.table = /** @type {HTMLSelectElement} */ (el("select", {}, tableNames().map((one) => el("option", { value: one }, tableTitle(one)))));
    const file = /** @type {HTMLInputElement} */ (el("input", { type: "file", accept: ".toml", onchange: () => this.takeTable(file.files?.[0]) }));
    if (this.fileTable) this.offerTable(this.fileTable);
    const name = /** @type {HTMLInputElement} */ (el("input", { maxlength: 64, required: true }));
    const bots = el("div", { class: "choices" }, "Looking …");
    const challenges = el("div", { class: "choices" });
    fill(this.top, el("h1", {}, "Play"),
      el("p", {}, "You are ", el("strong", {}, me.name), ". Games played here are unrated. ",
        el("button", { type: "button", onclick: () => this.leave() }, "Sign out")),
      tokenPanel(),
      this.problem, el("p", { class: "one-line wide" }, labelled("Kind of table", this.table), labelled("Table file, from pooliad calibrate", file), labelled("Noise of the strokes", this.noise)),
      el("div", { class: "cards" },
        el("section", { class: "panel", "aria-label": "Opponent" }, el("h2", {}, "Against the house"), bots),
        el("section", { class: "panel", "aria-label": "Another player" }, el("h2", {}, "Against another player"),
          el("form", { class: "one-line", onsubmit: (event) => { event.preventDefault(); this.challengeByName(name.value.trim()); } },
            labelled("Name of the player", name), el("button", {}, "Challenge"))),
        el("section", { class: "panel", "aria-label": "Challenges" }, el("h2", {}, "Challenges to you"), challenges)));
    this.showBots(bots);
    this.lookOut(challenges, me, choice);
    return choice;
  }

  /** A table file was chosen: its table is one more kind, and chosen. @param {File | undefined} file */
  async takeTable(file) {
    if (!file) return;
    await this.attempt(async () => {
      const values = await readTableFile(file);
      this.fileTable = { title: `${file.name}: ${describeTable(values)}`, values };
      this.offerTable(this.fileTable);
    });
  }

  /** @param {{title: string}} table */
  offerTable({ title }) {
    this.table.querySelector(`[value="${FROM_FILE}"]`)?.remove();
    this.table.append(el("option", { value: FROM_FILE, selected: true }, title));
    this.table.value = FROM_FILE;
  }

  async showBots(place) {
    const { agents } = await get("/v1/agents?house=true").catch(() => ({ agents: [] }));
    fill(place, agents.length ? agents.map((bot) => el("button", { type: "button", class: "first", onclick: () => this.challenge(bot.id) }, `Play ${bot.name}`)) :
      el("p", { class: "empty" }, "This server keeps no house player."));
  }

  /** Show challenges as they come, and enter a match as soon as one begins: an opponent may accept long after. */
  async lookOut(place, me, choice) {
    while (!choice.aborted) {
      const { matches } = await get(`/v1/matches?agent=${me.id}&status=challenged`).catch(() => ({ matches: [] }));
      const mine = matches.filter((match) => match.agents[match.challenger] !== me.id);
      fill(place, mine.length ? mine.map((match) => el("button", { type: "button", onclick: () => this.accept(match.id) },
        `Accept ${match.players[match.challenger]}, ${describeTable(match.table)}`)) : el("p", { class: "empty" }, "None."));
      await pause(AGAIN);
      if (!choice.aborted) await this.continueMatch(me, choice).catch(() => null);
    }
  }

  async challengeByName(name) {
    await this.attempt(async () => {
      const found = await agentCalled(name);
      if (found) await this.challenge(found.id);
      else fill(this.problem, `There is no player called ${name}.`);
    });
  }

  async challenge(opponent) {
    const terms = {
      agents: [identity().id, opponent], games: 1, table: this.table.value === FROM_FILE ? this.fileTable?.values : this.table.value, rated: false, client_seed_seconds: SEEDS_WITHIN,
      noise: { level: Number(this.noise.value), told: true }, clock: { seconds: SECONDS },
    };
    await this.attempt(async () => {
      const match = await command("/v1/matches", terms);
      if (WAITING.includes(match.status)) await command(`/v1/matches/${match.id}/seed`, { seed: newSeed() }).catch(() => null);
      this.enter(match.id);
    });
  }

  async accept(match) {
    await this.attempt(async () => this.enter((await command(`/v1/matches/${match}/accept`, { client_seed: newSeed() })).id));
  }

  async attempt(act) {
    try {
      fill(this.problem);
      await act();
    } catch (error) {
      fill(this.problem, words(error));
    }
  }

  /** Wait for the match's game, then play it. @param {string} id */
  async enter(id) {
    if (this.match || this.closed) return;
    this.match = id;
    this.choice.withdraw();
    fill(this.top, el("h1", {}, "Play"), el("p", { role: "status" }, "Waiting for the opponent …"));
    while (!this.closed) {
      const match = await get(`/v1/matches/${id}`).catch(() => null);
      if (this.closed) return;
      if (match?.status === "aborted") return this.over("The match was called off.");
      const game = match?.played.at(-1);
      if (game) {
        this.begin(game.id);
        return this.poll();
      }
      await pause(500);
    }
  }

  /** @param {string} game */
  begin(game) {
    fill(this.top);
    this.game?.close();
    this.game = new GameView();
    this.aiming = new Aiming(this.game.stage, (action) => this.act(action));
    this.game.idle = () => this.prepare();
    this.game.ended = () => this.turn && this.dropTurn();
    const concede = this.conceding = el("button", { type: "button", onclick: () => this.concede(concede) }, "Concede");
    this.waiting = el("p", { class: "waiting", role: "status" }, "Waiting for the turn …");
    this.dock = el("div", { class: "dock" }, this.waiting, this.aiming.element);
    this.game.sitDown([this.aiming.said, this.aiming.spin.element], this.dock, el("div", { class: "choices" }, concede,
      el("button", { type: "button", onclick: () => copyAddress(game) }, "Copy link to the game")), tokenPanel());
    history.replaceState(null, "", `#/play/${game}`);
    fill(this.gamePart, this.game.element);
    this.measure();
    this.game.watch(game);
  }

  /** The table's screen begins below the bar, and ends where the window does. */
  measure() {
    const screen = this.game?.screen;
    if (screen?.isConnected) screen.style.setProperty("--above", `${Math.round(screen.getBoundingClientRect().top + scrollY)}px`);
  }

  /** Ask for turns until this match is over. A turn is asked for once: it waits until it is answered. */
  async poll() {
    while (!this.closed && this.match && !this.turn) {
      try {
        const message = await call("GET", "/v1/turns?wait=25", { signal: this.polls.signal });
        if (message) this.told(message);
      } catch (error) {
        if (this.closed) return;
        if (error instanceof ProblemError && error.status === 401) return this.leave();
        await pause(AGAIN);
      }
    }
  }

  async told(message) {
    if (message.match && message.match !== this.match && message.type !== "turn") return;
    if (message.type === "turn") {
      this.turn = message.view;
      if (this.game.model && message.game !== this.game.model.terms.id) {
        await this.lastSeen();
        if (this.closed) return;
        this.begin(message.game);
      }
      this.prepare();
    } else if (message.type === "match_over") {
      this.match = null;
      await this.lastSeen();
      if (!this.closed) this.over("");
    }
  }

  /** The game on show has been seen to its end; its result may come a moment later than the news of what follows. */
  async lastSeen() {
    const { game } = this;
    const late = performance.now() + RESULT_WITHIN;
    while (!this.closed && game?.model && !game.model.isOver && performance.now() < late) await pause(50);
    while (!this.closed && game?.model && !game.seen) await pause(50);
  }

  /** Take the turn, once the strokes before it have been seen. */
  prepare() {
    const { turn, game } = this;
    if (!turn || !game?.model || game.isBehind(turn) || this.aiming.view) return;
    game.catchUp();
    this.aiming.begin(turn);
    announce("It is your turn.", true);
  }

  /** The turn is not to be had any more: see what comes. */
  dropTurn() {
    this.turn = null;
    this.aiming.end();
    this.poll();
  }

  /** Answer the turn; until the server has spoken there is none, to be answered twice or dropped. */
  async act(action) {
    const view = this.turn;
    if (!view) return;
    this.turn = null;
    const verb = action.decision ? "decisions" : "shots";
    try {
      const answer = await sent(`/v1/games/${view.game}/${verb}`, action, view.version);
      this.aiming.end();
      if (answer.view.turn === answer.view.seat) this.turn = answer.view;
      this.game.follow.checked = true;
      this.game.goOn();
      if (!this.turn) this.poll();
    } catch (error) {
      this.refused(error, view);
    }
  }

  /** @param {unknown} error @param {Record<string, any>} view the turn it was to answer */
  refused(error, view) {
    const gone = error instanceof ProblemError && ["stale_version", "game_finished", "not_your_turn", "out_of_time"].includes(error.problem.code);
    if (gone) return this.dropTurn();
    this.turn = view;
    this.aiming.refuse(words(error));
  }

  concede(button) {
    if (!this.turn) return announce("You can concede when it is your turn.");
    if (button.textContent === "Concede") return fill(button, "Really concede?");
    fill(button, "Concede");
    return this.act({ decision: "concede" });
  }

  over(said) {
    this.match = null;
    this.turn = null;
    this.aiming?.end();
    const again = el("button", { type: "button", class: "first", onclick: () => this.again() }, "Play again");
    if (this.game) {
      this.conceding.hidden = true;
      fill(this.dock, el("p", { class: "waiting" }, "The match is over."), again);
      scrollTo(0, 0); // to the result, from whatever was looked at below
    } else fill(this.top, el("h1", {}, "Play"), said && el("p", {}, said), again);
  }

  again() {
    this.game?.close();
    this.game = null;
    fill(this.gamePart);
    history.replaceState(null, "", "#/play");
    this.chooseOpponent(identity());
  }

  leave() {
    this.close();
    signOut();
    location.reload();
  }

  close() {
    this.closed = true;
    removeEventListener("resize", this.resized);
    this.choice.withdraw();
    this.polls.abort();
    this.aiming?.end();
    this.game?.close();
  }
}

/** The match of a game; null when there is none. @param {string} game */
async function matchOf(game) {
  const found = await get(`/v1/games/${encodeURIComponent(game)}`).catch(() => null);
  return found && get(`/v1/matches/${encodeURIComponent(found.view.match)}`).catch(() => null);
}

/** What can be sent to anybody. @param {string} game */
async function copyAddress(game) {
  await navigator.clipboard?.writeText(linkTo(game)).catch(() => {});
  announce(`Copied: ${linkTo(game)}`);
}

/** The agent of exactly this name. @param {string} name */
async function agentCalled(name) {
  if (!name) return null;
  let cursor = "";
  do {
    const page = await get(`/v1/agents?limit=200&search=${encodeURIComponent(name)}${cursor && `&cursor=${encodeURIComponent(cursor)}`}`);
    const found = page.agents.find((agent) => agent.name === name);
    if (found) return found;
    cursor = page.next_cursor;
  } while (cursor);
  return null;
}

/** Send an action, again with the same name when the connection fails: it is carried out once. */
async function sent(path, body, version) {
  const key = newKey();
  for (let attempt = 1; ; attempt++) {
    try {
      return await command(path, body, { version, key });
    } catch (error) {
      if ((error instanceof ProblemError && error.status < 500) || attempt === 20) throw error;
      await pause(Math.min(AGAIN, 200 * attempt));
    }
  }
}

/** @param {unknown} error */
function words(error) {
  if (error instanceof TableFileError) return error.message;
  if (!(error instanceof ProblemError)) return "The server cannot be reached.";
  const faults = error.problem.errors ?? [];
  return faults.length ? faults.map((fault) => fault.detail ?? `${fault.field}: ${fault.allowed}`).join(" ") : error.message;
}

/** @param {number} milliseconds */
function pause(milliseconds) {
  return new Promise((go) => setTimeout(go, milliseconds));
}
