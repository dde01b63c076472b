/** Signing in: a name makes a new player, a token brings a known one back; and the token, to be seen and kept. */

import { call, signIn, token as ownToken } from "./api.js";
import { announce, el, fill, labelled } from "./dom.js";

/** @param {() => void} done @returns {HTMLElement} */
export function signInPanel(done) {
  const problem = el("p", { class: "refusal", role: "alert" });
  const name = /** @type {HTMLInputElement} */ (el("input", { autocomplete: "nickname", maxlength: 64, required: true }));
  const token = /** @type {HTMLInputElement} */ (el("input", { type: "password", autocomplete: "off", required: true }));
  const keep = /** @type {HTMLInputElement} */ (el("input", { type: "checkbox", checked: true }));
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
    signIn(made.token, made.agent, keep.checked);
  });
  const asKnown = attempt(async () => {
    const headers = { Authorization: `Bearer ${token.value.trim()}` };
    signIn(token.value.trim(), await call("GET", "/v1/agents/me", { headers }), keep.checked);
  });
  return el("section", { class: "panel sign-in", "aria-label": "Sign in" }, problem,
    el("form", { onsubmit: asNew }, labelled("New here? Choose a name", name), el("button", { class: "first" }, "Begin")),
    el("form", { onsubmit: asKnown }, labelled("Or come back with your token", token), el("button", {}, "Sign in")),
    el("label", { class: "check" }, keep, "Stay signed in on this device"));
}

/** The player's token: who has it is the player, here and from any program. */
export function tokenPanel() {
  const field = /** @type {HTMLInputElement} */ (el("input", { readonly: true, value: ownToken() ?? "", class: "token", autocomplete: "off" }));
  const copy = async () => {
    field.select();
    await navigator.clipboard?.writeText(field.value).catch(() => {});
    announce("Copied.");
  };
  return el("details", { class: "keep" }, el("summary", {}, "Your token"),
    el("p", { class: "facts" }, "It is your player: with it you come back on another device, or let a program play for you. Tell it to nobody."),
    el("div", { class: "one-line" }, labelled("Token", field), el("button", { type: "button", onclick: copy }, "Copy token")));
}
