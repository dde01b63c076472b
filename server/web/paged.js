/** A list the server gives in pages: rows, a search among all of them, a button for more. */

import { get } from "./api.js";
import { announce, el, fill } from "./dom.js";
import { Latest } from "./latest.js";

/** Time after the last letter before the server is asked, ms. */
const PAUSE = 200;
const LONGEST_SEARCH = 64;

export class PagedList {
  /**
   * @param {object} how
   * @param {string} how.title
   * @param {string} how.path with its query
   * @param {string} how.member the answer's field with the rows
   * @param {(row: any) => HTMLElement} how.row
   * @param {string} how.empty what to say when there is nothing
   */
  constructor({ title, path, member, row, empty }) {
    Object.assign(this, { path, member, row, empty });
    /** @type {any[]} */
    this.rows = [];
    /** @type {string | null} */
    this.cursor = null;
    this.pages = 0;
    /** What the rows on show were searched by. */
    this.wanted = "";
    this.timer = 0;
    this.latest = new Latest();
    this.search = /** @type {HTMLInputElement} */ (el("input", {
      type: "search", maxlength: LONGEST_SEARCH, placeholder: "Search", "aria-label": `Search ${title.toLowerCase()}`,
      oninput: () => this.searched(),
    }));
    this.list = el("ul", { class: "rows" });
    this.more = el("button", { type: "button", hidden: true, onclick: () => this.ask(this.cursor) }, "More");
    this.element = el("section", { class: "paged", "aria-label": title },
      el("header", {}, el("h2", {}, title), this.search), this.list, this.more);
  }

  /** The first page, anew. */
  load() {
    return this.ask(null);
  }

  /** The same, unless somebody has read further on. */
  refresh() {
    if (this.pages <= 1) this.load();
  }

  searched() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.load(), PAUSE);
  }

  /** One page. @param {string | null} cursor */
  async ask(cursor) {
    const signal = this.latest.ask();
    const wanted = this.search.value.trim();
    try {
      const page = await get(this.address(wanted, cursor), signal);
      this.rows = cursor ? [...this.rows, ...page[this.member]] : page[this.member];
      this.pages = cursor ? this.pages + 1 : 1;
      this.cursor = page.next_cursor ?? null;
      this.draw(wanted);
    } catch (error) {
      if (!signal.aborted) announce(error instanceof Error ? error.message : "The server cannot be reached.");
    }
  }

  address(wanted, cursor) {
    const [path, query] = this.path.split("?");
    const asked = new URLSearchParams(query);
    if (wanted) asked.set("search", wanted);
    if (cursor) asked.set("cursor", cursor);
    return `${path}?${asked}`;
  }

  /** The rows on show, with what has become known beside them. */
  redraw() {
    if (this.pages) this.draw(this.wanted);
  }

  /** @param {string} wanted */
  draw(wanted) {
    this.wanted = wanted;
    const none = wanted ? `Nothing is called “${wanted}”.` : this.empty;
    fill(this.list, this.rows.length ? this.rows.map((row) => el("li", {}, this.row(row))) : el("li", { class: "empty" }, none));
    this.more.hidden = this.cursor === null;
  }
}
