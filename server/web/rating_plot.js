/** Ratings as a picture: a dot for each entrant, a line for its interval of 95 % confidence. */

import { shape } from "./dom.js";

const WIDTH = 560;
const NAMES = 150;
const ROW = 26;
const EDGE = 20;

/**
 * @param {{name: string, elo: number, low: number, high: number}[]} ratings the best first
 * @returns {SVGSVGElement}
 */
export function ratingPlot(ratings) {
  const height = ROW * ratings.length + 34;
  const plot = /** @type {SVGSVGElement} */ (shape("svg", {
    viewBox: `0 0 ${WIDTH} ${height}`, class: "plot", role: "img",
    "aria-label": `Ratings in Elo points: ${ratings.map((one) => `${one.name} ${Math.round(one.elo)}`).join(", ")}`,
  }));
  const low = Math.min(-50, ...ratings.map((one) => one.low));
  const high = Math.max(50, ...ratings.map((one) => one.high));
  const across = (elo) => NAMES + ((elo - low) / (high - low)) * (WIDTH - NAMES - EDGE);
  for (const elo of ticks(low, high)) {
    plot.append(
      shape("line", { x1: across(elo), x2: across(elo), y1: 4, y2: height - 24, class: "grid" }),
      shape("text", { x: across(elo), y: height - 8, "text-anchor": "middle" }, String(elo)),
    );
  }
  ratings.forEach((one, row) => {
    const y = ROW * (row + 0.5) + 4;
    plot.append(
      shape("text", { x: NAMES - 10, y: y + 5, "text-anchor": "end" }, shortened(one.name)),
      shape("line", { x1: across(one.low), x2: across(one.high), y1: y, y2: y, class: "interval" }),
      shape("circle", { cx: across(one.elo), cy: y, r: 5, class: "rating" }),
    );
  });
  return plot;
}

/** Round numbers between two. @param {number} low @param {number} high */
function ticks(low, high) {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= rough) ?? 10 * power;
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, place) => (first + place) * step);
}

/** @param {string} name */
function shortened(name) {
  return name.length > 18 ? `${name.slice(0, 17)}…` : name;
}
