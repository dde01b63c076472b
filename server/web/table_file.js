/** A table file as `pooliad calibrate --out` writes it: TOML, the name of a table and the parameters that differ. */

import { call } from "./api.js";

const LINE = /^([a-z_]+)\s*=\s*(?:"([a-z_]*)"|'([a-z_]*)'|(true|false)|([+-]?\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][+-]?\d+)?))\s*(?:#.*)?$/;
/** What is wrong with a file, in words. */
export class TableFileError extends Error {}

/** Bytes; a table has some thirty numbers. */
const LARGEST = 65536;

/**
 * The table of a file, every parameter of it, as the server has it.
 * @param {File} file @returns {Promise<Record<string, any>>}
 * @throws {TableFileError | import("./api.js").ProblemError} when it is none, or no table can be so
 */
export async function readTableFile(file) {
  if (file.size > LARGEST) throw new TableFileError(`${file.name}: must be a table file of at most ${LARGEST} bytes.`);
  const { table } = await call("POST", "/v1/tables", { body: { table: valuesOf(await file.text(), file.name) } });
  return table;
}

/**
 * Names and values of its lines.
 * @param {string} text @param {string} name of the file, for what is said of it
 */
export function valuesOf(text, name) {
  /** @type {Record<string, string | number | boolean>} */
  const values = Object.create(null); // where no name stands from the start: not `constructor` either
  for (const [place, line] of text.split(/\r?\n/).map((one) => one.trim()).entries()) {
    if (!line || line.startsWith("#")) continue;
    const found = LINE.exec(line);
    const fault = found ? found[1] in values && `${found[1]} stands there twice` : "must be name = value, as in mu_slide = 0.21";
    if (fault) throw new TableFileError(`${name}, line ${place + 1}: ${fault}.`);
    const [, key, quoted, alsoQuoted, flag, digits] = /** @type {RegExpExecArray} */ (found);
    values[key] = quoted ?? alsoQuoted ?? (flag ? flag === "true" : Number(digits.replaceAll("_", "")));
  }
  return values;
}
