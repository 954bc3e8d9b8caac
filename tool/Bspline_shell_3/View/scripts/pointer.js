// Mouse and touch: turn, move, zoom, and point.
function listenToPointer(canvas, { orbit, views, cursor, changed }) {
  const pressed = new Map(); // positions of the pressed mouse button and of fingers
  const sharpestClick = 4; // pixels by which the pointer may move during a click
  let moved = 0;

  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pressed.set(event.pointerId, [event.clientX, event.clientY]);
    if (pressed.size === 1) moved = 0;
    canvas.focus();
  });
  canvas.addEventListener("pointermove", event => {
    const before = pressed.get(event.pointerId), now = [event.clientX, event.clientY];
    if (!before) {
      if (!cursor.isFixed) point(event);
      return;
    }
    const height = views.rectangle(0).height, dx = now[0] - before[0], dy = now[1] - before[1];
    moved += Math.abs(dx) + Math.abs(dy);
    if (pressed.size === 1) {
      if (event.shiftKey || event.buttons & 6) orbit.move(-dx / height, dy / height);
      else orbit.turn(3 * dx / height, 3 * dy / height);
    } else {
      const [other] = [...pressed].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
      const span = p => Math.hypot(p[0] - other[0], p[1] - other[1]);
      orbit.zoom(span(now) / Math.max(span(before), 1));
      orbit.move(-dx / height / 2, dy / height / 2);
    }
    pressed.set(event.pointerId, now);
    views.move();
  });
  for (const name of ["pointerup", "pointercancel"])
    canvas.addEventListener(name, event => {
      if (name === "pointerup" && pressed.size === 1 && moved <= sharpestClick) {
        point(event);
        cursor.isFixed = Boolean(cursor.at);
      }
      pressed.delete(event.pointerId);
    });
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    orbit.zoom(Math.exp(-event.deltaY / 500));
    views.move();
  }, { passive: false });
  canvas.addEventListener("dblclick", event => {
    point(event);
    focusOnCursor(orbit, cursor);
    views.redraw();
  });
  canvas.addEventListener("contextmenu", event => event.preventDefault());

  function point(event) {
    cursor.pick(views.lineOfSight(event.clientX, event.clientY));
    changed();
  }
}
