/** Drawing: the table with its pockets, balls, a cue, lines. A canvas shows it; what it shows is handed in each time. */

import { BallPictures, cssColour, isStriped } from "./ball_picture.js";
import { BALL_RADIUS } from "./motion.js";
import { UPRIGHT } from "./orientation.js";
import { FRAME, Projection, pockets } from "./projection.js";

/** @typedef {import("./orientation.js").Quaternion} Quaternion */
/**
 * @typedef {object} Line
 * @property {[number, number][]} points on the table, m
 * @property {string} colour
 * @property {number} [width] CSS pixels @property {number[]} [dash] @property {number} [alpha]
 */
/**
 * @typedef {object} Cue
 * @property {[number, number]} tip on the table, m @property {number} phi deg @property {number} length m, seen from above
 */
/**
 * @typedef {object} Scene
 * @property {Map<number, {position: [number, number], turned?: Quaternion, alpha?: number}>} balls
 * @property {Line[]} [lines] under the balls
 * @property {Line[]} [over] over them
 * @property {Cue | null} [cue]
 * @property {number | null} [calledBall] @property {number | null} [calledPocket]
 * @property {{position: [number, number], legal: boolean} | null} [held] a ball in the hand
 * @property {{x: number[], y: number[]} | null} [area] where it may be put
 * @property {((context: CanvasRenderingContext2D, projection: Projection) => void)} [under]
 */

const CLOTH = "#1d6b52";
const NOSE = "#15523f";
const WOOD = "#4a2f20";
const HOLE = "#0c0c0d";
const MARK = "rgb(255 255 255 / 45%)";
export const CALL = "#ffd84d";
/** How far behind its mouth a pocket's centre lies, and its radius, m. */
const BEHIND = 0.03;
const HOLE_RADIUS = 0.058;

export class TablePicture {
  /**
   * @param {HTMLCanvasElement} canvas @param {Record<string, any>} table
   * @param {{plain?: boolean, lying?: boolean}} [options] plain: discs instead of turned balls, for small pictures
   */
  constructor(canvas, table, { plain = false, lying = false } = {}) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.table = table;
    this.plain = plain;
    this.lying = lying;
    this.pictures = new BallPictures();
    this.ground = document.createElement("canvas");
    this.projection = new Projection(table, 1, 1, lying);
    this.density = 1;
  }

  /** Fit into so many CSS pixels. @param {number} width @param {number} height */
  fit(width, height) {
    const projection = new Projection(this.table, width, height, this.lying);
    const density = Math.min(2, window.devicePixelRatio || 1);
    if (projection.width === this.projection.width && density === this.density && this.canvas.width > 1) return;
    this.projection = projection;
    this.density = density;
    this.canvas.width = Math.max(1, Math.round(projection.width * density));
    this.canvas.height = Math.max(1, Math.round(projection.height * density));
    this.canvas.style.width = `${projection.width}px`;
    this.canvas.style.height = `${projection.height}px`;
    this.drawGround();
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

  drawGround() {
    const { ground, projection, table, density } = this;
    ground.width = this.canvas.width;
    ground.height = this.canvas.height;
    const context = /** @type {CanvasRenderingContext2D} */ (ground.getContext("2d"));
    context.setTransform(density, 0, 0, density, 0, 0);
    context.fillStyle = WOOD;
    roundedRectangle(context, 0, 0, projection.width, projection.height, FRAME * 0.5 * projection.scale);
    const inner = 0.045;
    box(context, projection, -inner, -inner, table.width + inner, table.length + inner, NOSE);
    box(context, projection, 0, 0, table.width, table.length, CLOTH);
    for (const pocket of pockets(table)) this.drawPocket(context, pocket);
    this.drawMarks(context);
  }

  drawPocket(context, { mouth, outward, ends }) {
    const { projection } = this;
    const centre = [mouth[0] + outward[0] * BEHIND, mouth[1] + outward[1] * BEHIND];
    context.fillStyle = HOLE;
    context.beginPath();
    context.arc(...projection.place(centre[0], centre[1]), HOLE_RADIUS * projection.scale, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = CLOTH;
    const inwards = ends.map(([x, y]) => [x - outward[0] * HOLE_RADIUS, y - outward[1] * HOLE_RADIUS]);
    polygon(context, projection, [ends[0], ends[1], inwards[1], inwards[0]]);
  }

  drawMarks(context) {
    const { projection, table } = this;
    context.strokeStyle = MARK;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(...projection.place(0, 0.75 * table.length));
    context.lineTo(...projection.place(table.width, 0.75 * table.length));
    context.stroke();
    context.fillStyle = MARK;
    context.beginPath();
    context.arc(...projection.place(table.width / 2, table.length / 4), 2, 0, 2 * Math.PI);
    context.fill();
  }

  drawArea({ x, y }) {
    box(this.context, this.projection, x[0], y[0], x[1], y[1], "rgb(255 255 255 / 12%)");
  }

  drawCalledPocket(number) {
    const { mouth, outward } = pockets(this.table)[number];
    const { context, projection } = this;
    context.strokeStyle = CALL;
    context.lineWidth = 3;
    context.beginPath();
    const centre = projection.place(mouth[0] + outward[0] * BEHIND, mouth[1] + outward[1] * BEHIND);
    context.arc(...centre, HOLE_RADIUS * projection.scale, 0, 2 * Math.PI);
    context.stroke();
  }

  /** @param {Line} line */
  drawLine({ points, colour, width = 1.5, dash = [], alpha = 1 }) {
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
    context.stroke();
    context.restore();
  }

  drawBall(ball, { position, turned = UPRIGHT, alpha = 1 }) {
    const { context, projection, density } = this;
    const [px, py] = projection.place(position[0], position[1]);
    const radius = BALL_RADIUS * projection.scale;
    context.globalAlpha = alpha;
    if (this.plain) {
      this.drawDisc(ball, px, py, radius);
    } else {
      context.fillStyle = "rgb(0 0 0 / 30%)";
      disc(context, px + radius * 0.18, py + radius * 0.22, radius);
      const picture = this.pictures.picture(ball, turned, radius * density, projection.axes);
      const size = picture.width / density;
      context.drawImage(picture, px - size / 2, py - size / 2, size, size);
    }
    context.globalAlpha = 1;
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

function disc(context, px, py, radius) {
  context.beginPath();
  context.arc(px, py, radius, 0, 2 * Math.PI);
  context.fill();
}

function polygon(context, projection, points) {
  context.beginPath();
  for (const [x, y] of points) context.lineTo(...projection.place(x, y));
  context.closePath();
  context.fill();
}

function box(context, projection, x0, y0, x1, y1, colour) {
  context.fillStyle = colour;
  polygon(context, projection, [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]);
}

function roundedRectangle(context, x, y, width, height, radius) {
  context.beginPath();
  context.roundRect(x, y, width, height, radius);
  context.fill();
}
