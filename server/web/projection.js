/** The table to scale on a canvas, upright or lying, never mirrored. */

/** Width of the frame around the cushion noses, m. */
export const FRAME = 0.11;

export class Projection {
  /**
   * @param {Record<string, any>} table @param {number} width CSS pixels to fit into @param {number} height
   * @param {boolean} lying whether the head string is on the left instead of at the top
   */
  constructor(table, width, height, lying) {
    this.table = table;
    this.lying = lying;
    const across = (lying ? table.length : table.width) + 2 * FRAME;
    const up = (lying ? table.width : table.length) + 2 * FRAME;
    this.scale = Math.min(width / across, height / up);
    this.width = across * this.scale;
    this.height = up * this.scale;
  }

  /** A place on the table in CSS pixels. @param {number} x @param {number} y @returns {[number, number]} */
  place(x, y) {
    const { table, scale } = this;
    if (this.lying) return [(FRAME + table.length - y) * scale, (FRAME + table.width - x) * scale];
    return [(FRAME + x) * scale, (FRAME + table.length - y) * scale];
  }

  /** The place on the table under a pixel. @param {number} px @param {number} py @returns {[number, number]} */
  unplace(px, py) {
    const { table, scale } = this;
    if (this.lying) return [FRAME + table.width - py / scale, FRAME + table.length - px / scale];
    return [px / scale - FRAME, FRAME + table.length - py / scale];
  }

  /** The direction of the table that shows to the right and the one that shows upwards. */
  get axes() {
    return this.lying ? { right: [0, -1], up: [1, 0] } : { right: [1, 0], up: [0, 1] };
  }
}

/**
 * The pockets: centre of the mouth, direction outwards, the mouth's two ends.
 * @param {Record<string, any>} table
 */
export function pockets(table) {
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
