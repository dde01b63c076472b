"use strict";
(() => {
  const scenes = JSON.parse(document.getElementById("scenes").textContent);
  const part = (name) => document.getElementById(name);
  const balls = Array.from({ length: 16 }, (_, ball) => part(`ball-${ball}`));
  /** Seconds in which a pocketed ball reaches its hole and is gone. */
  const DROP = 0.15;
  let shown = 0;
  let time = 0;
  let playing = false;
  let before = 0;

  /** The Bezier curve of one piece: exact, since a ball between two events has a constant acceleration. */
  function along([begins, ends, x0, y0, x1, y1, x2, y2], at) {
    const share = ends > begins ? Math.min(1, Math.max(0, (at - begins) / (ends - begins))) : 0;
    const rest = 1 - share;
    const mixed = (a, b, c) => rest * rest * a + 2 * rest * share * b + share * share * c;
    return [mixed(x0, x1, x2), mixed(y0, y1, y2)];
  }

  function place({ pieces, drops }, at) {
    if (drops && at >= drops[0]) {
      const gone = (at - drops[0]) / DROP;
      if (gone >= 1) return null;
      const [x, y] = along(pieces[pieces.length - 1], drops[0]);
      return [x + gone * (drops[1] - x), y + gone * (drops[2] - y), 1 - gone];
    }
    const piece = pieces.findLast((one) => one[0] <= at) || pieces[0];
    return [...along(piece, at), 1];
  }

  function draw() {
    const scene = scenes[shown];
    balls.forEach((ball, number) => {
      const track = scene.balls[number];
      const at = track ? place(track, time) : null;
      ball.toggleAttribute("hidden", at === null);
      if (!at) return;
      ball.setAttribute("transform", `translate(${at[0]} ${at[1]})`);
      ball.setAttribute("opacity", String(at[2]));
    });
    part("time").max = String(scene.duration);
    part("time").value = String(time);
    part("clock").textContent = `${time.toFixed(2)} of ${scene.duration.toFixed(2)} s`;
    const which = scenes.length > 1 ? `${shown + 1} of ${scenes.length}` : "";
    part("caption").textContent = [which, scene.caption].filter(Boolean).join(": ");
    part("play").textContent = playing ? "Pause" : "Play";
    part("back").disabled = shown === 0;
    part("on").disabled = shown === scenes.length - 1;
  }

  function show(scene) {
    shown = Math.min(scenes.length - 1, Math.max(0, scene));
    time = 0;
    draw();
  }

  function step(now) {
    if (!playing) return;
    time += (Math.min(100, now - before) / 1000) * Number(part("speed").value);
    before = now;
    if (time >= scenes[shown].duration + DROP) {
      if (shown < scenes.length - 1) show(shown + 1);
      else [time, playing] = [scenes[shown].duration, false];
    }
    time = Math.min(time, scenes[shown].duration + DROP);
    draw();
    requestAnimationFrame(step);
  }

  function toggle() {
    playing = !playing;
    if (playing && time >= scenes[shown].duration) time = 0;
    before = performance.now();
    draw();
    if (playing) requestAnimationFrame(step);
  }

  part("play").onclick = toggle;
  part("back").onclick = () => show(shown - 1);
  part("on").onclick = () => show(shown + 1);
  part("time").oninput = () => {
    playing = false;
    time = Number(part("time").value);
    draw();
  };
  document.addEventListener("keydown", (event) => {
    if (event.target !== document.body) return;
    const does = { " ": toggle, ArrowLeft: () => show(shown - 1), ArrowRight: () => show(shown + 1) }[event.key];
    if (!does) return;
    event.preventDefault();
    does();
  });
  draw();
})();
