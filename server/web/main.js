/** The page: an address after the hash shows a view; a record dropped anywhere is opened. */

import { isEmbedded } from "./api.js";
import { announce, el, fill } from "./dom.js";
import { AgentView } from "./view_agent.js";
import { GameView } from "./view_game.js";
import { LobbyView } from "./view_lobby.js";
import { MatchView } from "./view_match.js";
import { TournamentView } from "./view_tournament.js";

const main = /** @type {HTMLElement} */ (document.getElementById("main"));
/** @type {{element: HTMLElement, close: () => void}} */
let shown = { element: main, close: () => {} };

/** Addresses and their views; loaded when first asked for where most visitors never go. */
const ROUTES = [
  { at: /^\/?$/, page: "lobby", make: () => opened(new LobbyView(), (view) => view.open()) },
  {
    at: /^\/games\/([\w.:-]+)(?:\/strokes\/(\d+))?$/, page: "lobby",
    make: ([, game, stroke]) => opened(new GameView(), (view) => {
      view.goesOn = (next) => { location.hash = `#/games/${next}`; };
      view.watch(game, stroke === undefined ? null : Number(stroke));
    }),
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

async function route() {
  const mine = ++asked;
  const address = location.hash.slice(1);
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

/** @param {{element: HTMLElement, close: () => void}} view */
function show(view) {
  shown.close();
  shown = view;
  announce("");
  fill(main, view.element);
}

/** @param {string} address */
function notFound(address) {
  return { element: el("p", {}, `There is nothing at ${address}.`), close: () => {} };
}

/** @param {File | undefined} file */
async function openRecord(file) {
  if (!file) return;
  const mine = ++asked;
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

addEventListener("hashchange", route);
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
if (location.pathname !== "/" && !location.hash) history.replaceState(null, "", `/#${location.pathname}`); // a link that was posted: the server tells of the game there
theme();
route();
