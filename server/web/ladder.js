/** The ladder: agents by what their rated games prove, and who of them is there. */

import { get } from "./api.js";
import { el, facts, fill } from "./dom.js";
import { Latest } from "./latest.js";

/** Rungs that the lobby shows. */
const SHOWN = 20;

export class Ladder {
  constructor() {
    this.body = el("div", {});
    this.latest = new Latest();
    /** @type {Map<string, Record<string, any>>} by agent */
    this.rungs = new Map();
    this.element = el("section", { class: "paged", "aria-label": "Ladder" }, el("header", {}, el("h2", {}, "Ladder")), this.body);
  }

  async load() {
    const found = await get("/v1/ladder", this.latest.ask()).catch(() => null);
    if (!found) return;
    this.rungs = new Map(found.rungs.map((one) => [one.agent, one]));
    this.draw(found);
  }

  draw({ rungs, games }) {
    if (!rungs.length) return fill(this.body, el("p", { class: "empty" }, "No rated game yet."));
    const heads = [["", "number"], ["agent", null], ["rating", "number"], ["games", "number"]];
    fill(this.body, el("table", { class: "ladder" },
      el("caption", {}, `μ − 3σ (Plackett-Luce), after ${games === 1 ? "1 rated game" : `${games} rated games`}`),
      el("thead", {}, el("tr", {}, heads.map(([text, kind]) => (text ? el("th", { scope: "col", class: kind }, text) : el("td", {}))))),
      el("tbody", {}, rungs.slice(0, SHOWN).map((one) => el("tr", {},
        el("td", { class: "number" }, one.rank),
        el("th", { scope: "row" }, el("a", { href: `#/agents/${one.agent}` }, one.name), one.present && hereMark()),
        el("td", { class: "number", title: `μ ${one.mu.toFixed(2)}, σ ${one.sigma.toFixed(2)}` }, one.ordinal.toFixed(1)),
        el("td", { class: "number" }, one.games))))));
  }
}

/** An agent's place in words; nothing without a rated game. @param {string} agent */
export async function placeOf(agent) {
  const found = await get("/v1/ladder").catch(() => ({ rungs: [] }));
  const rung = found.rungs.find((one) => one.agent === agent);
  if (!rung) return null;
  return facts(`Rung ${rung.rank} of ${found.rungs.length}`, `rating ${rung.ordinal.toFixed(1)} (μ ${rung.mu.toFixed(1)}, σ ${rung.sigma.toFixed(1)})`,
    rated(rung.games), rung.present && hereMark());
}

/** @param {number} games */
function rated(games) {
  return games === 1 ? "1 rated game" : `${games} rated games`;
}

/** An agent in a list: its name, and what the ladder knows of it. @param {Record<string, any>} agent @param {Record<string, any>} [rung] */
export function agentRow(agent, rung) {
  const told = rung ? [`rating ${rung.ordinal.toFixed(1)}`, rated(rung.games)] : ["no rated game"];
  return el("article", { class: "match" }, el("a", { href: `#/agents/${agent.id}` }, agent.name),
    facts(...told, agent.house && el("span", { class: "mark" }, "house"), rung?.present && hereMark()));
}

function hereMark() {
  return el("span", { class: "mark" }, "connected");
}
