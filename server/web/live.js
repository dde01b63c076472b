/** The server's events, over and over again: after a break the stream goes on from the last event that came. */

import { ProblemError } from "./api.js";

/** Pauses before a stream is opened again, ms: the first, doubled each time it fails, up to the longest. */
const FIRST_PAUSE = 1000;
const LONGEST_PAUSE = 5000;
/** Refusals that stay what they are, however often one asks. */
const FINAL = new Set([401, 403, 404, 422]);
const KINDS = ["game", "stroke", "decision", "clocks", "connections", "result"];

/**
 * @typedef {object} Listener
 * @property {(kind: string, data: any, id: string) => void} told
 * @property {(said: string) => void} [connected] what is wrong with the connection, in words; nothing when it stands
 * @property {(why: string) => void} [refused] there is nothing to be watched, now or later
 */

/**
 * Watch one game, to its result.
 * @param {string} game @param {Listener} listener
 * @returns {() => void} stop
 */
export function watchGame(game, { told, ...rest }) {
  let last = "0";
  const stream = new Stream(() => `/v1/games/${encodeURIComponent(game)}/stream?after=${last}`, {
    ...rest,
    told: (kind, data, id) => {
      if (id) last = id;
      if (kind === "result") stream.stop();
      told(kind, data, id);
    },
  });
  return () => stream.stop();
}

/**
 * Watch several games at once: one connection, however many there are.
 * @param {string[]} games
 * @param {(game: string, kind: string, data: any) => void} told
 * @returns {() => void} stop
 */
export function watchGames(games, told) {
  const address = `/v1/stream?${games.map((game) => `game=${encodeURIComponent(game)}`).join("&")}`;
  const stream = new Stream(() => address, { told: (kind, { game, data }) => told(game, kind, data) });
  return () => stream.stop();
}

class Stream {
  /** @param {() => string} address asked for each time @param {Listener} listener */
  constructor(address, { told, connected = () => {}, refused = () => {} }) {
    Object.assign(this, { address, told, connected, refused });
    this.stopped = new AbortController();
    this.pause = FIRST_PAUSE;
    this.timer = 0;
    this.open();
  }

  stop() {
    this.stopped.abort();
    clearTimeout(this.timer);
    this.source.close();
  }

  open() {
    this.source = new EventSource(this.address());
    this.source.onopen = () => {
      this.pause = FIRST_PAUSE;
      this.connected("");
    };
    this.source.onerror = () => this.broken();
    for (const kind of KINDS) {
      this.source.addEventListener(kind, (event) => {
        if (!this.stopped.signal.aborted) this.told(kind, JSON.parse(event.data), event.lastEventId);
      });
    }
  }

  async broken() {
    if (this.stopped.signal.aborted) return;
    this.source.close();
    this.connected("The connection is lost; trying again …");
    const problem = await refusal(this.address(), this.stopped.signal);
    if (this.stopped.signal.aborted) return;
    if (problem && FINAL.has(problem.status)) {
      this.stop();
      this.refused(problem.message);
      return;
    }
    if (problem) this.connected(`${problem.message}; trying again …`);
    this.timer = setTimeout(() => this.open(), this.pause);
    this.pause = Math.min(LONGEST_PAUSE, 2 * this.pause);
  }
}

/**
 * Why a stream cannot be had, which `EventSource` does not tell; null when the server cannot be reached or has let go.
 * @param {string} address @param {AbortSignal} stopped
 */
async function refusal(address, stopped) {
  const asked = new AbortController();
  try {
    const response = await fetch(address, { signal: AbortSignal.any([asked.signal, stopped]) });
    if (!response.ok) return new ProblemError(response.status, await response.json());
  } catch {
    return null;
  }
  asked.abort();
  return null;
}
