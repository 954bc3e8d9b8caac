// The places where the proof fails, on the meshes and as a list of sentences.
function showPlaces(list, views, orbit) {
  if (!hasData("places")) return;
  const points = arrayOf("places"), most = 200; // more buttons would make the page slow
  const geometry = pointsGeometry(points), material = discMaterial(0xd0102c, 9);
  for (const scene of views.scenes) scene.add(new THREE.Points(geometry, material));
  const messages = linesOf("places.messages"), nearby = 0.1; // part of the whole that is shown around a place
  const title = points.length / 3 + " places where the proof fails";
  list.append(textElement("h2", title), ...messages.slice(0, most).map((message, n) => {
    const button = textElement("button", message);
    button.addEventListener("click", () => {
      orbit.focus(pointAt(points, n), nearby * orbit.radius);
      views.redraw();
    });
    return button;
  }));
  if (messages.length > most) list.append(textElement("p", "and " + (messages.length - most) + " more, drawn in the picture"));
  list.hidden = false;
}
