// Draws bodies at their places with WebGL: two lamps, one of them with shadows, and a ground.

const VERTEX = `#version 300 es
layout(location=0) in vec3 point; layout(location=1) in vec3 normal; layout(location=2) in vec3 colour;
uniform mat4 view, body, lamp;
out vec3 at, up, paint; out vec4 shade;
void main() {
  vec4 world = body * vec4(point, 1.0);
  at = world.xyz; up = mat3(body) * normal; paint = colour;
  shade = lamp * world; gl_Position = view * world;
}`;

const FRAGMENT = `#version 300 es
precision highp float; precision highp sampler2DShadow;
in vec3 at, up, paint; in vec4 shade; out vec4 pixel;
uniform sampler2DShadow shadows; uniform vec3 sun, eye, haze, second, tint; uniform vec4 tile; uniform float ground, glow, veil;
float lit(float facing) {
  vec3 where = shade.xyz / shade.w * 0.5 + 0.5;
  if (any(lessThan(where.xy, vec2(0.0))) || any(greaterThan(where.xy, vec2(1.0))) || where.z > 1.0) return 1.0;
  float offset = 0.0006 + 0.0016 * (1.0 - facing), sum = 0.0, step = 1.0 / float(textureSize(shadows, 0).x);
  for (int i = -1; i <= 1; i++) for (int j = -1; j <= 1; j++)
    sum += texture(shadows, vec3(where.xy + vec2(i, j) * step, where.z - offset));
  return sum / 9.0;
}
void main() {
  vec3 n = normalize(up), colour = paint; float far = distance(at, eye);
  if (tile.z > 0.0) {
    vec2 place = (at.xy - tile.xy) / tile.zw, soft = fwidth(place);
    float odd = mod(floor(place.x) + floor(place.y), 2.0);
    colour = mix(mix(paint, second, odd), 0.5 * (paint + second), clamp(1.6 * max(soft.x, soft.y) - 0.4, 0.0, 1.0));
  }
  if (ground > 0.0) {
    vec2 cell = abs(fract(at.xy - 0.5) - 0.5) / fwidth(at.xy);
    colour *= 1.0 - 0.07 * (1.0 - min(min(cell.x, cell.y), 1.0)) * exp(-0.08 * far);
  }
  float facing = max(dot(n, sun), 0.0), sky = 0.5 + 0.5 * n.z;
  vec3 light = vec3(0.40, 0.41, 0.43) + 0.17 * sky + vec3(0.52, 0.51, 0.48) * facing * lit(facing)
    + vec3(0.10, 0.11, 0.13) * max(dot(n, normalize(vec3(-0.6, 0.5, 0.6))), 0.0);
  vec3 half_ = normalize(sun + normalize(eye - at));
  colour = colour * light + 0.05 * pow(max(dot(n, half_), 0.0), 24.0) * facing;
  colour = mix(colour, tint, glow);
  pixel = vec4(mix(colour, haze, ground * smoothstep(7.0, 26.0, far)), 1.0 - veil);
}`;

const DEPTH = `#version 300 es
layout(location=0) in vec3 point; uniform mat4 body, lamp;
void main() { gl_Position = lamp * body * vec4(point, 1.0); }`;
const NOTHING = `#version 300 es
precision highp float; void main() {}`;

