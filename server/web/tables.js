/**
 * Tables as the server describes them: names, parameters, and of those with jaws every line and arc. The named ones
 * are part of the script, see `server/routes/page.py`: a table is drawn at once.
 */

import { call } from "./api.js";
import { NAMED } from "./named_tables.js";

/** @typedef {[number, number]} Point */
/**
 * @typedef {object} Jaw
 * @property {Point} tip @property {Point} nose_end @property {Point} horn_centre @property {number} horn_radius
 * @property {Point} facing_start @property {Point} facing_end @property {Point} facing_normal
 */
/**
 * @typedef {object} Description as `GET /v1/tables/{name}` answers
 * @property {Record<string, any>} table @property {number} contact_distance
 * @property {{cushion: number, ends: [Point, Point]}[]} noses
 * @property {{mouth: [Point, Point], jaws: Jaw[], hole_centre: Point, hole_radius: number}[]} pockets
 */

/** What the lines depend on, beside the name. */
const SHAPING = [
  "corner_mouth", "side_mouth", "corner_cut", "side_cut", "corner_shelf", "side_shelf", "corner_hole_radius",
  "side_hole_radius", "horn_radius", "cushion_width", "rail_width", "nose_height",
];
const NAMES = { olympiad: "Olympiad", fastfiz: "FastFiz", nine_foot: "nine-foot", eight_foot: "eight-foot", seven_foot: "seven-foot" };

/** @type {Map<string, Description>} of tables with a shape of their own, by that */
const others = new Map();

/** The names there are. */
export function tableNames() {
  return Object.keys(NAMED);
}

/** Every parameter of a named table. @param {string} name @returns {Record<string, any>} */
export function namedTable(name) {
  return NAMED[name].table;
}

/** A table by its name, as text. @param {string} name */
export function tableTitle(name) {
  return `${NAMES[name] ?? name} table`;
}

/**
 * A table in words: its name, and whether something is otherwise than there.
 * @param {string | Record<string, any>} table a name, or parameters
 */
export function describeTable(table) {
  if (typeof table === "string") return tableTitle(table);
  const usual = NAMED[table.name]?.table ?? table;
  const own = Object.keys(table).filter((key) => key in usual && table[key] !== usual[key]);
  return tableTitle(table.name) + (own.length ? `, own ${own.map((key) => key.replaceAll("_", " ")).join(", ")}` : "");
}

/** Whether a table is exactly the one of its name. @param {Record<string, any>} table */
export function isNamed(table) {
  const usual = NAMED[table.name]?.table;
  return Boolean(usual) && Object.keys(usual).every((key) => usual[key] === table[key]);
}

/** @param {Record<string, any>} table */
export function hasJaws(table) {
  return table.horn_radius !== undefined;
}

/** Where everything of a table with jaws is; null without jaws, or as long as it is not known. @param {Record<string, any>} table */
export function shapeOf(table) {
  if (!hasJaws(table)) return null;
  const usual = NAMED[table.name];
  if (usual && SHAPING.every((key) => usual.table[key] === table[key])) return usual;
  return others.get(keyOf(table)) ?? null;
}

/** Ask the server for a shape that is not known yet. @param {Record<string, any>} table @returns {Promise<Description | null>} */
export async function askShape(table) {
  if (!hasJaws(table) || shapeOf(table)) return shapeOf(table);
  const found = await call("POST", "/v1/tables", { body: { table } }).catch(() => null);
  if (found) others.set(keyOf(table), found);
  return found;
}

function keyOf(table) {
  return JSON.stringify(["name", ...SHAPING].map((key) => table[key]));
}

/** How near to a nose a ball's centre comes, m. @param {Record<string, any>} table @param {number} radius of a ball */
export function contactDistance(table, radius) {
  return shapeOf(table)?.contact_distance ?? radius;
}
