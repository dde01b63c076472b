/** Drawing: the table with its pockets, balls, a cue, lines. A canvas shows it; what it shows is handed in each time. */

import { BallPictures, cssColour, isStriped } from "./ball_picture.js";
import { box, disc } from "./brushes.js";
import { drawPlaces } from "./jaw_ground.js";
import { BALL_RADIUS } from "./motion.js";
import { UPRIGHT } from "./orientation.js";
import { Projection, pockets } from "./projection.js";
import { drawTable } from "./table_ground.js";
import { askShape, shapeOf } from "./tables.js";

/** @typedef {import("./orientation.js").Quaternion} Quaternion */
/**
 * @typedef {object} Line
 * @property {[number, number][]} points on the table, m
 * @property {string} colour
 * @property {number} [width] CSS pixels @property {number[]} [dash] @property {number} [alpha]
 * @property {boolean} [filled] the area within it as well
 */
/**
 * @typedef {object} Cue
 * @property {[number, number]} tip on the table, m @property {number} phi deg @property {number} length m, seen from above
 */
/**
 * @typedef {object} Scene
 * @property {Map<number, {position: [number, number], height?: number, turned?: Quaternion, alpha?: number}>} balls height: m,
 *   over where it rests on the cloth
 * @property {Line[]} [lines] under the balls
 * @property {Line[]} [over] over them
 * @property {Cue | null} [cue]
 * @property {number | null} [calledBall] @property {number | null} [calledPocket]
 * @property {{position: [number, number], legal: boolean} | null} [held] a ball in the hand
 * @property {{name: string, x: number[], y: number[]} | null} [area] where it may be put
 * @property {((context: CanvasRenderingContext2D, projection: Projection) => void)} [under]
 */

const CALL = "#ffd84d";
/** How much lighter the cloth is where a ball in hand may lie. */
const IN_HAND = 0.12;
/** Least radius of a ball in a small picture, CSS pixels: below it colours are not told apart. */
const LEAST_DISC = 3.2;
/** m over the cloth, the eye: what is nearer to it is seen larger. */
const EYE = 2;
/** How far a shadow falls aside for each metre of height, by the light of ball_picture.js. */
const SHADOW_RIGHT = 0.42;
const SHADOW_DOWN = 0.5;

