/** The table without its balls, drawn once for a size: frame, sights, cushions, cloth, pockets, string and spot. */

import { CUSHION, SHADE, SHADE_WIDTH, box, disc, drawHole, polygon } from "./brushes.js";
import { drawBedWithJaws } from "./jaw_ground.js";
import { pockets } from "./projection.js";
import { shapeOf } from "./tables.js";

/** @typedef {import("./projection.js").Projection} Projection */

const CLOTH = { lit: "#257a5f", plain: "#1d6b52", dim: "#155440" };
const WOOD = ["#6b4128", "#54311d", "#3d2315"];
const SIGHT = "#e8dcc0";
const MARK = "rgb(255 255 255 / 38%)";
/** Width of a cushion, m; where the sights are, behind the noses. */
const CUSHION_WIDTH = 0.045;
const SIGHTS = 0.078;
/** Height of the letter on the frame, m. */
const NORTH = 0.045;
/** Pixels a metre below which details are left out. */
const DETAILED = 150;

/**
 * Draw it on a canvas as large as another.
 * @param {HTMLCanvasElement} ground @param {{width: number, height: number}} like
 * @param {Projection} projection @param {number} density device pixels in a CSS pixel
 */
export function drawTable(ground, { width, height }, projection, density) {
  ground.width = width;
  ground.height = height;
  const context = /** @type {CanvasRenderingContext2D} */ (ground.getContext("2d"));
  context.setTransform(density, 0, 0, density, 0, 0);
  const around = pockets(projection.table);
  const shape = shapeOf(projection.table);
  drawFrame(context, projection);
  if (shape) {
    drawBedWithJaws(context, projection, shape, around, clothColour(context, projection));
  } else {
    drawCushions(context, projection);
    for (const pocket of around) drawHole(context, projection, pocket);
    drawCloth(context, projection, around);
  }
  drawMarks(context, projection);
}

function drawFrame(context, projection) {
  const { width, height, scale, table, frame } = projection;
  const wood = context.createLinearGradient(0, 0, 0, height);
  WOOD.forEach((colour, place) => wood.addColorStop(place / (WOOD.length - 1), colour));
  context.fillStyle = wood;
  roundedRectangle(context, 0, 0, width, height, frame * 0.5 * scale);
  context.strokeStyle = "rgb(255 255 255 / 14%)";
  context.lineWidth = 1;
  context.beginPath();
  context.roundRect(1, 1, width - 2, height - 2, frame * 0.48 * scale);
  context.stroke();
  if (scale < DETAILED) return;
  context.fillStyle = SIGHT;
  for (const [x, y] of sights(table)) disc(context, ...projection.place(x, y), Math.max(1.2, 0.006 * scale));
  drawNorth(context, projection);
}

/** Pockets and cushions are called as on a map: where its north is, between two sights of the head rail. */
function drawNorth(context, projection) {
  const { table, scale } = projection;
  context.font = `700 ${Math.max(9, NORTH * scale)}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText("N", ...projection.place((3 * table.width) / 8, table.length + behindNose(table)));
}

/** How far behind the noses sights are, m. */
function behindNose({ cushion_width, rail_width }) {
  return rail_width === undefined ? SIGHTS : (cushion_width + rail_width) / 2;
}

/** The marks on the frame: quarters of the width, eighths of the length, none at a pocket. */
function sights(table) {
  const { width, length } = table;
  const behind = behindNose(table);
  const ends = [1, 2, 3].flatMap((part) => [-behind, length + behind].map((y) => [(part * width) / 4, y]));
  const sides = [1, 2, 3, 5, 6, 7].flatMap((part) => [-behind, width + behind].map((x) => [x, (part * length) / 8]));
  return [...ends, ...sides];
}

function drawCushions(context, projection) {
  const { width, length } = projection.table;
  context.fillStyle = CUSHION.top;
  box(context, projection, [-CUSHION_WIDTH, -CUSHION_WIDTH], [width + CUSHION_WIDTH, length + CUSHION_WIDTH]);
  context.fillStyle = CUSHION.nose;
  box(context, projection, [-SHADE_WIDTH, -SHADE_WIDTH], [width + SHADE_WIDTH, length + SHADE_WIDTH]);
}

/** Lighter in the middle. @returns {CanvasGradient} */
function clothColour(context, projection) {
  const { width, length } = projection.table;
  const [px, py] = projection.place(width / 2, length / 2);
  const cloth = context.createRadialGradient(px, py, 0, px, py, Math.max(projection.width, projection.height) * 0.6);
  cloth.addColorStop(0, CLOTH.lit);
  cloth.addColorStop(0.55, CLOTH.plain);
  cloth.addColorStop(1, CLOTH.dim);
  return cloth;
}

/** The cloth covers what of the holes is in front of the mouths. */
function drawCloth(context, projection, [southWest, , northWest, northEast, , southEast]) {
  const { width, length } = projection.table;
  context.fillStyle = clothColour(context, projection);
  const outline = [[southWest, 1], [northWest, 1], [northWest, 0], [northEast, 0], [northEast, 1], [southEast, 1], [southEast, 0], [southWest, 0]];
  polygon(context, projection, outline.map(([pocket, end]) => pocket.ends[end]));
  context.save();
  context.clip();
  context.fillStyle = SHADE;
  box(context, projection, [0, 0], [SHADE_WIDTH, length]);
  box(context, projection, [0, length - SHADE_WIDTH], [width, length]);
  context.restore();
}

function drawMarks(context, projection) {
  const { width, length } = projection.table;
  context.strokeStyle = MARK;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(...projection.place(0, 0.75 * length));
  context.lineTo(...projection.place(width, 0.75 * length));
  context.stroke();
  context.fillStyle = MARK;
  disc(context, ...projection.place(width / 2, length / 4), 2);
}

function roundedRectangle(context, x, y, width, height, radius) {
  context.beginPath();
  context.roundRect(x, y, width, height, radius);
  context.fill();
}
