// Colors of numbers and labels, from 0 to 255.
const unknownColor = [150, 150, 150];

// Converts a color of the space CIELAB, given by lightness, chroma, and hue in degrees, to sRGB.
function fromLCh(lightness, chroma, hue) {
  const angle = hue * Math.PI / 180, y = (lightness + 16) / 116;
  const inverse = t => t > 6 / 29 ? t ** 3 : 3 * (6 / 29) ** 2 * (t - 4 / 29);
  const X = 0.95047 * inverse(y + chroma * Math.cos(angle) / 500), Y = inverse(y);
  const Z = 1.08883 * inverse(y - chroma * Math.sin(angle) / 200);
  return [3.2406 * X - 1.5372 * Y - 0.4986 * Z, -0.9689 * X + 1.8758 * Y + 0.0415 * Z, 0.0557 * X - 0.2040 * Y + 1.0570 * Z]
    .map(x => Math.min(Math.max(x, 0), 1))
    .map(x => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055)));
}

// Colors from 0 to 1, whose lightness increases linearly from dark violet to yellow.
const scaleColors = Array.from({ length: 256 }, (_, n) => {
  const t = n / 255;
  return fromLCh(20 + 70 * t, 45 + 25 * t - 70 * t * (1 - t), 300 - 200 * t);
});

function scaleColor(t) {
  return t >= 0 && t <= 1 ? scaleColors[Math.round(255 * t)] : unknownColor;
}

// Hues of consecutive labels differ by the golden angle, so that they are easy to distinguish.
function labelColor(label) {
  return isFinite(label) ? fromLCh(62 + 12 * (label % 2), 48, 40 + 137.508 * label) : unknownColor;
}
