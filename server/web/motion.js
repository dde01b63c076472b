/**
 * One ball between two events: the closed forms (5) to (9) and (43) of docs/physics.md.
 *
 * Metres, seconds, radians per second; x and y along the cloth, z up.
 */

export const BALL_RADIUS = 0.028575;
export const GRAVITY = 9.81;

/**
 * @typedef {object} BallState
 * @property {[number, number]} position
 * @property {[number, number]} velocity
 * @property {[number, number, number]} spin
 * @property {string} motion stationary, spinning, sliding, rolling or flying; pocketed, absent or driven_off
 * @property {number} [height] of the centre above where it rests on the cloth; none on tables where nothing flies
 * @property {number} [velocity_z] upwards
 */

/**
 * @typedef {object} Cloth
 * @property {number} slide deceleration of a sliding ball, m/s²
 * @property {number} roll of a rolling ball, m/s²
 * @property {number} spin of the spin about the vertical, rad/s²
 * @property {number} spinSliding the same while the ball slides
 */

/**
 * The cloth's decelerations on a table.
 * @param {Record<string, any>} table its parameters, as views and records carry them
 * @returns {Cloth}
 */
export function clothOf(table) {
  const spin = (5 * table.mu_spin * GRAVITY) / (2 * BALL_RADIUS);
  const spinSliding = table.collisions === "fastfiz" ? spin / 4 : spin;
  return { slide: table.mu_slide * GRAVITY, roll: table.mu_roll * GRAVITY, spin, spinSliding };
}

/** @param {BallState} state @returns {boolean} whether it is on the table */
export function isOnTable(state) {
  return state.motion !== "pocketed" && state.motion !== "absent" && state.motion !== "driven_off";
}

/** In the air: straight in plan, a parabola upwards, the spin as it is. @param {BallState} state @param {number} dt @returns {BallState} */
function fly(state, dt) {
  const { position: [x, y], velocity: [vx, vy], height = 0, velocity_z = 0 } = state;
  return {
    ...state,
    position: [x + dt * vx, y + dt * vy],
    height: Math.max(height + dt * (velocity_z - dt * (GRAVITY / 2)), 0),
    velocity_z: velocity_z - GRAVITY * dt,
  };
}

/**
 * Half the acceleration: the slip's direction, or that of the velocity, against it.
 * @param {Cloth} cloth @param {BallState} state @returns {[number, number]}
 */
function halfAcceleration(cloth, state) {
  const [vx, vy] = state.velocity;
  if (state.motion === "sliding") {
    const ux = vx - BALL_RADIUS * state.spin[1];
    const uy = vy + BALL_RADIUS * state.spin[0];
    return scaled(ux, uy, cloth.slide);
  }
  return state.motion === "rolling" ? scaled(vx, vy, cloth.roll) : [0, 0];
}

/** @param {number} x @param {number} y @param {number} deceleration @returns {[number, number]} */
function scaled(x, y, deceleration) {
  const size = Math.sqrt(x * x + y * y);
  return size === 0 ? [0, 0] : [(-0.5 * deceleration * x) / size, (-0.5 * deceleration * y) / size];
}

/** Spin about the vertical: it falls at a rate and stops at 0. @param {number} spin @param {number} loss */
function decayed(spin, loss) {
  if (spin > loss) return spin - loss;
  return spin < -loss ? spin + loss : 0;
}

/**
 * Where a ball is `dt` seconds later, nothing having happened to it.
 * @param {Cloth} cloth @param {BallState} state @param {number} dt @returns {BallState}
 */
export function advance(cloth, state, dt) {
  if (dt === 0 || state.motion === "stationary" || !isOnTable(state)) return state;
  if (state.motion === "flying") return fly(state, dt);
  const [wx, wy, wz] = state.spin;
  if (state.motion === "spinning") return { ...state, spin: [wx, wy, decayed(wz, cloth.spin * dt)] };
  const [hx, hy] = halfAcceleration(cloth, state);
  const [x, y] = state.position;
  const [vx, vy] = state.velocity;
  /** @type {[number, number]} */
  const velocity = [vx + 2 * hx * dt, vy + 2 * hy * dt];
  const turn = (5 * dt) / BALL_RADIUS;
  return {
    position: [x + dt * (vx + dt * hx), y + dt * (vy + dt * hy)],
    velocity,
    spin:
      state.motion === "sliding"
        ? [wx + turn * hy, wy - turn * hx, decayed(wz, cloth.spinSliding * dt)]
        : [-velocity[1] / BALL_RADIUS, velocity[0] / BALL_RADIUS, decayed(wz, cloth.spin * dt)],
    motion: state.motion,
  };
}
