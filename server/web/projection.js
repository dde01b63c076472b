/** The table to scale on a canvas, upright or lying, never mirrored. */

import { shapeOf } from "./tables.js";

/** Width of the frame around the cushion noses of a table that does not say it, m. */
const FRAME = 0.11;
/** Of a straight mouth: how far behind it the hole's centre is drawn, and the hole's radius, m. */
const BEHIND = 0.03;
const HOLE_RADIUS = 0.058;

export class Projection {
  /**
   * @param {Record<string, any>} table @param {number} width CSS pixels to fit into @param {number} height
   * @param {boolean} lying whether the head string is on the left instead of at the top
   */
  constructor(table, width, height, lying) {
    this.table = table;
    this.lying = lying;
    this.frame = table.rail_width ?? FRAME;
    const across = (lying ? table.length : table.width) + 2 * this.frame;
    const up = (lying ? table.width : table.length) + 2 * this.frame;
    this.scale = Math.min(width / across, height / up);
    this.width = across * this.scale;
    this.height = up * this.scale;
  }

  /** A place on the table in CSS pixels. @param {number} x @param {number} y @returns {[number, number]} */
  place(x, y) {
    const { table, scale, frame } = this;
    if (this.lying) return [(frame + table.length - y) * scale, (frame + table.width - x) * scale];
    return [(frame + x) * scale, (frame + table.length - y) * scale];
  }

  /** The place on the table under a pixel. @param {number} px @param {number} py @returns {[number, number]} */
  unplace(px, py) {
    const { table, scale, frame } = this;
    if (this.lying) return [frame + table.width - py / scale, frame + table.length - px / scale];
    return [px / scale - frame, frame + table.length - py / scale];
  }

  /** The direction of the table that shows to the right and the one that shows upwards. */
  get axes() {
    return this.lying ? { right: [0, -1], up: [1, 0] } : { right: [1, 0], up: [0, 1] };
  }
}

/**
 * @typedef {object} PocketPlace
 * @property {[number, number]} mouth the middle of the mouth's line @property {[number, number][]} ends of this line
 * @property {[number, number]} hole its middle @property {number} radius of the hole
 */

/** The pockets SW W NW NE E SE. @param {Record<string, any>} table @returns {PocketPlace[]} */
export function pockets(table) {
  const shape = shapeOf(table);
  if (!shape) return straightPockets(table).map((pocket) => ({ ...pocket, hole: behind(pocket), radius: HOLE_RADIUS }));
  return shape.pockets.map(({ mouth: [one, two], hole_centre, hole_radius }) => ({
    mouth: [(one[0] + two[0]) / 2, (one[1] + two[1]) / 2], ends: [one, two], hole: hole_centre, radius: hole_radius,
  }));
}

/** @returns {[number, number]} */
function behind({ mouth, outward }) {
  return [mouth[0] + outward[0] * BEHIND, mouth[1] + outward[1] * BEHIND];
}

function straightPockets(table) {
  const { width, length } = table;
  const reach = table.corner_mouth / Math.SQRT2;
  const half = table.side_mouth / 2;
  const middle = length / 2;
  const corner = (x, y) => {
    const inwardX = x === 0 ? 1 : -1;
    const inwardY = y === 0 ? 1 : -1;
    return {
      mouth: [x + (inwardX * reach) / 2, y + (inwardY * reach) / 2],
      outward: [-inwardX * Math.SQRT1_2, -inwardY * Math.SQRT1_2],
      ends: [[x + inwardX * reach, y], [x, y + inwardY * reach]],
    };
  };
  const side = (x) => ({
    mouth: [x, middle],
    outward: [x === 0 ? -1 : 1, 0],
    ends: [[x, middle - half], [x, middle + half]],
  });
  return [corner(0, 0), side(0), corner(0, length), corner(width, length), side(width), corner(width, 0)];
}
