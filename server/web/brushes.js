/** What grounds of every kind of table are drawn with. */

export const CUSHION = { top: "#1a5f49", nose: "#0f4434" };
const LEATHER = "#21150e";
const HOLE = ["#000000", "#17181a"];
export const SHADE = "rgb(0 0 0 / 22%)";
/** Width of the shade that a cushion throws, m. */
export const SHADE_WIDTH = 0.014;
/** Width of the leather around a hole, m. */
const RIM = 0.011;

/** @param {import("./projection.js").PocketPlace} pocket @param {number} [rim] width of the leather around it, m */
export function drawHole(context, projection, { hole, radius }, rim = RIM) {
  const centre = projection.place(...hole);
  context.fillStyle = LEATHER;
  disc(context, ...centre, (radius + rim) * projection.scale);
  const dark = context.createRadialGradient(...centre, 0, ...centre, radius * projection.scale);
  HOLE.forEach((colour, place) => dark.addColorStop(place, colour));
  context.fillStyle = dark;
  disc(context, ...centre, radius * projection.scale);
}

export function disc(context, px, py, radius) {
  context.beginPath();
  context.arc(px, py, radius, 0, 2 * Math.PI);
  context.fill();
}

/** A rectangle of the table between two corners. @param {[number, number]} low @param {[number, number]} high */
export function box(context, projection, [x0, y0], [x1, y1]) {
  polygon(context, projection, [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]);
}

export function polygon(context, projection, points) {
  context.beginPath();
  for (const [x, y] of points) context.lineTo(...projection.place(x, y));
  context.closePath();
  context.fill();
}
