/** What can be sent of a game: its address, a frame for another page, a picture. */

import { announce, el, labelled } from "./dom.js";

/** The address of a game to be posted: where it is shown in small, the server tells who plays and how the balls lie. @param {string} game */
export function linkTo(game) {
  return `${location.origin}/games/${game}`;
}

/** @param {string} game @returns {HTMLElement[]} */
export function sharing(game) {
  const address = linkTo(game);
  const frame = `<iframe src="${linkTo(game)}" title="A game of pool" width="720" height="560" style="border:0" loading="lazy"></iframe>`;
  const link = /** @type {HTMLInputElement} */ (el("input", { readonly: true, value: address }));
  const code = /** @type {HTMLTextAreaElement} */ (el("textarea", { readonly: true, spellcheck: "false" }));
  code.value = frame;
  const copy = (field) => async () => {
    field.select();
    await navigator.clipboard?.writeText(field.value).catch(() => {});
    announce("Copied.");
  };
  return [
    el("summary", {}, "Share and embed"),
    el("div", { class: "one-line" }, labelled("Link", link), el("button", { type: "button", onclick: copy(link) }, "Copy link")),
    labelled("Frame for another page", code),
    el("p", { class: "facts" }, el("button", { type: "button", onclick: copy(code) }, "Copy frame"),
      el("a", { href: `/v1/games/${game}/position.svg` }, "picture of the position")),
    el("p", { class: "facts" }, "A frame shows where the server's setting frame_ancestors lets it."),
  ];
}
