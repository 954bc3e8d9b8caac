// How surfaces, lines, and points are drawn. The clipping plane is common to all of them.
const clipping = { value: new THREE.Vector4(0, 0, 0, 1) }; // points p with dot(p, xyz) > w are not drawn

const discardClipped = `
uniform vec4 clipping;
varying vec3 v_point;
void discardClipped() { if(dot(v_point, clipping.xyz) > clipping.w) discard; }
`;

// Facets are shaded by the angle to the line of sight; their normals are derivatives of the position.
function surfaceMaterial({ image = null, opacity = 1 } = {}) {
  const isTransparent = opacity < 1;
  return new THREE.ShaderMaterial({
    uniforms: { clipping, image: { value: image }, opacity: { value: opacity } },
    defines: image ? { HAS_IMAGE: "" } : {},
    vertexShader: `
      attribute vec3 paint;
      varying vec3 v_point, v_eye, v_paint;
      varying vec2 v_texture;
      void main() {
        vec4 p = modelViewMatrix * vec4(position, 1.0);
        v_point = position;
        v_eye = p.xyz;
        v_paint = paint;
        v_texture = uv;
        gl_Position = projectionMatrix * p;
      }`,
    fragmentShader: discardClipped + `
      uniform sampler2D image;
      uniform float opacity;
      varying vec3 v_eye, v_paint;
      varying vec2 v_texture;
      void main() {
        discardClipped();
        vec3 normal = normalize(cross(dFdx(v_eye), dFdy(v_eye)));
        float light = 0.4 + 0.6 * abs(dot(normal, normalize(v_eye)));
        #ifdef HAS_IMAGE
          vec3 color = texture2D(image, v_texture).rgb;
        #else
          vec3 color = v_paint;
        #endif
        gl_FragColor = vec4(light * color, opacity);
      }`,
    extensions: { derivatives: true },
    side: THREE.DoubleSide,
    transparent: isTransparent,
    depthWrite: !isTransparent,
    polygonOffset: true, // so that edges are in front of facets
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1
  });
}

function lineMaterial(color, { isClipped = true, isAlwaysVisible = false } = {}) {
  return new THREE.ShaderMaterial({
    uniforms: { clipping: isClipped ? clipping : { value: new THREE.Vector4(0, 0, 0, 1) }, color: { value: new THREE.Color(color) } },
    vertexShader: `
      varying vec3 v_point;
      void main() {
        v_point = position;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: discardClipped + `
      uniform vec3 color;
      void main() {
        discardClipped();
        gl_FragColor = vec4(color, 1.0);
      }`,
    depthTest: !isAlwaysVisible,
    transparent: isAlwaysVisible // drawn last
  });
}

// Discs of a size on the screen, in pixels, which are always visible.
function discMaterial(color, size) {
  return new THREE.ShaderMaterial({
    uniforms: { color: { value: new THREE.Color(color) }, size: { value: size * window.devicePixelRatio } },
    vertexShader: `
      uniform float size;
      void main() {
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        gl_PointSize = size;
      }`,
    fragmentShader: `
      uniform vec3 color;
      void main() {
        float r = 2.0 * length(gl_PointCoord - 0.5);
        if(r > 1.0) discard;
        gl_FragColor = vec4(r > 0.7 ? vec3(1.0) : color, 1.0);
      }`,
    depthTest: false,
    transparent: true
  });
}

function pointsGeometry(points) {
  return new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(Float32Array.from(points), 3));
}
