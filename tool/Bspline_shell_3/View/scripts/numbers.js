// Texts of numbers.
function shortNumber(x) {
  return isFinite(x) ? String(Number(x.toPrecision(4))) : "no value";
}

// Points of the page are relative to a center; people read coordinates of the file.
function pointText(p) {
  const center = arrayOf("center");
  return p.map((x, a) => String(Number((x + center[a]).toPrecision(6)))).join(", ");
}
