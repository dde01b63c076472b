/** The server's events, over and over again: after a break the stream goes on from the last event that came. */

const AGAIN = 1500;

/**
 * Watch one game.
 * @param {string} game
 * @param {(kind: string, data: any) => void} told
 * @param {(connected: boolean) => void} [connected]
 * @returns {() => void} stop
 */
export function watchGame(game, told, connected = () => {}) {
  let last = "0";
  const address = () => `/v1/games/${encodeURIComponent(game)}/stream?after=${last}`;
  return listen(address, (kind, data, id) => {
    if (id) last = id;
    told(kind, data);
  }, connected);
}

/**
 * Watch several games at once: one connection, however many there are.
 * @param {string[]} games
 * @param {(game: string, kind: string, data: any) => void} told
 * @returns {() => void} stop
 */
export function watchGames(games, told) {
  const address = `/v1/stream?${games.map((game) => `game=${encodeURIComponent(game)}`).join("&")}`;
  return listen(() => address, (kind, { game, data }) => told(game, kind, data), () => {}, true);
}

const KINDS = ["game", "stroke", "decision", "clocks", "connections", "result"];

/** @param {() => string} address */
function listen(address, told, connected, several = false) {
  /** @type {EventSource | null} */
  let source = null;
  let stopped = false;
  let timer = 0;
  const stop = () => {
    stopped = true;
    clearTimeout(timer);
    source?.close();
  };
  const open = () => {
    source = new EventSource(address());
    source.onopen = () => connected(true);
    for (const kind of KINDS) {
      source.addEventListener(kind, (event) => {
        if (stopped) return;
        if (kind === "result" && !several) stop();
        told(kind, JSON.parse(event.data), event.lastEventId);
      });
    }
    source.onerror = () => {
      if (stopped) return;
      connected(false);
      source?.close();
      timer = setTimeout(open, AGAIN);
    };
  };
  open();
  return stop;
}
