// Describes the cursor in words.
function showCursor(element, cursor, meshes, channel) {
  const at = cursor.at;
  element.hidden = !at;
  if (!at) return;
  const lines = [["Point", pointText(at.place.point)]];
  if (at.image) {
    lines.push(["Image", pointText(at.image.point)]);
    lines.push(["Distance", shortNumber(distance(at.place.point, at.image.point))]);
  }
  const value = Channels.valueAt(channel, meshes[at.side], at.place);
  if (value) lines.push([channel.title, value]);
  if (at.reason) lines.push(["", at.reason]);
  element.replaceChildren(...lines.map(([title, text]) => {
    const line = document.createElement("div"), bold = document.createElement("b");
    bold.textContent = title;
    line.append(bold, " " + text);
    return line;
  }));
}
