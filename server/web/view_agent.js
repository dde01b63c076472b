/** One agent: its matches, and how it stands against everybody it met. */

import { get } from "./api.js";
import { el, fill } from "./dom.js";
import { placeOf } from "./ladder.js";
import { matchRow } from "./match_row.js";
import { PagedList } from "./paged.js";

/** Pages of matches the table of opponents is made from. */
const PAGES = 10;

export class AgentView {
  constructor() {
    this.element = el("article", {}, el("p", {}, "Loading …"));
  }

  /** @param {string} id */
  async open(id) {
    const path = `/v1/matches?agent=${encodeURIComponent(id)}&limit=200`;
    const matches = await all(path);
    const seen = matches.find((match) => match.agents.includes(id));
    const name = seen ? seen.players[seen.agents.indexOf(id)] : id;
    const list = new PagedList({ title: "Matches", path: `/v1/matches?agent=${encodeURIComponent(id)}&limit=20`, member: "matches", row: matchRow, empty: "No match yet." });
    document.title = `${name} · Pooliad`;
    fill(this.element, el("header", { class: "heading" }, el("h1", {}, name), await placeOf(id)),
      el("div", { class: "halves" }, headToHead(matches.filter((match) => match.rated), id), list.element));
    await list.load();
  }

  close() {}
}

/** All rows of a list, as far as a page may look. @param {string} path */
async function all(path) {
  const rows = [];
  let cursor = null;
  for (let page = 0; page < PAGES; page++) {
    const answer = await get(cursor ? `${path}&cursor=${encodeURIComponent(cursor)}` : path);
    rows.push(...answer.matches);
    cursor = answer.next_cursor;
    if (!cursor) break;
  }
  return rows;
}

/** @param {any[]} matches @param {string} id */
function headToHead(matches, id) {
  /** @type {Map<string, {name: string, won: number, lost: number}>} */
  const met = new Map();
  for (const match of matches) {
    const seat = match.agents.indexOf(id);
    const other = match.agents[1 - seat];
    const sum = met.get(other) ?? { name: match.players[1 - seat], won: 0, lost: 0 };
    sum.won += match.score[seat];
    sum.lost += match.score[1 - seat];
    met.set(other, sum);
  }
  if (!met.size) return el("p", { class: "empty panel" }, "It has played no rated match yet.");
  const number = { class: "number" };
  return el("div", { class: "panel" }, el("table", {}, el("caption", {}, "Head to head, in rated games"),
    el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "opponent"), ["won", "lost"].map((text) => el("th", { scope: "col", ...number }, text)))),
    el("tbody", {}, [...met].map(([other, { name, won, lost }]) => el("tr", {},
      el("th", { scope: "row" }, el("a", { href: `#/agents/${other}` }, name)), el("td", number, won), el("td", number, lost))))));
}
