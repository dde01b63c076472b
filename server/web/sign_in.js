/** Signing in: a name makes a new player, a token brings a known one back. Kept for this tab alone. */

import { call, signIn } from "./api.js";
import { el, fill, labelled } from "./dom.js";

/** @param {() => void} done @returns {HTMLElement} */
export function signInPanel(done) {
  const problem = el("p", { class: "refusal", role: "alert" });
  const name = /** @type {HTMLInputElement} */ (el("input", { autocomplete: "nickname", maxlength: 64, required: true }));
  const token = /** @type {HTMLInputElement} */ (el("input", { type: "password", autocomplete: "off", required: true }));
  const attempt = (act) => async (event) => {
    event.preventDefault();
    fill(problem);
    try {
      await act();
      done();
    } catch (error) {
      fill(problem, error instanceof Error ? error.message : String(error));
    }
  };
  const asNew = attempt(async () => {
    const made = await call("POST", "/v1/agents", { body: { name: name.value.trim() } });
    signIn(made.token, made.agent);
  });
  const asKnown = attempt(async () => {
    const headers = { Authorization: `Bearer ${token.value.trim()}` };
    signIn(token.value.trim(), await call("GET", "/v1/agents/me", { headers }));
  });
  return el("section", { class: "panel", "aria-label": "Sign in" }, problem,
    el("form", { onsubmit: asNew }, labelled("New here? Choose a name", name), el("button", { class: "first" }, "Begin")),
    el("form", { onsubmit: asKnown }, labelled("Or come back with your token", token), el("button", {}, "Sign in")),
    el("p", { class: "facts" }, "The token is kept in this tab and forgotten with it."));
}
