// Coarse geometries, which slow computers draw while the picture moves.
// most triangles of a geometry: software renderers draw two such geometries about 30 times a second
const coarseTriangles = 6000;

// Returns a geometry with the same vertices and fewer triangles: vertices in a cell of a grid are replaced by one of
// them. Returns the geometry itself if it has few triangles.
function coarseGeometry(geometry, radius) {
  const index = geometry.index.array, points = geometry.getAttribute("position").array;
  if (index.length <= 3 * coarseTriangles) return geometry;
  for (let cells = 128; ; cells = Math.floor(cells / 1.3)) {
    const { triangles, groups } = clusteredTriangles(index, geometry.groups, clusters(points, 2 * radius / cells));
    if (triangles.length > 3 * coarseTriangles) continue;
    const coarse = new THREE.BufferGeometry();
    for (const [name, attribute] of Object.entries(geometry.attributes)) coarse.setAttribute(name, attribute);
    coarse.setIndex(new THREE.BufferAttribute(Uint32Array.from(triangles), 1));
    for (const { start, count, materialIndex } of groups) coarse.addGroup(start, count, materialIndex);
    coarse.boundingSphere = geometry.boundingSphere;
    return coarse;
  }
}

// Returns for each vertex the first one in its cell.
function clusters(points, width) {
  const first = new Map(), size = 2 ** 10, result = new Uint32Array(points.length / 3);
  for (let n = 0; n < result.length; ++n) {
    const [i, j, k] = pointAt(points, n).map(x => Math.floor(x / width) + size / 2);
    const key = (i * size + j) * size + k;
    if (!first.has(key)) first.set(key, n);
    result[n] = first.get(key);
  }
  return result;
}

// Returns the triangles whose corners remain different. If there are no groups, all triangles are one.
function clusteredTriangles(index, groups, cluster) {
  const triangles = [], coarseGroups = [];
  for (const { start, count, materialIndex } of groups.length > 0 ? groups : [{ start: 0, count: index.length }]) {
    const begin = triangles.length;
    for (let n = start; n < start + count; n += 3) {
      const a = cluster[index[n]], b = cluster[index[n + 1]], c = cluster[index[n + 2]];
      if (a !== b && b !== c && c !== a) triangles.push(a, b, c);
    }
    if (groups.length > 0) coarseGroups.push({ start: begin, count: triangles.length - begin, materialIndex });
  }
  return { triangles, groups: coarseGroups };
}
