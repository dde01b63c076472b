/** A position and a shot as text: the one-line notation, Python, JSON, curl. */

/** @typedef {import("./trace.js").Balls} Balls */
/** @typedef {import("./shot_form.js").Shot} Shot */

/** `0:0.5,1.7 3:0.4,0.6`, as `client.notation` reads it. @param {Balls} balls */
export function notation(balls) {
  return Object.entries(balls).map(([ball, [x, y]]) => `${ball}:${x},${y}`).join(" ");
}

/** @param {string} text @returns {Balls} @throws {Error} in words */
export function readNotation(text) {
  /** @type {Balls} */
  const balls = {};
  for (const word of text.split(/\s+/).filter(Boolean)) {
    const parts = /^(\d{1,2}):(-?[\d.eE+-]+),(-?[\d.eE+-]+)$/.exec(word);
    if (!parts || Number(parts[1]) > 15) throw new Error(`“${word}” is no ball; balls are written like 3:0.4,0.6`);
    const place = [Number(parts[2]), Number(parts[3])];
    if (!place.every(Number.isFinite)) throw new Error(`“${word}” has no place; balls are written like 3:0.4,0.6`);
    balls[Number(parts[1])] = /** @type {[number, number]} */ (place);
  }
  return balls;
}

/** @param {Balls} balls @param {Shot} shot @param {string} table its name */
export function asJson(balls, shot, table) {
  return JSON.stringify({ table, balls, shot, trace: true });
}

/** @param {Balls} balls @param {Shot} shot @param {string} table its name */
export function asPython(balls, shot, table) {
  const places = Object.entries(balls).map(([ball, [x, y]]) => `${ball}: (${x}, ${y})`).join(", ");
  const { v, phi, theta, a, b } = shot;
  return [
    "import physics",
    "",
    `table = physics.Table.${table}()`,
    `state = physics.TableState.from_positions({${places}})`,
    `shot = physics.Shot(v=${v}, phi=${phi}, theta=${theta}, a=${a}, b=${b})`,
    "result = physics.simulate(table, state, shot)",
    "print(result.status.name, result.duration, result.final.to_dict())",
  ].join("\n");
}

/** @param {Balls} balls @param {Shot} shot @param {string} table its name @param {string} origin */
export function asCurl(balls, shot, table, origin) {
  return [
    `curl -sS --fail-with-body -X POST "${origin}/v1/simulate" \\`,
    '  -H "Authorization: Bearer $TOKEN" -H "Content-Type: application/json" \\',
    `  -d '${asJson(balls, shot, table)}'`,
  ].join("\n");
}
