/** What the server says about a shot that is only thought of: the least elevation, and where the balls would go. */

import { ProblemError, call } from "./api.js";
import { Latest } from "./latest.js";

/** Time after the last change before the server is asked, ms. */
const PAUSE = 120;

export class Preview {
  /** @param {(answer: any, elevation: number | null, problem: string) => void} show */
  constructor(show) {
    this.show = show;
    this.timer = 0;
    this.latest = new Latest();
  }

  /**
   * Ask, a moment after the last change.
   * @param {Record<string, any>} table @param {import("./trace.js").Balls} balls
   * @param {import("./shot_form.js").Shot} shot
   * @param {boolean} lowest whether the cue is to be raised only as far as it must
   * @param {boolean} [simulated] whether the balls are to be followed as well
   */
  ask(table, balls, shot, lowest, simulated = true) {
    this.cancel();
    this.timer = setTimeout(() => this.send(table, balls, shot, lowest, simulated), PAUSE);
  }

  cancel() {
    clearTimeout(this.timer);
    this.latest.withdraw();
  }

  async send(table, balls, shot, lowest, simulated) {
    const signal = this.latest.ask();
    const post = (path, body) => call("POST", path, { body, signal });
    try {
      const { phi, a, b } = shot;
      const elevation = lowest ? (await post("/v1/min-elevation", { table, balls, phi, a, b })).theta : shot.theta;
      if (elevation === null) return this.show(null, null, "The cue cannot get at the ball from here.");
      const theta = lowest ? Math.min(table.theta_max, Math.ceil(elevation * 10) / 10 + 0.5) : elevation;
      if (!simulated) return this.show(null, theta, "");
      const answer = await post("/v1/simulate", { table, balls, shot: { ...shot, theta }, trace: true });
      this.show(answer, theta, answer.status === "at_rest" ? "" : answer.reason);
    } catch (error) {
      if (signal.aborted) return;
      this.show(null, null, error instanceof ProblemError ? error.message : "The server cannot be reached.");
    }
  }
}
