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

/**
 * The address of the laboratory with a position and a shot in it.
 * @param {string} table its name @param {Balls} balls @param {Shot} [shot]
 * @param {boolean} [lowest] the cue stays as low as it can be
 */
export function labAddress(table, balls, shot, lowest = false) {
  const aim = shot ? `&shot=${[shot.v, shot.phi, shot.theta, shot.a, shot.b].join(",")}${lowest ? "&lowest" : ""}` : "";
  return `#/lab?table=${encodeURIComponent(table)}&balls=${notation(balls).replaceAll(" ", "+")}${aim}`;
}

/**
 * What an address of the laboratory says.
 * @param {string} query @returns {{table: string | null, balls: Balls | null, shot: Shot | null, rack: number | null, lowest: boolean}} @throws {Error} in words
 */
export function readAddress(query) {
  const asked = new URLSearchParams(query);
  const shot = asked.get("shot")?.split(",").map(Number);
  if (shot && !(shot.length === 5 && shot.every(Number.isFinite))) throw new Error("The address has no shot: five numbers v,phi,theta,a,b.");
  const [v, phi, theta, a, b] = shot ?? [];
  const rack = asked.get("rack");
  if (rack !== null && !/^\d$/.test(rack)) throw new Error("The address has no rack: a number from 0 to 9.");
  return {
    table: asked.get("table"), balls: asked.has("balls") ? readNotation(asked.get("balls") ?? "") : null,
    shot: shot ? { v, phi, theta, a, b } : null, lowest: asked.has("lowest"), rack: rack === null ? null : Number(rack),
  };
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
