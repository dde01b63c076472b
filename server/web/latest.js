/** Of several questions to the server only the last one's answer is wanted. */

export class Latest {
  constructor() {
    /** @type {AbortController | null} */
    this.asked = null;
  }

  /** @returns {AbortSignal} for a new question; the one before is withdrawn, and its request fails if it still runs */
  ask() {
    this.withdraw();
    this.asked = new AbortController();
    return this.asked.signal;
  }

  withdraw() {
    this.asked?.abort();
  }
}
