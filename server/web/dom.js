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
 * Short facts in a row.
 * @param {...Child} parts text or elements
 */
export function facts(...parts) {
  const told = kept(parts).map((part) => (part instanceof Node ? part : el("span", {}, part)));
  return el("span", { class: "facts" }, told);
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

/** Say something to everybody, readers of the screen included; quietly: to them alone. @param {string} text */
export function announce(text, quietly = false) {
  const status = document.getElementById("status");
  if (!status) return;
  clearTimeout(silence);
  status.textContent = text;
  status.classList.toggle("quiet", quietly);
  silence = setTimeout(() => { status.textContent = ""; }, SAID);
}

const UNITS = /** @type {[Intl.RelativeTimeFormatUnit, number][]} */ ([["day", 86400], ["hour", 3600], ["minute", 60]]);

/** How long ago a time of the server is; the time itself where the pointer rests. @param {string | null} text */
export function ago(text) {
  if (!text) return null;
  const then = new Date(text);
  const seconds = (then.getTime() - Date.now()) / 1000;
  const [unit, size] = UNITS.find(([, one]) => -seconds >= one) ?? ["second", 1];
  const told = unit === "second" ? "just now" : new Intl.RelativeTimeFormat("en").format(Math.ceil(seconds / size), unit);
  return el("time", { datetime: text, title: then.toLocaleString() }, told);
}

/**
 * Make a part of a drawing.
 * @param {string} tag @param {Record<string, unknown>} [attributes] @param {...(Node | string)} children
 * @returns {SVGElement}
 */
export function shape(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return /** @type {SVGElement} */ (made);
}
