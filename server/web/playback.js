/** A clock for looking at strokes: runs, stands, jumps, at any speed. */

export class Playback {
  /**
   * @param {(time: number) => void} show called for every frame to be drawn
   * @param {() => void} ended called when the end is reached while running
   */
  constructor(show, ended = () => {}) {
    this.show = show;
    this.ended = ended;
    this.start = 0;
    this.duration = 0;
    this.time = 0;
    this.speed = 1;
    this.frame = 0;
    this.last = 0;
  }

  get playing() {
    return this.frame !== 0;
  }

  /** Take another stroke. @param {number} start @param {number} duration */
  load(start, duration) {
    this.pause();
    this.start = start;
    this.duration = duration;
    this.time = start;
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.duration) this.time = this.start;
    this.last = performance.now();
    this.frame = requestAnimationFrame((now) => this.step(now));
  }

  pause() {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }

  /** Show a time, without running. @param {number} time */
  seek(time) {
    this.time = Math.min(this.duration, Math.max(this.start, time));
    this.show(this.time);
  }

  step(now) {
    this.time = Math.min(this.duration, this.time + (this.speed * Math.max(0, now - this.last)) / 1000);
    this.last = now;
    this.frame = this.time < this.duration ? requestAnimationFrame((next) => this.step(next)) : 0;
    this.show(this.time);
    if (!this.playing) this.ended();
  }
}

/** Whether the reader asked for as little movement as possible. */
export function reducedMotion() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
