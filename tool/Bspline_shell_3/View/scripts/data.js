// The arrays of the page, which are decoded when they are first used.
const blocks = new Map();
for (const element of document.querySelectorAll("script[data-name]")) blocks.set(element.dataset.name, { element });

const numberTypes = { Float32: Float32Array, Float64: Float64Array, Int32: Int32Array, Uint32: Uint32Array, Uint8: Uint8Array };

function hasData(name) {
  return blocks.has(name);
}

function titleOf(name) {
  return blocks.get(name).element.dataset.title;
}

function bytesOf(name) {
  const text = atob(blocks.get(name).element.textContent);
  const bytes = new Uint8Array(text.length);
  for (let n = 0; n < text.length; ++n) bytes[n] = text.charCodeAt(n);
  return bytes;
}

function arrayOf(name) {
  const block = blocks.get(name);
  if (!block.array) {
    block.array = new numberTypes[block.element.dataset.type](bytesOf(name).buffer);
    block.element.textContent = "";
  }
  return block.array;
}

function linesOf(name) {
  return new TextDecoder().decode(bytesOf(name)).split("\n").slice(0, -1);
}

function imageURL(name) {
  const element = blocks.get(name).element;
  return "data:" + element.dataset.type + ";base64," + element.textContent;
}
