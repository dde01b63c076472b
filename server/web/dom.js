/** Elements from values: whatever comes from outside becomes text, never markup. */

/**
 * @typedef {Node | string | number | null | undefined | false} Child
 */

/**
 * Make an element.
 * @param {string} tag
 * @param {Record<string, unknown>} [properties] `class`, `on…` (a listener), else an attribute; `false` and
 *   `null` leave one out, `true` gives an empty one.
 * @param {...(Child | Child[])} children text or nodes
 * @returns {HTMLElement}
 */
export function el(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === false || value === null || value === undefined) continue;
    if (name.startsWith("on")) made.addEventListener(name.slice(2), /** @type {EventListener} */ (value));
    else made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...kept(children));
  return made;
}

/**
 * Put children in the place of whatever an element holds.
 * @param {Element} parent
 * @param {...(Child | Child[])} children
 */
export function fill(parent, ...children) {
  parent.replaceChildren(...kept(children));
}

/** @param {(Child | Child[])[]} children */
function kept(children) {
  return children
    .flat()
    .filter((child) => child !== null && child !== undefined && child !== false)
    .map((child) => (child instanceof Node ? child : String(child)));
}

/**
 * A labelled control.
 * @param {string} label
 * @param {HTMLElement} control
 */
export function labelled(label, control) {
  return el("label", { class: "field" }, el("span", {}, label), control);
}

/** How long something said stays on the screen, ms. */
const SAID = 6000;
let silence = 0;

/** Say something to everybody, readers of the screen included. @param {string} text */
export function announce(text) {
  const status = document.getElementById("status");
  if (!status) return;
  clearTimeout(silence);
  status.textContent = text;
  silence = setTimeout(() => { status.textContent = ""; }, SAID);
}

/** A time of the server in the reader's words. @param {string | null} text */
export function when(text) {
  return text ? new Date(text).toLocaleString() : "";
}
