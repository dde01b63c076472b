/** A list the server gives in pages: rows, a search over what is shown, a button for more. */

import { get } from "./api.js";
import { announce, el, fill, labelled } from "./dom.js";

export class PagedList {
  /**
   * @param {object} how
   * @param {string} how.title
   * @param {string} how.path with its query
   * @param {string} how.member the answer's field with the rows
   * @param {(row: any) => HTMLElement} how.row
   * @param {(row: any) => string} how.text what a search looks at
   * @param {string} how.empty what to say when there is nothing
   */
  constructor({ title, path, member, row, text, empty }) {
    Object.assign(this, { path, member, row, text, empty });
    /** @type {any[]} */
    this.rows = [];
    /** @type {string | null} */
    this.cursor = null;
    this.search = /** @type {HTMLInputElement} */ (el("input", { type: "search", oninput: () => this.draw() }));
    this.list = el("ul", { class: "rows" });
    this.more = el("button", { type: "button", hidden: true, onclick: () => this.next() }, "More");
    this.element = el("section", { class: "paged", "aria-label": title },
      el("h2", {}, title), labelled(`Search ${title.toLowerCase()}`, this.search), this.list, this.more);
  }

  /** The first page, anew. */
  async load() {
    this.rows = [];
    this.cursor = null;
    await this.next();
  }

  async next() {
    const joint = this.path.includes("?") ? "&" : "?";
    const address = this.cursor ? `${this.path}${joint}cursor=${encodeURIComponent(this.cursor)}` : this.path;
    try {
      const page = await get(address);
      this.rows.push(...page[this.member]);
      this.cursor = page.next_cursor ?? null;
    } catch (error) {
      announce(error instanceof Error ? error.message : "The server cannot be reached.");
    }
    this.draw();
  }

  draw() {
    const wanted = this.search.value.trim().toLowerCase();
    const shown = this.rows.filter((row) => this.text(row).toLowerCase().includes(wanted));
    fill(this.list, shown.length ? shown.map((row) => el("li", {}, this.row(row))) : el("li", { class: "empty" }, this.empty));
    this.more.hidden = this.cursor === null;
  }
}
