/** A stroke told: the sentence, the rules behind it, the shot as meant and as played, its events. */

import { el, fill } from "./dom.js";
import { describeAction, describeEvent, describeShot, named, rules } from "./words.js";

const SHOWN_EVENTS = 400;

export class StrokeStory {
  /** @param {(time: number) => void} seek */
  constructor(seek) {
    this.seek = seek;
    this.sentence = el("p", { class: "sentence", "aria-live": "polite" });
    this.rules = el("ul", { class: "rules" });
    this.shot = el("dl", { class: "shot" });
    this.events = el("ol", { class: "events" });
    this.details = el("details", {}, el("summary", {}, "Events"), this.events);
    this.details.addEventListener("toggle", () => this.listEvents());
    this.element = el("section", { class: "story", "aria-label": "Stroke" },
      this.sentence, this.rules, this.shot, this.details);
    /** @type {Record<string, any> | null} */
    this.entry = null;
  }

  /** @param {Record<string, any>} entry @param {string[]} players */
  async show(entry, players) {
    this.entry = entry;
    fill(this.sentence, named(entry.ruling.words, players));
    fill(this.shot, this.shotRows(entry, players));
    this.listEvents();
    const sentences = await rules();
    if (this.entry !== entry) return;
    fill(this.rules, entry.ruling.rules.map((rule) => this.ruleRow(entry, rule, sentences[rule])));
  }

  /** A stroke that still rolls. @param {string} words */
  await(words) {
    this.entry = null;
    fill(this.sentence, words);
    for (const part of [this.rules, this.shot, this.events]) fill(part);
  }

  shotRows(entry, players) {
    const rows = [["player", players[entry.seat]], ["called", describeAction(entry)]];
    if (entry.shot) rows.push(["meant", describeShot(entry.action.shot)], ["played", describeShot(entry.shot)]);
    if (entry.miscue) rows.push(["miscue", "the tip slipped off the cue ball"]);
    return rows.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]);
  }

  /** A rule with its sentence and the moments that prove it. */
  ruleRow(entry, rule, sentence) {
    const proofs = entry.ruling.evidence.filter((one) => one.rule === rule).flatMap((one) => one.events ?? []);
    const events = [...new Set(proofs)].map((index) => entry.events?.[index]).filter(Boolean);
    return el("li", { class: entry.ruling.fouls.includes(rule) ? "foul" : null },
      el("b", {}, rule), " ", sentence ?? "",
      events.slice(0, 4).map((event) => el("button", { type: "button", class: "link", onclick: () => this.seek(event.time) },
        `${describeEvent(event)} (${event.time.toFixed(2)} s)`)));
  }

  /** The list is made when it is looked at: a break has hundreds. */
  listEvents() {
    if (!this.details.hasAttribute("open")) return fill(this.events);
    const events = this.entry?.events ?? [];
    const rows = events.slice(0, SHOWN_EVENTS).map((event) => el("li", { value: event.index },
      el("button", { type: "button", class: "link", onclick: () => this.seek(event.time) },
        `${event.time.toFixed(4)} s  ${describeEvent(event)}`)));
    fill(this.events, rows, events.length > SHOWN_EVENTS && el("li", {}, `and ${events.length - SHOWN_EVENTS} more`));
  }
}