class Drawing {
  constructor(canvas) {
    this.canvas = canvas;
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "low-power" });
    if (!gl) throw new Error("this browser has no WebGL 2: the 3-D picture is left out, the rest works");
    this.gl = gl;
    this.lit = this.program(VERTEX, FRAGMENT);
    this.deep = this.program(DEPTH, NOTHING);
    this.things = [];
    const info = gl.getExtension("WEBGL_debug_renderer_info"), name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
    this.slow = /swiftshader|llvmpipe|software|basic render/i.test(name); // no graphics card
    this.sharp = this.slow ? 0.75 : 1;
    this.shadowed = true;
    this.sun = unit([0.35, -0.45, 1.0]);
    this.shadowMap(this.slow ? 768 : 1536);
  }

  program(vertex, fragment) {
    const gl = this.gl, made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    const names = {};
    for (let k = 0; k < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); k++) {
      const { name } = gl.getActiveUniform(made, k);
      names[name] = gl.getUniformLocation(made, name);
    }
    return { made, names };
  }

  shadowMap(size) {
    const gl = this.gl;
    this.size = size;
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, size, size);
    for (const [key, value] of [
      [gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE], [gl.TEXTURE_MIN_FILTER, gl.LINEAR],
      [gl.TEXTURE_MAG_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
    ]) gl.texParameteri(gl.TEXTURE_2D, key, value);
    this.buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.buffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.texture, 0);
    gl.drawBuffers([gl.NONE]);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  upload(piece) {
    const gl = this.gl, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    [piece.points, piece.normals, piece.colours].forEach((values, place) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(values), gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(piece.faces), gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    return { array, count: piece.faces.length, second: piece.second, tile: piece.tile, origin: piece.origin };
  }

  // What is to be drawn from now on; `things` know the place of their body.
  show(scene) {
    this.things = [];
    const g = 60, h = -0.012, colour = [0.56, 0.59, 0.62];
    const ground = { points: [-g, -g, h, g, -g, h, g, g, h, -g, g, h], normals: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1], colours: [...colour, ...colour, ...colour, ...colour], faces: [0, 1, 2, 0, 2, 3] };
    this.ground = this.upload(ground);
    scene.bodies.forEach((body, place) => {
      for (const piece of pieces(body, scene.meshes)) this.things.push({ ...this.upload(piece), place });
    });
  }

  // A strip on the floor along points [x, y].
  way(points) {
    if (points.length < 2) { this.strip = null; return; }
    const piece = { points: [], normals: [], colours: [], faces: [] };
    points.forEach(([x, y], k) => {
      const [a, b] = [points[Math.max(0, k - 1)], points[Math.min(points.length - 1, k + 1)]];
      const [dx, dy] = [b[0] - a[0], b[1] - a[1]], n = Math.hypot(dx, dy) || 1, w = 0.018;
      piece.points.push(x - dy / n * w, y + dx / n * w, 0.004, x + dy / n * w, y - dx / n * w, 0.004);
      piece.normals.push(0, 0, 1, 0, 0, 1);
      piece.colours.push(0.05, 0.45, 0.75, 0.05, 0.45, 0.75);
      if (k) piece.faces.push(2 * k - 2, 2 * k - 1, 2 * k, 2 * k - 1, 2 * k + 1, 2 * k);
    });
    if (this.strip) this.gl.deleteVertexArray(this.strip.array);
    this.strip = this.upload(piece);
  }

  resize() {
    const scale = Math.min(window.devicePixelRatio || 1, 2) * this.sharp;
    const [w, h] = [Math.round(this.canvas.clientWidth * scale), Math.round(this.canvas.clientHeight * scale)];
    if (this.canvas.width === w && this.canvas.height === h) return false;
    [this.canvas.width, this.canvas.height] = [w, h];
    return true;
  }

  // Draw bodies at `matrices` (null: not there) as seen by `camera`; returns the view's matrix. Of each
  // of `ghosts` ({all: matrices, bodies: a set of places, tint}) these are drawn once more, to be looked through.
  draw(matrices, camera, haze, glows, ghosts) {
    const gl = this.gl, { eye, at } = camera;
    this.resize();
    const view = times(perspective(camera.fovy, this.canvas.width / Math.max(1, this.canvas.height), 0.05, 120), lookAt(eye, at, [0, 0, 1]));
    const reach = Math.max(2.5, Math.min(7, 0.9 * camera.distance)), from = [0, 1, 2].map((k) => at[k] + 9 * this.sun[k]);
    const lamp = times(orthographic(reach, 1, 20), lookAt(from, at, [0, 1, 0]));
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.buffer);
    gl.viewport(0, 0, this.size, this.size);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    if (this.shadowed) {
      gl.useProgram(this.deep.made);
      gl.uniformMatrix4fv(this.deep.names.lamp, false, lamp);
      for (const thing of this.things) {
        if (!matrices[thing.place] || thing.second) continue;
        gl.uniformMatrix4fv(this.deep.names.body, false, matrices[thing.place]);
        gl.bindVertexArray(thing.array);
        gl.drawElements(gl.TRIANGLES, thing.count, gl.UNSIGNED_INT, 0);
      }
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...haze, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { made, names } = this.lit;
    gl.useProgram(made);
    gl.uniformMatrix4fv(names.view, false, view);
    gl.uniformMatrix4fv(names.lamp, false, lamp);
    gl.uniform3fv(names.sun, this.sun);
    gl.uniform3fv(names.eye, eye);
    gl.uniform3fv(names.haze, haze);
    const still = matrixOf(UNIT);
    const paint = (thing, matrix, { ground = 0, glow = 0, veil = 0, tint = [0.1, 0.65, 1.0] } = {}) => {
      gl.uniformMatrix4fv(names.body, false, matrix);
      gl.uniform1f(names.ground, ground);
      gl.uniform1f(names.glow, glow);
      gl.uniform1f(names.veil, veil);
      gl.uniform3fv(names.tint, tint);
      gl.uniform3fv(names.second, thing.second ? thing.second.slice(0, 3) : [0, 0, 0]);
      gl.uniform4fv(names.tile, thing.second ? [...thing.origin, ...thing.tile] : [0, 0, 0, 0]);
      gl.bindVertexArray(thing.array);
      gl.drawElements(gl.TRIANGLES, thing.count, gl.UNSIGNED_INT, 0);
    };
    if (this.ground) paint(this.ground, still, { ground: 1 });
    for (const thing of this.things) if (matrices[thing.place]) paint(thing, matrices[thing.place], { glow: glows[thing.place] || 0 });
    for (const ghost of ghosts) {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      for (const thing of this.things) if (ghost.bodies.has(thing.place)) paint(thing, ghost.all[thing.place], { glow: ghost.tint ? 0.7 : 0.5, veil: 0.6, tint: ghost.tint });
      gl.disable(gl.BLEND);
    }
    gl.disable(gl.CULL_FACE);
    if (this.strip) paint(this.strip, still);
    return view;
  }
}
