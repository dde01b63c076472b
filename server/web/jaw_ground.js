/** The table with jaws without its balls: cloth into the mouths, holes, cushions with horns and facings, to scale. */

import { CUSHION, SHADE, SHADE_WIDTH, box, disc, drawHole, polygon } from "./brushes.js";

/** @typedef {import("./tables.js").Description} Description */

/** More than a mouth is wide, m. */
const MOUTH = 0.2;
/** Points of a horn's arc. */
const STEPS = 10;
/** Pockets at the ends of each nose, as the server lists noses: counter-clockwise from the south one. */
const ENDS = [[0, 5], [5, 4], [4, 3], [3, 2], [2, 1], [1, 0]];

/**
 * What is between frame and marks.
 * @param {CanvasRenderingContext2D} context @param {import("./projection.js").Projection} projection
 * @param {Description} shape @param {import("./projection.js").PocketPlace[]} places
 * @param {CanvasGradient} cloth
 */
export function drawBedWithJaws(context, projection, shape, places, cloth) {
  const { width, length, cushion_width: back } = shape.table;
  for (const place of places) drawHole(context, projection, place);
  context.fillStyle = cloth;
  box(context, projection, [-back, -back], [width + back, length + back]);
  context.fillStyle = SHADE;
  for (const { cushion, ends: [one, two] } of shape.noses) {
    if (cushion === 0) box(context, projection, one, [two[0] + SHADE_WIDTH, two[1]]);
    if (cushion === 3) box(context, projection, one, [two[0], two[1] - SHADE_WIDTH]);
  }
  for (const place of places) drawHole(context, projection, place, 0);
  for (const [index, nose] of shape.noses.entries()) drawCushion(context, projection, shape, nose, ENDS[index]);
}

/**
 * Where the centre of a ball in hand may lie, opaque: the bed and the mouths, less what is nearer to a cushion than a
 * ball may come, and less the holes.
 * @param {CanvasRenderingContext2D} context of an empty canvas @param {import("./projection.js").Projection} projection
 * @param {Description} shape @param {{y: number[]}} area @param {boolean} toTheEnd whether it ends at the table's, not before
 */
export function drawPlaces(context, projection, shape, { y: [low] }, toTheEnd) {
  const { table: { width, length, cushion_width }, contact_distance: near } = shape;
  const back = cushion_width - 2 / projection.scale; // the cushions' own soft edges would leave a line there
  context.fillStyle = context.strokeStyle = "#ffffff";
  box(context, projection, [-back, toTheEnd ? -back : low], [width + back, length + back]);
  context.globalCompositeOperation = "destination-out";
  context.lineWidth = 2 * near * projection.scale;
  context.lineJoin = context.lineCap = "round";
  for (const [index, nose] of shape.noses.entries()) {
    const front = frontOf(shape, nose, ENDS[index]);
    polygon(context, projection, front);
    context.beginPath();
    for (const [x, y] of front) context.lineTo(...projection.place(x, y));
    context.stroke();
  }
  for (const { hole_centre, hole_radius, jaws } of shape.pockets) {
    disc(context, ...projection.place(...hole_centre), hole_radius * projection.scale);
    for (const jaw of jaws) polygon(context, projection, beyond(jaw));
  }
}

/** What is beyond the end of a facing, as far as the mouth goes. @returns {[number, number][]} */
function beyond({ facing_start: [x0, y0], facing_end: [x, y] }) {
  const length = Math.hypot(x - x0, y - y0);
  const [dx, dy] = [(MOUTH * (x - x0)) / length, (MOUTH * (y - y0)) / length];
  return [[x - dy, y + dx], [x + dy, y - dx], [x + dy + dx, y - dx + dy], [x - dy + dx, y + dx + dy]];
}

/** The front of a cushion from facing to facing. @returns {[number, number][]} */
function frontOf(shape, { ends }, pockets) {
  return [
    ...jawLine(jawAt(shape.pockets[pockets[0]].jaws, ends[0])).reverse(),
    ...jawLine(jawAt(shape.pockets[pockets[1]].jaws, ends[1])),
  ];
}

/** One cushion: its front, closed at the back. */
function drawCushion(context, projection, shape, nose, pockets) {
  const front = frontOf(shape, nose, pockets);
  context.save();
  context.fillStyle = CUSHION.top;
  polygon(context, projection, front);
  context.clip();
  context.strokeStyle = CUSHION.nose;
  context.lineWidth = 2 * SHADE_WIDTH * projection.scale;
  context.lineJoin = "round";
  context.beginPath();
  for (const [x, y] of front) context.lineTo(...projection.place(x, y));
  context.stroke();
  context.restore();
}

/** The jaw that a nose ends at. */
function jawAt(jaws, end) {
  const away = (jaw) => Math.hypot(jaw.nose_end[0] - end[0], jaw.nose_end[1] - end[1]);
  return away(jaws[0]) < away(jaws[1]) ? jaws[0] : jaws[1];
}

/**
 * A jaw from the nose's end to the facing's: the horn as points of its arc.
 * @param {import("./tables.js").Jaw} jaw @returns {[number, number][]}
 */
export function jawLine({ nose_end, horn_centre: [x, y], horn_radius, facing_start, facing_end }) {
  const from = Math.atan2(nose_end[1] - y, nose_end[0] - x);
  const turn = Math.atan2(facing_start[1] - y, facing_start[0] - x) - from;
  const shorter = turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
  const arc = Array.from({ length: STEPS + 1 }, (_, step) => {
    const angle = from + (shorter * step) / STEPS;
    return /** @type {[number, number]} */ ([x + horn_radius * Math.cos(angle), y + horn_radius * Math.sin(angle)]);
  });
  return [...arc, facing_end];
}
