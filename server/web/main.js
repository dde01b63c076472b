/**
 * The page: an address after the hash shows a view; a record dropped anywhere is opened.
 *
 * A game's address is a path: the server shows how it stands before this script has run, and what that shows stays until
 * the view has as much to show.
 */

import { isEmbedded } from "./api.js";
import { announce, el, fill } from "./dom.js";
import { AgentView } from "./view_agent.js";
import { GameView } from "./view_game.js";
import { LobbyView } from "./view_lobby.js";
import { MatchView } from "./view_match.js";
import { TournamentView } from "./view_tournament.js";

const main = /** @type {HTMLElement} */ (document.getElementById("main"));
/** @typedef {{element: HTMLElement, close: () => void, placed?: () => void}} View placed: told when it is on the page */
const NONE = /** @type {View} */ ({ element: main, close: () => {} });
let shown = NONE;
/** What has been asked for and has nothing to show yet. */
let coming = NONE;

/** Addresses and their views; loaded when first asked for where most visitors never go. */
const ROUTES = [
  { at: /^\/?$/, page: "lobby", make: () => opened(new LobbyView(), (view) => view.open()) },
  {
    at: /^\/games\/([\w.:-]+)(?:\/strokes\/(\d+))?$/, page: "lobby",
    make: async ([address, game, stroke]) => {
      if (stroke === undefined) history.replaceState(null, "", address);
      const view = new GameView();
      coming = view;
      view.goesOn = (next) => { location.hash = `#/games/${next}`; };
      view.watch(game, stroke === undefined ? null : Number(stroke));
      await view.ready;
      return view;
    },
  },
  { at: /^\/matches\/([\w.:-]+)$/, page: "lobby", make: ([, id]) => opened(new MatchView(), (view) => view.open(id)) },
  { at: /^\/tournaments\/([\w.:-]+)$/, page: "lobby", make: ([, id]) => opened(new TournamentView(), (view) => view.open(id)) },
  {
    at: /^\/play(?:\/([\w.:-]+))?$/, page: "play",
    make: async ([, game]) => opened(new (await import("./view_play.js")).PlayView(), (view) => view.open(game ?? null)),
  },
  {
    at: /^\/lab(?:\?(.*))?$/, page: "lab",
    make: async ([, query]) => opened(new (await import("./view_lab.js")).LabView(), (view) => view.open(query ?? "")),
  },
  { at: /^\/agents\/([\w.:-]+)$/, page: "lobby", make: ([, id]) => opened(new AgentView(), (view) => view.open(id)) },
];

/** Make a view and let it load; what goes wrong is said where it would have been. */
function opened(view, open) {
  Promise.resolve(open(view)).catch((error) => fill(view.element, el("p", { class: "problem" }, error.message)));
  return view;
}

/** Counts changes of address: a view that loads slowly must not replace a later one. */
let asked = 0;
/** What is to be shown: it stands after the hash, or is the path of a game. */
function addressed() {
  return location.hash ? location.hash.slice(1) : location.pathname;
}

async function route() {
  const mine = ++asked;
  coming.close();
  shown.close(); // it stays to be seen, and does nothing more: it might write its own address over the new one
  shown = NONE;
  const address = addressed();
  if (location.hash && location.pathname !== "/") history.replaceState(null, "", `/${location.hash}`);
  const found = ROUTES.map((one) => ({ ...one, match: one.at.exec(address) })).find((one) => one.match);
  document.title = "Pooliad";
  const view = found ? await found.make(found.match) : notFound(address);
  if (mine !== asked) return view.close();
  show(view);
  for (const link of document.querySelectorAll("nav a[data-page]")) {
    if (link.getAttribute("data-page") === found?.page) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

/** @param {View} view */
function show(view) {
  shown.close();
  shown = view;
  coming = NONE;
  announce("");
  fill(main, view.element);
  view.placed?.();
}

/** @param {string} address */
function notFound(address) {
  return { element: el("p", {}, `There is nothing at ${address}.`), close: () => {} };
}

/** @param {File | undefined} file */
async function openRecord(file) {
  if (!file) return;
  const mine = ++asked;
  coming.close();
  const view = new GameView();
  try {
    const text = await file.text();
    if (mine !== asked) return view.close();
    show(view);
    view.open(text);
  } catch (error) {
    view.close();
    if (mine !== asked) return;
    show({ element: el("p", { class: "problem" }, error instanceof Error ? error.message : String(error)), close: () => {} });
  }
}

/** The colours chosen before; nothing where the browser lets nobody remember, as in a frame of another page. */
function chosenBefore() {
  try {
    return localStorage.getItem("pooliad.theme");
  } catch {
    return null;
  }
}

/** What the server drew has been seen: until then the script would only hold it up. Nobody sees a hidden page. */
async function painted() {
  if (document.hidden || !document.querySelector(".first-picture")) return;
  await new Promise((seen) => requestAnimationFrame(() => setTimeout(seen)));
}

function theme() {
  const button = /** @type {HTMLElement} */ (document.getElementById("theme"));
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const apply = (chosen) => {
    const isDark = chosen ? chosen === "dark" : dark.matches;
    document.documentElement.dataset.theme = isDark ? "dark" : "light";
    button.textContent = isDark ? "Light" : "Dark";
    button.setAttribute("aria-label", isDark ? "Light colours" : "Dark colours");
  };
  button.addEventListener("click", () => {
    const chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    localStorage.setItem("pooliad.theme", chosen);
    apply(chosen);
  });
  dark.addEventListener("change", () => apply(chosenBefore()));
  apply(chosenBefore());
}

addEventListener("popstate", route); // links after the hash too; `hashchange` tells nothing of a step between a path and a hash
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  openRecord(event.dataTransfer?.files[0]);
});
addEventListener("change", (event) => {
  const input = /** @type {HTMLInputElement} */ (event.target);
  if (input.id === "record-file") openRecord(input.files?.[0]);
});
document.getElementById("skip")?.addEventListener("click", (event) => {
  event.preventDefault();
  main.focus();
});
document.documentElement.classList.toggle("embedded", isEmbedded());
theme();
painted().then(route);
