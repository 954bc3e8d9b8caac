// What the meshes can be colored by. Both meshes have the same choice and the same range of numbers.
class Channels {
  constructor(meshes) {
    this.list = [];
    if (meshes.some(mesh => mesh.hasOwnColors())) this.list.push({ title: "colors of the file", isOwn: true });
    this.list.push({ title: "none", isPlain: true });
    meshes.forEach((mesh, side) => {
      for (let n = 0; hasData(mesh.name + ".channel" + n); ++n) this.add(mesh.name + ".channel" + n, side);
    });
    this.list.push(this.list.splice(this.list.findIndex(channel => channel.isPlain), 1)[0]);
  }

  add(name, side) {
    const title = titleOf(name), labels = name + ".labels";
    let channel = this.list.find(other => other.title === title && other.blocks);
    if (!channel) {
      channel = { title, blocks: [], hasLabels: hasData(labels), names: [] };
      this.list.push(channel);
    }
    if (channel.hasLabels && hasData(labels)) channel.names = linesOf(labels);
    channel.blocks[side] = name;
  }

  // Returns the range of the numbers of both meshes.
  static range(channel) {
    if (!channel.range) {
      channel.range = [Infinity, -Infinity];
      for (const name of channel.blocks.filter(Boolean))
        for (const x of arrayOf(name))
          if (isFinite(x)) channel.range = [Math.min(channel.range[0], x), Math.max(channel.range[1], x)];
    }
    return channel.range;
  }

  // Returns the color of each vertex of a mesh, or null if the channel has none for it.
  static colors(channel, mesh) {
    if (channel.isOwn) return mesh.ownColors();
    if (channel.isPlain || !channel.blocks[mesh.side]) return null;
    const values = arrayOf(channel.blocks[mesh.side]), colors = new Uint8Array(3 * values.length);
    const [low, high] = Channels.range(channel);
    for (let n = 0; n < values.length; ++n) {
      const t = high > low ? (values[n] - low) / (high - low) : isFinite(values[n]) ? 0 : NaN;
      colors.set(channel.hasLabels ? labelColor(values[n]) : scaleColor(t), 3 * n);
    }
    return colors;
  }

  // Returns the value at a place of a mesh as a text, or an empty text.
  static valueAt(channel, mesh, place) {
    if (!channel.blocks || !channel.blocks[mesh.side]) return "";
    const values = arrayOf(channel.blocks[mesh.side]);
    const corners = [0, 1, 2].map(i => values[mesh.triangles[3 * place.triangle + i]]);
    if (channel.hasLabels) return Channels.labelText(channel, corners[place.weights.indexOf(Math.max(...place.weights))]);
    return shortNumber(dot(corners, place.weights));
  }

  static labelText(channel, label) {
    return channel.names[label] || (isFinite(label) ? String(label) : "no value");
  }
}
