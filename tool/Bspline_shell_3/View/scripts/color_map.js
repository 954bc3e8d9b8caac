// Colors of numbers and labels, from 0 to 255.
const unknownColor = [150, 150, 150];

// Returns a color of the space CIELAB, from its lightness, chroma, and hue in degrees.
function fromLCh(lightness, chroma, hue) {
  const angle = hue * Math.PI / 180;
  return [lightness, chroma * Math.cos(angle), chroma * Math.sin(angle)];
}

// Converts a color of the space CIELAB to sRGB.
function toSRGB([lightness, a, b]) {
  const y = (lightness + 16) / 116, inverse = t => t > 6 / 29 ? t ** 3 : 3 * (6 / 29) ** 2 * (t - 4 / 29);
  const X = 0.95047 * inverse(y + a / 500), Y = inverse(y), Z = 1.08883 * inverse(y - b / 200);
  return [3.2406 * X - 1.5372 * Y - 0.4986 * Z, -0.9689 * X + 1.8758 * Y + 0.0415 * Z, 0.0557 * X - 0.2040 * Y + 1.0570 * Z]
    .map(x => Math.min(Math.max(x, 0), 1))
    .map(x => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055)));
}

// Colors from dark violet to yellow. In CIELAB, their distances are equal, so that equal differences of numbers look
// equal.
const scaleColors = (() => {
  const number = 256, samples = 4096, colors = [], lengths = [0];
  const path = t => fromLCh(20 + 70 * t, 45 + 25 * t - 70 * t * (1 - t), 300 - 200 * t);
  for (let n = 1; n <= samples; ++n) lengths.push(lengths[n - 1] + distance(path(n / samples), path((n - 1) / samples)));
  for (let n = 0, at = 0; n < number; ++n) {
    while (lengths[at] < n / (number - 1) * lengths[samples]) ++at;
    colors.push(toSRGB(path(at / samples)));
  }
  return colors;
})();

function scaleColor(t) {
  return t >= 0 && t <= 1 ? scaleColors[Math.round(255 * t)] : unknownColor;
}

// Hues of consecutive labels differ by the golden angle, so that they are easy to distinguish.
function labelColor(label) {
  return isFinite(label) ? toSRGB(fromLCh(62 + 12 * (label % 2), 48, 40 + 137.508 * label)) : unknownColor;
}
