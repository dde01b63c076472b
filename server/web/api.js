/** Requests to the server this page came from, and the token of the player: kept for the tab, or on this device. */

const TOKEN = "pooliad.token";
const AGENT = "pooliad.agent";

/** A request the server did not carry out; `problem` is its RFC 9457 body. */
export class ProblemError extends Error {
  /** @param {number} status @param {Record<string, any>} problem */
  constructor(status, problem) {
    super(problem.detail || problem.title || `the server answered ${status}`);
    this.status = status;
    this.problem = problem;
  }
}

/** @typedef {{id: string, name: string}} Identity */

/** @returns {Identity | null} the player who is signed in */
export function identity() {
  const kept = stored(AGENT);
  return kept && token() ? JSON.parse(kept) : null;
}

/** @returns {string | null} */
export function token() {
  return stored(TOKEN);
}

/** Whether the page is shown within another one, which must not act for a player: it could lead clicks astray. */
export function isEmbedded() {
  return window.top !== window.self;
}

/** The tab's own player goes before the device's: two tabs may play against each other. */
function stored(name) {
  if (isEmbedded()) return null;
  const here = sessionStorage.getItem(TOKEN) ? sessionStorage : localStorage;
  return here.getItem(name);
}

/** @param {string} newToken @param {Identity} agent @param {boolean} keep on this device, until somebody signs out */
export function signIn(newToken, agent, keep) {
  for (const store of keep ? [sessionStorage, localStorage] : [sessionStorage]) {
    store.setItem(TOKEN, newToken);
    store.setItem(AGENT, JSON.stringify(agent));
  }
}

/** Forget the player, on the device too when it is the one that is kept there. */
export function signOut() {
  const gone = token();
  for (const store of [sessionStorage, localStorage]) {
    if (store.getItem(TOKEN) !== gone) continue;
    store.removeItem(TOKEN);
    store.removeItem(AGENT);
  }
}

/**
 * Send a request; the answer's JSON, or null when it has none.
 * @param {string} method
 * @param {string} path
 * @param {{body?: unknown, headers?: Record<string, string>, signal?: AbortSignal}} [options]
 * @returns {Promise<any>}
 */
export async function call(method, path, { body, headers = {}, signal } = {}) {
  const sent = { Accept: "application/json", ...(token() && { Authorization: `Bearer ${token()}` }), ...headers };
  if (body !== undefined) sent["Content-Type"] = "application/json";
  const response = await fetch(path, { method, headers: sent, body: body === undefined ? undefined : JSON.stringify(body), signal });
  const text = await response.text();
  const read = text ? parsed(text) : null;
  if (!response.ok) throw new ProblemError(response.status, read || {});
  return read;
}

/** @param {string} path @param {AbortSignal} [signal] */
export function get(path, signal) {
  return call("GET", path, { signal });
}

/**
 * A request that changes something: carried out once, however often it is sent.
 * @param {string} path @param {unknown} [body] @param {{version?: number, key?: string}} [options]
 */
export function command(path, body, { version, key = newKey() } = {}) {
  const headers = { "Idempotency-Key": key };
  if (version !== undefined) headers["If-Match"] = `"${version}"`;
  return call("POST", path, { body, headers });
}

/** A name for a request. (`crypto.randomUUID` is missing on pages without TLS.) */
export function newKey() {
  return randomDigits(16);
}

/** A player's own seed for the draw of racks and noise. */
export function newSeed() {
  return randomDigits(32);
}

/** @param {number} count bytes, as hexadecimal digits */
function randomDigits(count) {
  const bytes = crypto.getRandomValues(new Uint8Array(count));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** @param {string} text */
function parsed(text) {
  try {
    return JSON.parse(text);
  } catch {
    return { detail: text.slice(0, 200) };
  }
}
