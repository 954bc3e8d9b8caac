// Explains the colors.
function showLegend(element, channel, section, surfaces) {
  element.replaceChildren(...colorLegend(channel), ...lineLegend(section, surfaces));
  element.hidden = element.childElementCount === 0;
}

function colorLegend(channel) {
  if (!channel.blocks) return [];
  const title = textElement("div", channel.title);
  if (channel.hasLabels) return [title, ...labelLegend(channel)];
  const [low, high] = Channels.range(channel);
  const bar = document.createElement("div"), numbers = document.createElement("div");
  bar.className = "bar";
  const stops = Array.from({ length: 17 }, (_, n) => colorText(scaleColor(n / 16)));
  bar.style.background = "linear-gradient(to right," + stops + ")";
  numbers.className = "numbers";
  numbers.append(...[low, (low + high) / 2, high].map(x => textElement("span", shortNumber(x))));
  return [title, bar, numbers, textElement("div", "interpolated between vertices")];
}

function labelLegend(channel) {
  const most = 12, labels = new Set();
  for (const name of channel.blocks.filter(Boolean)) for (const x of arrayOf(name)) if (isFinite(x)) labels.add(x);
  const sorted = [...labels].sort((a, b) => a - b);
  const lines = sorted.slice(0, most).map(label => colorLine(colorText(labelColor(label)), Channels.labelText(channel, label)));
  if (sorted.length > most) lines.push(textElement("div", "and " + (sorted.length - most) + " more labels"));
  return lines;
}

function lineLegend(section, surfaces) {
  const lines = [];
  const hexadecimal = color => "#" + color.toString(16).padStart(6, "0");
  if (surfaces.isShown || section.axis !== null)
    for (const surface of surfaces.list) lines.push(colorLine(hexadecimal(surface.color), surface.name + " surface of the shell"));
  if (section.axis !== null)
    for (const body of section.bodies.filter(body => body.title)) lines.push(colorLine(hexadecimal(body.color), "section: " + body.title));
  return lines;
}

function colorText(color) {
  return "rgb(" + color.join(",") + ")";
}

function colorLine(color, text) {
  const line = textElement("div", text), square = document.createElement("i");
  square.style.background = color;
  line.prepend(square);
  return line;
}

function textElement(tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  return element;
}