export class TablePicture {
  /**
   * @param {HTMLCanvasElement} canvas @param {Record<string, any>} table
   * @param {{plain?: boolean, lying?: boolean, changed?: () => void}} [options] plain: discs instead of turned balls,
   *   for small pictures; changed: called when the table is to be drawn again, because its shape has become known
   */
  constructor(canvas, table, { plain = false, lying = false, changed = () => {} } = {}) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.table = table;
    this.plain = plain;
    this.lying = lying;
    this.pictures = new BallPictures();
    this.ground = document.createElement("canvas");
    this.projection = new Projection(table, 1, 1, lying);
    this.density = 1;
    /** Where a ball in hand may lie on a table with jaws, drawn once. @type {{canvas: HTMLCanvasElement, key: string}} */
    this.places = { canvas: document.createElement("canvas"), key: "" };
    if (!shapeOf(table)) askShape(table).then((shape) => shape && this.reshape(changed));
  }

  /** The shape is known now. */
  reshape(changed) {
    if (this.canvas.width > 1) drawTable(this.ground, this.canvas, this.projection, this.density);
    changed();
  }

  /** Fit into so many CSS pixels. @param {number} width @param {number} height */
  fit(width, height) {
    const projection = new Projection(this.table, width, height, this.lying);
    const density = Math.min(2, window.devicePixelRatio || 1);
    const same = projection.lying === this.projection.lying && projection.width === this.projection.width;
    if (same && density === this.density && this.canvas.width > 1) return;
    this.projection = projection;
    this.density = density;
    this.canvas.width = Math.max(1, Math.round(projection.width * density));
    this.canvas.height = Math.max(1, Math.round(projection.height * density));
    this.canvas.style.width = `${projection.width}px`;
    this.canvas.style.height = `${projection.height}px`;
    drawTable(this.ground, this.canvas, projection, density);
  }

  /** @param {Scene} scene */
  draw(scene) {
    const { context, projection, density } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.ground, 0, 0);
    context.setTransform(density, 0, 0, density, 0, 0);
    if (scene.area) this.drawArea(scene.area);
    if (scene.under) scene.under(context, projection);
    if (scene.calledPocket !== null && scene.calledPocket !== undefined) this.drawCalledPocket(scene.calledPocket);
    for (const line of scene.lines || []) this.drawLine(line);
    for (const [ball, shown] of scene.balls) this.drawBall(ball, shown);
    if (scene.calledBall !== null && scene.calledBall !== undefined) this.drawRing(scene.balls.get(scene.calledBall));
    if (scene.held) this.drawHeld(scene.held);
    for (const line of scene.over || []) this.drawLine(line);
    if (scene.cue) this.drawCue(scene.cue);
  }

  drawArea(area) {
    const { context, projection, table } = this;
    const shape = shapeOf(table);
    context.globalAlpha = IN_HAND;
    context.fillStyle = "#ffffff";
    if (shape) context.drawImage(this.placesWithJaws(shape, area), 0, 0, projection.width, projection.height);
    else box(context, projection, [area.x[0], area.y[0]], [area.x[1], area.y[1]]);
    context.globalAlpha = 1;
  }

  placesWithJaws(shape, area) {
    const { canvas } = this.places;
    const { width, height } = this.canvas;
    const key = `${width} ${height} ${this.projection.lying} ${area.name}`;
    if (this.places.key === key) return canvas;
    this.places.key = key;
    [canvas.width, canvas.height] = [width, height];
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    context.setTransform(this.density, 0, 0, this.density, 0, 0);
    drawPlaces(context, this.projection, shape, area, area.name !== "kitchen");
    return canvas;
  }

  drawCalledPocket(number) {
    const { hole, radius } = pockets(this.table)[number];
    const { context, projection } = this;
    context.strokeStyle = CALL;
    context.lineWidth = 3;
    context.beginPath();
    context.arc(...projection.place(...hole), radius * projection.scale, 0, 2 * Math.PI);
    context.stroke();
  }

  /** @param {Line} line */
  drawLine({ points, colour, width = 1.5, dash = [], alpha = 1, filled = false }) {
    if (points.length < 2) return;
    const { context, projection } = this;
    context.save();
    context.globalAlpha = alpha;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    points.forEach(([x, y], place) => {
      if (place === 0) context.moveTo(...projection.place(x, y));
      else context.lineTo(...projection.place(x, y));
    });
    context.fillStyle = colour;
    if (filled) context.fill();
    context.stroke();
    context.restore();
  }

  drawBall(ball, { position, height = 0, turned = UPRIGHT, alpha = 1 }) {
    const { context, projection, density } = this;
    const [px, py] = projection.place(position[0], position[1]);
    const radius = (BALL_RADIUS * projection.scale * EYE) / (EYE - Math.min(height, EYE / 2));
    context.globalAlpha = alpha;
    if (this.plain) {
      this.drawDisc(ball, px, py, Math.max(LEAST_DISC, radius));
    } else {
      this.drawShadow(px + SHADOW_RIGHT * height * projection.scale, py + SHADOW_DOWN * height * projection.scale);
      const picture = this.pictures.picture(ball, turned, radius * density, projection.axes);
      const size = picture.width / density;
      context.drawImage(picture, px - size / 2, py - size / 2, size, size);
    }
    context.globalAlpha = 1;
  }

  /** What a ball at a place of the picture shades. @param {number} px @param {number} py */
  drawShadow(px, py) {
    const { context, projection } = this;
    const radius = BALL_RADIUS * projection.scale;
    context.fillStyle = "rgb(0 0 0 / 16%)";
    disc(context, px + radius * 0.3, py + radius * 0.36, radius * 1.08);
    disc(context, px + radius * 0.16, py + radius * 0.2, radius);
  }

  /** A small ball: a disc of its colour, a stripe as a ring of white. */
  drawDisc(ball, px, py, radius) {
    const { context } = this;
    context.fillStyle = isStriped(ball) ? "#f4f0e4" : cssColour(ball);
    disc(context, px, py, radius);
    if (!isStriped(ball)) return;
    context.fillStyle = cssColour(ball);
    disc(context, px, py, radius * 0.62);
  }

  drawRing(shown) {
    if (!shown) return;
    const { context, projection } = this;
    context.strokeStyle = CALL;
    context.lineWidth = 2;
    context.beginPath();
    context.arc(...projection.place(shown.position[0], shown.position[1]), BALL_RADIUS * projection.scale + 3, 0, 2 * Math.PI);
    context.stroke();
  }

  drawHeld({ position, legal }) {
    const { context, projection } = this;
    context.strokeStyle = legal ? "#7dff9b" : "#ff6b5e";
    context.lineWidth = 3;
    context.setLineDash(legal ? [] : [4, 3]);
    context.beginPath();
    context.arc(...projection.place(position[0], position[1]), BALL_RADIUS * projection.scale + 4, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
  }

  /** @param {Cue} cue */
  drawCue({ tip, phi, length }) {
    const { context, projection } = this;
    const angle = (phi * Math.PI) / 180;
    const end = [tip[0] - length * Math.cos(angle), tip[1] - length * Math.sin(angle)];
    for (const [colour, width, from, to] of /** @type {[string, number, number, number][]} */ ([
      ["#d9b27c", 3.4, 0, 1], ["#3b2618", 4.4, 0.55, 1], ["#6fb7e8", 3.4, 0, 0.012],
    ])) {
      context.strokeStyle = colour;
      context.lineWidth = Math.max(1.5, (width * projection.scale) / 280);
      context.beginPath();
      for (const part of [from, to]) {
        const at = projection.place(tip[0] + (end[0] - tip[0]) * part, tip[1] + (end[1] - tip[1]) * part);
        if (part === from) context.moveTo(...at);
        else context.lineTo(...at);
      }
      context.stroke();
    }
  }
}
