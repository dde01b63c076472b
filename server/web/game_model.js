/** A game as it is known: who plays, every stroke so far, clocks, the result; from the server's events or a file. */

/** @typedef {Record<string, any>} Entry a line of the record: a stroke or a decision */

export class GameModel {
  /**
   * @param {{id: string, players: string[], table: Record<string, any>, noise: any, number: number,
   *   games: number | null, match: string | null, balls: import("./trace.js").Balls}} terms
   */
  constructor(terms) {
    this.terms = terms;
    /** @type {Entry[]} */
    this.entries = [];
    /** @type {any} */
    this.clocks = null;
    /** @type {[boolean, boolean] | null} */
    this.connected = null;
    /** @type {any} */
    this.result = null;
    /** @type {[number, number] | number[] | null} games won in the match */
    this.score = [0, 0];
    /** Told, but not to be shown yet: clocks and result of what has not been seen. @type {{clocks?: any, toldAt?: number, result?: any}} */
    this.news = {};
    /** @type {Record<string, any> | null} the referee's state before the first entry */
    this.first = null;
    /** Whether the first event of the stream came when strokes had been played: it tells how the game stands then. */
    this.late = false;
    /** When the clocks were told, on the reader's own clock, ms. */
    this.toldAt = 0;
  }

  /** The match began from a position: so were the groups before the first stroke; in every second game the seats are exchanged. @param {{groups: [string, string] | null}} start */
  startsFrom({ groups }) {
    if (this.first) this.first = { ...this.first, groups: groups && this.terms.number % 2 ? [groups[1], groups[0]] : groups };
  }

  /** From the first event of a stream. @param {Record<string, any>} game */
  static ofEvent(game) {
    const { view } = game;
    const { players, table, noise, number, games, match, balls, groups, turn } = view;
    const made = new GameModel({ id: game.id, players, table, noise, number, games, match, balls });
    made.first = { state: balls, groups, turn, phase: view.phase, cue_ball_in_hand: view.cue_ball_area?.name ?? null };
    made.late = view.version > 1;
    made.score = view.score;
    return made;
  }

  /**
   * From the text of a record file.
   * @param {string} text JSON lines
   * @throws {Error} in words, when it is none
   */
  static ofRecord(text) {
    const lines = text.split("\n").filter((line) => line.trim()).map(readLine);
    const [header] = lines;
    if (header?.type !== "game" || !Array.isArray(header.players) || !header.table || !header.start) {
      throw new Error("This is no record of a game: its first line is not a game's header.");
    }
    const { game: id, players, table, noise, number, match, start } = header;
    const made = new GameModel({ id, players: players.map(String), table, noise, number, games: null, match, balls: start.state });
    made.first = start;
    made.score = null; // that of the match, which a record does not tell
    for (const line of lines.slice(1)) {
      if (line.type === "stroke") made.entries.push(line);
      if (line.type === "end") made.result = { outcome: line.outcome, score: null };
    }
    return made;
  }

  /** An event of the stream. @param {string} kind @param {any} data */
  take(kind, data) {
    if (kind === "stroke" || kind === "decision") {
      if (data.entry === 0 && this.late) this.first = beforeFirst(data);
      if (data.entry === this.entries.length) this.entries.push(data);
    } else if (kind === "clocks") {
      this.news = { ...this.news, clocks: data, toldAt: performance.now() };
    } else if (kind === "connections") {
      this.connected = data.connected;
    } else if (kind === "result") {
      this.news = { ...this.news, result: data };
    }
  }

  /** Everything that led to the news has been seen: they are no secret any more. @returns {boolean} whether the game is over by them */
  settle() {
    const { result } = this.news;
    Object.assign(this, this.news);
    this.news = {};
    if (result?.score) this.score = result.score;
    return Boolean(result);
  }

  /** Whether the game has a result, shown or not. */
  get isOver() {
    return this.result !== null || Boolean(this.news.result);
  }

  get players() {
    return this.terms.players;
  }

  /** The referee's state after the last entry. */
  get now() {
    return this.entries.at(-1)?.game ?? null;
  }

  /** The balls an entry began with. @param {number} place @returns {import("./trace.js").Balls} */
  ballsBefore(place) {
    const entry = this.entries[place];
    if (entry?.before) return entry.before;
    return place > 0 ? this.entries[place - 1].game.state : this.terms.balls;
  }

  /** What a player's clock shows now, s; null without one. @param {number} seat */
  secondsLeft(seat) {
    const clock = this.clocks?.clocks[seat];
    if (!clock || clock.seconds_left === null) return null;
    return clock.running ? clock.seconds_left - (performance.now() - this.toldAt) / 1000 : clock.seconds_left;
  }
}

/**
 * The referee's state before the first stroke, as far as the stroke tells it: a stroke that calls nothing is a break.
 * @param {Entry} entry
 */
function beforeFirst({ action, before, game, seat }) {
  const breaks = !action.call;
  return { state: before ?? game.state, groups: breaks ? null : game.groups, turn: seat, phase: action.decision ? "decision" : breaks ? "break" : "play", cue_ball_in_hand: action.cue_ball ? "anywhere" : null };
}

/** @param {string} line @param {number} place */
function readLine(line, place) {
  try {
    return JSON.parse(line);
  } catch {
    throw new Error(`This is no record of a game: line ${place + 1} is not JSON.`);
  }
}
